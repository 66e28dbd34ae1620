//! The statements that proved rasters make.

use crate::cell::Cell;
use crate::certificate::CertificateLine;
use crate::error::Error;
use crate::hop::strip::Strip;
use crate::line::traps_up_to;
use crate::theorems::cells::ProvedCells;
use crate::theorems::digits::{at_least, at_most};
use crate::theorems::theorem::Theorem;
use basin_of_attraction::{Grid, LabelImage};
use hopper_basin::HopperFate;

/// A window in words.
fn window(grid: &Grid) -> String {
    format!(
        "M from {} to {}, α from {} to {}, {} × {} pixels",
        grid.x.left, grid.x.right, grid.y.left, grid.y.right, grid.columns, grid.rows
    )
}

/// Every point of a raster has the fate of its label. `computed` has the labels of [`hopper_basin::basin_raster`]
/// for the same grid.
///
/// # Errors
/// [`Error::MassRatios`] for a mass ratio of the raster that is none.
pub fn points_theorem(
    name: &'static str,
    proved: &LabelImage,
    computed: &LabelImage,
) -> Result<Theorem, Error> {
    let mut theorem = Theorem::new(
        name,
        format!(
            "The fate of the middle of every pixel is that of its label: {}.",
            window(&proved.grid)
        ),
    );
    let open = proved.labels.iter().filter(|label| label.is_undecided()).count();
    theorem.step(
        "every point is proved",
        format!("{open} of {} open", proved.labels.len()),
        open == 0,
    );
    let pairs = proved.labels.iter().zip(&computed.labels);
    let other =
        pairs.filter(|(proved, computed)| !proved.is_undecided() && proved != computed).count();
    theorem.step(
        "the raster of the library has the same labels",
        format!("{other} differ"),
        other == 0 && computed.grid == proved.grid && computed.labels.len() == proved.labels.len(),
    );
    let grid = proved.grid;
    theorem.evidence.push(CertificateLine::Grid(grid));
    theorem
        .evidence
        .push(CertificateLine::Speeds((0..grid.rows).map(|row| grid.y_at(row)).collect()));
    for column in 0..grid.columns {
        let mass_ratio = grid.x_at(column);
        let traps = traps_up_to(&Strip::at(mass_ratio)?, grid.y.right)?;
        let labels = (0..grid.rows).map(|row| proved.labels[row * grid.columns + column]).collect();
        theorem.evidence.push(CertificateLine::Points { mass_ratio, traps, labels });
    }
    Ok(theorem)
}

/// The area of each basin lies between two bounds, and every pixel that is coloured belongs to one basin as a
/// whole. It is proved if at most `open` of the area is open.
///
/// # Errors
/// [`Error::Columns`] unless all columns of the raster were added.
pub fn cells_theorem(name: &'static str, found: &ProvedCells, open: f64) -> Result<Theorem, Error> {
    let grid = *found.grid();
    if found.columns_added() < grid.columns {
        return Err(Error::Columns { wanted: found.columns_added(), all: grid.columns });
    }
    let areas = found.areas();
    let mut theorem = Theorem::new(
        name,
        format!(
            "All mass ratios and all speeds of a cell that is called a basin's have its fate, and the area of each \
             basin is between the bounds below: {}.",
            window(&grid)
        ),
    );
    for (label, share) in &areas {
        theorem.step(
            format!("the area: {}", HopperFate::label_name(*label)),
            format!("{} to {} of the window", at_least(share.low(), 4), at_most(share.high(), 4)),
            share.low() >= 0.0,
        );
    }
    let area = found.open_area();
    theorem.step(
        format!("at most {open} of the area is open"),
        format!(
            "open area {}; cells that are open {:.4}, or open or cut by a boundary {:.4}",
            at_most(area, 4),
            found.open_cells(),
            found.undecided_cells()
        ),
        area <= open,
    );
    theorem.evidence.push(CertificateLine::Grid(grid));
    let of_one_basin = found.cells().iter().filter(|cell| matches!(cell, Cell::Basin(_))).count();
    theorem.evidence.push(CertificateLine::Cells { edges: found.edges().to_vec(), of_one_basin });
    theorem.evidence.push(CertificateLine::Strips(grid.columns * found.strips()));
    theorem
        .evidence
        .extend(areas.into_iter().map(|(label, share)| CertificateLine::Area { label, share }));
    Ok(theorem)
}
