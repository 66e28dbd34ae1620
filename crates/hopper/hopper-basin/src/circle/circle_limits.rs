//! How far a circle of fates is refined, and what its labels stand on.

use basin_of_attraction::Refinement;

/// How far the circle is refined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CircleLimits {
    /// When the search for intervals stops; lengths are phases, of which the circle has 1. Intervals of less than
    /// 16 ulps of the speed are never followed. For M ≤ 0.9 and n ≤ 8.
    pub refinement: Refinement,
    /// The number of points at which each sudden window is searched for branches of the map. For M ≤ 0.9 and n ≤ 8.
    pub window_samples: usize,
    /// The number of speeds whose fates are found, for M > 0.905 or n > 8, where the branches are not known or
    /// are too many.
    pub fate_samples: usize,
}

impl Default for CircleLimits {
    /// Stops at an undecided length of 10⁻⁸ of the circle, at intervals shorter than 10⁻¹¹ of it, or at 2·10⁴
    /// intervals. A window has 200 samples, which is far more than it has branches, and the circle 10 000 fates.
    fn default() -> Self {
        let refinement = Refinement {
            undecided: 1e-8,
            shortest: 1e-11,
            intervals: 20_000,
            ..Refinement::default()
        };
        CircleLimits { refinement, window_samples: 200, fate_samples: 10_000 }
    }
}

/// What the labels of a circle stand on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ground {
    /// On the monotone branches of the map, for M ≤ 0.9 and n ≤ 8: every speed of an interval has the label, if the
    /// branches are complete. On contact parts they are (docs/theory.md, Corollary 28), and in the sudden windows
    /// for the M of Theorem 48. For other M a branch narrower than `spacing` may be missed there.
    Branches {
        /// The spacing of the samples of the sudden windows, in units of speed.
        spacing: f64,
    },
    /// On the fates of single speeds, for M > 0.905 or n > 8. Between two neighbours of equal label another basin
    /// may be missed. Nothing is certain but the fates of these speeds.
    Spacing {
        /// The spacing of the speeds, in units of speed.
        speeds: f64,
    },
}
