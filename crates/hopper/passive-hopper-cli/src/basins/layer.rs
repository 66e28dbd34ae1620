//! A layer of a raster on disk: its tiles, its array, its picture and its summary.

use crate::basins::call::{Payload, Work};
use crate::basins::job_folder::{JobFolder, Results};
use crate::basins::picture::Picture;
use crate::basins::pieces::Finished;
use crate::error::Error;
use crate::interrupt::Interrupt;
use basin_of_attraction::{Grid, Label};
use hopper_basin::HopperFate;
use hopper_figures::{
    BasinWindow, FLAG, LAYERS, Layer, LayerColumns, Meaning, Values, draw_layer, label_of,
};
use journal_figures::{Element, Order, npy_header};
use journal_figures::{Svg, render};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Columns of a tile. A killed run loses one unfinished tile for each thread: with wider tiles more work is lost.
/// Narrower tiles share less work between columns, and are more files to flush.
pub(crate) const TILE: usize = 16;

/// Pixels of a picture for each point of its drawing.
pub(crate) const SHARPNESS: f64 = 2.0;

/// A layer of numbers, and the names of its files.
#[derive(Debug, Clone)]
pub(crate) struct StoredLayer {
    pub(crate) layer: &'static Layer,
    pub(crate) values: &'static Values,
    pub(crate) tiles: String,
    pub(crate) array: String,
    pub(crate) picture: String,
    summary: String,
    digests: String,
}

/// All layers of numbers: coverage has a job of its own.
pub(crate) fn stored_layers() -> impl Iterator<Item = StoredLayer> {
    LAYERS.iter().filter_map(|layer| StoredLayer::of(layer.key))
}

impl StoredLayer {
    /// The layer with one of the keys; `None` for a layer of shares and for other words.
    pub(crate) fn of(key: &str) -> Option<Self> {
        let layer = Layer::of(key)?;
        let values = layer.values()?;
        let (file, key) = (layer.file, layer.key);
        // The folders of the first layer have no key: they are older than the others.
        let is_first = std::ptr::eq(layer, &raw const LAYERS[0]);
        let [tiles, summary] = match is_first {
            true => ["tiles".into(), "legend.json".into()],
            false => [format!("tiles_{key}"), format!("{key}.json")],
        };
        let [array, picture, digests] =
            ["npy", "png", "digests"].map(|end| format!("{file}.{end}"));
        Some(StoredLayer { layer, values, tiles, array, picture, summary, digests })
    }

    /// The results whose digests tell whether they are complete.
    pub(crate) fn results(&self) -> Results<'_> {
        Results { main: &self.array, summary: &self.summary, digests: &self.digests }
    }

    /// Its tiles.
    pub(crate) fn work(&self, grid: &Grid) -> Work<'_> {
        let Grid { columns, rows, .. } = *grid;
        Work {
            folder: &self.tiles,
            unit: self.layer.pieces,
            count: columns.div_ceil(TILE),
            pixels: TILE.min(columns) * rows,
            payload: Payload::Tile { width: TILE, columns, rows, element: self.values.bytes },
        }
    }

    /// The names of all its files, and of the folder of its tiles.
    pub(crate) fn files(&self) -> [&str; 5] {
        [&self.array, &self.picture, &self.summary, &self.digests, &self.tiles]
    }

    /// One tile, column by column from the lowest speed up, in little-endian order.
    pub(crate) fn tile(
        &self,
        grid: &Grid,
        tile: usize,
        interrupt: &Interrupt,
    ) -> Result<Vec<u8>, Error> {
        let columns = tile * TILE..grid.columns.min((tile + 1) * TILE);
        // A tall tile takes minutes.
        let width = self.values.together;
        let mut bytes = Vec::new();
        for from in columns.clone().step_by(width) {
            interrupt.check()?;
            let columns = from..columns.end.min(from + width);
            let found =
                (self.values.columns)(&LayerColumns { grid: *grid, logarithmic: false, columns })?;
            for value in found.iter().flatten() {
                bytes.extend(&value.to_le_bytes()[..self.values.bytes]);
            }
        }
        Ok(bytes)
    }

    /// The numbers of a tile.
    pub(crate) fn numbers(&self, bytes: &[u8]) -> impl Iterator<Item = u64> {
        let size = self.values.bytes;
        bytes.chunks_exact(size).map(move |bytes| {
            let mut word = [0; 8];
            word[..size].copy_from_slice(bytes);
            u64::from_le_bytes(word)
        })
    }

    /// Joins the tiles to the array, and draws the picture. Returns the summary, which is not written yet.
    pub(crate) fn assemble(
        &self,
        job: &JobFolder,
        grid: &Grid,
        (tiles, finished): (usize, &Finished),
        interrupt: &Interrupt,
    ) -> Result<Value, Error> {
        let size = self.values.bytes;
        let is_real = matches!(self.values.meaning, Meaning::Reals(_));
        let element = match size {
            _ if is_real => Element::F32,
            2 => Element::U16,
            4 => Element::U32,
            _ => Element::U64,
        };
        // Row 0 is the lowest speed. In Fortran's order the columns, and therefore the tiles, follow one another in the
        // file.
        let header = npy_header(Order::Fortran, element, grid.rows, grid.columns);
        let (mut counts, mut values) = (BTreeMap::new(), Vec::new());
        let mut reals = Reals::default();
        // A pixel that is not there has no number.
        let absent = match is_real {
            true => u64::from(f32::NAN.to_bits()),
            false => u64::from(Label::OUTSIDE.code()),
        };
        let mut picture = Picture::new(grid, TILE, absent);
        finished.kept.assemble(
            &job.path.join(&self.array),
            &header,
            tiles,
            // The joining of a large raster takes minutes.
            || interrupt.check(),
            |tile, bytes| {
                values.clear();
                values.extend(self.numbers(bytes));
                match is_real {
                    true => values.iter().for_each(|&value| reals.add(self.values.number(value))),
                    false => {
                        values.iter().for_each(|&value| *counts.entry(value).or_insert(0u64) += 1);
                    }
                }
                picture.add(tile, &values);
            },
        )?;
        let window = window(grid, self.layer.file);
        let drawing =
            draw_layer((self.layer, self.values), &window, &picture.grid, &picture.pixels)?;
        job.write(&self.picture, &png(&self.picture, &drawing)?)?;
        Ok(match self.values.meaning {
            Meaning::Fates { flag } => legend(&counts, flag),
            Meaning::Numbers { .. } => summary(&counts),
            Meaning::Reals(_) => reals.summary(),
        })
    }
}

