//! What does the orbit of a boundary point come to?
//!
//! Two speeds on both sides of one boundary point visit the same laps of the map until their orbits part. They part
//! at a fixed point, which then lies between them, or at a zero of F, beyond which the hopper is grounded.

use crate::fates::fates_at_mass_ratio::Fates;
use passive_hopper::index_below;

/// What a boundary point comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FallsOnto {
    /// After `hops` hops the orbit is at α*_m exactly. On one side of the boundary point lies the basin of m, on
    /// the other the circle of m, with all its boundary points. (At an extremum both sides are alike.)
    FixedPoint {
        /// The index.
        m: u64,
        /// The number of hops.
        hops: usize,
    },
    /// The last of `hops` hops ends with the speed 0: on one side of the point the hopper is grounded in this hop.
    Grounding {
        /// The number of hops.
        hops: usize,
    },
}

/// Most hops of the two orbits. An orbit that lingers at a fixed point for longer comes from less than some 10⁻⁹
/// beside it.
const MOST_HOPS: usize = 4096;

/// Where the orbits of two neighbouring speeds part; `None` if they do not, or if a hop is undecided.
pub(crate) fn falls_onto(fates: &Fates, left: f64, right: f64) -> Option<FallsOnto> {
    let (mut a, mut b) = (left, right);
    for hops in 0..MOST_HOPS {
        let (low, high) = (index_below(a).ok()?, index_below(b).ok()?);
        if low != high {
            return Some(FallsOnto::FixedPoint { m: low.max(high), hops });
        }
        let hop = |speed| fates.map().image(speed).ok();
        match (hop(a)?, hop(b)?) {
            (Some(next_a), Some(next_b)) => (a, b) = (next_a, next_b),
            (None, None) => return None,
            _ => return Some(FallsOnto::Grounding { hops: hops + 1 }),
        }
        if a == b {
            return None;
        }
    }
    None
}
