//! Tipping: the fate of a hopper whose mass ratio changes, at once or slowly.

use super::finding::{Finding, Table};
use super::humps_of_window::{FROM, TO, estimate, fates, is_incessant, percent};
use super::measure::ratio_ticks;
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{
    CurveLimits, FractionRange, Fractions, Interval, IntervalBasins, Label, Matching, Refinement,
    SplitMix64, Tipping, TippingCounts, fractions_along,
};
use hopper_basin::{
    BranchGround, Fates, HopperFate, first_humps, hopper_basins, known_kinks, tipping_along_drift,
};
use hopper_figures::fate_colors;
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, csv_file, decades, ticks};
use passive_hopper::MassRatio;
use std::collections::BTreeMap;

/// Mass ratios before: up to the largest at which the branches up to α*_6 are proved.
const RATIOS: (f64, f64) = (0.05, 0.8);

/// Neighbours of these mass ratios differ by 25 % at most, and the first steps are 3.5 % of M. Half of that takes twice as long.
const CURVE: CurveLimits = CurveLimits {
    first_steps: 80,
    difference: 0.01,
    relative: 0.25,
    shortest: 1e-3,
    budget: 250,
    matching: Matching::ByLabel,
};

/// Random speeds of a probability: 95 % intervals of ± 0.01 and less where a tenth of them is in the basin.
const SPEEDS: usize = 40_000;
const SEED: u64 = 11;

/// Shortest interval of the basins. What is undecided opens the bounds by some 10⁻⁵.
const REFINEMENT: Refinement =
    Refinement { shortest: 1e-8, undecided: 1e-6, levels: 1_000_000, intervals: 1_000_000 };

/// The drift from the first to the second of these mass ratios, both of the paper, takes 1 to 2⁹ hops.
const DRIFT: (f64, f64) = (0.1, 0.2);
const DOUBLINGS: usize = 9;
/// Speeds of a drift. All hops of all drifts take some seconds.
const DRIFTING: usize = 20_000;

/// Marker and name of the curves of the drift.
const LOOKS: [(u64, Marker); 3] = [(1, Marker::Disc), (2, Marker::Square), (3, Marker::Triangle)];

fn together(label: Label) -> Label {
    if is_incessant(label) { HopperFate::INCESSANT } else { label }
}

fn proved(tipping: &Tipping, from: Label, to: Label) -> Result<FractionRange, Error> {
    let known = tipping.probability(from, to);
    known
        .map(|p| FractionRange { value: p.middle(), lower: p.lower, upper: p.upper })
        .ok_or_else(|| Error::CheckFailed(format!("no speed is known to go to {from}")))
}

fn counted(found: &TippingCounts, from: Label, to: Label) -> Result<FractionRange, Error> {
    let known = found.probability(from, to)?;
    known.map(Into::into).ok_or_else(|| Error::CheckFailed(format!("no speed goes to {from}")))
}

/// The basins at M, of which the branches of the map must be proved.
fn proved_basins(fates: &Fates) -> Result<IntervalBasins, Error> {
    let found = hopper_basins(fates, FROM, TO, 400, REFINEMENT)?;
    let m = fates.map().mass_ratio().value();
    match found.ground {
        BranchGround::Proved => Ok(found.basins),
        _ => Err(Error::CheckFailed(format!("the branches at M = {m} are not proved"))),
    }
}

fn three(p: FractionRange) -> [f64; 3] {
    [p.value, p.lower, p.upper]
}

