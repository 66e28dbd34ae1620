//! The statements that proved rasters make.

use crate::theorems::raster::ProvedCells;
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

/// Every point of a raster has the fate of its label. `computed` has the labels of [`hopper_basin::basin_raster`] for the same grid.
pub fn points_theorem(name: &'static str, proved: &LabelImage, computed: &LabelImage) -> Theorem {
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
        other == 0,
    );
    theorem
}

/// The area of each basin lies between two bounds, and every pixel that is coloured belongs to one basin as a whole. It is proved if at most
/// `open` of the area is open.
pub fn cells_theorem(name: &'static str, found: &ProvedCells, open: f64) -> Theorem {
    let mut theorem = Theorem::new(
        name,
        format!(
            "All mass ratios and all speeds of a cell that is called a basin's have its fate, and the area of each basin is between the bounds below: {}.",
            window(&found.grid)
        ),
    );
    for (label, share) in &found.areas {
        theorem.step(
            format!("the area: {}", HopperFate::label_name(*label)),
            format!("{:.4} to {:.4} of the window", share.low, share.high),
            share.low >= 0.0,
        );
    }
    let area = found.open_area();
    theorem.step(
        format!("at most {open} of the area is open"),
        format!(
            "open area {area:.4}; cells that are open {:.4}, or open or cut by a boundary {:.4}",
            found.open_cells(),
            found.undecided_cells()
        ),
        area <= open,
    );
    theorem
}
