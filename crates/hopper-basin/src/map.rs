//! The hopper's map and traps as the generic tools see them.

use crate::{Fates, HopperFate};
use basin_of_attraction::{Image, ScalarMap, Traps};
use passive_hopper::index_below;

impl ScalarMap for Fates {
    fn image(&self, alpha: f64) -> Image {
        match self.map().hop(alpha) {
            Ok(hop) if hop.certain => hop.next.into(),
            Ok(_) | Err(_) => Image::Undecided,
        }
    }
}

impl Traps for Fates {
    /// The index of the trap that holds `alpha`; indices above 65 000 share the last label.
    fn label(&self, alpha: f64) -> Option<u16> {
        let n = index_below(alpha).ok()?;
        let trap = self.trap(n).ok()?;
        trap.contains(alpha).then_some(n.min(HopperFate::LARGEST_LABEL) as u16)
    }
}