/// Tipping from each M to 0.2 and to 1, and along a drift from 0.1 to 0.2.
pub(super) fn tipping_of_basins(job: &Job) -> Result<Finding, Error> {
    let all = HopperFate::INCESSANT;
    let (slow, heavy) = (fates(DRIFT.1)?, fates(1.0)?);
    let window = first_humps(TO - FROM);
    // What is common to all mass ratios before.
    let slow_basins = proved_basins(&slow)?;
    let random = SplitMix64::from_seed(SEED);
    let speed = |k: usize| window.left + window.length() * random.uniform(k as u64);
    let speeds: Vec<f64> = (0..SPEEDS).map(speed).collect();
    let at_one = heavy.labels(&speeds)?;
    let mut rows = job.rows("tipping")?;
    let mut sudden: BTreeMap<u64, Vec<f64>> = BTreeMap::new();
    let at = |logarithm: f64| {
        let m = pxfm::f_exp(logarithm);
        let row = rows.next(|| {
            let before = fates(m)?;
            let to_slow = proved_basins(&before)?.tipping_to(&slow_basins)?.relabelled(together);
            let pairs = before.labels(&speeds)?.into_iter().zip(at_one.iter().copied());
            let to_one = TippingCounts::new(pairs)?.relabelled(together);
            Ok([three(proved(&to_slow, all, all)?), three(counted(&to_one, all, all)?)].concat())
        })?;
        let found = [(all, estimate(&row[..3]))].into();
        sudden.insert(m.to_bits(), row);
        Ok::<_, Error>(Fractions { found, ..Fractions::default() })
    };
    let range = Interval::new(pxfm::f_log(RATIOS.0), pxfm::f_log(RATIOS.1))?;
    let kinks: Vec<f64> =
        known_kinks(FROM, TO)?.into_iter().chain([DRIFT.1]).map(pxfm::f_log).collect();
    fractions_along(range, &kinks, CURVE, at)?;
    // The bits of positive numbers are in their order.
    let (ratios, sudden): (Vec<f64>, Vec<Vec<f64>>) =
        sudden.into_iter().map(|(bits, row)| (f64::from_bits(bits), row)).unzip();
    let drifts = job.scan("drifts", DOUBLINGS + 1, |k| {
        let hops = 1usize << k;
        let at = |hop: usize| {
            MassRatio::new(DRIFT.0 + (DRIFT.1 - DRIFT.0) * ((hop + 1) as f64 / hops as f64))
        };
        let drift = (0..hops).map(at).collect::<Result<Vec<_>, _>>()?;
        let found = tipping_along_drift(&fates(DRIFT.0)?, &drift, &slow, window, DRIFTING, SEED)?;
        let stays = |(n, _): &(u64, Marker)| {
            let label = HopperFate::label_of_fixed_point(*n);
            counted(&found, label, label).map(three)
        };
        Ok(LOOKS.iter().map(stays).collect::<Result<Vec<_>, _>>()?.concat())
    })?;
    let mut svg = Svg::new(860.0, 420.0);
    let left =
        Frame::linear(70.0, 34.0, 350.0, 310.0, (RATIOS.0, RATIOS.1), (5e-4, 1.3)).log_x().log_y();
    svg.text(left.left, 22.0, Anchor::Start, 13.0, "(a)  stays incessant, $M$ changes at once");
    let pens = [Pen::solid("#0072b2", 1.7), Pen::dashed("#d55e00", 1.7, "7 3")];
    for (at, (pen, name)) in
        pens.into_iter().zip(["to 0.2, by intervals", "to 1, by points (95 %)"]).enumerate()
    {
        let of = |row: &Vec<f64>| estimate(&row[3 * at..3 * at + 3]);
        bars(&mut svg, &left, &ratios, &sudden.iter().map(of).collect::<Vec<_>>(), pen);
        let y = 312.0 + 17.0 * at as f64;
        svg.line((84.0, y), (114.0, y), pen);
        svg.text(120.0, y + 4.0, Anchor::Start, 11.5, name);
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
        let of = |row: &Vec<f64>| estimate(&row[3 * at..3 * at + 3]);
        let found: Vec<FractionRange> = drifts.iter().map(of).collect();
        bars(&mut svg, &right, &hops, &found, Pen::solid(color, 1.2));
        for (&hops, fraction) in hops.iter().zip(&found) {
            svg.marker(right.at((hops, fraction.value)), marker, 6.5, color);
        }
        let y = 52.0 + 17.0 * at as f64;
        svg.marker((right.left + 16.0, y), marker, 6.5, color);
        let name = format!("basin of $α$^{{∗}}_{{{n}}}");
        svg.text(right.left + 27.0, y + 4.0, Anchor::Start, 11.5, &name);
    }
    let doublings: Vec<_> = hops.iter().step_by(3).map(|&hops| (hops, format!("{hops}"))).collect();
    right.axes(&mut svg, &doublings, &ticks(right.y, 5), "hops of the drift", "probability");
    let data = [
        csv_file(
            "tipping.csv",
            &["mass_ratio", "to_0.2", "lower", "upper", "to_1", "to_1_lower", "to_1_upper"],
            ratios.iter().zip(&sudden).map(|(&m, row)| with(m, row)),
        )?,
        csv_file(
            "drift.csv",
            &[
                "hops", "1", "1_lower", "1_upper", "2", "2_lower", "2_upper", "3", "3_lower",
                "3_upper",
            ],
            hops.iter().zip(&drifts).map(|(&hops, row)| with(hops, row)),
        )?,
    ];
    Ok(Finding {
        figure: Figure {
            name: "beyond_tipping",
            title: "Tipping: the fate of a hopper whose mass ratio changes".into(),
            paper: "The basins at $M$ = 0.1 and at $M$ = 0.2, each for itself.".into(),
            notes: format!(
                "The fixed points do not depend on $M$; their basins do. (a) A lift-off speed of [$α$^{{∗}}_{{1}}, $α$^{{∗}}_{{6}}], \
                 equally likely anywhere in the basins of incessant hopping at $M$, is taken by a sudden change to 0.2 or to 1: \
                 the probability that it still hops for ever. To 0.2 by intersecting basins as intervals, with bounds \
                 thinner than the line (the branches of the map are proved at both mass ratios); to 1, where they are not, by {SPEEDS} \
                 speeds of certain fate. (b) $M$ grows from 0.1 to 0.2 in equal parts from hop to hop, and the orbit follows. \
                 With 1 hop the change is sudden. The slower the drift, the more speeds come into the trap of $M$ = 0.2 before the \
                 trap has shrunk. Orbits of the drift are computed without error bounds."
            ),
            svg,
            data: data.into(),
        },
        table: table(&sudden, &ratios, &slow_basins)?,
    })
}

