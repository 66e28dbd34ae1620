//! The measure of each basin against the mass ratio, and the difference between M and 1/M.

use super::finding::{Finding, Table};
use super::humps_of_window::{
    FROM, FractionWithBar, TO, bounds, by_humps, estimate, fates, geometric, hump, is_incessant,
    label, percent,
};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{
    Bounds, Interval, Label, Refinement, equally_spaced_fractions, low_discrepancy_fractions,
    proportion_interval, random_fractions,
};
use hopper_basin::{Fates, HopperFate, crisis, hopper_basins};
use hopper_figures::fate_colors;
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, decades};
use std::collections::BTreeMap;

/// Smallest and largest mass ratio and their number, equally spaced on a logarithmic scale: 1/50 to 50, so that each
/// mass ratio has its inverse.
const RATIOS: (f64, f64, usize) = (0.02, 50.0, 121);

/// Largest mass ratio at which basins are computed as intervals. Up to it a hop has at most one sudden lift-off, so
/// that its branches are known. For larger mass ratios fractions are estimated from points.
const BY_INTERVALS: f64 = 0.905;
/// Shortest interval whose preimages are computed. Shorter intervals widen the bounds of the measure.
const SHORTEST: f64 = 1e-7;
/// Points, one at random in each of as many parts of the window: about the 50 000 of the paper.
const POINTS: usize = 64_000;
/// Seed of the random points. Another seed changes the data within their intervals.
const SEED: u64 = 2002;

/// The label of all incessant fates together. Fates have labels up to `LARGEST_LABEL` = 65 000, or above 65 530. This label
/// lies between them and belongs to no fate.
const ALL: Label = Label::numbered::<65_525>();

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

type FractionsWithBars = BTreeMap<Label, FractionWithBar>;

/// The window as an interval in which each hump has length one.
fn window() -> Result<Interval, Error> {
    Ok(Interval::new(0.0, (TO - FROM) as f64)?)
}

/// Basin fractions of all labels, and of all incessant fates together.
fn fractions_with_bars(mass_ratio: f64) -> Result<FractionsWithBars, Error> {
    let fates = fates(mass_ratio)?;
    if mass_ratio <= BY_INTERVALS {
        return fractions_by_intervals(&fates, SHORTEST);
    }
    let at = |place: f64| label(&fates, by_humps(place));
    let mut fractions = low_discrepancy_fractions(window()?, POINTS, SEED, at)?;
    let together = |place: f64| if is_incessant(at(place)) { ALL } else { Label::from(0) };
    let all = low_discrepancy_fractions(window()?, POINTS, SEED, together)?;
    fractions.extend(all.get(&ALL).map(|&fraction| (ALL, fraction)));
    let mut fractions: FractionsWithBars =
        fractions.into_iter().map(|(label, fraction)| (label, fraction.into())).collect();
    // A label that no point has may still have a fraction: its interval is that of 0 hits.
    let unseen = proportion_interval(0, POINTS)?;
    LABELS.into_iter().for_each(|label| {
        fractions.entry(label).or_insert(unseen.into());
    });
    Ok(fractions)
}

/// The same fractions with bounds, from basins as intervals: means over the humps.
fn fractions_by_intervals(fates: &Fates, shortest: f64) -> Result<FractionsWithBars, Error> {
    let refinement = Refinement { shortest, ..Refinement::default() };
    let found = hopper_basins(fates, FROM, TO, 400, refinement)?.basins;
    let mut fractions = FractionsWithBars::new();
    for n in FROM..TO {
        let part = found.within(hump(n)?)?;
        let scale = 1.0 / (part.window().length() * (TO - FROM) as f64);
        let mut add = |label: Label, resolved: f64, length: Bounds| {
            let none = FractionWithBar { value: 0.0, lower: 0.0, upper: 0.0 };
            let fraction = fractions.entry(label).or_insert(none);
            fraction.value += scale * resolved;
            fraction.lower += scale * length.lower;
            fraction.upper += scale * length.upper;
        };
        for label in LABELS.into_iter().filter(|&label| label != ALL) {
            add(label, part.resolved_length(label), part.basin_length(label));
        }
        let all = (part.resolved_length_of(is_incessant), part.basin_length_of(is_incessant));
        add(ALL, all.0, all.1);
    }
    Ok(fractions)
}

