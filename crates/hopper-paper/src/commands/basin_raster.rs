//! `basin-raster`: the basins over any window of (M, α), in tiles on disk.
//!
//! A run that is killed leaves its finished tiles, and the next run computes the others. The array is written from the
//! tiles and compared with them. The tiles are removed only after this comparison.

use super::coverage_files;
use super::share_files::{self, Shares};
use super::zoom_files::{self, Zoom};
use crate::error::Error;
use crate::figures::basin_plot::{PIXELS, Window, draw_basins};
use basin_of_attraction::{Grid, Interval, Label, LabelImage};
use hopper_asymptotics::Offset;
use hopper_basin::{HopperFate, basin_columns, first_humps};
use journal_figures::render;
use passive_hopper::MassRatio;
use rayon::prelude::*;
use repository_tools::{Folder, Progress};
use resumable_job::{AtomicFile, Lock, Order, Pieces, npy_header};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub struct Options {
    /// Folder for the results, and for finished tiles until the results are complete
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Mass ratios from and to
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], default_values_t = [0.1, 1.0], allow_negative_numbers = true)]
    mass_ratio: Vec<f64>,
    /// Lift-off speeds from and to [default: the first and the sixth fixed point]
    #[arg(long, num_args = 2, value_names = ["FROM", "TO"], allow_negative_numbers = true)]
    speed: Option<Vec<f64>>,
    /// Pixels across and up [default: 1024 1024; with --zoom 320 320]
    #[arg(long, num_args = 2, value_names = ["COLUMNS", "ROWS"])]
    pixels: Option<Vec<usize>>,
    /// Show the speeds below this fixed point at all scales: each pixel has the shares of the basins that it covers
    #[arg(long, value_name = "N", conflicts_with = "speed")]
    about: Option<u64>,
    /// With --about: distances below the fixed point, on a logarithmic scale [default: 1e-2 1e-300]
    #[arg(long, num_args = 2, value_names = ["FAR", "NEAR"], requires = "about", allow_negative_numbers = true)]
    offset: Option<Vec<Offset>>,
    /// With --about: distances from a preimage of the fixed point instead, on both sides. It is the one next to this speed at
    /// this mass ratio, followed over the mass ratios of the raster
    #[arg(long, num_args = 2, value_names = ["M", "SPEED"], requires = "about", conflicts_with = "turns", allow_negative_numbers = true)]
    preimage: Option<Vec<f64>>,
    /// With --about: the phase instead of the distance, so many turns of the circle of fates
    #[arg(
        long,
        value_name = "TURNS",
        requires = "about",
        conflicts_with = "offset",
        allow_negative_numbers = true
    )]
    turns: Option<f64>,
    /// Give each pixel the shares of the basins in it at the mass ratio of its column. At most this part of a pixel stays undecided,
    /// unless too many basins meet there
    #[arg(long, value_name = "TOLERANCE", num_args = 0..=1, default_missing_value = "0.05", conflicts_with_all = ["about", "zoom"], allow_negative_numbers = true)]
    coverage: Option<f64>,
    /// Make a sequence of frames into the edge of a basin next to this speed, at this mass ratio
    #[arg(long, num_args = 2, value_names = ["M", "SPEED"], conflicts_with_all = ["about", "speed"], allow_negative_numbers = true)]
    zoom: Option<Vec<f64>>,
    /// With --zoom: the number of frames; the first has the half height 1
    #[arg(long, value_name = "COUNT", requires = "zoom", default_value_t = 101)]
    frames: usize,
    /// With --zoom: decades from one frame to the next
    #[arg(
        long,
        value_name = "DECADES",
        requires = "zoom",
        default_value_t = 1.0,
        allow_negative_numbers = true
    )]
    step: f64,
}

/// Pixels across and up unless others are given.
const PIXELS_OF_RASTER: [usize; 2] = [1024, 1024];
const PIXELS_OF_FRAME: [usize; 2] = [320, 320];

/// Columns of a tile. A killed run loses one unfinished tile for each thread: with wider tiles more work is lost.
/// Narrower tiles share less work between columns, and are more files to flush.
const TILE: usize = 16;

/// The largest number of pixels along each axis. A tile of 2²⁰ rows has 32 MiB of labels, and some hundred megabytes
/// are in use while it is computed.
const MOST_ALONG: usize = 1 << 20;

/// The largest number of pixels of the picture along each axis: as many as the paper's basin figures have, since both
/// are drawn in the same frame. The picture of a larger raster shows some of its columns and rows only; the array has
/// them all.
const PICTURE: usize = PIXELS;

/// The names of the results.
const ARRAY: &str = "basin.npy";
const PICTURE_FILE: &str = "basin.png";
const LEGEND: &str = "legend.json";