fn with(first: f64, row: &[f64]) -> Vec<Option<f64>> {
    std::iter::once(first).chain(row.iter().copied()).map(Some).collect()
}

/// A curve with bars.
fn bars(svg: &mut Svg, frame: &Frame, xs: &[f64], found: &[FractionRange], pen: Pen) {
    frame.clipped(svg, |svg| {
        let line: Vec<(f64, f64)> = xs.iter().zip(found).map(|(&x, p)| (x, p.value)).collect();
        frame.polyline(svg, &line, pen);
        for (&x, p) in xs.iter().zip(found) {
            let ends = [p.lower.max(frame.y.0), p.upper].map(|y| frame.at((x, y)));
            svg.line(ends[0], ends[1], Pen::solid(pen.color, 0.9));
        }
    });
}

/// From each basin at 0.1 to each at 0.2, and from some mass ratios to 1.
fn table(sudden: &[Vec<f64>], ratios: &[f64], slow: &IntervalBasins) -> Result<Table, Error> {
    let mut table = Table::new(&[
        "from",
        "decaying",
        "to $α$^{∗}_{1}",
        "$α$^{∗}_{2}",
        "$α$^{∗}_{3}",
        "$α$^{∗}_{4}",
        "$α$^{∗}_{5}",
    ]);
    let found = proved_basins(&fates(DRIFT.0)?)?.tipping_to(slow)?;
    for n in FROM..TO {
        let label = HopperFate::label_of_fixed_point;
        let cell = |to: u64| {
            let p = proved(&found, label(n), label(to))?;
            Ok(format!("{:.4} … {:.4} %", 100.0 * p.lower, 100.0 * p.upper))
        };
        let cells = (0..TO).map(cell).collect::<Result<Vec<_>, Error>>()?;
        let name = format!("$α$^{{∗}}_{{{n}}}, $M$ = 0.1 to 0.2");
        table.row(std::iter::once(name).chain(cells));
    }
    /// Every this many mass ratios one is in the table; the others are in the data.
    const ROWS: usize = 12;
    for (m, row) in ratios.iter().zip(sudden).step_by(ROWS) {
        let p = estimate(&row[3..]);
        let name = format!("incessant, $M$ = {m:.3} to 1");
        let cells = ["–".into(), format!("all: {}", percent(&p)), "–".into()];
        let rest = ["–", "–", "–"].map(String::from);
        table.row(std::iter::once(name).chain(cells).chain(rest));
    }
    Ok(table)
}
