//! The basins on each hump: their fractions repeat from hump to hump.

use super::finding::{Finding, Table};
use super::humps_of_window::{fates, hump, is_incessant};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::Refinement;
use hopper_basin::{HopperFate, hopper_basins};
use hopper_figures::fate_colors;
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, decades};

/// The mass ratio of the paper's small measure.
const M: f64 = 0.2;
/// The last hump. The number of intervals grows with the hump, and six humps show the pattern.
const LAST: u64 = 6;

/// A fraction of a hump, and the same with everything undecided added.
type FractionBounds = (f64, f64);

/// The fraction of each hump that each fixed point below attracts.
pub(super) fn nested_basins(_: &Job) -> Result<Finding, Error> {
    let fates = fates(M)?;
    let refinement = Refinement { undecided: 2e-4, intervals: 4_000_000, ..Refinement::default() };
    let basins = hopper_basins(&fates, 1, LAST + 1, 400, refinement)?.basins;
    let mut table = Table::new(&[
        "hump",
        "own trap",
        "to $α$^{∗}_{1}",
        "$α$^{∗}_{2}",
        "$α$^{∗}_{3}",
        "$α$^{∗}_{4}",
        "own fixed point",
        "all",
        "undecided",
    ]);
    let mut fractions: Vec<Vec<FractionBounds>> = Vec::new();
    for n in 1..=LAST {
        let part = basins.within(hump(n)?)?;
        let length = part.window().length();
        let undecided = part.undecided() / length;
        let row: Vec<f64> = (1..=n)
            .map(|k| part.resolved_length(HopperFate::label_of_fixed_point(k)) / length)
            .collect();
        let cell = |fraction: Option<&f64>| {
            fraction.map_or("–".into(), |s| format!("{:.4} %", 100.0 * s))
        };
        let all = part.resolved_length_of(is_incessant) / length;
        let mut cells = vec![format!("{n}"), cell(Some(&(fates.trap(n)?.delta / length)))];
        cells.extend((0..4).map(|k| cell(row.get(k))));
        cells.extend([cell(row.last()), cell(Some(&all)), cell(Some(&undecided))]);
        table.row(cells);
        fractions.push(row.into_iter().map(|fraction| (fraction, fraction + undecided)).collect());
    }
    let mut svg = Svg::new(560.0, 430.0);
    let frame =
        Frame::linear(70.0, 20.0, 440.0, 350.0, (0.8, LAST as f64 + 0.2), (1e-4, 0.1)).log_y();
    // Five curves: one for each colour. The sixth fixed point is in the data.
    for m in 1..=5u8 {
        let at = |n: u64| fractions[n as usize - 1][usize::from(m) - 1];
        let points: Vec<_> = (u64::from(m)..=LAST).map(|n| (n as f64, at(n).0)).collect();
        let color = fate_colors::css(m.into());
        frame.polyline(&mut svg, &points, Pen::solid(color, 1.5));
        for (n, &point) in (u64::from(m)..).zip(&points) {
            let (x, y) = frame.at(point);
            svg.line((x, y), frame.at((n as f64, at(n).1)), Pen::solid(color, 0.9));
            svg.dot(x, y, 3.2, color);
        }
        let y = 318.0 - 18.0 * f64::from(5 - m);
        svg.line((90.0, y), (112.0, y), Pen::solid(color, 1.5));
        svg.dot(101.0, y, 3.2, color);
        svg.text(120.0, y + 4.0, Anchor::Start, 11.5, &fate_colors::name(m.into()));
    }
    let n_ticks: Vec<_> = (1..=LAST).map(|n| (n as f64, format!("{n}"))).collect();
    frame.axes(&mut svg, &n_ticks, &decades(frame.y, 1), "hump $n$", "fraction of hump $n$");
    let data = fractions.iter().zip(1u64..).flat_map(|(row, n)| {
        row.iter()
            .zip(1u64..)
            .map(move |(fraction, m)| [n as f64, m as f64, fraction.0, fraction.1])
    });
    Ok(Finding {
        figure: Figure::new(
            "beyond_humps",
            svg,
            vec![csv_file(
                "humps.csv",
                &["hump", "fixed_point", "fraction_lower", "fraction_upper"],
                data,
            )?],
            &[],
        )?,
        table,
    })
}