/// Runs the command.
pub fn run(options: &Options) -> Result<(), Error> {
    if let Some(n) = options.about {
        let Options { out, mass_ratio, offset, turns, .. } = options.clone();
        let pixels = options.pixels.clone().unwrap_or(PIXELS_OF_RASTER.to_vec());
        let preimage = options.preimage.as_deref().and_then(|pair| pair.try_into().ok());
        return share_files::run(&Shares { n, out, mass_ratio, pixels, offset, turns, preimage });
    }
    if let Some(&[mass_ratio, speed]) = options.zoom.as_deref() {
        let Options { out, frames, step, .. } = options.clone();
        let &[columns, rows] = options.pixels.as_deref().unwrap_or(&PIXELS_OF_FRAME) else {
            return Err(Error::CheckFailed("--pixels takes columns and rows".into()));
        };
        return zoom_files::run(&Zoom { out, mass_ratio, speed, frames, step, columns, rows });
    }
    let grid = grid(options)?;
    if let Some(tolerance) = options.coverage {
        return coverage_files::run(&options.out, grid, tolerance);
    }
    let folder = Folder::open(&options.out)?;
    let description = format!(
        "basins, M {:?} to {:?}, α {:?} to {:?}, {} × {} pixels",
        grid.x.left, grid.x.right, grid.y.left, grid.y.right, grid.columns, grid.rows
    );
    let lock = Lock::take(folder.path(), "basin-raster")?;
    // A result that cannot have its name is an error before the computation. The trial files are dropped unfinished,
    // which removes them.
    for name in [ARRAY, PICTURE_FILE, LEGEND] {
        drop(AtomicFile::create(&folder.path().join(name))?);
    }
    let kept = Pieces::open(&folder.path().join("tiles"), &description)?;
    let tiles = grid.columns.div_ceil(TILE);
    let bar = Progress.bar("basins", tiles as u64);
    let done = AtomicU64::new(0);
    (0..tiles).into_par_iter().try_for_each(|tile| {
        if kept.read(tile)?.is_none() {
            let labels = columns(&grid, tile)?;
            // Without its lock this run would write among the tiles of another run.
            lock.confirm()?;
            kept.write(tile, &labels)?;
        }
        bar.set(done.fetch_add(1, Ordering::Relaxed) + 1);
        Ok::<(), Error>(())
    })?;
    bar.finish();
    lock.confirm()?;
    let array = folder.path().join(ARRAY);
    let mut counts = BTreeMap::new();
    let mut picture = Picture::new(&grid);
    // Row 0 is the lowest speed. In Fortran's order the columns, and therefore the tiles, follow one another in the
    // file.
    let header = npy_header(Order::Fortran, grid.rows, grid.columns);
    kept.assemble(&array, &header, tiles, |tile, bytes| {
        for pair in bytes.chunks_exact(2) {
            *counts.entry(label(pair)).or_insert(0) += 1;
        }
        picture.add(tile, bytes);
    })?;
    let image = picture.image();
    let window = Window {
        name: "basin",
        mass_ratio: (grid.x.left, grid.x.right),
        alpha: (grid.y.left, grid.y.right),
        inset: None,
        tick_counts: (6, 8),
    };
    let rendered = render("basin", &draw_basins(&window, &image)?, 2.0)?;
    lock.confirm()?;
    folder.write(PICTURE_FILE, &rendered.png)?;
    let legend: Vec<_> = counts
        .iter()
        .map(|(&label, &pixels)| {
            let name = HopperFate::label_name(label);
            serde_json::json!({ "label": label.code(), "name": name, "pixels": pixels })
        })
        .collect();
    let text = serde_json::to_string_pretty(&legend)
        .map_err(|e| Error::Render { what: LEGEND.into(), reason: e.to_string() })?;
    lock.confirm()?;
    folder.write(LEGEND, text.as_bytes())?;
    kept.remove(tiles)?;
    folder.remove_leftovers();
    drop(lock);
    let mut out = std::io::stdout().lock();
    let said = (|| {
        for (&label, pixels) in &counts {
            let (code, name) = (label.code(), HopperFate::label_name(label));
            writeln!(out, "label {code:5}  {name:40} {pixels} pixels")?;
        }
        writeln!(out, "{}\n{}", array.display(), folder.path().join(PICTURE_FILE).display())
    })();
    said.map_err(|source| Error::File { path: "standard output".into(), source })
}

