//! `hopper basins`: the basins over any window of (M, α), in tiles on disk, layer by layer.
//!
//! A call that is killed leaves its finished tiles, and the next call computes the others. The array is written
//! from the tiles and compared with them. The tiles are removed only after this comparison.

use crate::basins::call::Call;
use crate::basins::job::{Job, Visit, Words, raster_in};
use crate::basins::job_folder::{JobFolder, Place, Share};
use crate::basins::layer::StoredLayer;
use crate::basins::options::RasterOptions;
use crate::basins::pieces::compute;
use crate::basins::tables::Tables;
use crate::basins::window::grid;
use crate::error::Error;
use basin_of_attraction::Grid;
use hopper_basin::RASTER_VERSION;
use hopper_figures::{FLAG, LAYERS, Meaning};
use std::path::Path;

/// Pixels across and up unless others are given.
pub(crate) const PIXELS: [usize; 2] = [1024, 1024];

/// Mass ratios unless others are given.
pub(crate) const MASS_RATIOS: [f64; 2] = [0.1, 1.0];

impl RasterOptions {
    /// The grid, with so many pixels unless others are given.
    pub(crate) fn grid(&self, pixels: [usize; 2]) -> Result<Grid, Error> {
        let mass_ratio = self.mass_ratio.as_deref().unwrap_or(&MASS_RATIOS);
        grid(mass_ratio, self.speed.as_deref(), self.pixels.as_deref().unwrap_or(&pixels))
    }

    /// The layers, each once.
    pub(crate) fn layers(&self) -> Vec<StoredLayer> {
        let keys = match self.layer.is_empty() {
            true => vec![LAYERS[0].key],
            false => self.layer.iter().map(String::as_str).collect(),
        };
        let mut layers: Vec<StoredLayer> = Vec::new();
        for layer in keys.into_iter().filter_map(StoredLayer::of) {
            if layers.iter().all(|other| other.array != layer.array) {
                layers.push(layer);
            }
        }
        layers
    }
}

fn description(grid: &Grid) -> String {
    format!(
        "basins, M {:?} to {:?}, α {:?} to {:?}, {} × {} pixels; computation {RASTER_VERSION}",
        grid.x.left, grid.x.right, grid.y.left, grid.y.right, grid.columns, grid.rows
    )
}

impl Job for RasterOptions {
    fn words(&self) -> Words {
        let mut words = Words::of("basins");
        words.window(self.mass_ratio.as_deref(), self.speed.as_deref(), self.pixels.as_deref());
        let keys: Vec<&str> = self.layers().iter().map(|layer| layer.layer.key).collect();
        words.option("--layer", Some(&keys));
        words
    }

    /// With the layers that are in the folder already, in the order of the table.
    fn words_in(&self, folder: &Path) -> Words {
        let mut own = self.clone();
        if let Some(kept) = raster_in(folder)
            && kept.grid(PIXELS).ok() == self.grid(PIXELS).ok()
        {
            let layers: Vec<&str> = [self, &kept]
                .iter()
                .flat_map(|job| job.layers())
                .map(|own| own.layer.key)
                .collect();
            let known = LAYERS.iter().map(|layer| layer.key).filter(|key| layers.contains(key));
            own.layer = known.map(str::to_owned).collect();
        }
        own.words()
    }

    fn visit(&self, visit: &mut Visit<'_>) -> Result<(), Error> {
        let grid = self.grid(PIXELS)?;
        let description = description(&grid);
        for layer in self.layers() {
            visit(&description, &layer.work(&grid), &layer.results())?;
        }
        Ok(())
    }

    fn run(&self, place: &Place<'_>, call: &mut Call<'_>) -> Result<Tables, Error> {
        let (grid, layers) = (self.grid(PIXELS)?, self.layers());
        let results: Vec<&str> =
            layers.iter().flat_map(|layer| layer.files().into_iter().take(4)).collect();
        let job = JobFolder::open(place, description(&grid), &results)?;
        let mut tables = Tables::default();
        for layer in &layers {
            one_layer(&job, &grid, layer, call, &mut tables)?;
        }
        Ok(tables)
    }
}

fn one_layer(
    job: &JobFolder,
    grid: &Grid,
    layer: &StoredLayer,
    call: &mut Call<'_>,
    tables: &mut Tables,
) -> Result<(), Error> {
    let (results, work) = (layer.results(), layer.work(grid));
    let (tiles, folder) = (work.count, work.folder);
    let summary = match job.complete(&results, &work, call)? {
        Some(summary) => summary,
        None => {
            let interrupt = call.interrupt.clone();
            let finished = compute(job, &work, call, |tile| layer.tile(grid, tile, &interrupt))?;
            if let Share::Part(part) = job.share {
                tables.push_part(part, folder, &finished);
                return Ok(());
            }
            let summary = layer.assemble(job, grid, (tiles, &finished), &call.interrupt)?;
            job.finish(
                &results,
                &[&layer.array, &layer.picture],
                &summary,
                (finished.kept, tiles),
            )?;
            summary
        }
    };
    tables.push_layer(layer.layer.key, layer.values, &summary);
    let bits = 8 * layer.values.bytes;
    let order = "rows from the lowest speed, columns of mass ratios";
    let (numbers, about_summary) = match layer.values.meaning {
        Meaning::Fates { flag: None } => ("labels".into(), "the meaning of the labels"),
        Meaning::Fates { flag: Some(flag) } => {
            (format!("labels, and {FLAG} more where they are {flag}"), "the meaning of the labels")
        }
        Meaning::Numbers { .. } | Meaning::Reals(_) => {
            (layer.layer.name.into(), "the smallest, the largest and the mean")
        }
    };
    let kind = match layer.values.meaning {
        Meaning::Reals(_) => "floating-point numbers",
        Meaning::Numbers { .. } | Meaning::Fates { .. } => "integers",
    };
    for (name, content) in [
        (&layer.array, format!("{numbers}: {bits}-bit {kind}, {order}")),
        (&layer.picture, "the picture, with axes and legend".into()),
        (&results.summary.into(), about_summary.into()),
    ] {
        tables.push_file(job.place_of(name), &content);
    }
    Ok(())
}
