//! The layers of a raster: the labels of fates, and the numbers of hops until they are known.

use crate::basins::job_folder::{JobFolder, Results};
use crate::basins::picture::Picture;
use crate::basins::pieces::Finished;
use crate::error::Error;
use crate::interrupt::Interrupt;
use basin_of_attraction::{Grid, Label, LabelImage};
use hopper_basin::{HopperFate, basin_columns, hop_columns};
use hopper_figures::{Window, draw_basins, draw_hops};
use journal_figures::{Svg, render};
use resumable_job::{Element, Order, npy_header};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Columns of a tile. A killed run loses one unfinished tile for each thread: with wider tiles more work is lost.
/// Narrower tiles share less work between columns, and are more files to flush.
pub(crate) const TILE: usize = 16;

/// Pixels of a picture for each point of its drawing.
const SHARPNESS: f64 = 2.0;

/// What a raster shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Layer {
    /// The fate of every pixel
    Label,
    /// The number of hops until this fate is known
    Hops,
}

/// The names of a layer's files.
pub(crate) struct Names {
    pub(crate) tiles: &'static str,
    /// What messages call a tile.
    pub(crate) unit: &'static str,
    pub(crate) array: &'static str,
    pub(crate) picture: &'static str,
    pub(crate) results: Results,
}

impl Layer {
    /// Bytes of an element of the array.
    pub(crate) fn element_size(self) -> usize {
        match self {
            Layer::Label => size_of::<u16>(),
            Layer::Hops => size_of::<u64>(),
        }
    }

    pub(crate) fn names(self) -> Names {
        match self {
            Layer::Label => Names {
                tiles: "tiles",
                unit: "tiles",
                array: "basin.npy",
                picture: "basin.png",
                results: Results {
                    main: "basin.npy",
                    summary: "legend.json",
                    digests: "basin.digests",
                },
            },
            Layer::Hops => Names {
                tiles: "tiles_hops",
                unit: "tiles of hops",
                array: "hops.npy",
                picture: "hops.png",
                results: Results {
                    main: "hops.npy",
                    summary: "hops.json",
                    digests: "hops.digests",
                },
            },
        }
    }

    /// One tile, column by column from the lowest speed up, in little-endian order.
    pub(crate) fn tile(
        self,
        grid: &Grid,
        tile: usize,
        interrupt: &Interrupt,
    ) -> Result<Vec<u8>, Error> {
        let columns = tile * TILE..grid.columns.min((tile + 1) * TILE);
        let mut bytes = Vec::new();
        match self {
            Layer::Label => {
                let labels = basin_columns(grid, columns)?;
                bytes.extend(labels.iter().flatten().flat_map(|label| label.code().to_le_bytes()));
            }
            Layer::Hops => {
                for column in columns {
                    // A tall tile takes minutes.
                    interrupt.check()?;
                    let hops = hop_columns(grid, column..column + 1)?;
                    bytes.extend(hops.iter().flatten().flat_map(|hops| hops.to_le_bytes()));
                }
            }
        }
        Ok(bytes)
    }

    /// Joins the tiles to the array, and draws the picture. Returns the summary, which is not written yet.
    pub(crate) fn assemble(
        self,
        job: &JobFolder,
        grid: &Grid,
        (tiles, finished): (usize, &Finished),
        interrupt: &Interrupt,
    ) -> Result<Value, Error> {
        // The joining of a large raster takes minutes.
        let go_on = || interrupt.check();
        let names = self.names();
        let array = job.path.join(names.array);
        // Row 0 is the lowest speed. In Fortran's order the columns, and therefore the tiles, follow one another in the
        // file.
        let header = |element| npy_header(Order::Fortran, element, grid.rows, grid.columns);
        let (drawing, summary) = match self {
            Layer::Label => {
                let (mut counts, mut values) = (BTreeMap::new(), Vec::new());
                let mut picture = Picture::new(grid, TILE, Label::OUTSIDE);
                finished.kept.assemble(
                    &array,
                    &header(Element::U16),
                    tiles,
                    go_on,
                    |tile, bytes| {
                        values.clear();
                        let words = bytes.as_chunks::<2>().0.iter();
                        values
                            .extend(words.map(|word| Label::from_code(u16::from_le_bytes(*word))));
                        for &label in &values {
                            *counts.entry(label).or_insert(0u64) += 1;
                        }
                        picture.add(tile, &values);
                    },
                )?;
                let image = LabelImage { grid: picture.grid, labels: picture.pixels };
                (draw_basins(&window(grid, "basin"), &image)?, legend(&counts))
            }
            Layer::Hops => {
                let (mut hops, mut values) = (Hops::default(), Vec::new());
                let mut picture = Picture::new(grid, TILE, 0u64);
                finished.kept.assemble(
                    &array,
                    &header(Element::U64),
                    tiles,
                    go_on,
                    |tile, bytes| {
                        values.clear();
                        let words = bytes.as_chunks::<8>().0.iter();
                        values.extend(words.map(|word| u64::from_le_bytes(*word)));
                        values.iter().for_each(|&count| hops.add(count));
                        picture.add(tile, &values);
                    },
                )?;
                let drawing = draw_hops(&window(grid, "hops"), &picture.grid, &picture.pixels)?;
                (drawing, hops.summary())
            }
        };
        job.write(names.picture, &png(names.picture, &drawing)?)?;
        Ok(summary)
    }
}

