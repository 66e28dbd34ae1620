//! A basin level by level: the trap, its preimages, their preimages.

use crate::basins::branches::branches;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::traps::trap::TrapEdge;
use basin_of_attraction::{Interval, IntervalSet, preimage_levels};

/// The basin of α*_n in the window [α*_n, α*_top], level by level. Level k is the set of speeds whose orbits enter the
/// trap after exactly k hops (paper, Sec. VI A).
///
/// # Errors
/// As [`branches`] and [`preimage_levels`], which tests the trap and the branches: for M > 0.9056 a branch that was
/// missed shows itself there as a rule.
pub fn basin_levels(
    fates: &Fates,
    n: u64,
    top: u64,
    depth: usize,
    samples: usize,
) -> Result<Vec<IntervalSet>, Error> {
    let trap = fates.trap(n)?;
    let branches = branches(fates, n, top, samples)?;
    let mut level = Interval::new(trap.fixed_point.value(), trap.right())?;
    if trap.edge == TrapEdge::Crossing {
        // The end of the trap is where f falls to α*_n. The computed map crosses α*_n some ulps beside the computed
        // end. These ulps would form a separate interval of level 1. Therefore level 0 ends where the computed map
        // crosses α*_n.
        let own = branches.iter().filter_map(|branch| branch.preimage(fates, &level));
        level.right = own.filter(|p| p.left < level.right).fold(level.right, |r, p| r.max(p.right));
    }
    Ok(preimage_levels(fates, &branches, level, depth)?)
}
