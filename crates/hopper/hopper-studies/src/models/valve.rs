//! The bifurcation diagram of the pressure relief valve.

use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use example_systems::valve::turning_points;
use journal_figures::{Frame, Svg, csv_file, indexed_png, ticks};
use rayon::prelude::*;

/// Flow rates of the tutorial's diagram.
const RATES: (f64, f64) = (0.2, 10.0);
/// Number of flow rates, and number of flow rates in one piece that is stored on disk.
const COLUMNS: usize = 980;
const PIECE: usize = 20;
/// Turning points that are left out while the motion settles. Chosen: more cost time in proportion, and fewer leave
/// orbits that still approach their limit near a bifurcation, where they settle slowly.
const TRANSIENT: usize = 1024;
/// Turning points that are drawn. A periodic orbit with up to three of them meets each of its pixels 32 times or more,
/// and is drawn black.
const DRAWN: usize = 96;
/// The picture in pixels, two across for each flow rate.
const PIXELS: (usize, usize) = (2 * COLUMNS, 1200);
/// The largest displacement that is drawn: the next whole number above the largest one found, 8.86.
const HIGHEST: f64 = 9.0;

/// The displacements at the turning points against the flow rate.
pub(super) fn figure(job: &Job) -> Result<Figure, Error> {
    let rate =
        |column: usize| RATES.0 + (RATES.1 - RATES.0) * (column as f64 + 0.5) / COLUMNS as f64;
    let pieces = job.scan("the valve's turning points", COLUMNS / PIECE, |piece| {
        let columns = piece * PIECE..(piece + 1) * PIECE;
        let displacements: Vec<Vec<f64>> = columns
            .into_par_iter()
            .map(|column| turning_points(rate(column), TRANSIENT, DRAWN))
            .collect::<Result<_, _>>()?;
        Ok(displacements.concat())
    })?;
    let displacements: Vec<f64> = pieces.concat();
    let (width, height) = PIXELS;
    let mut hits = vec![0u32; width * height];
    for (k, &displacement) in displacements.iter().enumerate() {
        let row = ((1.0 - displacement / HIGHEST) * height as f64).floor();
        if row >= 0.0 && row < height as f64 {
            for (down, right) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let row = (row as usize + down).min(height - 1);
                hits[row * width + 2 * (k / DRAWN) + right] += 1;
            }
        }
    }
    // The shade is the bit length of the number of hits: one hit is light grey, 32 or more are black.
    let shades: Vec<[u8; 3]> = [255, 120, 85, 60, 40, 20, 0].map(|grey| [grey; 3]).to_vec();
    let pixels: Vec<u8> =
        hits.iter().map(|&hits| (32 - hits.leading_zeros()).min(6) as u8).collect();
    let png = indexed_png("valve", width, height, &shades, &pixels)?;
    let mut svg = Svg::new(620.0, 400.0);
    let frame = Frame::linear(62.0, 14.0, 540.0, 330.0, RATES, (0.0, HIGHEST));
    svg.image(frame.left, frame.top, frame.width, frame.height, &png);
    frame.axes(
        &mut svg,
        &ticks(RATES, 10),
        &ticks((0.0, HIGHEST), 9),
        "flow rate $q$ (dimensionless)",
        "displacement $y$_{1} at the turning points, $y$_{2} = 0",
    );
    let rows = displacements
        .iter()
        .enumerate()
        .map(|(k, &displacement)| vec![Some(rate(k / DRAWN)), Some(displacement)]);
    Figure::new(
        "valve",
        svg,
        vec![csv_file("valve.csv", &["flow_rate", "displacement"], rows)?],
        &[
            ("drawn", DRAWN.to_string()),
            ("transient", TRANSIENT.to_string()),
            ("columns", COLUMNS.to_string()),
        ],
    )
}