fn png(name: &str, drawing: &Svg) -> Result<Vec<u8>, Error> {
    Ok(render(name, drawing, SHARPNESS)?.png)
}

pub(crate) fn window(grid: &Grid, name: &'static str) -> BasinWindow {
    BasinWindow {
        name,
        mass_ratio: (grid.x.left, grid.x.right),
        alpha: (grid.y.left, grid.y.right),
        inset: None,
        tick_counts: (6, 8),
    }
}

/// The labels that occur, with their names, their flags and numbers of pixels.
fn legend(counts: &BTreeMap<u64, u64>, flag: Option<&str>) -> Value {
    let entry = |(&value, &pixels): (&u64, &u64)| {
        let label = label_of(value);
        let name = HopperFate::label_name(label);
        let mut entry = json!({ "label": label.code(), "name": name, "pixels": pixels });
        if let Some(flag) = flag {
            entry[flag] = json!(value & FLAG != 0);
        }
        entry
    };
    Value::Array(counts.iter().map(entry).collect())
}

/// The smallest, the largest and the mean of numbers. 2³⁴ pixels with numbers up to 2⁶⁴ fit.
fn summary(counts: &BTreeMap<u64, u64>) -> Value {
    let pixels: u64 = counts.values().sum();
    let product = |(&value, &count): (&u64, &u64)| u128::from(value) * u128::from(count);
    let sum: u128 = counts.iter().map(product).sum();
    let (smallest, largest) = (counts.keys().next(), counts.keys().next_back());
    let mean = (pixels > 0).then(|| sum as f64 / pixels as f64);
    json!({ "pixels": pixels, "smallest": smallest, "largest": largest, "mean": mean })
}

/// The smallest, the largest and the mean of real numbers, of which there may be as many as pixels.
#[derive(Debug, Default)]
struct Reals {
    pixels: u64,
    without: u64,
    ends: Option<(f64, f64)>,
    sum: f64,
}

impl Reals {
    fn add(&mut self, number: f64) {
        self.pixels += 1;
        if number.is_nan() {
            self.without += 1;
            return;
        }
        let (smallest, largest) = self.ends.unwrap_or((number, number));
        self.ends = Some((smallest.min(number), largest.max(number)));
        self.sum += number;
    }

    fn summary(&self) -> Value {
        let (smallest, largest) = self.ends.unzip();
        let mean = self.ends.map(|_| self.sum / (self.pixels - self.without) as f64);
        json!({
            "pixels": self.pixels, "without": self.without,
            "smallest": smallest, "largest": largest, "mean": mean,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::basins::tables;
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
            let [labels, hops] = ["label", "hops"]
                .map(|key| StoredLayer::of(key).unwrap().tile(&grid, tile, &interrupt).unwrap());
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

    /// Two layers with one file would overwrite each other.
    #[test]
    fn every_layer_has_files_and_a_table_of_its_own() {
        let mut files: Vec<String> =
            stored_layers().flat_map(|own| own.files().map(str::to_owned)).collect();
        let all = files.len();
        files.sort();
        files.dedup();
        assert_eq!((all, files.len()), (5 * stored_layers().count(), all));
        for own in stored_layers() {
            let key = own.layer.key;
            let table = tables::of_layer(key).unwrap_or_else(|| panic!("{key} has no table"));
            let shown = tables::ALL.iter().filter(|kind| std::ptr::eq(**kind, table)).count();
            assert_eq!(shown, 1, "the table of {key} is not in the help");
        }
    }

    #[test]
    fn a_summary_of_numbers_has_their_range_and_mean() {
        assert!(summary(&BTreeMap::new())["mean"].is_null());
        let found = summary(&BTreeMap::from([(3, 1), (u64::MAX, 1), (0, 1)]));
        assert_eq!(
            (found["smallest"].as_u64(), found["largest"].as_u64()),
            (Some(0), Some(u64::MAX))
        );
        assert_eq!(found["mean"].as_f64(), Some((u64::MAX as f64 + 3.0) / 3.0));
    }
}
