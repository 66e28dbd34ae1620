//! The monotone branches of the map.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::traps::hump::Hump;
use basin_of_attraction::{Branch, Interval, monotone_branches};
use passive_hopper::alpha_star;
use std::f64::consts::PI;

/// Samples of a part on which the map is known to be monotone. Such a part may contain one edge of grounding, and
/// two samples on either side of it would suffice to bracket it. 64 intervals leave room for a gap of grounding
/// that takes up nearly all of a part.
const SAMPLES_OF_MONOTONE_PART: usize = 65;

/// The monotone branches of the map from α*_`from` to α*_`to`.
///
/// On the contact parts all branches are found: theory gives every critical point, and the map is cut there. Each
/// sudden window (nπ, α*_n) is searched with `samples` points, which may miss branches narrower than their
/// spacing. For M ≤ 0.905 a hop has at most one sudden lift-off, and the windows have few branches.
///
/// # Errors
/// As [`Fates::new`].
pub fn branches(fates: &Fates, from: u64, to: u64, samples: usize) -> Result<Vec<Branch>, Error> {
    let mu = fates.map().mass_ratio().mu();
    let mut branches = Vec::new();
    for n in from..to {
        let hump = Hump::new(n)?;
        // Without the fixed points themselves: a hop from one has no loss, and belongs to neither side.
        let (left, end) = (hump.star.value().next_up(), (n + 1) as f64 * PI);
        let right = alpha_star(n + 1).next_down();
        let mut cuts = vec![left];
        if let Some((maximum, minimum)) = hump.critical(mu)? {
            cuts.extend([maximum, minimum].map(|t| hump.star.value() + hump.delta(t)));
        }
        cuts.push(end);
        for pair in cuts.windows(2) {
            let part = Interval::new(pair[0], pair[1])?;
            branches.extend(monotone_branches(fates, part, SAMPLES_OF_MONOTONE_PART)?);
        }
        branches.extend(monotone_branches(fates, Interval::new(end, right)?, samples)?);
    }
    Ok(branches)
}
