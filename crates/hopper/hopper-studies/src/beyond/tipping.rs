//! Tipping: the fate of a hopper whose mass ratio changes, at once or slowly.

use super::finding::{Finding, Table};
use super::humps_of_window::{
    FROM, TO, bounds, estimate, fates, fraction_curve, fraction_header, fraction_row, is_incessant,
    three,
};
use super::measure::ratio_ticks;
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{
    CurveLimits, FractionRange, Fractions, FractionsAlong, Interval, IntervalBasins, Label,
    Refinement, Tipping, fractions_along,
};
use hopper_basin::{HopperFate, first_humps, known_kinks, tipping_along_drift};
use hopper_figures::fate_colors;
use hopper_proof::basins_at_every_mass_ratio;
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, csv_file, decades, ticks};
use passive_hopper::MassRatio;

/// Mass ratios before the change.
const RATIOS: (f64, f64) = (0.05, 1.0);

/// The mass ratios after the change, with pen and name: one of the paper, and equal masses.
const AFTER: [(f64, Pen, &str); 2] = [
    (0.2, Pen::solid("#0072b2", 1.7), "to 0.2"),
    (1.0, Pen::dashed("#d55e00", 1.7, "7 3"), "to 1"),
];

/// Neighbours of these mass ratios differ by 25 % at most, and the first steps are 3.5 % of M. Half of that takes
/// twice as long.
const CURVE: CurveLimits =
    CurveLimits { first_steps: 86, difference: 0.01, relative: 0.25, shortest: 1e-3, budget: 250 };

/// When the search for intervals stops: at this undecided length below M = 0.83, above it at this number of intervals.
const REFINEMENT: Refinement =
    Refinement { shortest: 1e-8, undecided: 1e-5, levels: 1_000_000, intervals: 200_000 };

/// The drift from the first to the second of these mass ratios, both of the paper, takes 1 to 2⁹ hops.
const DRIFT: (f64, f64) = (0.1, 0.2);
const DOUBLINGS: usize = 9;
/// Random speeds of a drift. All hops of all drifts take some seconds.
const DRIFTING: usize = 20_000;
const SEED: u64 = 11;

/// The basins that are followed along the drift, with their markers.
const LOOKS: [(u64, Marker); 3] = [(1, Marker::Disc), (2, Marker::Square), (3, Marker::Triangle)];

fn together(label: Label) -> Label {
    if is_incessant(label) { HopperFate::INCESSANT } else { label }
}

/// The probability that a speed of the basin `from` comes into the basin `to`, between bounds.
fn probability(tipping: &Tipping, from: Label, to: Label) -> Result<FractionRange, Error> {
    let known = tipping.probability(from, to);
    known
        .map(|p| FractionRange { value: p.middle(), lower: p.lower, upper: p.upper })
        .ok_or_else(|| Error::CheckFailed(format!("no speed is known to go to {from}")))
}

fn interval_basins(mass_ratio: f64) -> Result<IntervalBasins, Error> {
    let fates = fates(mass_ratio)?;
    Ok(basins_at_every_mass_ratio(&fates, FROM, TO, 400, REFINEMENT)?.basins)
}

/// The probabilities that incessant hopping survives the change from each M to each of [`AFTER`], which has labels
/// 0, 1.
fn sudden_changes(job: &Job) -> Result<FractionsAlong, Error> {
    let all = HopperFate::INCESSANT;
    let after: Vec<IntervalBasins> =
        AFTER.iter().map(|(m, ..)| interval_basins(*m)).collect::<Result<_, Error>>()?;
    let mut rows = job.rows("tipping")?;
    let at = |logarithm: f64| {
        let row = rows.next(|| {
            let before = interval_basins(pxfm::f_exp(logarithm))?;
            let survives = |after: &IntervalBasins| {
                let tipping = before.tipping_to(after)?.relabelled(together);
                probability(&tipping, all, all).map(three)
            };
            Ok(after.iter().map(survives).collect::<Result<Vec<_>, Error>>()?.concat())
        })?;
        let found = (0u8..).map(Label::from).zip(row.chunks(3).map(estimate)).collect();
        Ok::<_, Error>(Fractions { found, ..Fractions::default() })
    };
    let range = Interval::new(pxfm::f_log(RATIOS.0), pxfm::f_log(RATIOS.1))?;
    let kinks: Vec<f64> =
        known_kinks(FROM, TO)?.into_iter().chain([AFTER[0].0]).map(pxfm::f_log).collect();
    Ok(fractions_along(range, &kinks, CURVE, at)?.with_parameters(pxfm::f_exp))
}

/// For drifts of 1, 2, 4, … hops: the probabilities that a speed stays in each basin of [`LOOKS`].
fn drifts(job: &Job) -> Result<Vec<Vec<f64>>, Error> {
    let (before, after) = (fates(DRIFT.0)?, fates(DRIFT.1)?);
    job.scan("drifts", DOUBLINGS + 1, |k| {
        let hops = 1usize << k;
        let part = |hop: usize| (hop + 1) as f64 / hops as f64;
        let at = |hop: usize| MassRatio::new(DRIFT.0 + (DRIFT.1 - DRIFT.0) * part(hop));
        let drift = (0..hops).map(at).collect::<Result<Vec<_>, _>>()?;
        let window = first_humps(TO - FROM);
        let found = tipping_along_drift(&before, &drift, &after, window, DRIFTING, SEED)?;
        let stays = |(n, _): &(u64, Marker)| {
            let label = HopperFate::label_of_fixed_point(*n);
            let none = || Error::CheckFailed(format!("no speed goes to {label}"));
            Ok(three(found.probability(label, label)?.ok_or_else(none)?.into()))
        };
        Ok(LOOKS.iter().map(stays).collect::<Result<Vec<_>, Error>>()?.concat())
    })
}