fn grid(options: &Options) -> Result<Grid, Error> {
    let pair = |values: &[f64]| match *values {
        [from, to] => Interval::new(from, to).map_err(Error::from),
        _ => Err(Error::CheckFailed("two numbers are needed, from and to".into())),
    };
    let default = [first_humps(5).left, first_humps(5).right];
    let &[columns, rows] = options.pixels.as_deref().unwrap_or(&PIXELS_OF_RASTER) else {
        return Err(Error::CheckFailed("--pixels takes columns and rows".into()));
    };
    if columns.max(rows) > MOST_ALONG {
        return Err(basin_of_attraction::Error::BadRaster { columns, rows }.into());
    }
    let speed = options.speed.as_deref().unwrap_or(&default);
    for values in [&options.mass_ratio[..], speed] {
        // A window narrower than 10⁻¹² of its end has some thousand doubles: many neighbouring pixels would be the same
        // point after rounding.
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
    // This call labels no column. It refuses a grid that has no labels before anything is written.
    basin_columns(&grid, 0..0)?;
    Ok(grid)
}

/// The labels of one tile, column by column from the lowest speed up, in little-endian order.
fn columns(grid: &Grid, tile: usize) -> Result<Vec<u8>, Error> {
    let first = tile * TILE;
    let count = TILE.min(grid.columns - first);
    let labels = basin_columns(grid, first..first + count)?;
    Ok(labels.iter().flatten().flat_map(|label| label.code().to_le_bytes()).collect())
}

/// The label in two bytes of a tile.
fn label(pair: &[u8]) -> Label {
    match *pair {
        [low, high] => Label::from_code(u16::from_le_bytes([low, high])),
        _ => Label::UNDECIDED,
    }
}

/// The picture of a raster that may be larger: ⌊k · size / picture size⌋ of its columns and rows.
struct Picture {
    grid: Grid,
    image: LabelImage,
    /// The next column of the picture; tiles come in order.
    next: usize,
}

impl Picture {
    fn new(grid: &Grid) -> Self {
        let (columns, rows) = (grid.columns.min(PICTURE), grid.rows.min(PICTURE));
        let labels = vec![Label::OUTSIDE; columns * rows];
        let image = LabelImage { grid: Grid { columns, rows, ..*grid }, labels };
        Picture { grid: *grid, image, next: 0 }
    }

    /// Takes from the next tile the columns that the picture shows.
    fn add(&mut self, tile: usize, bytes: &[u8]) {
        let Grid { columns, rows, .. } = self.image.grid;
        while self.next < columns {
            let from = self.next * self.grid.columns / columns;
            if from >= (tile + 1) * TILE {
                return; // it is in a later tile
            }
            let base = (from - tile * TILE) * self.grid.rows;
            for row in 0..rows {
                let at = 2 * (base + row * self.grid.rows / rows);
                let pair = bytes.get(at..at + 2);
                let label = pair.map_or(Label::UNDECIDED, label);
                self.image.labels[row * columns + self.next] = label;
            }
            self.next += 1;
        }
    }

    fn image(self) -> LabelImage {
        self.image
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hopper_basin::basin_raster;
    use passive_hopper::alpha_star;
    use std::ops::ControlFlow;

    #[test]
    fn windows_without_labels_are_refused_before_anything_is_written() {
        let options = |mass_ratio: [f64; 2], speed: [f64; 2], pixels: [usize; 2]| Options {
            out: PathBuf::from("/nowhere"),
            mass_ratio: mass_ratio.to_vec(),
            speed: Some(speed.to_vec()),
            pixels: Some(pixels.to_vec()),
            about: None,
            offset: None,
            turns: None,
            preimage: None,
            coverage: None,
            zoom: None,
            frames: 1,
            step: 1.0,
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

    /// A picture of a larger raster shows its pixels at equal distances, whatever tile they are in.
    #[test]
    fn the_picture_shows_pixels_of_the_raster() {
        let x = Interval::new(0.1, 0.9).unwrap();
        for (columns, rows) in [(1, 1), (40, 25), (1200, 3), (1201, 2), (2999, 1300)] {
            let grid = Grid { x, y: x, columns, rows };
            let label = |column: usize, row: usize| (7 * column + 3 * row) as u16;
            let mut picture = Picture::new(&grid);
            for tile in 0..columns.div_ceil(TILE) {
                let within = tile * TILE..columns.min((tile + 1) * TILE);
                let labels = within.flat_map(|c| (0..rows).map(move |r| label(c, r)));
                picture.add(tile, &labels.flat_map(u16::to_le_bytes).collect::<Vec<_>>());
            }
            let image = picture.image();
            let shown = image.grid;
            for column in 0..shown.columns {
                for row in 0..shown.rows {
                    let from = (column * columns / shown.columns, row * rows / shown.rows);
                    assert_eq!(
                        image.at(column, row),
                        Some(Label::from_code(label(from.0, from.1)))
                    );
                }
            }
        }
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
                assert_eq!(Some(label(pair)), whole.at(column, row), "{column} {row}");
            }
        }
    }
}
