//! Resilience: how far lift-off speeds are from the boundary of their basin.

use super::finding::{Finding, Table};
use super::humps_of_window::{FROM, TO, fates, geometric, is_incessant};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use basin_of_attraction::{Bounds, IntervalBasins, Label, Refinement};
use hopper_basin::{HopperFate, hopper_basins};
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, decades};

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
        .map(|m| Ok((m, hopper_basins(&fates(m)?, FROM, TO, 400, REFINEMENT)?.basins)))
        .collect::<Result<_, Error>>()?;
    let panels: [(&str, Label, f64); 2] = [
        ("(a)  basin of $α$^{∗}_{1}", Label::from(1), 66.0),
        ("(b)  incessant hopping, all fixed points as one", HopperFate::INCESSANT, 496.0),
    ];
    for (title, label, left) in panels {
        let frame =
            Frame::linear(left, 34.0, 340.0, 310.0, (DISTANCES.0, DISTANCES.1), (1e-4, 1.3))
                .log_x()
                .log_y();
        svg.text(left, 22.0, Anchor::Start, 13.0, title);
        for ((at, (m, basins)), pen) in all.iter().enumerate().zip(PENS) {
            let basins = match label {
                HopperFate::INCESSANT => basins.clone().relabelled(|part| {
                    if is_incessant(part.label) { HopperFate::INCESSANT } else { part.label }
                }),
                _ => basins.clone(),
            };
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
            let y = 228.0 + 18.0 * at as f64;
            svg.line((left + 200.0, y), (left + 232.0, y), pen);
            svg.text(left + 238.0, y + 4.0, Anchor::Start, 11.5, &format!("$M$ = {m}"));
            let number = f64::from(label.code());
            data.extend(points.iter().map(|(d, part)| {
                [*m, number, *d, part.lower, part.upper].into_iter().map(Some).collect()
            }));
            let (safest, largest) = found.largest().unwrap_or((f64::NAN, within(0.0)));
            // An ulp above the fixed point the state is in its trap.
            let upward = (label == Label::from(1))
                .then(|| basins.distance_to_boundary(basins.window().left.next_up(), RESOLUTION))
                .flatten();
            table.row([
                format!("{m}"),
                if label == Label::from(1) { "$α$^{∗}_{1}".into() } else { "incessant".into() },
                format!("{:.6}", found.length()),
                percent(within(1e-3)),
                percent(within(1e-2)),
                length(largest),
                format!("{safest:.6}"),
                upward.map_or("–".into(), |distance| length(distance.above)),
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
        figure: Figure {
            name: "beyond_resilience",
            title: "Resilience: how close the speeds of a basin are to its boundary".into(),
            paper: "Measures of the basins, whatever their shape.".into(),
            notes: "The part of the basin within $ε$ of its boundary, in [$α$^{∗}_{1}, $α$^{∗}_{6}], from basins as \
                    intervals (ends to an ulp, branches of the map proved): the probability that some shock of size $ε$ takes a speed \
                    out of the basin. The bounds differ by less than the line is wide, but for the smallest $ε$; the \
                    ends of the window count as boundary for the upper one only. A fixed point itself is on the boundary: any \
                    shock downwards is fatal. Upwards the fatal shock from $α$^{∗}_{1} is the length of the trap, from the \
                    crisis of hump 1 on, and at $M$ = 0.1 more than the whole hump."
                .into(),
            svg,
            data: vec![csv_file("resilience.csv", &["mass_ratio", "label", "distance", "fraction_lower", "fraction_upper"], data)?],
        },
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
