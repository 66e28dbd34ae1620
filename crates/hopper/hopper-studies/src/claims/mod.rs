//! Every claim of the paper, with its value, our value, and the ground of the verdict.
//!
//! A claim is tested by something that does not contain it, or it is a theorem and is shown as such. A check takes the
//! thing that it tests as a parameter. So a test can pass a false one, and the claim must fail (`false_claims.rs`).

mod boundary;
mod box_count;
mod claim;
mod construction;
#[cfg(test)]
mod false_claims;
mod fixed_points;
mod humps;
mod invariance;
mod measures;
mod stability;
mod sudden;
mod trap;

pub(crate) use claim::{Claim, Ground, Verdict};

use crate::error::Error;
use crate::repository::Progress;
use claim::Check;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// All claims, group by group.
fn checks() -> impl Iterator<Item = &'static Check> {
    let groups = [
        invariance::CHECKS,
        sudden::CHECKS,
        fixed_points::CHECKS,
        stability::CHECKS,
        trap::CHECKS,
        humps::CHECKS,
        measures::CHECKS,
        construction::CHECKS,
        boundary::CHECKS,
        box_count::CHECKS,
    ];
    groups.into_iter().flatten()
}

fn checked(checks: &[&Check], progress: &Progress) -> Result<Vec<Claim>, Error> {
    let bar = progress.bar("claims", checks.len() as u64);
    let done = AtomicU64::new(0);
    let check = |check: &&Check| {
        let claim = check.claim();
        bar.set(done.fetch_add(1, Ordering::Relaxed) + 1);
        claim
    };
    let claims = checks.par_iter().map(check).collect();
    bar.finish();
    claims
}

/// All claims, checked.
pub(crate) fn all(progress: &Progress) -> Result<Vec<Claim>, Error> {
    checked(&checks().collect::<Vec<_>>(), progress)
}

/// The claims about the invariance, checked.
pub(crate) fn invariance(progress: &Progress) -> Result<Vec<Claim>, Error> {
    checked(&invariance::CHECKS.iter().collect::<Vec<_>>(), progress)
}