fn png(name: &str, drawing: &Svg) -> Result<Vec<u8>, Error> {
    Ok(render(name, drawing, SHARPNESS)?.png)
}

pub(crate) fn window(grid: &Grid, name: &'static str) -> Window {
    Window {
        name,
        mass_ratio: (grid.x.left, grid.x.right),
        alpha: (grid.y.left, grid.y.right),
        inset: None,
        tick_counts: (6, 8),
    }
}

/// The labels that occur, with their names and numbers of pixels.
fn legend(counts: &BTreeMap<Label, u64>) -> Value {
    let entry = |(&label, &pixels): (&Label, &u64)| {
        let name = HopperFate::label_name(label);
        json!({ "label": label.code(), "name": name, "pixels": pixels })
    };
    Value::Array(counts.iter().map(entry).collect())
}

/// The smallest, the largest and the sum of numbers of hops.
#[derive(Debug, Default)]
struct Hops {
    range: Option<(u64, u64)>,
    /// 2³⁴ pixels with 2⁶⁴ hops each fit.
    sum: u128,
    pixels: u64,
}

impl Hops {
    fn add(&mut self, hops: u64) {
        let (smallest, largest) = self.range.unwrap_or((hops, hops));
        self.range = Some((smallest.min(hops), largest.max(hops)));
        self.sum += u128::from(hops);
        self.pixels += 1;
    }

    fn summary(&self) -> Value {
        let (smallest, largest) = self.range.unzip();
        let mean = (self.pixels > 0).then(|| self.sum as f64 / self.pixels as f64);
        json!({ "pixels": self.pixels, "smallest": smallest, "largest": largest, "mean": mean })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use basin_of_attraction::Interval;
    use hopper_basin::{Fates, HOP_BUDGET, basin_raster};
    use passive_hopper::{MassRatio, alpha_star};
    use std::ops::ControlFlow;

    fn grid() -> Grid {
        let window = Interval::new(alpha_star(1), alpha_star(3)).unwrap();
        Grid { x: Interval::new(0.1, 0.9).unwrap(), y: window, columns: 40, rows: 25 }
    }

    /// Tiles hold the labels of the whole raster, and the numbers of hops of its pixels.
    #[test]
    fn tiles_are_the_raster() {
        let grid = grid();
        let whole = basin_raster(grid, |_| ControlFlow::Continue(())).unwrap();
        let interrupt = Interrupt::default();
        for tile in 0..3 {
            let labels = Layer::Label.tile(&grid, tile, &interrupt).unwrap();
            let hops = Layer::Hops.tile(&grid, tile, &interrupt).unwrap();
            let pairs = labels.as_chunks::<2>().0.iter().zip(hops.as_chunks::<8>().0);
            for (k, (&label, &hops)) in pairs.enumerate() {
                let (column, row) = (tile * TILE + k / 25, k % 25);
                let label = Label::from_code(u16::from_le_bytes(label));
                assert_eq!(Some(label), whole.at(column, row), "{column} {row}");
                if k % 7 == 0 {
                    let fates = Fates::new(MassRatio::new(grid.x_at(column)).unwrap()).unwrap();
                    let (fate, count) = fates.fate_within(grid.y_at(row), HOP_BUDGET).unwrap();
                    assert_eq!((fate.label(), count as u64), (label, u64::from_le_bytes(hops)));
                }
            }
            assert_eq!(
                (labels.len() / 2, hops.len() / 8),
                match tile {
                    2 => (8 * 25, 8 * 25),
                    _ => (16 * 25, 16 * 25),
                }
            );
        }
    }

    #[test]
    fn a_summary_of_hops_has_their_range_and_mean() {
        let mut hops = Hops::default();
        assert!(hops.summary()["mean"].is_null());
        [3, u64::MAX, 0].into_iter().for_each(|count| hops.add(count));
        let summary = hops.summary();
        assert_eq!(
            (summary["smallest"].as_u64(), summary["largest"].as_u64()),
            (Some(0), Some(u64::MAX))
        );
        assert_eq!(summary["mean"].as_f64(), Some((u64::MAX as f64 + 3.0) / 3.0));
    }
}
