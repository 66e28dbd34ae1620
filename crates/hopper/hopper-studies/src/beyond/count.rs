//! The number of boundary points against scale, from 1 to 10⁻¹⁰⁰, with its law.

use super::finding::{Finding, Table};
use super::humps_of_window::fates;
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use hopper_basin::{CircleLimits, GapCount, PhaseBasins};
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, csv_file, ticks};
use std::f64::consts::LN_10;

/// The mass ratio of the paper's small measure: all speeds next to α*_1 decay, the circle of α*_2 has two boundary
/// points, and that of α*_3 has limit points.
const M: f64 = 0.2;

/// Marker and colour of n = 2 and 3.
const LOOKS: [(Marker, &str); 2] = [(Marker::Square, "#d03a2b"), (Marker::Triangle, "#1f4e96")];

/// The smallest scale, in decades.
const DECADES: usize = 100;

/// Counts of the gaps between boundary points, and of the law.
pub(super) fn count(_: &Job) -> Result<Finding, Error> {
    let fates = fates(M)?;
    let mut counts: Vec<GapCount> = Vec::new();
    for n in [2, 3] {
        let circle = PhaseBasins::new(&fates, n, CircleLimits::default())?;
        counts.push(GapCount::new(&fates, &circle, &counts)?);
    }
    let mut svg = Svg::new(860.0, 400.0);
    let x = (0.0, DECADES as f64);
    let left = Frame::linear(70.0, 34.0, 350.0, 310.0, x, (0.0, 30.0));
    let right = Frame::linear(500.0, 34.0, 340.0, 310.0, x, (0.0, 6.0));
    svg.text(left.left, 22.0, Anchor::Start, 13.0, "(a)  number of gaps longer than $ε$");
    svg.text(right.left, 22.0, Anchor::Start, 13.0, "(b)  times $ε$^{1/4}");
    let header =
        ["$ε$", "left of $α$^{∗}_{2}", "× $ε$^{1/4}", "left of $α$^{∗}_{3}", "× $ε$^{1/4}"];
    let mut table = Table::new(&header);
    let found = |count: &GapCount, decades: f64| {
        let number = count.longer_than(-LN_10 * decades);
        number.ok_or_else(|| Error::CheckFailed(format!("no count at 10^-{decades}")))
    };
    let mut rows = vec![Vec::new(); DECADES + 1];
    for (count, (marker, color)) in counts.iter().zip(LOOKS) {
        for (k, row) in rows.iter_mut().enumerate() {
            let decades = k as f64;
            let number = found(count, decades)?;
            let scaled = number * pxfm::f_exp10(-0.25 * decades);
            row.push((number, scaled));
            if k % 4 == 0 && number > 0.0 {
                let height = pxfm::f_log10(number);
                svg.marker(left.at((decades, height)), marker, 6.0, color);
                svg.marker(right.at((decades, scaled)), marker, 6.0, color);
            }
        }
        // Between two deep scales the count times ε^{1/4} rises by ¾ B a unit of ln 1/ε for depth 2.
        let level = 0.75 * count.constant();
        let rise = if count.depth() == 2 { LN_10 * level } else { 0.0 };
        let start = if count.depth() == 2 {
            rows[DECADES].last().map_or(0.0, |r| r.1) - rise * x.1
        } else {
            level
        };
        let pen = Pen::dashed(color, 1.1, "5 3");
        right.clipped(&mut svg, |svg| {
            right.polyline(svg, &[(0.0, start), (x.1, start + rise * x.1)], pen)
        });
    }
    for (k, row) in rows.iter().enumerate() {
        if [2, 4, 6, 8, 10, 20, 40, 60, 80, 100].contains(&k) {
            let cells = row.iter().flat_map(|(number, scaled)| {
                let digits =
                    if *number < 1e6 { format!("{number:.0}") } else { format!("{number:.4e}") };
                [digits, format!("{scaled:.4}")]
            });
            table.row([format!("10^{{−{k}}}")].into_iter().chain(cells));
        }
    }
    let names = ["left of $α$^{∗}_{2}: $ε$^{−1/4}", "left of $α$^{∗}_{3}: $ε$^{−1/4} ln 1/$ε$"];
    for (at, (name, (marker, color))) in names.into_iter().zip(LOOKS).enumerate() {
        svg.marker_key((left.left + 16.0, 52.0 + 18.0 * at as f64), marker, color, name);
    }
    let powers = |frame: (f64, f64), sign: &str| -> Vec<(f64, String)> {
        let label = |(value, _): (f64, String)| {
            let sign = if value == 0.0 { "" } else { sign };
            (value, format!("10^{{{sign}{value:.0}}}"))
        };
        ticks(frame, 5).into_iter().map(label).collect()
    };
    left.axes(&mut svg, &powers(x, "−"), &powers(left.y, ""), "scale $ε$", "number");
    right.axes(&mut svg, &powers(x, "−"), &ticks(right.y, 6), "scale $ε$", "number × $ε$^{1/4}");
    let data = rows.iter().enumerate().map(|(k, row)| {
        std::iter::once(k as f64).chain(row.iter().flat_map(|&(number, scaled)| [number, scaled]))
    });
    let header = ["decades", "gaps_2", "scaled_2", "gaps_3", "scaled_3"];
    let data = csv_file("count.csv", &header, data)?;
    let [two, three] = [0, 1].map(|at| counts.get(at).map_or(0.0, GapCount::constant));
    let deep =
        |decades: f64| found(&counts[1], decades).map(|n| n * pxfm::f_exp10(-0.25 * decades));
    let slope = (deep(100.0)? - deep(60.0)?) / (40.0 * LN_10);
    Ok(Finding {
        figure: Figure::new(
            "beyond_count",
            svg,
            vec![data],
            &[
                ("two", format!("{:.4}", 0.75 * two)),
                ("three", format!("{:.5}", 0.75 * three)),
                ("slope", format!("{slope:.5}")),
            ],
        )?,
        table,
    })
}
