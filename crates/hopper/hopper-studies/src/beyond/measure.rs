//! The measure of each basin against the mass ratio, and the difference between M and 1/M.

use super::finding::{Finding, Table};
use super::humps_of_window::{
    FROM, TO, bounds, by_humps, estimate, fates, fraction_curve, fraction_header, fraction_row,
    geometric, is_incessant, label, percent, three,
};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{
    CurveLimits, FractionRange, Fractions, Interval, Label, UnresolvedStep,
    equally_spaced_fractions, low_discrepancy_fractions, random_fractions, stratified_fractions,
    stratified_points,
};
use hopper_basin::{
    FractionLimits, HopperFate, MinimumOnFixedPoint, crisis, fractions_over_mass_ratio,
    hump_fractions, known_kinks, minima_on_fixed_points,
};
use hopper_figures::fate_colors;
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, decades};
use std::collections::BTreeMap;

/// Smallest and largest mass ratio, 1/50 to 50, so that each mass ratio has its inverse.
const RATIOS: (f64, f64) = (0.02, 50.0);

/// How finely the mass ratios are divided: neighbours differ by 30 % or by 0.005, a hundredth of the height of the
/// curves, or by less than can be seen. Half of that takes twice as long. The first steps are 4 % of M: peaks such
/// as that at M = 0.1705 are wider.
const CURVE: CurveLimits =
    CurveLimits { first_steps: 200, difference: 0.005, relative: 0.3, shortest: 1e-4, budget: 600 };

/// Points and seed of the comparison with the paper's way of counting.
const POINTS: usize = 64_000;
const SEED: u64 = 2002;

/// The label of all incessant fates together.
const ALL: Label = HopperFate::INCESSANT;

/// Labels in the order of the columns of the data.
const LABELS: [Label; 8] = [
    Label::numbered::<1>(),
    Label::numbered::<2>(),
    Label::numbered::<3>(),
    Label::numbered::<4>(),
    Label::numbered::<5>(),
    ALL,
    Label::numbered::<0>(),
    HopperFate::GROUNDED,
];

/// The window as an interval in which each hump has length one.
fn window() -> Result<Interval, Error> {
    Ok(Interval::new(0.0, (TO - FROM) as f64)?)
}

/// The fractions as numbers, and back.
fn numbers(fractions: &Fractions) -> Vec<f64> {
    LABELS.into_iter().flat_map(|label| three(fractions.of(label))).collect()
}

fn from_numbers(row: &[f64]) -> Fractions {
    let found = LABELS.into_iter().zip(row.chunks(3).map(estimate)).collect();
    Fractions { found, ..Fractions::default() }
}

