//! When the search for interval basins stops, and why it stopped.

use crate::error::Error;

/// When to stop the search for preimages. The preimages of long intervals are found first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// Stop as soon as no more than this length is undecided.
    pub undecided: f64,
    /// Intervals shorter than this are not followed.
    pub shortest: f64,
    /// Intervals of this level or higher are not followed.
    pub levels: usize,
    /// Stop as soon as this number of intervals is found.
    pub intervals: usize,
}

/// Which limit of a [`Refinement`] stopped the search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopReason {
    /// The undecided length is at most [`Refinement::undecided`].
    Resolved,
    /// Every interval has been followed, and more than [`Refinement::undecided`] is undecided: these points are in
    /// no basin, or a branch is missing.
    AllFollowed,
    /// The undecided length is at most [`Refinement::undecided`], but the branches were searched at some spacing: a
    /// branch that was missed leaves wrong labels.
    SampledBranches,
    /// More than [`Refinement::undecided`] was found twice, with different fates, or the fate of a point is not
    /// that of its interval: a branch is missing, or is not monotone.
    Contradiction,
    /// All intervals not yet followed are shorter than [`Refinement::shortest`], or of the last level.
    ShortestInterval,
    /// All intervals not yet followed are of the level [`Refinement::levels`].
    LevelLimit,
    /// There are [`Refinement::intervals`] intervals or more.
    IntervalLimit,
}

impl Refinement {
    /// Returns an error for limits that no search can reach.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let Refinement { undecided, shortest, .. } = *self;
        if undecided >= 0.0 && shortest >= 0.0 && shortest.is_finite() {
            return Ok(());
        }
        Err(Error::BadRefinement { undecided, shortest })
    }
}

impl Default for Refinement {
    /// Stops at an undecided length of 10⁻⁶, or at a million intervals.
    ///
    /// Intervals shorter than 10⁻¹² are not followed: in windows between −100 and 100 their ends have ulps of up to
    /// 10⁻¹⁴. The limits on levels and intervals bound time and memory.
    fn default() -> Self {
        Refinement { undecided: 1e-6, shortest: 1e-12, levels: 1_000_000, intervals: 1_000_000 }
    }
}
