//! Every claim of the paper, with its value and ours.

mod basins;
mod claim;
mod construction;
mod fixed_points;
mod invariance;
mod local_map;

pub use claim::{Claim, Verdict};

use crate::error::Error;
use repository_tools::Progress;

/// Checks a group of claims.
type Group = fn(&Progress) -> Result<Vec<Claim>, Error>;

/// All claims, checked.
pub fn all(progress: &Progress) -> Result<Vec<Claim>, Error> {
    let groups: [Group; 5] = [
        invariance::check,
        fixed_points::check,
        local_map::check,
        basins::check,
        construction::check,
    ];
    let mut claims = Vec::new();
    for group in groups {
        claims.extend(group(progress)?);
    }
    Ok(claims)
}

/// The claims about the invariance, checked.
pub fn invariance(progress: &Progress) -> Result<Vec<Claim>, Error> {
    invariance::check(progress)
}
