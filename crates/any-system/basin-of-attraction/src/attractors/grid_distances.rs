//! Distances on a grid of states, round periods, and the cells that a state touches.

use crate::attractors::axis::Axis;
use crate::attractors::state_grid::StateGrid;

impl StateGrid {
    /// How far two values of a coordinate are apart, in lengths of its side, the short way round a period; in parts of the larger value if the
    /// grid has no cells along it.
    pub(crate) fn apart(&self, coordinate: usize, a: f64, b: f64) -> f64 {
        let (off, axis) =
            ((a - b).abs(), self.axes.iter().find(|axis| axis.coordinate == coordinate));
        match axis {
            Some(axis) if axis.is_periodic => {
                let off = off / axis.side.length();
                off.min((1.0 - off).abs())
            }
            Some(axis) => off / axis.side.length(),
            None if off == 0.0 => 0.0,
            None => off / a.abs().max(b.abs()),
        }
    }

    /// A state in units of cells: a periodic coordinate is a place on a circle. Coordinates without cells are left out.
    pub(crate) fn in_cells(&self, state: &[f64]) -> impl Iterator<Item = f64> {
        let place = |axis: &Axis| {
            let (x, cells) = (axis.part(state[axis.coordinate]), axis.cells as f64);
            match axis.is_periodic {
                true => {
                    let (sine, cosine) = pxfm::f_sincos(std::f64::consts::TAU * x);
                    let radius = cells / std::f64::consts::TAU;
                    [Some(radius * cosine), Some(radius * sine)]
                }
                false => [Some(cells * x), None],
            }
        };
        self.axes.iter().flat_map(place).flatten()
    }

    /// Whether a state of the region is on the border of cells, to rounding.
    pub(crate) fn is_on_border(&self, state: &[f64]) -> bool {
        self.axes.iter().any(|axis| axis.is_on_border(state[axis.coordinate]))
    }

    /// The cells that contain a state of the region, or touch it: two where it is on the border of two, to rounding.
    pub(crate) fn touched(&self, state: &[f64]) -> Vec<u64> {
        let (mut found, mut unit) = (vec![0], 1u64);
        for axis in &self.axes {
            let places = axis.touched(state[axis.coordinate]);
            found = places.iter().flat_map(|at| found.iter().map(move |n| n + at * unit)).collect();
            unit = unit.saturating_mul(axis.cells);
        }
        found
    }
}
