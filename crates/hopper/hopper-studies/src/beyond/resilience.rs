//! Resilience: how far lift-off speeds are from the boundary of their basin.

use super::finding::{Finding, Table};
use super::humps_of_window::{TO, fates, geometric};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{Bounds, IntervalBasins, Refinement};
use hopper_basin::{HopperFate, hopper_basins};
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, decades};
use passive_hopper::alpha_star;

/// The mass ratios of the paper's measures, and two larger ones at which the branches of the map are proved.
const RATIOS: [f64; 4] = [0.1, 0.2, 0.5, 0.8];

const PENS: [Pen; 4] = [
    Pen::solid("#000000", 1.8),
    Pen::dashed("#0072b2", 1.8, "7 3"),
    Pen::dashed("#d55e00", 1.8, "2 2.6"),
    Pen::dashed("#666666", 1.8, "9 3 2 3"),
];

/// Shortest interval of the basins, far below the distances that are shown.
const REFINEMENT: Refinement =
    Refinement { shortest: 1e-10, undecided: 1e-8, levels: 1_000_000, intervals: 2_000_000 };

/// Gaps up to this length between two intervals of one basin are roundings: some ulps of a speed of 20.
const RESOLUTION: f64 = 1e-13;

/// Distances shown, and their number.
const DISTANCES: (f64, f64, usize) = (1e-6, 1.0, 61);

/// The distribution of distances over the basins, at the mass ratios of the paper.
pub(super) fn resilience(_: &Job) -> Result<Finding, Error> {
    let distances = geometric(DISTANCES.0, DISTANCES.1, DISTANCES.2);
    let mut svg = Svg::new(860.0, 400.0);
    let mut table = Table::new(&[
        "$M$",
        "basin",
        "length",
        "within 10^{−3} of the boundary",
        "within 10^{−2}",
        "largest distance",
        "at $α$",
        "upward fatal shock from the fixed point",
    ]);
    let mut data = Vec::new();
    let all: Vec<(f64, IntervalBasins)> = RATIOS
        .into_iter()
        .map(|m| Ok((m, hopper_basins(&fates(m)?, 0, TO, 400, REFINEMENT)?.basins)))
        .collect::<Result<_, Error>>()?;
    for (panel, n) in [1, 2].into_iter().enumerate() {
        let (left, label) = (66.0 + 430.0 * panel as f64, HopperFate::label_of_fixed_point(n));
        let name = format!("$α$^{{∗}}_{{{n}}}");
        let frame =
            Frame::linear(left, 34.0, 340.0, 310.0, (DISTANCES.0, DISTANCES.1), (1e-4, 1.3))
                .log_x()
                .log_y();
        let title = ["(a)", "(b)"][panel];
        svg.text(left, 22.0, Anchor::Start, 13.0, &format!("{title}  basin of {name}"));
        for ((at, (m, basins)), pen) in all.iter().enumerate().zip(PENS) {
            let found = basins.distances_to_boundary(label, RESOLUTION);
            let within = |distance: f64| {
                let part = found.fraction_within(distance);
                part.unwrap_or(Bounds { lower: 0.0, upper: 1.0 })
            };
            let points: Vec<(f64, Bounds)> = distances.iter().map(|&d| (d, within(d))).collect();
            frame.clipped(&mut svg, |svg| {
                let line: Vec<_> = points.iter().map(|(d, part)| (*d, part.middle())).collect();
                frame.polyline(svg, &line, pen);
            });
            svg.line_key((left + 216.0, 228.0 + 18.0 * at as f64), pen, &format!("$M$ = {m}"));
            let number = f64::from(label.code());
            data.extend(points.iter().map(|(d, part)| [*m, number, *d, part.lower, part.upper]));
            let (safest, largest) = found.largest().unwrap_or((f64::NAN, within(0.0)));
            // An ulp above the fixed point the state is in its trap.
            let star = alpha_star(n).next_up();
            let upward = basins.distance_to_boundary(star, RESOLUTION).map(|at| at.above);
            table.row([
                format!("{m}"),
                name.clone(),
                format!("{:.6}", found.length()),
                percent(within(1e-3)),
                percent(within(1e-2)),
                length(largest),
                format!("{safest:.6}"),
                upward.map_or("–".into(), length),
            ]);
        }
        frame.axes(
            &mut svg,
            &decades(frame.x, 1),
            &decades(frame.y, 1),
            "distance $ε$ in speed",
            "fraction of the basin",
        );
    }
    Ok(Finding {
        figure: Figure::new(
            "beyond_resilience",
            svg,
            vec![csv_file(
                "resilience.csv",
                &["mass_ratio", "label", "distance", "fraction_lower", "fraction_upper"],
                data,
            )?],
            &[],
        )?,
        table,
    })
}

fn percent(part: Bounds) -> String {
    format!("{:.3} … {:.3} %", 100.0 * part.lower, 100.0 * part.upper)
}

/// A distance between bounds. Where no other basin is known the upper bound is infinite.
fn length(distance: Bounds) -> String {
    let Bounds { lower, upper } = distance;
    if upper.is_infinite() {
        format!("at least {lower:.6}")
    } else if upper - lower < 1e-6 {
        format!("{:.6}", distance.middle())
    } else {
        format!("{lower:.6} … {upper:.6}")
    }
}
