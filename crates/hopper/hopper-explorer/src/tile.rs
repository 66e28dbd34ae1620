//! Strips of pixels of the (M, α) plane.
//!
//! A tile is a window of `columns` × `rows` pixels. On the linear axis its pixels are those of [`basin_columns`] on
//! the same grid, bit for bit. On the logarithmic axis the columns are equally far apart in log₂ M.

use crate::refusal::Refusal;
use basin_of_attraction::{Grid, Interval, Label};
use hopper_basin::{
    CoverageColumn, CoverageLimits, Fates, HOP_BUDGET, ShareColumn, ShareRaster, Upwards,
    basin_columns,
};
use hopper_figures::{coverage_pixels, fate_colors, hop_color};
use hopper_proof::ProvedPoints;
use passive_hopper::MassRatio;
use std::ops::Range;

/// What the pixels show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layer {
    /// The fate of each pixel's middle.
    Fate,
    /// The number of hops until this fate is known.
    Hops,
    /// The share of every basin in each pixel, mixed as light.
    Coverage,
    /// Whether the fate of each pixel's middle is proved, or only computed.
    Proof,
}

impl Layer {
    /// The layer of that number: 0 to 3 in the order above.
    ///
    /// # Errors
    /// A refusal for other numbers.
    pub fn numbered(number: u32) -> Result<Self, Refusal> {
        match number {
            0 => Ok(Layer::Fate),
            1 => Ok(Layer::Hops),
            2 => Ok(Layer::Coverage),
            3 => Ok(Layer::Proof),
            _ => Err(Refusal::new(format!("there is no layer {number}; there are 0 to 3"))),
        }
    }
}

/// The number of hops with the darkest colour. Few pixels have more; one scale for all tiles keeps neighbours
/// comparable.
pub(crate) const DARKEST_HOPS: u64 = 10_000;

/// Most pixels of a tile each way: its pixels then take 64 MB.
const MOST_PIXELS: usize = 4096;

/// A tile of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
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

impl Window {
    fn grid(&self) -> Result<Grid, Refusal> {
        let Window { columns, rows, .. } = *self;
        let good = |pixels: usize| (1..=MOST_PIXELS).contains(&pixels);
        if !(good(columns) && good(rows)) {
            let most = MOST_PIXELS;
            let text = format!("a tile has 1 to {most} pixels each way, not {columns} × {rows}");
            return Err(Refusal::new(text));
        }
        let x = Interval::new(self.x.0, self.x.1)?;
        let y = Interval::new(self.alpha.0, self.alpha.1)?;
        Ok(Grid { x, y, columns, rows })
    }

    /// The mass ratio of a column.
    fn mass_ratio(&self, grid: &Grid, column: usize) -> Result<MassRatio, Refusal> {
        let x = grid.x_at(column);
        Ok(MassRatio::new(if self.logarithmic { pxfm::f_exp2(x) } else { x })?)
    }
}

/// Some columns of a tile.
#[derive(Debug, Clone, PartialEq)]
pub struct Strip {
    /// Red, green, blue and opacity, the highest row first.
    pub pixels: Vec<u8>,
    /// Column by column, each from below: the codes of the labels, with [`PROVED`] added where the layer says so,
    /// or the numbers of hops up to 2³² − 1. Empty for shares.
    pub values: Vec<u32>,
}

/// Some columns of a tile.
///
/// # Errors
/// The refusals of the libraries for windows outside the model, and of columns outside the tile.
pub fn strip(layer: Layer, window: &Window, columns: Range<usize>) -> Result<Strip, Refusal> {
    let grid = window.grid()?;
    if columns.start > columns.end || columns.end > grid.columns {
        let (first, end, all) = (columns.start, columns.end, grid.columns);
        return Err(Refusal::new(format!("columns {first}..{end} of a tile of {all}")));
    }
    match layer {
        Layer::Fate => fates(window, &grid, columns),
        Layer::Hops => hops(window, &grid, columns),
        Layer::Coverage => coverage(window, &grid, columns),
        Layer::Proof => proof(window, &grid, columns),
    }
}

/// The mass ratios of all columns, then the speeds of all rows from below.
///
/// # Errors
/// As [`strip`].
pub fn places(window: &Window) -> Result<Vec<f64>, Refusal> {
    let grid = window.grid()?;
    let ratio = |column| Ok(window.mass_ratio(&grid, column)?.value());
    let mut all = (0..grid.columns).map(ratio).collect::<Result<Vec<_>, Refusal>>()?;
    all.extend(speeds(&grid));
    Ok(all)
}