/// Measures from M = 0.02 to 50.
pub(super) fn measure(job: &Job) -> Result<Finding, Error> {
    let ratios = geometric(RATIOS.0, RATIOS.1, RATIOS.2);
    let scan = job.scan("measures", ratios.len(), |k| {
        let fractions = fractions_with_bars(ratios[k])?;
        let numbers =
            |label: Label| fractions.get(&label).map_or([0.0; 3], |s| [s.value, s.lower, s.upper]);
        Ok(LABELS.into_iter().flat_map(numbers).collect())
    })?;
    let fractions_of =
        |row: &Vec<f64>| LABELS.into_iter().zip(row.chunks(3).map(estimate)).collect();
    let all: Vec<(f64, FractionsWithBars)> =
        ratios.iter().zip(&scan).map(|(&m, row)| (m, fractions_of(row))).collect();
    let mut svg = Svg::new(700.0, 470.0);
    let frame =
        Frame::linear(70.0, 20.0, 600.0, 380.0, (RATIOS.0, RATIOS.1), (1e-5, 1.5)).log_x().log_y();
    let touch = crisis(1)?.mass_ratio;
    for m in [touch, 1.0 / touch] {
        let x = frame.at((m, 1.0)).0;
        svg.line((x, frame.top), (x, frame.top + frame.height), Pen::dashed("#888", 0.8, "4 3"));
    }
    let x = frame.at((touch, 1.0)).0;
    svg.text(x - 4.0, frame.top + frame.height - 8.0, Anchor::End, 11.0, "$M$_{c}(1)");
    let x = frame.at((1.0 / touch, 1.0)).0;
    svg.text(x + 4.0, frame.top + frame.height - 8.0, Anchor::Start, 11.0, "1/$M$_{c}(1)");
    for label in (FROM..TO).rev().map(HopperFate::label_of_fixed_point) {
        curve(&mut svg, &frame, &all, label, fate_colors::css(label), 1.1);
    }
    curve(&mut svg, &frame, &all, ALL, "#000000", 2.0);
    frame.axes(
        &mut svg,
        &ratio_ticks(),
        &decades(frame.y, 1),
        "mass ratio $M$ = $m$_{2}/$m$_{1}",
        "fraction of the window",
    );
    legend(&mut svg);
    let rows = all.iter().map(|(m, fractions)| {
        let cells = |label: Label| {
            let fraction = fractions.get(&label);
            [fraction.map(|s| s.value), fraction.map(|s| s.lower), fraction.map(|s| s.upper)]
        };
        std::iter::once(Some(*m)).chain(LABELS.into_iter().flat_map(cells)).collect()
    });
    let names = ["1", "2", "3", "4", "5", "all", "decaying", "grounded"];
    let header: Vec<String> = std::iter::once("mass_ratio".to_owned())
        .chain(names.iter().flat_map(|n| ["", "_lower", "_upper"].map(|end| format!("{n}{end}"))))
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let data = csv_file("measure.csv", &header, rows)?;
    Ok(Finding {
        figure: Figure {
            name: "beyond_measure",
            title: "Measure of the basins against the mass ratio".into(),
            paper: "Measures at $M$ = 0.1 (1, and 0.953 for the first basin) and $M$ = 0.2 (0.037), by \
                    50 000 points each, without errors; “falls rapidly with $M$”."
                .into(),
            notes: format!(
                "Basin fractions of [$α$^{{∗}}_{{1}}, $α$^{{∗}}_{{6}}], humps weighted equally as in the paper; \
                 for $M$ ≤ 0.905 by intervals down to 10^{{−7}}, with bounds that hold for the branches found \
                 and up to rounding; beyond, by one random point in each of {POINTS} equal parts, with 95 % intervals. The collapse is the crisis of hump 1 at $M$_{{c}}(1) = {touch:.5}: \
                 there it falls through its fixed point. Between it and its inverse the measure falls and \
                 rises by a factor of 300, with spikes where whole parts of a hump fall into the trap of \
                 $α$^{{∗}}_{{1}} at once (near $M$ = 0.172, three times its neighbours). At 1/$M$_{{c}}(1) nearly all \
                 of it is back; what is missing beyond, a thousandth and less, falls through needles in the \
                 sudden windows."
            ),
            svg,
            data: vec![data],
        },
        table: three_ways()?,
    })
}

fn curve(
    svg: &mut Svg,
    frame: &Frame,
    all: &[(f64, FractionsWithBars)],
    label: Label,
    color: &'static str,
    width: f64,
) {
    let found: Vec<(f64, FractionWithBar)> = all
        .iter()
        .filter_map(|(m, fractions)| Some((*m, *fractions.get(&label)?)))
        .filter(|(_, fraction)| fraction.value > frame.y.0)
        .collect();
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
    svg.line((x, 455.0), (x + 20.0, 455.0), Pen::solid("#000000", 2.0));
    svg.text(x + 25.0, 459.0, Anchor::Start, 11.5, "all together");
    x += 110.0;
    for n in (FROM..TO).map(HopperFate::label_of_fixed_point) {
        svg.line((x, 455.0), (x + 20.0, 455.0), Pen::solid(fate_colors::css(n), 1.4));
        svg.text(x + 25.0, 459.0, Anchor::Start, 11.5, &fate_colors::name(n));
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
    fn percent_of_all<F: Copy + Into<FractionWithBar>>(fractions: &BTreeMap<Label, F>) -> String {
        fractions.get(&ALL).map_or("0".into(), |&fraction| percent(&fraction.into()))
    }
    for m in [0.1, 0.15, 0.2, 0.3, 0.5, 0.8] {
        let fates = fates(m)?;
        let together = |place: f64| {
            if is_incessant(label(&fates, by_humps(place))) { ALL } else { Label::from(0) }
        };
        let certain = fractions_by_intervals(&fates, 1e-7)?;
        table.row([
            format!("{m}"),
            certain.get(&ALL).map_or("0".into(), bounds),
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