/// Measures from M = 0.02 to 50.
pub(super) fn measure(job: &Job) -> Result<Finding, Error> {
    let mut rows = job.rows("measures")?;
    let at = |m: f64| {
        let compute =
            || Ok(numbers(&hump_fractions(&fates(m)?, FROM, TO, FractionLimits::default())?.0));
        Ok::<_, Error>(from_numbers(&rows.next(compute)?))
    };
    let ratios = Interval::new(RATIOS.0, RATIOS.1)?;
    let all = fractions_over_mass_ratio(ratios, FROM, TO, CURVE, at)?;
    let mut svg = Svg::new(700.0, 480.0);
    let frame = Frame::linear(70.0, 20.0, 600.0, 380.0, RATIOS, (1e-5, 1.5)).log_x().log_y();
    for m in known_kinks(FROM, TO)?.into_iter().filter(|m| (RATIOS.0..RATIOS.1).contains(m)) {
        let x = frame.at((m, 1.0)).0;
        svg.line((x, frame.top), (x, frame.top + 6.0), Pen::solid("#000", 0.8));
    }
    let touch = crisis(1)?.mass_ratio;
    for (m, anchor, text) in
        [(touch, Anchor::End, "$M$_{c}(1)"), (1.0 / touch, Anchor::Start, "1/$M$_{c}(1)")]
    {
        let (x, bottom) = (frame.at((m, 1.0)).0, frame.top + frame.height);
        svg.line((x, frame.top), (x, bottom), Pen::dashed("#888", 0.8, "4 3"));
        let aside = if anchor == Anchor::End { -4.0 } else { 4.0 };
        svg.text(x + aside, bottom - 8.0, anchor, 11.0, text);
    }
    let mut curve = |label: Label, pen: Pen| {
        let found: Vec<_> =
            all.of(label).filter(|(_, fraction)| fraction.value > frame.y.0).collect();
        fraction_curve(&mut svg, &frame, &found, pen);
    };
    for label in (FROM..TO).rev().map(HopperFate::label_of_fixed_point) {
        curve(label, Pen::solid(fate_colors::css(label), 1.1));
    }
    curve(ALL, Pen::solid("#000000", 1.8));
    frame.axes(
        &mut svg,
        &ratio_ticks(),
        &decades(frame.y, 1),
        "mass ratio $M$ = $m$_{2}/$m$_{1}",
        "fraction of the window",
    );
    legend(&mut svg);
    let names = ["1", "2", "3", "4", "5", "all", "decaying", "grounded"];
    let rows: Vec<(f64, Vec<f64>)> =
        all.points().iter().map(|(m, fractions)| (*m, numbers(fractions))).collect();
    let rows = rows.iter().map(|(m, row)| fraction_row(*m, row));
    let data = csv_file("measure.csv", &fraction_header("mass_ratio", &names), rows)?;
    let falls = all.jumps().map(fall).collect::<Result<Vec<_>, Error>>()?;
    let steep = all.jumps().zip(&falls).map(|(step, fall)| {
        let label = f64::from(step.label.code());
        let known = [step.from, step.to, label, step.before.value, step.after.value].map(Some);
        let fall = fall.map(|fall| {
            [fall.mass_ratio, fall.hump as f64, f64::from(fall.hops), fall.fixed_point as f64]
        });
        known.into_iter().chain(fall.map_or([None; 4], |fall| fall.map(Some)))
    });
    let header =
        ["from", "to", "label", "before", "after", "mass_ratio", "hump", "hops", "fixed_point"];
    let steep = csv_file("measure_jumps.csv", &header, steep)?;
    let causes: Vec<String> =
        all.jumps().zip(&falls).map(|(step, fall)| cause(step, fall)).collect();
    Ok(Finding {
        figure: Figure::new(
            "beyond_measure",
            svg,
            vec![data, steep],
            &[
                ("points", FractionLimits::default().points.to_string()),
                ("ratios", all.points().len().to_string()),
                ("larger", all.unresolved().len().to_string()),
                ("explained", causes.len().to_string()),
                ("causes", causes.join("; ")),
                ("touch", format!("{touch:.5}")),
            ],
        )?,
        table: three_ways()?,
    })
}

/// Hops within which an orbit from a minimum of the map is followed.
const HOPS: u8 = 6;

/// The first fall of a minimum onto a fixed point in a step or one of its neighbours. The square root may begin
/// beside the step in which it changes too much.
fn fall(step: &UnresolvedStep) -> Result<Option<MinimumOnFixedPoint>, Error> {
    let width = step.to - step.from;
    let around = Interval::new(step.from - width, step.to + width)?;
    Ok(minima_on_fixed_points(around, TO - 1, HOPS)?.first().copied())
}

fn cause(step: &UnresolvedStep, fall: &Option<MinimumOnFixedPoint>) -> String {
    match fall {
        Some(MinimumOnFixedPoint { mass_ratio, hump, hops, fixed_point }) => {
            format!(
                "$M$ = {mass_ratio:.5}, from hump {hump} to $α$^{{∗}}_{{{fixed_point}}} in {hops}"
            )
        }
        None => format!("$M$ = {:.5}, none found in {HOPS} hops", step.from),
    }
}

/// Ticks 0.02, 0.05, 0.1, …, 50 of an axis of mass ratios.
pub(super) fn ratio_ticks() -> Vec<(f64, String)> {
    [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]
        .into_iter()
        .map(|m| (m, format!("{m}")))
        .collect()
}

fn legend(svg: &mut Svg) {
    svg.line_key((92.0, 465.0), Pen::solid("#000000", 2.0), "all together");
    for (n, label) in (FROM..TO).map(HopperFate::label_of_fixed_point).enumerate() {
        let at = (202.0 + 88.0 * n as f64, 465.0);
        svg.line_key(at, Pen::solid(fate_colors::css(label), 1.4), &fate_colors::name(label));
    }
}

