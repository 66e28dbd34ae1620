//! The bifurcation diagram of the pressure relief valve.

use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use example_systems::valve::turns;
use journal_figures::{Frame, Svg, csv_file, indexed_png, ticks};
use rayon::prelude::*;

/// Flow rates of the tutorial's diagram.
const RATES: (f64, f64) = (0.2, 10.0);
/// Flow rates, and those of one piece that is kept on disk.
const COLUMNS: usize = 980;
const PIECE: usize = 20;
/// Turns that are left out while the motion settles, and turns that are drawn.
const TRANSIENT: usize = 1024;
const DRAWN: usize = 96;
/// The picture in pixels, two across for each flow rate.
const PIXELS: (usize, usize) = (2 * COLUMNS, 1200);
/// The largest displacement that is drawn.
const HIGHEST: f64 = 9.0;

/// The displacements at the turns against the flow rate.
pub(super) fn figure(job: &Job) -> Result<Figure, Error> {
    let rate =
        |column: usize| RATES.0 + (RATES.1 - RATES.0) * (column as f64 + 0.5) / COLUMNS as f64;
    let pieces = job.scan("the valve's turns", COLUMNS / PIECE, |piece| {
        let columns = piece * PIECE..(piece + 1) * PIECE;
        let turns: Vec<Vec<f64>> = columns
            .into_par_iter()
            .map(|column| turns(rate(column), TRANSIENT, DRAWN))
            .collect::<Result<_, _>>()?;
        Ok(turns.concat())
    })?;
    let turns: Vec<f64> = pieces.concat();
    let (width, height) = PIXELS;
    let mut hits = vec![0u32; width * height];
    for (k, &turn) in turns.iter().enumerate() {
        let row = ((1.0 - turn / HIGHEST) * height as f64).floor();
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
        "displacement $y$_{1} at the turns, $y$_{2} = 0",
    );
    let rows = turns.iter().enumerate().map(|(k, &turn)| vec![Some(rate(k / DRAWN)), Some(turn)]);
    Ok(Figure {
        name: "valve",
        title: "Bifurcations of a pressure relief valve".into(),
        paper: "Not in the paper: the model of the MPGOS tutorial.".into(),
        notes: format!(
            "{DRAWN} turns after {TRANSIENT}, from (0.2, 0, 0), tolerances 10^{{−10}}, {COLUMNS} flow rates"
        ),
        svg,
        data: vec![csv_file("valve.csv", &["flow_rate", "displacement"], rows)?],
    })
}
