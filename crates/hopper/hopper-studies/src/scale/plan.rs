//! A raster too large to be measured, from the tiles of one that was.

use super::rasters::{Raster, TILE};
use pxfm::{f_exp2, f_log2};

/// Pixels along each side of the planned raster: 10¹² pixels.
pub(crate) const SIDE: usize = 1_000_000;

/// Windows along each side. A window of `hopper basins` has at most 2³⁴ pixels; 125000² are fewer, and with 7
/// windows it would be more.
pub(crate) const WINDOWS: usize = 8;

/// The tiles of the planned raster.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    /// CPU seconds of every tile, window after window.
    pub(crate) tiles: Vec<f64>,
}

/// The planned raster, if the CPU time grows by `growth` for each doubling of the side from `measured` on.
///
/// Each tile has the time of the measured one at the same M, times one factor that gives the total. The rows of
/// windows share the time evenly.
pub(crate) fn plan(measured: &Raster, growth: f64) -> Plan {
    let doublings = f_log2(SIDE as f64 / measured.side as f64);
    let total = measured.seconds() * f_exp2(f_log2(growth) * doublings);
    let in_window = (SIDE / WINDOWS).div_ceil(TILE);
    let across = in_window * WINDOWS;
    let at = |k: usize| measured.tiles[k * measured.tiles.len() / across];
    let row: Vec<f64> = (0..across).map(at).collect();
    let factor = total / (WINDOWS as f64 * row.iter().sum::<f64>());
    let window = |window: usize| {
        let first = window % WINDOWS * in_window;
        row[first..first + in_window].iter().map(move |seconds| factor * seconds)
    };
    Plan { tiles: (0..WINDOWS * WINDOWS).flat_map(window).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_has_the_total_of_its_growth() {
        let measured = Raster { side: 250_000, tiles: vec![1.0, 3.0, 2.0], bytes: 0 };
        let found = plan(&measured, 3.0);
        assert_eq!(found.tiles.len(), 64 * 7813);
        let total: f64 = found.tiles.iter().sum();
        assert!((total / 54.0 - 1.0).abs() < 1e-9, "{total}");
        // The middle third of the columns takes half of the time: a window has columns of one side only.
        assert!(found.tiles[0] < found.tiles[7812 * 4]);
    }
}