/// The measure of all incessant hopping by intervals and by three kinds of points.
fn three_ways() -> Result<Table, Error> {
    let mut table = Table::new(&[
        "$M$",
        "intervals (bounds)",
        "equally spaced, 50 000 (as the paper)",
        "random, 50 000",
        "low discrepancy, 50 000",
    ]);
    fn percent_of_all<F: Copy + Into<FractionRange>>(fractions: &BTreeMap<Label, F>) -> String {
        fractions.get(&ALL).map_or("0".into(), |&fraction| percent(&fraction.into()))
    }
    for m in [0.1, 0.15, 0.2, 0.3, 0.5, 0.8] {
        let fates = fates(m)?;
        let together = |place: f64| {
            if is_incessant(label(&fates, by_humps(place))) { ALL } else { Label::from(0) }
        };
        let (certain, _) = hump_fractions(&fates, FROM, TO, FractionLimits::default())?;
        table.row([
            format!("{m}"),
            bounds(&certain.of(ALL)),
            percent_of_all(&equally_spaced_fractions(window()?, 50_000, together)?),
            percent_of_all(&random_fractions(window()?, 50_000, SEED, together)?),
            percent_of_all(&low_discrepancy_fractions(window()?, 50_000, SEED, together)?),
        ]);
    }
    Ok(table)
}

/// The basins at M compared with those at 1/M.
pub(super) fn asymmetry(job: &Job) -> Result<Finding, Error> {
    let ratios = geometric(RATIOS.0, 1.0, 61);
    let places = stratified_points(window()?, POINTS, SEED)?;
    let speeds: Vec<f64> = places.into_iter().map(by_humps).collect();
    let scan = job.scan("asymmetry", ratios.len(), |k| {
        let light = fates(ratios[k])?.labels(&speeds)?;
        let heavy = fates(1.0 / ratios[k])?.labels(&speeds)?;
        let fraction = |is: fn(Label, Label) -> bool| {
            let starts = light.iter().zip(&heavy).map(|(&one, &two)| Label::from(is(one, two)));
            let found = stratified_fractions(&starts.collect::<Vec<_>>())?;
            Ok(found.get(&Label::from(true)).map_or([0.0; 3], |&part| three(part.into())))
        };
        let found: Result<Vec<_>, Error> = [
            fraction(|light, _| is_incessant(light)),
            fraction(|_, heavy| is_incessant(heavy)),
            fraction(|light, heavy| light != heavy),
        ]
        .into_iter()
        .collect();
        Ok(found?.concat())
    })?;
    let mut svg = Svg::new(640.0, 430.0);
    let frame =
        Frame::linear(70.0, 20.0, 540.0, 350.0, (RATIOS.0, 1.0), (1e-3, 1.5)).log_x().log_y();
    let curves = [
        (Pen::solid("#0072b2", 1.8), "incessant at $M$"),
        (Pen::dashed("#d55e00", 1.8, "7 3"), "incessant at 1/$M$"),
        (Pen::dashed("#444444", 1.4, "1.6 2.6"), "fate at $M$ and at 1/$M$ differ"),
    ];
    for (k, (pen, name)) in curves.into_iter().enumerate() {
        let points: Vec<_> =
            ratios.iter().zip(&scan).map(|(&m, row)| (m, row[3 * k].max(frame.y.0))).collect();
        frame.clipped(&mut svg, |svg| frame.polyline(svg, &points, pen));
        svg.line_key((110.0, 310.0 + 18.0 * k as f64), pen, name);
    }
    let ticks: Vec<_> = ratio_ticks().into_iter().filter(|(m, _)| *m <= 1.0).collect();
    frame.axes(
        &mut svg,
        &ticks,
        &decades(frame.y, 1),
        "$M$, or its inverse",
        "fraction of the window",
    );
    let mut table = Table::new(&["$M$", "incessant at $M$", "at 1/$M$", "fates differ"]);
    for (m, row) in ratios.iter().zip(&scan).step_by(6) {
        let cells = row.chunks(3).map(|three| percent(&estimate(three)));
        table.row([format!("{m:.4}")].into_iter().chain(cells));
    }
    let header =
        fraction_header("mass_ratio", &["incessant", "incessant_at_inverse", "fates_differ"]);
    let rows = ratios.iter().zip(&scan).map(|(&m, row)| fraction_row(m, row));
    let data = csv_file("asymmetry.csv", &header, rows)?;
    Ok(Finding { figure: Figure::new("beyond_asymmetry", svg, vec![data], &[])?, table })
}
