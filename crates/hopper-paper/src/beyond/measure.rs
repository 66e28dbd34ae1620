//! The measure of each basin against the mass ratio, and the difference between M and 1/M.

use super::finding::{Finding, Table};
use super::humps_of_window::{
    FROM, TO, bounds, by_humps, estimate, fates, geometric, is_incessant, label, percent,
};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{
    CurveLimits, FractionRange, Fractions, FractionsAlong, Interval, Label,
    equally_spaced_fractions, low_discrepancy_fractions, random_fractions,
};
use hopper_basin::{
    FractionLimits, HopperFate, crisis, fractions_over_mass_ratio, hump_fractions, known_kinks,
};
use hopper_figures::fate_colors;
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, decades};
use std::collections::BTreeMap;

/// Smallest and largest mass ratio, 1/50 to 50, so that each mass ratio has its inverse.
const RATIOS: (f64, f64) = (0.02, 50.0);

/// How finely the mass ratios are divided: neighbours differ by 30 % or by 0.005, a hundredth of the height of the curves, or by less
/// than can be seen. Half of that takes twice as long. The first steps are 4 % of M: peaks such as that at M = 0.1705 are wider.
const CURVE: CurveLimits = CurveLimits {
    first_steps: 200,
    difference: 0.005,
    relative: 0.3,
    shortest: 1e-4,
    budget: 600,
    matching: basin_of_attraction::Matching::ByLabel,
};

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
    let three = |label: Label| {
        let FractionRange { value, lower, upper } = fractions.of(label);
        [value, lower, upper]
    };
    LABELS.into_iter().flat_map(three).collect()
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
    for label in (FROM..TO).rev().map(HopperFate::label_of_fixed_point) {
        curve(&mut svg, &frame, &all, label, fate_colors::css(label), 1.1);
    }
    curve(&mut svg, &frame, &all, ALL, "#000000", 1.8);
    frame.axes(
        &mut svg,
        &ratio_ticks(),
        &decades(frame.y, 1),
        "mass ratio $M$ = $m$_{2}/$m$_{1}",
        "fraction of the window",
    );
    legend(&mut svg);
    let rows = all
        .points()
        .iter()
        .map(|(m, fractions)| std::iter::once(*m).chain(numbers(fractions)).map(Some).collect());
    let names = ["1", "2", "3", "4", "5", "all", "decaying", "grounded"];
    let header: Vec<String> = std::iter::once("mass_ratio".to_owned())
        .chain(names.iter().flat_map(|n| ["", "_lower", "_upper"].map(|end| format!("{n}{end}"))))
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let data = csv_file("measure.csv", &header, rows)?;
    let steep = all.jumps().map(|step| {
        let row =
            [step.from, step.to, step.label.code().into(), step.before.value, step.after.value];
        row.map(Some).to_vec()
    });
    let steep = csv_file("measure_jumps.csv", &["from", "to", "label", "before", "after"], steep)?;
    let places: Vec<String> = all.jumps().map(|step| format!("{:.4}", step.from)).collect();
    Ok(Finding {
        figure: Figure {
            name: "beyond_measure",
            title: "Measure of the basins against the mass ratio".into(),
            paper: "Measures at $M$ = 0.1 (1, and 0.953 for the first basin) and $M$ = 0.2 (0.037), by \
                    50 000 points each, without errors; “falls rapidly with $M$”."
                .into(),
            notes: format!(
                "Basin fractions of [$α$^{{∗}}_{{1}}, $α$^{{∗}}_{{6}}], humps weighted equally as in the paper; \
                 where the branches of the map are proved ($M$ ≤ 0.83 and more) by intervals down to 10^{{−7}}, with bounds up \
                 to rounding; beyond, by one random point in each of {} equal parts, with 95 % intervals. {} mass ratios: \
                 steps are halved until neighbours differ by at most 30 % or 0.005. {} steps remain larger, {} of them of \
                 2·10^{{−4}} of $M$ at most, at $M$ = {}: a fraction jumps there, or rises from zero with a vertical tangent, as behind \
                 a crisis or an onset of grounding. Ticks at the top: the crises of \
                 the humps 1 to 5, the onsets of grounding, and their inverses. The collapse is the crisis of hump 1 at $M$_{{c}}(1) = {touch:.5}: \
                 there it falls through its fixed point. Between it and its inverse the measure falls and \
                 rises by a factor of 300, with spikes where whole parts of a hump fall into the trap of \
                 $α$^{{∗}}_{{1}} at once (at $M$ = 0.1705, three times its neighbours). At 1/$M$_{{c}}(1) nearly all \
                 of it is back; what is missing beyond, a thousandth and less, falls through needles in the \
                 sudden windows.",
                FractionLimits::default().points,
                all.points().len(),
                all.unresolved().len(),
                places.len(),
                places.join(", "),
            ),
            svg,
            data: vec![data, steep],
        },
        table: three_ways()?,
    })
}

fn curve(
    svg: &mut Svg,
    frame: &Frame,
    all: &FractionsAlong,
    label: Label,
    color: &'static str,
    width: f64,
) {
    let found: Vec<(f64, FractionRange)> =
        all.of(label).filter(|(_, fraction)| fraction.value > frame.y.0).collect();
    frame.clipped(svg, |svg| {
        let line: Vec<_> = found.iter().map(|(m, fraction)| (*m, fraction.value)).collect();
        frame.polyline(svg, &line, Pen::solid(color, width));
        for (m, fraction) in &found {
            let ends = [fraction.lower.max(frame.y.0), fraction.upper].map(|y| frame.at((*m, y)));
            svg.line(ends[0], ends[1], Pen::solid(color, 0.8));
        }
    });
}

