//! `basin-raster`: the basins over any window of (M, α), in tiles that survive anything.

use crate::checkpoint::Checkpoint;
use crate::error::Error;
use crate::figures::basin_plot::{Window, draw_basins};
use basin_of_attraction::{Grid, Interval, LabelImage};
use hopper_basin::{HopperFate, basin_columns, five_humps};
use journal_figures::render;
use passive_hopper::MassRatio;
use rayon::prelude::*;
use repository_tools::{Folder, Progress};
use std::collections::BTreeMap;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub struct Options {
    /// Folder for the results and, until they are complete, for finished tiles
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Mass ratios from and to
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], default_values_t = [0.1, 1.0], allow_negative_numbers = true)]
    mass_ratio: Vec<f64>,
    /// Lift-off speeds from and to [default: the first and the sixth fixed point]
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], allow_negative_numbers = true)]
    speed: Option<Vec<f64>>,
    /// Pixels across and up
    #[arg(long, num_args = 2, value_names = ["COLUMNS", "ROWS"], default_values_t = [1024, 1024])]
    pixels: Vec<usize>,
}

/// Columns of a tile.
const TILE: usize = 16;

/// Pixels of a raster along each axis, at most: a tile of so many rows is some hundred megabytes of work.
const MOST_ALONG: usize = 1 << 20;

/// Pixels of the picture, at most, along each axis; a larger raster is thinned for it.
const PICTURE: usize = 1200;

/// Runs the command.
pub fn run(options: &Options) -> Result<(), Error> {
    let grid = grid(options)?;
    let folder = Folder::open(&options.out)?;
    let description = format!(
        "basins, M {:?} to {:?}, α {:?} to {:?}, {} × {} pixels",
        grid.x.left, grid.x.right, grid.y.left, grid.y.right, grid.columns, grid.rows
    );
    let kept = Checkpoint::open(&folder.path().join("tiles"), &description)?;
    let tiles = grid.columns.div_ceil(TILE);
    let bar = Progress.bar("basins", tiles as u64);
    let done = AtomicU64::new(0);
    (0..tiles).into_par_iter().try_for_each(|tile| {
        if kept.read(tile)?.is_none() {
            kept.write(tile, &columns(&grid, tile)?)?;
        }
        bar.set(done.fetch_add(1, Ordering::Relaxed) + 1);
        Ok::<(), Error>(())
    })?;
    bar.finish();
    let (array, counts) = write_array(&folder, &kept, &grid)?;
    let image = thinned(&kept, &grid)?;
    let window = Window {
        name: "basin",
        mass_ratio: (grid.x.left, grid.x.right),
        alpha: (grid.y.left, grid.y.right),
        inset: None,
        tick_counts: (6, 8),
    };
    let rendered = render("basin", &draw_basins(&window, &image)?, 2.0)?;
    folder.write("basin.png", &rendered.png)?;
    let legend: Vec<_> = counts
        .iter()
        .map(|(&label, &pixels)| {
            let name = HopperFate::label_name(label);
            serde_json::json!({ "label": label, "name": name, "pixels": pixels })
        })
        .collect();
    let text = serde_json::to_string_pretty(&legend)
        .map_err(|e| Error::Render { what: "legend.json".into(), reason: e.to_string() })?;
    folder.write("legend.json", text.as_bytes())?;
    kept.remove(tiles)?;
    let mut out = std::io::stdout().lock();
    let said = (|| {
        for (&label, pixels) in &counts {
            writeln!(out, "label {label:5}  {:40} {pixels} pixels", HopperFate::label_name(label))?;
        }
        writeln!(out, "{}\n{}", array.display(), folder.path().join("basin.png").display())
    })();
    said.map_err(|source| Error::File { path: "standard output".into(), source })
}

fn grid(options: &Options) -> Result<Grid, Error> {
    let pair = |values: &[f64]| match *values {
        [from, to] => Interval::new(from, to).map_err(Error::from),
        _ => Err(Error::CheckFailed("two numbers are needed, from and to".into())),
    };
    let default = [five_humps().left, five_humps().right];
    let [columns, rows] = options.pixels[..] else {
        return Err(Error::CheckFailed("--pixels takes columns and rows".into()));
    };
    if columns.max(rows) > MOST_ALONG {
        return Err(basin_of_attraction::Error::BadRaster { columns, rows }.into());
    }
    let speed = options.speed.as_deref().unwrap_or(&default);
    for values in [&options.mass_ratio[..], speed] {
        // Neighbouring pixels must differ.
        if let [from, to] = *values
            && !(to - from > 1e-12 * to.abs())
        {
            return Err(Error::CheckFailed(format!("a window from {from} to {to} has no pixels")));
        }
    }
    for &m in &options.mass_ratio {
        MassRatio::new(m)?;
    }
    let grid = Grid { x: pair(&options.mass_ratio)?, y: pair(speed)?, columns, rows };
    // No column at all: whether there can be any.
    basin_columns(&grid, 0..0)?;
    Ok(grid)
}

/// The labels of one tile, column by column from the lowest speed up, in little-endian order.
fn columns(grid: &Grid, tile: usize) -> Result<Vec<u8>, Error> {
    let first = tile * TILE;
    let count = TILE.min(grid.columns - first);
    let labels = basin_columns(grid, first..first + count)?;
    Ok(labels.iter().flatten().flat_map(|label| label.to_le_bytes()).collect())
}

