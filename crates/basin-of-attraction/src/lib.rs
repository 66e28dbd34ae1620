//! Basins of attraction of maps, with every label decided by a trap or marked as undecided.
//!
//! ```text
//!   f(trap) ⊂ trap      basin = trap ∪ f⁻¹(trap) ∪ f⁻²(trap) ∪ …       level k enters after k steps
//! ```
//!
//! | item | role |
//! |---|---|
//! | [`ScalarMap`], [`Image`] | a map of the line; closures `Fn(f64) -> Option<f64>` are maps |
//! | [`TrapSet`], [`Traps`] | sets that orbits do not leave, with labels |
//! | [`classify`], [`Fate`], [`Reason`] | the fate of a point: trapped, stopped, or undecided and why |
//! | [`Interval`], [`IntervalSet`] | disjoint intervals: union, difference, measure |
//! | [`monotone_branches`], [`Branch`] | where a map is monotone, and preimages on a branch to 1 ulp |
//! | [`preimage_levels`] | the basin of a trap, level by level |
//! | [`interval_basins`], [`IntervalBasins`] | all basins in a window as intervals, with what is left undecided |
//! | [`PreimageTree`], [`ResidualSet`], [`geometric_limit`] | which branch leads where; a Cantor set left over, or a countable one |
//! | [`equally_spaced_fractions`], [`random_fractions`], [`low_discrepancy_fractions`] | measures by points, each with an interval |
//! | [`Estimate`], [`wilson_interval`], [`student_interval`] | a value with its interval |
//! | [`BoxCount`], [`occupied_boxes`], [`power_law`] | boxes with more than one basin, entropies, dimensions with local slopes and warnings |
//! | [`uncertain_fraction`], [`IntervalBasins::uncertain_fraction`] | final-state uncertainty, by pairs of points or exactly |
//! | [`LabelImage::wada`] | do all basins share one boundary? |
//! | [`raster`], [`Grid`], [`LabelImage`] | labels over a window of the plane, in parallel |
//!
//! ```
//! use basin_of_attraction::{Fate, Interval, TrapSet, classify};
//! // Newton's method for x² − 2 on the right of its root: quadratic, and trapped at once.
//! let newton = |x: f64| Some(0.5 * (x + 2.0 / x));
//! let traps = TrapSet::new(vec![(Interval::new(1.4142, 1.5)?, 1), (Interval::new(-1.5, -1.4142)?, 2)])?;
//! assert_eq!(classify(&newton, &traps, 100.0, 50).0, Fate::Trapped(1));
//! assert_eq!(classify(&newton, &traps, -0.01, 50).0, Fate::Trapped(2));
//! # Ok::<(), basin_of_attraction::Error>(())
//! ```
//!
//! # Accuracy
//! A trap must be one: that its points stay in it is the caller's theorem. Ends of preimages are
//! located to one ulp of the map as it is computed. The same input gives the same labels with any
//! number of threads.
//!
//! A slope between two scales is no dimension: [`PowerLaw`] shows all local slopes and warns when they
//! drift.
//!
//! # Not here
//! Maps of more than one variable (a raster takes any labelling of the plane); finding attractors.
//!
//! # References
//! C. Grebogi, S. W. McDonald, E. Ott, J. A. Yorke, Phys. Lett. A 99, 415 (1983), uncertainty exponent;
//! A. Daza et al., Sci. Rep. 6, 31416 (2016), basin entropy; A. Daza, A. Wagemakers, M. A. F. Sanjuán,
//! Sci. Rep. 8, 9954 (2018), Wada by merging; E. B. Wilson, J. Am. Stat. Assoc. 22, 209 (1927).

mod boxes;
mod branches;
mod entropy;
mod error;
mod fate;
mod interval;
mod interval_basins;
mod power_law;
mod preimage;
mod preimage_tree;
mod raster;
mod sampling;
mod scalar_map;
mod statistics;
mod uncertainty;
mod wada;

pub use boxes::{BoxCount, occupied_boxes};
pub use branches::{Branch, monotone_branches};
pub use entropy::entropy;
pub use error::Error;
pub use fate::{Fate, Reason, TrapSet, Traps, classify};
pub use interval::{Interval, IntervalSet};
pub use interval_basins::{
    IntervalBasins, LabelledInterval, Refinement, StopReason, interval_basins,
};
pub use power_law::{PowerLaw, Warning, power_law};
pub use preimage::preimage_levels;
pub use preimage_tree::{Node, PreimageTree, ResidualSet, geometric_limit};
pub use raster::{Grid, LabelImage, LegendEntry, raster, raster_by_strips};
pub use sampling::{
    equally_spaced_counts, equally_spaced_fractions, low_discrepancy_fractions, random_fractions,
};
pub use scalar_map::{Image, ScalarMap};
pub use statistics::{Estimate, student_interval, wilson_interval};
pub use uncertainty::uncertain_fraction;
pub use wada::WadaTest;