/// Tipping from each M to 0.2 and to 1, and along a drift from 0.1 to 0.2.
pub(super) fn tipping_of_basins(job: &Job) -> Result<Finding, Error> {
    let (sudden, drifts) = (sudden_changes(job)?, drifts(job)?);
    let mut svg = Svg::new(860.0, 420.0);
    let left = Frame::linear(70.0, 34.0, 350.0, 310.0, RATIOS, (1e-3, 1.3)).log_x().log_y();
    svg.text(left.left, 22.0, Anchor::Start, 13.0, "(a)  stays incessant, $M$ changes at once");
    for (at, (_, pen, name)) in (0u8..).zip(AFTER) {
        fraction_curve(&mut svg, &left, &sudden.of(at.into()).collect::<Vec<_>>(), pen);
        svg.line_key((99.0, 312.0 + 17.0 * f64::from(at)), pen, name);
    }
    let few: Vec<_> =
        ratio_ticks().into_iter().filter(|(m, _)| (RATIOS.0..=RATIOS.1).contains(m)).collect();
    left.axes(&mut svg, &few, &decades(left.y, 1), "$M$ before", "probability");
    let most = (1usize << DOUBLINGS) as f64;
    let right = Frame::linear(500.0, 34.0, 340.0, 310.0, (0.8, 1.25 * most), (0.0, 1.0)).log_x();
    svg.text(right.left, 22.0, Anchor::Start, 13.0, "(b)  stays, $M$ drifts from 0.1 to 0.2");
    let hops: Vec<f64> = (0..=DOUBLINGS).map(|k| (1usize << k) as f64).collect();
    for (at, (n, marker)) in LOOKS.into_iter().enumerate() {
        let label = HopperFate::label_of_fixed_point(n);
        let color = fate_colors::css(label);
        let stays = |row: &Vec<f64>| estimate(&row[3 * at..3 * at + 3]);
        let found: Vec<_> = hops.iter().copied().zip(drifts.iter().map(stays)).collect();
        fraction_curve(&mut svg, &right, &found, Pen::solid(color, 1.2));
        for (hops, fraction) in found {
            svg.marker(right.at((hops, fraction.value)), marker, 6.5, color);
        }
        let name = format!("basin of $α$^{{∗}}_{{{n}}}");
        svg.marker_key((right.left + 16.0, 52.0 + 17.0 * at as f64), marker, color, &name);
    }
    let doublings: Vec<_> = hops.iter().step_by(3).map(|&hops| (hops, format!("{hops}"))).collect();
    right.axes(&mut svg, &doublings, &ticks(right.y, 5), "hops of the drift", "probability");
    let changes = sudden.points().iter().map(|(m, found)| {
        let both = [0u8, 1].map(|at| three(found.of(at.into())));
        [&[*m], both.as_flattened()].concat()
    });
    let drifting = hops.iter().zip(&drifts).map(|(&hops, row)| fraction_row(hops, row));
    let data = vec![
        csv_file("tipping.csv", &fraction_header("mass_ratio", &["to_0.2", "to_1"]), changes)?,
        csv_file("drift.csv", &fraction_header("hops", &["1", "2", "3"]), drifting)?,
    ];
    Ok(Finding { figure: Figure::new("beyond_tipping", svg, data, &[])?, table: table(&sudden)? })
}

/// From each basin at 0.1 to each at 0.2, and from some mass ratios to 1.
fn table(sudden: &FractionsAlong) -> Result<Table, Error> {
    let mut table = Table::new(&[
        "from",
        "decaying",
        "to $α$^{∗}_{1}",
        "$α$^{∗}_{2}",
        "$α$^{∗}_{3}",
        "$α$^{∗}_{4}",
        "$α$^{∗}_{5}",
    ]);
    let found = interval_basins(DRIFT.0)?.tipping_to(&interval_basins(DRIFT.1)?)?;
    for n in FROM..TO {
        let label = HopperFate::label_of_fixed_point;
        let cell = |to: u64| Ok(bounds(&probability(&found, label(n), label(to))?));
        let cells = (0..TO).map(cell).collect::<Result<Vec<_>, Error>>()?;
        let name = format!("$α$^{{∗}}_{{{n}}}, $M$ = 0.1 to 0.2");
        table.row(std::iter::once(name).chain(cells));
    }
    /// Every this many mass ratios one is in the table; the others are in the data.
    const ROWS: usize = 12;
    for (m, p) in sudden.of(1.into()).step_by(ROWS) {
        let name = format!("incessant, $M$ = {m:.3} to 1");
        let all = format!("all: {}", bounds(&p));
        table.row([name, "–".into(), all].into_iter().chain(["–"; 4].map(String::from)));
    }
    Ok(table)
}