fn speeds(grid: &Grid) -> Vec<f64> {
    (0..grid.rows).map(|row| grid.y_at(row)).collect()
}

fn fates(window: &Window, grid: &Grid, columns: Range<usize>) -> Result<Strip, Refusal> {
    let labels: Vec<Vec<Label>> = if window.logarithmic {
        let speeds = speeds(grid);
        let column = |at| Ok(Fates::new(window.mass_ratio(grid, at)?)?.labels(&speeds)?);
        columns.map(column).collect::<Result<_, Refusal>>()?
    } else {
        basin_columns(grid, columns)?
    };
    let color = |label: &Label| fate_colors::rgb(*label);
    let values = labels.iter().flatten().map(|label| u32::from(label.code())).collect();
    Ok(Strip { pixels: painted(&labels, grid.rows, color), values })
}

/// The colour of a fate that is computed and not proved: a light blue. The colours of fates are black, grey, yellow
/// and dark ones.
pub const ONLY_COMPUTED: [u8; 3] = [0x38, 0xc0, 0xff];

/// What a value of the layer of proofs has beside the code of its label if the fate is proved.
pub const PROVED: u32 = 1 << 16;

fn proof(window: &Window, grid: &Grid, columns: Range<usize>) -> Result<Strip, Refusal> {
    let speeds = speeds(grid);
    let column = |at| {
        let ratio = window.mass_ratio(grid, at)?;
        let computed = Fates::new(ratio)?.labels(&speeds)?;
        let mut points = ProvedPoints::new(ratio.value())?;
        let of = |(&speed, computed): (&f64, Label)| {
            let proved = points.label(speed)?;
            Ok(if proved.is_undecided() { (computed, false) } else { (proved, true) })
        };
        speeds.iter().zip(computed).map(of).collect()
    };
    let found: Vec<Vec<(Label, bool)>> = columns.map(column).collect::<Result<_, Refusal>>()?;
    let color = |&(label, proved): &(Label, bool)| {
        let only_computed = !proved && !label.is_undecided();
        if only_computed { ONLY_COMPUTED } else { fate_colors::rgb(label) }
    };
    let value = |&(label, proved)| u32::from(Label::code(label)) | if proved { PROVED } else { 0 };
    let values = found.iter().flatten().map(value).collect();
    Ok(Strip { pixels: painted(&found, grid.rows, color), values })
}

fn hops(window: &Window, grid: &Grid, columns: Range<usize>) -> Result<Strip, Refusal> {
    let speeds = speeds(grid);
    let column = |at| {
        let found = Fates::new(window.mass_ratio(grid, at)?)?.fates_within(&speeds, HOP_BUDGET)?;
        Ok(found.into_iter().map(|(_, hops)| hops as u64).collect())
    };
    let counts: Vec<Vec<u64>> = columns.map(column).collect::<Result<_, Refusal>>()?;
    let color = |count: &u64| hop_color((*count).min(DARKEST_HOPS), DARKEST_HOPS);
    let value = |count: &u64| u32::try_from(*count).unwrap_or(u32::MAX);
    let values = counts.iter().flatten().map(value).collect();
    Ok(Strip { pixels: painted(&counts, grid.rows, color), values })
}

fn coverage(window: &Window, grid: &Grid, columns: Range<usize>) -> Result<Strip, Refusal> {
    let limits = CoverageLimits::default();
    let column = |at| {
        let fates = Fates::new(window.mass_ratio(grid, at)?)?;
        let own = CoverageColumn::new(&fates, grid.y, grid.rows, limits)?;
        Ok(Some(ShareColumn::from(&own)))
    };
    let width = columns.len();
    if width == 0 {
        return Ok(Strip { pixels: Vec::new(), values: Vec::new() });
    }
    let shares = columns.map(column).collect::<Result<Vec<_>, Refusal>>()?;
    let part = Grid { columns: width, ..*grid };
    let raster = ShareRaster::from_columns(part, Upwards::LiftOffSpeed, shares)?;
    Ok(Strip { pixels: opaque(&coverage_pixels(&raster)), values: Vec::new() })
}

/// The pixels of columns, the highest row first.
fn painted<T>(columns: &[Vec<T>], rows: usize, color: impl Fn(&T) -> [u8; 3]) -> Vec<u8> {
    let mut pixels = Vec::with_capacity(4 * rows * columns.len());
    for row in (0..rows).rev() {
        for value in columns.iter().filter_map(|column| column.get(row)) {
            pixels.extend(color(value));
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