/// All tiles as one NumPy array of shape (rows, columns), row 0 the lowest speed; in Fortran's order,
/// in which tiles follow one another. Counts the labels on the way.
fn write_array(
    folder: &Folder,
    kept: &Checkpoint,
    grid: &Grid,
) -> Result<(PathBuf, BTreeMap<u16, usize>), Error> {
    let (path, partial) =
        (folder.path().join("basin.npy"), folder.path().join("basin.npy.partial.tmp"));
    let fail = |source| Error::File { path: path.clone(), source };
    let mut file = BufWriter::new(std::fs::File::create(&partial).map_err(fail)?);
    file.write_all(&npy_header(grid.rows, grid.columns)).map_err(fail)?;
    let mut counts = BTreeMap::new();
    for tile in 0..grid.columns.div_ceil(TILE) {
        let bytes = piece(kept, tile)?;
        for pair in bytes.chunks_exact(2) {
            *counts.entry(u16::from_le_bytes([pair[0], pair[1]])).or_insert(0) += 1;
        }
        file.write_all(&bytes).map_err(fail)?;
    }
    file.into_inner().map_err(|e| fail(e.into_error()))?.sync_all().map_err(fail)?;
    std::fs::rename(&partial, &path).map_err(fail)?;
    Ok((path, counts))
}

/// The header of version 1.0 of the format: magic, length, and a dictionary padded to 64 bytes.
fn npy_header(rows: usize, columns: usize) -> Vec<u8> {
    let mut text =
        format!("{{'descr': '<u2', 'fortran_order': True, 'shape': ({rows}, {columns}), }}");
    let unpadded = 10 + text.len() + 1;
    text.push_str(&" ".repeat(unpadded.next_multiple_of(64) - unpadded));
    text.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend_from_slice(&(text.len() as u16).to_le_bytes());
    bytes.extend_from_slice(text.as_bytes());
    bytes
}

fn piece(kept: &Checkpoint, tile: usize) -> Result<Vec<u8>, Error> {
    kept.read(tile)?.ok_or_else(|| Error::Piece {
        path: Path::new(kept.description()).into(),
        reason: "a finished tile has gone",
    })
}

/// Every so many-th pixel, for the picture.
fn thinned(kept: &Checkpoint, grid: &Grid) -> Result<LabelImage, Error> {
    let (columns, rows) = (grid.columns.min(PICTURE), grid.rows.min(PICTURE));
    let mut labels = vec![0u16; columns * rows];
    let mut held: Option<(usize, Vec<u8>)> = None;
    for column in 0..columns {
        let from = column * grid.columns / columns;
        if held.as_ref().is_none_or(|(tile, _)| *tile != from / TILE) {
            held = Some((from / TILE, piece(kept, from / TILE)?));
        }
        let Some((tile, bytes)) = &held else { continue };
        let base = (from - tile * TILE) * grid.rows;
        for row in 0..rows {
            let at = 2 * (base + row * grid.rows / rows);
            let label =
                bytes.get(at..at + 2).map_or(0, |pair| u16::from_le_bytes([pair[0], pair[1]]));
            labels[row * columns + column] = label;
        }
    }
    Ok(LabelImage { grid: Grid { columns, rows, ..*grid }, labels })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hopper_basin::basin_raster;
    use passive_hopper::alpha_star;
    use std::ops::ControlFlow;

    #[test]
    fn absurd_windows_are_refused_before_anything_is_written() {
        let options = |mass_ratio: [f64; 2], speed: [f64; 2], pixels: [usize; 2]| Options {
            out: PathBuf::from("/nowhere"),
            mass_ratio: mass_ratio.to_vec(),
            speed: Some(speed.to_vec()),
            pixels: pixels.to_vec(),
        };
        let (m, alpha) = ([0.1, 1.0], [4.5, 20.0]);
        assert!(grid(&options(m, alpha, [10, 20])).is_ok());
        for pixels in [[0, 10], [10, 0], [usize::MAX, 2], [1, 1 << 21], [1 << 20, 1 << 20]] {
            assert!(grid(&options(m, alpha, pixels)).is_err(), "{pixels:?}");
        }
        for window in
            [[1.0, 1.0], [2.0, 1.0], [1.0, 1.0f64.next_up()], [f64::NAN, 1.0], [0.0, f64::INFINITY]]
        {
            assert!(grid(&options(window, alpha, [10, 10])).is_err(), "{window:?}");
            assert!(grid(&options(m, window, [10, 10])).is_err(), "{window:?}");
        }
        for window in [[0.0, 1e6], [-1.0, 5.0]] {
            assert!(grid(&options(m, window, [10, 10])).is_err(), "{window:?}");
        }
    }

    #[test]
    fn the_header_is_one_that_numpy_reads() {
        let header = npy_header(3, 4);
        assert_eq!(header.len() % 64, 0);
        assert_eq!(&header[..8], b"\x93NUMPY\x01\x00");
        let mut bytes = header;
        bytes.extend((0u16..12).flat_map(u16::to_le_bytes));
        let array: ndarray::Array2<u16> =
            ndarray_npy::ReadNpyExt::read_npy(std::io::Cursor::new(bytes)).unwrap();
        assert_eq!(array.dim(), (3, 4));
        assert_eq!((array[(0, 0)], array[(2, 0)], array[(0, 1)]), (0, 2, 3));
    }

    /// Tiles hold the labels of the whole raster.
    #[test]
    fn tiles_are_the_raster() {
        let window = Interval::new(alpha_star(1), alpha_star(3)).unwrap();
        let x = Interval::new(0.1, 0.9).unwrap();
        let grid = Grid { x, y: window, columns: 40, rows: 25 };
        let whole = basin_raster(grid, |_| ControlFlow::Continue(())).unwrap();
        for tile in 0..3 {
            let bytes = columns(&grid, tile).unwrap();
            for (k, pair) in bytes.chunks(2).enumerate() {
                let (column, row) = (tile * TILE + k / 25, k % 25);
                let label = u16::from_le_bytes([pair[0], pair[1]]);
                assert_eq!(Some(label), whole.at(column, row), "{column} {row}");
            }
        }
    }
}
