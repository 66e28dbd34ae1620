//! `hopper basins`: the basins over any window of (M, α), in tiles on disk, layer by layer.
//!
//! A call that is killed leaves its finished tiles, and the next call computes the others. The array is written
//! from the tiles and compared with them. The tiles are removed only after this comparison.

use crate::basins::call::{Call, Payload, Work};
use crate::basins::job_folder::{JobFolder, Share};
use crate::basins::layer::{StoredLayer, TILE};
use crate::basins::pieces::compute;
use crate::basins::tables::Tables;
use crate::error::Error;
use basin_of_attraction::Grid;
use hopper_basin::RASTER_VERSION;
use hopper_figures::{FLAG, Meaning};
use std::path::Path;

/// Computes the layers of a raster.
pub(crate) fn run(
    place: (&Path, Share, bool),
    grid: &Grid,
    layers: &[StoredLayer],
    call: &mut Call<'_>,
) -> Result<Tables, Error> {
    let description = format!(
        "basins, M {:?} to {:?}, α {:?} to {:?}, {} × {} pixels; computation {RASTER_VERSION}",
        grid.x.left, grid.x.right, grid.y.left, grid.y.right, grid.columns, grid.rows
    );
    let results: Vec<&str> =
        layers.iter().flat_map(|layer| layer.files().into_iter().take(4)).collect();
    let job = JobFolder::open(place, description, &results)?;
    let mut tables = Tables::default();
    let is_new = |at: usize| layers[..at].iter().all(|other| other.array != layers[at].array);
    for at in (0..layers.len()).filter(|&at| is_new(at)) {
        one_layer(&job, grid, &layers[at], call, &mut tables)?;
    }
    Ok(tables)
}

fn one_layer(
    job: &JobFolder,
    grid: &Grid,
    layer: &StoredLayer,
    call: &mut Call<'_>,
    tables: &mut Tables,
) -> Result<(), Error> {
    let results = layer.results();
    let tiles = grid.columns.div_ceil(TILE);
    let pixels = TILE.min(grid.columns) * grid.rows;
    let (columns, rows) = (grid.columns, grid.rows);
    let payload = Payload::Tile { width: TILE, columns, rows, element: layer.values.bytes };
    let (folder, unit) = (layer.tiles.as_str(), layer.layer.pieces);
    let work = Work { folder, unit, count: tiles, pixels, payload };
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
