//! Strips of pixels of the (M, α) plane.
//!
//! A tile is a window of `columns` × `rows` pixels. On the linear axis its pixels are those of
//! [`basin_columns`](hopper_basin::basin_columns) on the same grid, bit for bit. On the logarithmic axis the columns
//! are equally far apart in log₂ M.

use crate::refusal::Refusal;
use basin_of_attraction::{Grid, Interval};
use hopper_figures::{Content, LAYERS, Layer, LayerColumns, Values};
use std::ops::Range;

/// Most pixels of a tile each way: its pixels then take 64 MB.
const MOST_PIXELS: usize = 4096;

/// A tile of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tile {
    /// M from and to, or log₂ M.
    pub x: (f64, f64),
    /// Whether `x` is log₂ M.
    pub logarithmic: bool,
    /// α from and to.
    pub alpha: (f64, f64),
    /// Pixels across.
    pub columns: usize,
    /// Pixels up.
    pub rows: usize,
}

impl Tile {
    fn columns(&self, columns: Range<usize>) -> Result<LayerColumns, Refusal> {
        let (first, end, all) = (columns.start, columns.end, self.columns);
        let good = |pixels: usize| (1..=MOST_PIXELS).contains(&pixels);
        if !(good(all) && good(self.rows)) {
            let (most, rows) = (MOST_PIXELS, self.rows);
            let text = format!("a tile has 1 to {most} pixels each way, not {all} × {rows}");
            return Err(Refusal::new(text));
        }
        if first > end || end > all {
            return Err(Refusal::new(format!("columns {first}..{end} of a tile of {all}")));
        }
        let x = Interval::new(self.x.0, self.x.1)?;
        let y = Interval::new(self.alpha.0, self.alpha.1)?;
        let grid = Grid { x, y, columns: all, rows: self.rows };
        Ok(LayerColumns { grid, logarithmic: self.logarithmic, columns })
    }
}

/// The layer of that number, in the order of [`LAYERS`].
///
/// # Errors
/// A refusal for other numbers.
pub fn numbered(number: u32) -> Result<&'static Layer, Refusal> {
    let last = LAYERS.len() - 1;
    let missing = || Refusal::new(format!("there is no layer {number}; there are 0 to {last}"));
    LAYERS.get(number as usize).ok_or_else(missing)
}

/// Some columns of a tile.
#[derive(Debug, Clone, PartialEq)]
pub struct TileStrip {
    /// Red, green, blue and opacity, the highest row first.
    pub pixels: Vec<u8>,
    /// Column by column, each from below: the numbers of the layer, up to 2³² − 1, or the bits of an `f32`. Empty for shares.
    pub values: Vec<u32>,
}

/// Some columns of a tile.
///
/// # Errors
/// The refusals of the libraries for windows outside the model, and of columns outside the tile.
pub fn strip(layer: &Layer, tile: &Tile, columns: Range<usize>) -> Result<TileStrip, Refusal> {
    let of = tile.columns(columns)?;
    match &layer.content {
        Content::Shares(pixels) => {
            Ok(TileStrip { pixels: opaque(&pixels(&of)?), values: Vec::new() })
        }
        Content::Values(values) => {
            let found = (values.columns)(&of)?;
            let bits = |value: &u64| u32::try_from(*value).unwrap_or(u32::MAX);
            let numbers = found.iter().flatten().map(bits).collect();
            Ok(TileStrip { pixels: painted(values, &found, tile.rows), values: numbers })
        }
    }
}

/// The mass ratios of all columns, then the speeds of all rows from below.
///
/// # Errors
/// As [`strip`].
pub fn places(tile: &Tile) -> Result<Vec<f64>, Refusal> {
    let of = tile.columns(0..tile.columns)?;
    let ratio = |column| Ok(of.mass_ratio(column)?.value());
    let mut all = (0..tile.columns).map(ratio).collect::<Result<Vec<_>, Refusal>>()?;
    all.extend(of.speeds());
    Ok(all)
}

/// The pixels of columns, the highest row first.
fn painted(values: &Values, columns: &[Vec<u64>], rows: usize) -> Vec<u8> {
    let mut pixels = Vec::with_capacity(4 * rows * columns.len());
    for row in (0..rows).rev() {
        for value in columns.iter().filter_map(|column| column.get(row)) {
            pixels.extend(values.color(*value));
            pixels.push(u8::MAX);
        }
    }
    pixels
}

/// Pixels with full opacity.
pub(crate) fn opaque(pixels: &[u8]) -> Vec<u8> {
    let (triples, _) = pixels.as_chunks::<3>();
    triples.iter().flat_map(|&[red, green, blue]| [red, green, blue, u8::MAX]).collect()
}
