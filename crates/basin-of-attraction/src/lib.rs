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
//! | [`equally_spaced_counts`] | labels of equally spaced points, counted |
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
//! # Not here
//! Dimensions, entropies and confidence intervals; maps of more than one variable (a raster takes
//! any labelling of the plane).

mod branches;
mod error;
mod fate;
mod interval;
mod measure;
mod preimage;
mod raster;
mod scalar_map;

pub use branches::{Branch, monotone_branches};
pub use error::Error;
pub use fate::{Fate, Reason, TrapSet, Traps, classify};
pub use interval::{Interval, IntervalSet};
pub use measure::equally_spaced_counts;
pub use preimage::preimage_levels;
pub use raster::{Grid, LabelImage, raster};
pub use scalar_map::{Image, ScalarMap};