/// Ticks 0.02, 0.05, 0.1, …, 50 of an axis of mass ratios.
pub(super) fn ratio_ticks() -> Vec<(f64, String)> {
    [0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]
        .into_iter()
        .map(|m| (m, format!("{m}")))
        .collect()
}

fn legend(svg: &mut Svg) {
    let mut x = 78.0;
    svg.line((x, 465.0), (x + 20.0, 465.0), Pen::solid("#000000", 2.0));
    svg.text(x + 25.0, 469.0, Anchor::Start, 11.5, "all together");
    x += 110.0;
    for n in (FROM..TO).map(HopperFate::label_of_fixed_point) {
        svg.line((x, 465.0), (x + 20.0, 465.0), Pen::solid(fate_colors::css(n), 1.4));
        svg.text(x + 25.0, 469.0, Anchor::Start, 11.5, &fate_colors::name(n));
        x += 82.0;
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

/// M, the fraction of incessant starts at M and at 1/M, and the fraction of starts whose fates differ.
type AsymmetryRow = (f64, f64, f64, f64);

/// The basins at M compared with those at 1/M.
pub(super) fn asymmetry(job: &Job) -> Result<Finding, Error> {
    let ratios = geometric(RATIOS.0, 1.0, 61);
    let scan = job.scan("asymmetry", ratios.len(), |k| {
        let (light, heavy) = (fates(ratios[k])?, fates(1.0 / ratios[k])?);
        let compare = |place: f64| {
            let alpha = by_humps(place);
            let (one, two) = (label(&light, alpha), label(&heavy, alpha));
            Label::from(
                u8::from(is_incessant(one))
                    + 2 * u8::from(is_incessant(two))
                    + 4 * u8::from(one != two),
            )
        };
        let counts = low_discrepancy_fractions(window()?, POINTS, SEED, compare)?;
        let sum = |bit: u16| -> f64 {
            counts
                .iter()
                .filter(|(k, _)| k.code() & bit != 0)
                .map(|(_, fraction)| fraction.value)
                .sum()
        };
        // The bit belongs to several counted kinds. The sum of their half widths bounds the half width of the sum.
        let width = |bit: u16| -> f64 {
            counts
                .iter()
                .filter(|(k, _)| k.code() & bit != 0)
                .map(|(_, fraction)| fraction.half_width())
                .sum()
        };
        Ok([1, 2, 4].into_iter().flat_map(|bit| [sum(bit) + 0.0, width(bit) + 0.0]).collect())
    })?;
    let rows: Vec<AsymmetryRow> =
        ratios.iter().zip(&scan).map(|(&m, row)| (m, row[0], row[2], row[4])).collect();
    let mut svg = Svg::new(640.0, 430.0);
    let frame =
        Frame::linear(70.0, 20.0, 540.0, 350.0, (RATIOS.0, 1.0), (1e-3, 1.5)).log_x().log_y();
    type AsymmetryCurve = fn(&AsymmetryRow) -> f64;
    let curves: [(AsymmetryCurve, Pen, &str); 3] = [
        (|row| row.1, Pen::solid("#0072b2", 1.8), "incessant at $M$"),
        (|row| row.2, Pen::dashed("#d55e00", 1.8, "7 3"), "incessant at 1/$M$"),
        (|row| row.3, Pen::dashed("#444444", 1.4, "1.6 2.6"), "fate at $M$ and at 1/$M$ differ"),
    ];
    for (k, (column, pen, name)) in curves.into_iter().enumerate() {
        let points: Vec<_> = rows.iter().map(|row| (row.0, column(row).max(frame.y.0))).collect();
        frame.clipped(&mut svg, |svg| frame.polyline(svg, &points, pen));
        let y = 310.0 + 18.0 * k as f64;
        svg.line((95.0, y), (125.0, y), pen);
        svg.text(131.0, y + 4.0, Anchor::Start, 11.5, name);
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
        let cell = |k: usize| format!("{:.3} ± {:.3} %", 100.0 * row[k], 100.0 * row[k + 1]);
        table.row([format!("{m:.4}"), cell(0), cell(2), cell(4)]);
    }
    let data = ratios
        .iter()
        .zip(&scan)
        .map(|(&m, row)| std::iter::once(m).chain(row.iter().copied()).map(Some).collect());
    Ok(Finding {
        figure: Figure {
            name: "beyond_asymmetry",
            title: "The basins at $M$ and at 1/$M$ differ, although the traps are the same".into(),
            paper: "The dynamics is invariant under $M$ → 1/$M$, outside the windows of sudden \
                    lift-off."
                .into(),
            notes: "The intervals of attraction are the same at $M$ and 1/$M$; the basins are not, since \
                    orbits pass the sudden windows ($nπ$, $α$^{∗}_{n}), where the map is not invariant. \
                    The measure at 1/$M$ is up to three times that at $M$, or down to half of it. For $M$ > 1/3 up to \
                    half of all starts have another fate: mostly it is decaying against grounded."
                .into(),
            svg,
            data: vec![csv_file(
                "asymmetry.csv",
                &[
                    "mass_ratio",
                    "incessant",
                    "incessant_half_width",
                    "incessant_at_inverse",
                    "incessant_at_inverse_half_width",
                    "fates_differ",
                    "fates_differ_half_width",
                ],
                data,
            )?],
        },
        table,
    })
}
