//! `hopper basins`: the basins over any window of (M, α), in tiles on disk, layer by layer.
//!
//! A call that is killed leaves its finished tiles, and the next call computes the others. The array is written
//! from the tiles and compared with them. The tiles are removed only after this comparison.

use crate::basins::call::{Call, Payload, Work};
use crate::basins::job_folder::{JobFolder, Share};
use crate::basins::layer::{Layer, TILE};
use crate::basins::pieces::compute;
use crate::basins::tables::{self, Tables};
use crate::error::Error;
use basin_of_attraction::Grid;
use hopper_basin::RASTER_VERSION;
use std::path::Path;

/// Computes the layers of a raster.
pub(crate) fn run(
    place: (&Path, Share, bool),
    grid: &Grid,
    layers: &[Layer],
    call: &mut Call<'_>,
) -> Result<Tables, Error> {
    let description = format!(
        "basins, M {:?} to {:?}, α {:?} to {:?}, {} × {} pixels; computation {RASTER_VERSION}",
        grid.x.left, grid.x.right, grid.y.left, grid.y.right, grid.columns, grid.rows
    );
    let results: Vec<&str> = layers
        .iter()
        .map(|layer| layer.names())
        .flat_map(|names| {
            [names.array, names.picture, names.results.summary, names.results.digests]
        })
        .collect();
    let job = JobFolder::open(place, description, &results)?;
    let mut tables = Tables::default();
    let repeated = |at: usize| layers[..at].contains(&layers[at]);
    for layer in (0..layers.len()).filter(|&at| !repeated(at)).map(|at| layers[at]) {
        one_layer(&job, grid, layer, call, &mut tables)?;
    }
    Ok(tables)
}

fn one_layer(
    job: &JobFolder,
    grid: &Grid,
    layer: Layer,
    call: &mut Call<'_>,
    tables: &mut Tables,
) -> Result<(), Error> {
    let names = layer.names();
    let tiles = grid.columns.div_ceil(TILE);
    let pixels = TILE.min(grid.columns) * grid.rows;
    let (columns, rows) = (grid.columns, grid.rows);
    let payload = Payload::Tile { width: TILE, columns, rows, element: layer.element_size() };
    let work = Work { folder: names.tiles, unit: names.unit, count: tiles, pixels, payload };
    let summary = match job.complete(&names.results, &work, call)? {
        Some(summary) => summary,
        None => {
            let interrupt = call.interrupt.clone();
            let finished = compute(job, &work, call, |tile| layer.tile(grid, tile, &interrupt))?;
            if let Share::Part(part) = job.share {
                tables.push_part(part, names.tiles, &finished);
                return Ok(());
            }
            let summary = layer.assemble(job, grid, (tiles, &finished), &call.interrupt)?;
            let others = [names.array, names.picture];
            job.finish(&names.results, &others, &summary, (finished.kept, tiles))?;
            summary
        }
    };
    match layer {
        Layer::Label => tables.labels = tables::labels(&summary),
        Layer::Hops => tables.hops = tables::hops(&summary),
    }
    let contents: [(&str, &str); 3] = match layer {
        Layer::Label => [
            (
                names.array,
                "labels: 16-bit integers, rows from the lowest speed, columns of mass ratios",
            ),
            (names.picture, "the picture, with axes and legend"),
            (names.results.summary, "the meaning of the labels"),
        ],
        Layer::Hops => [
            (names.array, "numbers of hops: 64-bit integers, in the same order"),
            (names.picture, "the picture, with axes and scale"),
            (names.results.summary, "their smallest, largest and mean"),
        ],
    };
    for (name, content) in contents {
        tables.push_file(job.place_of(name), content);
    }
    Ok(())
}
