//! The bifurcation diagram of the forced oscillator with a stop.

use super::bifurcations::{draw_branch, draw_end};
use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use example_systems::impact_oscillator::{impact_oscillator, steady_start};
use journal_figures::{Anchor, Frame, Svg, csv_file, ticks};
use return_map::{
    BranchSteps, EquationReturns, OrbitLength, Seeds, bifurcation_diagram, follow_branch,
};
use std::ops::ControlFlow::Continue;

/// Forcings, from the motion beside the stop to impacts.
const FORCINGS: (f64, f64) = (0.1, 0.5);
const COLUMNS: usize = 540;
/// Periods that are left out while the motion settles: the free motion keeps 0.78 of a disturbance in each.
const TRANSIENT: usize = 400;
const DRAWN: usize = 96;
const PIXELS: (usize, usize) = (COLUMNS, 600);
/// Displacements that are drawn.
const HEIGHTS: (f64, f64) = (-0.6, 0.5);

/// The displacements once in a period of the forcing, and the branches of the motions with and without impacts.
pub(super) fn figure(_: &Job) -> Result<Figure, Error> {
    let oscillator =
        impact_oscillator("0.4").clock_text("strobe", "2*pi/frequency", "2*pi/frequency");
    let periods = EquationReturns::new(&oscillator, "forcing", ("free", "strobe"), &["x", "v"])?;
    let forcing =
        |k: usize| FORCINGS.0 + (FORCINGS.1 - FORCINGS.0) * (k as f64 + 0.5) / COLUMNS as f64;
    let forcings: Vec<f64> = (0..COLUMNS).map(forcing).collect();
    let [x, v, _] = steady_start(FORCINGS.0);
    let seeds = [vec![x, v]];
    let length = OrbitLength { transient: TRANSIENT, keep: DRAWN };
    let from = (&seeds[..], Seeds::Fresh);
    let columns = bifurcation_diagram(&periods, &forcings, from, length, |_| Continue(()));
    let (mut points, mut last) = (Vec::new(), Vec::new());
    for column in columns {
        for orbit in column.orbits {
            let orbit = orbit?;
            points.extend(orbit.iter().map(|point| (column.parameter, point[0])));
            last = orbit.last().cloned().unwrap_or_default();
        }
    }
    let mut svg = Svg::new(620.0, 400.0);
    let frame = Frame::linear(62.0, 14.0, 540.0, 330.0, FORCINGS, HEIGHTS);
    frame.point_cloud(&mut svg, PIXELS, points.iter().copied())?;
    let start = (&[x, v][..], FORCINGS.0);
    let steps = BranchSteps::default();
    let free = follow_branch(&periods, 1, start, FORCINGS, steps, |_| Continue(()))?;
    draw_branch(&mut svg, frame, &free);
    draw_end(&mut svg, frame, &free.ends[1], Anchor::Start);
    // At the last forcing the motion has impacts.
    let hits = (&last[..], forcings[COLUMNS - 1]);
    let hits = follow_branch(&periods, 1, hits, FORCINGS, steps, |_| Continue(()))?;
    draw_branch(&mut svg, frame, &hits);
    frame.axes(
        &mut svg,
        &ticks(FORCINGS, 8),
        &ticks(HEIGHTS, 11),
        "forcing $F$ (dimensionless)",
        "displacement $x$ once in a period",
    );
    let rows = points.iter().map(|&(forcing, x)| vec![Some(forcing), Some(x)]);
    Figure::new(
        "oscillator",
        svg,
        vec![csv_file("oscillator.csv", &["forcing", "displacement"], rows)?],
        &[
            ("drawn", DRAWN.to_string()),
            ("transient", TRANSIENT.to_string()),
            ("columns", COLUMNS.to_string()),
        ],
    )
}
