//! The forced oscillator of Sommerer and Ott: its attractor, and two orbits with different fates.

use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use example_systems::forced_oscillator::ForcedOscillator;
use hybrid_system::{Execution, Limits};
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, csv_file, decades, indexed_png, ticks};
use nalgebra::{Vector4, Vector5};
use rayon::prelude::*;

/// Points of the attractor that are drawn, in pieces that are computed side by side, and periods that are left out
/// before each piece. After 200 periods an orbit of the plane is on the attractor to far below a pixel: volumes
/// there shrink by a factor of e^(−0.09) in a period.
const PIECES: u32 = 40;
const POINTS: u32 = 2500;
const TRANSIENT: u32 = 200;

/// The window of the attractor, and its picture in pixels.
const X: (f64, f64) = (-2.0, 2.0);
const VELOCITY: (f64, f64) = (-5.0, 3.0);
const PIXELS: (usize, usize) = (1160, 1160);

/// The two orbits start at rest at (x, y). The first falls on the attractor, the second escapes.
const STARTS: [(f64, f64); 2] = [(0.3, 0.64), (0.3, 0.66)];

/// Periods in which |y| is drawn.
const PERIODS: usize = 1200;

const COLORS: [&str; 2] = ["#10386e", "#d0702b"];

/// |y| at the end of each period, up to an escape.
fn distances(start: (f64, f64)) -> Result<Vec<(f64, f64)>, Error> {
    let oscillator = ForcedOscillator::PUBLISHED;
    let state = Vector5::new(start.0, 0.0, start.1, 0.0, 0.0);
    let limits = Limits::new(f64::from(PERIODS as u32 + 1) * oscillator.period(), PERIODS);
    let mut found = vec![(0.0, start.1.abs())];
    for (k, arc) in (1u32..).zip(Execution::new(&oscillator, (), state, limits)) {
        if let Some(event) = arc?.event() {
            found.push((f64::from(k), event.before[2].abs()));
        }
    }
    Ok(found)
}

/// The attractor on the left, |y| of two orbits on the right.
pub(super) fn figure(_: &Job) -> Result<Figure, Error> {
    let oscillator = ForcedOscillator::PUBLISHED;
    let points: Vec<Vector4<f64>> = (0..PIECES)
        .into_par_iter()
        .flat_map_iter(|piece| {
            let mut point = Vector4::new(0.02 * f64::from(piece) - 0.4, 0.1, 0.0, 0.0);
            for _ in 0..TRANSIENT {
                point = oscillator.stroboscopic_map(&point);
            }
            (0..POINTS).map(move |_| {
                point = oscillator.stroboscopic_map(&point);
                point
            })
        })
        .collect();
    let (width, height) = PIXELS;
    let mut hits = vec![0u32; width * height];
    for point in &points {
        let share = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
        let column = (share(point[0], X) * width as f64) as usize;
        let row = ((1.0 - share(point[1], VELOCITY)) * height as f64) as usize;
        for (down, right) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            hits[(row + down).min(height - 1) * width + (column + right).min(width - 1)] += 1;
        }
    }
    // The shade is the bit length of the number of hits: a single hit is grey, 8 or more are black.
    let shades: Vec<[u8; 3]> = [255, 130, 85, 45, 0].map(|grey| [grey; 3]).to_vec();
    let pixels: Vec<u8> =
        hits.iter().map(|&hits| (32 - hits.leading_zeros()).min(4) as u8).collect();
    let png = indexed_png("forced_oscillator", width, height, &shades, &pixels)?;

    let mut svg = Svg::new(690.0, 370.0);
    let plane = Frame::linear(52.0, 30.0, 280.0, 280.0, X, VELOCITY);
    svg.image(plane.left, plane.top, plane.width, plane.height, &png);
    plane.axes(&mut svg, &ticks(X, 4), &ticks(VELOCITY, 8), "$x$", "velocity $u$ = d$x$/d$t$");
    svg.text(
        plane.left,
        plane.top - 10.0,
        Anchor::Start,
        12.5,
        "the attractor in $y$ = 0, once a period",
    );

    let fates =
        Frame::linear(408.0, 30.0, 264.0, 280.0, (0.0, PERIODS as f64), (1e-14, 1e2)).log_y();
    let orbits = [distances(STARTS[0])?, distances(STARTS[1])?];
    fates.clipped(&mut svg, |svg| {
        for (orbit, color) in orbits.iter().zip(COLORS) {
            fates.polyline(svg, orbit, Pen::solid(color, 1.0));
        }
    });
    if let Some(&last) = orbits[1].last() {
        svg.marker(fates.at(last), Marker::Wedge, 8.0, COLORS[1]);
    }
    fates.axes(
        &mut svg,
        &ticks(fates.x, 4),
        &decades(fates.y, 2),
        "forcing periods",
        "distance |$y$| from the attractor",
    );
    svg.text(fates.left, fates.top - 10.0, Anchor::Start, 12.5, "two orbits that start 0.02 apart");
    let rows = points.iter().map(|point| vec![Some(point[0]), Some(point[1])]);
    Figure::new(
        "forced_oscillator",
        svg,
        vec![csv_file("forced_oscillator.csv", &["x", "velocity"], rows)?],
        &[
            ("points", (PIECES * POINTS).to_string()),
            ("first", format!("{:?}", STARTS[0])),
            ("second", format!("{:?}", STARTS[1])),
        ],
    )
}
