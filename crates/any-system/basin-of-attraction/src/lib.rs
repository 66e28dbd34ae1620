//! Attractors and basins of attraction of maps, return maps and flows. A trap decides every label, or the label is marked as undecided.
//!
//! ```text
//!   f(trap) ⊂ trap      basin = trap ∪ f⁻¹(trap) ∪ f⁻²(trap) ∪ …       level k enters the trap after k steps
//! ```
//!
//! | item | role |
//! |---|---|
//! | [`ScalarMap`], [`Image`] | a map of the line; closures `Fn(f64) -> Option<f64>` are maps |
//! | [`Label`] | the number of a basin, or undecided, or outside the region of interest |
//! | [`TrapSet`], [`Traps`] | sets that orbits do not leave, with labels |
//! | [`classify`], [`Fate`], [`UndecidedReason`] | the fate of a point: trapped, stopped, or undecided for a reason |
//! | [`Interval`], [`IntervalSet`] | disjoint intervals: union, difference, measure |
//! | [`monotone_branches`], [`Branch`] | the map restricted to its laps, and preimages on a lap to 1 ulp |
//! | [`preimage_levels`] | the basin of a trap, level by level |
//! | [`interval_basins`], [`IntervalBasins`] | all basins in a window as intervals, with the undecided length |
//! | [`check_trap`], [`TrapGround`], [`check_branches`] | tests of what a caller gives; `interval_basins` makes them |
//! | [`Refinement`], [`StopReason`] | when that search stops, and why it stopped |
//! | [`repeller`](fn@repeller), [`Repeller`] | dimension and escape rate of the Cantor set that full branches leave, to rounding (Bowen's equation) |
//! | [`repeller_bounds`](fn@repeller_bounds), [`RepellerBounds`] | proved bounds on both, from bounds on the slopes |
//! | [`PreimageTree::itineraries`], [`Itineraries`] | whether finitely, countably many or a Cantor set of points never enter a trap, with bounds on the entropy |
//! | [`GapLengths`] | the gaps of a set: their number at each scale, their exponent, the length that they leave |
//! | [`KneadingSequence`] | the kneading sequence of a unimodal map, and its topological entropy with proved bounds |
//! | [`EscapeTimes`], [`saddle_orbit`] | how fast orbits leave a region, and orbits on the chaotic saddle that never leave it |
//! | [`PreimageTree`], [`ResidualSet`], [`geometric_limit`] | which branch leads where; whether a Cantor set or a countable set remains |
//! | [`equally_spaced_fractions`], [`random_fractions`], [`low_discrepancy_fractions`] | basin fractions from sample points, each with its uncertainty |
//! | [`ConfidenceInterval`], [`proportion_interval`], [`wilson_interval`], [`student_interval`] | an estimate with a 95 % confidence interval |
//! | [`Bounds`] | bounds on a number, which hold under stated conditions |
//! | [`SplitMix64`] | random numbers from a seed, the same with any number of threads |
//! | [`BoxCount`], [`occupied_boxes`], [`power_law`] | boxes with more than one basin, entropies, exponents with intervals from replicates, and local slopes |
//! | [`ball_entropy`], [`LabelImage::ln_2_criterion`] | whether a boundary looks smooth at one scale; whether it is shown to be fractal at all scales of an image |
//! | [`uncertain_fraction`], [`IntervalBasins::uncertain_fraction`] | final-state uncertainty, from perturbed starts or from intervals |
//! | [`Hyperrectangle`], [`region_fractions`] | regions of any dimension, and the fractions of the basins in them |
//! | [`region_boxes`] | boxes with more than one basin, and entropies, in a region of any dimension |
//! | [`uncertain_pairs`], [`uncertainty_exponent`] | final-state uncertainty in a region of any dimension |
//! | [`StateMap`], [`array_map`], [`watched_map`](fn@watched_map), [`StateGrid`] | maps of several variables, with progress and interruption, and cells of their states |
//! | [`Attractors`], [`Unmatched`] | attractors of maps and flows of several variables, found by recurrences and tested as traps |
//! | [`box_dimension`] | the dimension of an attractor, from the boxes that an orbit visits |
//! | [`Pilot`] | the limits of a search, from some orbits that are followed before |
//! | [`KnownAttractors`] | attractors that the caller knows by points: basins by the distance from them, and the time to convergence |
//! | [`FeatureAttractors`], [`FeatureGroups`], [`suggested_radius`] | the same by features of orbits, grouped by density with a suggested radius, in cells, or beside templates, by any [`Metric`] |
//! | [`fractions_along`], [`FractionsAlong`], [`Fractions`] | fractions along a curve of parameters, refined where they change, with their jumps |
//! | [`fractions_along_matched`], [`Matching`], [`match_by`] | the same where the numbers of the attractors mean nothing: which attractors at two parameters are the same |
//! | [`attractors_along`], [`AttractorsAlong`] | the attractors of a map and the fractions of their basins along a parameter, in one call |
//! | [`intermingledness`](fn@intermingledness) | how intermingled labelled points are |
//! | [`Stability`], [`AttractorStability`] | basin stability, times of convergence, fatal and harmless shocks of each attractor, in one pass |
//! | [`IntervalBasins::tipping_to`], [`Tipping`] | the probability that a state of basin a is in basin b after a change of parameters, with bounds |
//! | [`random_tipping`], [`label_after_drift`] | the same from random points, also for a slow change that the orbit follows |
//! | [`IntervalBasins::distance_to_boundary`], [`BoundaryDistances`] | the distance to the boundary on the line, with bounds: of a state, and its distribution over a basin |
//! | [`minimal_fatal_shock`], [`minimal_fatal_shock_watched`] | the smallest shock to another basin, in any dimension: an upper bound with a witness |
//! | [`boundary_between`], [`track_edge`] | a point of the boundary between two states, and the saddle that attracts the boundary |
//! | [`value_raster`], [`ValueImage`] | numbers over a window of the plane, such as the steps to a trap |
//! | [`LabelImage::wada`], [`IntervalBasins::wada`] | whether all basins share one boundary |
//! | [`raster`], [`Grid`], [`LabelImage`] | labels over a window of the plane, in parallel |
//! | [`PixelShares`], [`IntervalBasins::pixel_shares`] | the share of every basin in the pixels of a line, with bounds |
//! | `LabelImage::picture`, `ValueImage::picture`, `FractionsAlong::picture`, `share_picture` | pictures, one call each (feature `figures`) |
//! | `LabelImage::files`, `ValueImage::files`, `FractionsAlong::csv`, `Attractors::csv` | arrays for NumPy and tables, with their meaning (feature `figures`) |
//! | [`columns_in_parallel`] | any values of the columns of a raster |
//!
//! ```
//! use basin_of_attraction::{Fate, Interval, Label, TrapSet, classify};
//! // Newton's method for x² − 2 converges to √2 from the right of 0, and to −√2 from the left.
//! let newton = |x: f64| Some(0.5 * (x + 2.0 / x));
//! let (positive, negative) = (Label::from(1), Label::from(2));
//! let traps = TrapSet::new(vec![
//!     (Interval::new(1.4142, 1.5)?, positive),
//!     (Interval::new(-1.5, -1.4142)?, negative),
//! ])?;
//! assert_eq!(classify(&newton, &traps, 100.0, 50).0, Fate::Trapped(positive));
//! assert_eq!(classify(&newton, &traps, -0.01, 50).0, Fate::Trapped(negative));
//! # Ok::<(), basin_of_attraction::Error>(())
//! ```
//!
//! # Accuracy
//! Intervals given as traps, and branches, are tested by images or at random points; what the points miss is the
//! caller's. The ends of preimages are located to one ulp of the computed map. The same input gives the same labels
//! with any number of threads.
//!
//! A slope between two scales is not a dimension. [`PowerLaw`] has all local slopes, and no interval if they drift.
//!
//! # Not here
//! - Basins as certain sets for maps of more than one variable: regions of any dimension are sampled.
//! - Integrators of flows: a step of a flow is a closure, or a map of states of the crate `return-map`.
//! - Lower bounds on distances from a boundary in more than one dimension.
//!
//! # References
//! C. Grebogi, S. W. McDonald, E. Ott, J. A. Yorke, Phys. Lett. A 99, 415 (1983), uncertainty exponent; A. Daza et
//! al., Sci. Rep. 6, 31416 (2016), basin entropy; A. Puy, A. Daza, A. Wagemakers, M. A. F. Sanjuán, Commun.
//! Nonlinear Sci. Numer. Simul. 95, 105588 (2021), entropy of balls on a smooth boundary; A. Daza, A. Wagemakers,
//! M. A. F. Sanjuán, Sci. Rep. 8, 9954 (2018), Wada by merging; E. B. Wilson, J. Am. Stat. Assoc. 22, 209 (1927),
//! intervals of proportions; W. Hoeffding, Ann. Math. Stat. 27, 713 (1956), successes with different probabilities;
//! T. Gasser, L. Sroka, C. Jennen-Steinmetz, Biometrika 73, 625 (1986), variance from differences; G. L. Steele, D.
//! Lea, C. H. Flood, OOPSLA 2014, SplitMix64; G. Datseris, A. Wagemakers, Chaos 32, 023104 (2022), attractors by
//! recurrences and by features; M. Ester, H.-P. Kriegel, J. Sander, X. Xu, KDD 1996, 226, groups by density; G.
//! Datseris, K. Luiz Rossi, A. Wagemakers, Chaos 33, 073151 (2023), fractions along a parameter; B. Kaszás, U.
//! Feudel, T. Tél, Sci. Rep. 9, 8654 (2019), tipping; L. Halekotte, U. Feudel, Sci. Rep. 10, 11783 (2020), minimal
//! fatal shocks; J. D. Skufca, J. A. Yorke, B. Eckhardt, Phys. Rev. Lett. 96, 174101 (2006), edge tracking; P. J.
//! Menck, J. Heitzig, N. Marwan, J. Kurths, Nat. Phys. 9, 89 (2013), basin stability.

mod attractors;
mod boundaries;
mod error;
mod features;
mod line;
mod parameters;
mod shares;
mod space;
mod statistics;

pub use attractors::box_dimension::box_dimension;
pub use attractors::known_attractors::{KnownAttractors, KnownLimits};
pub use attractors::pilot::{Pilot, PilotEnd, PilotOrbit};
pub use attractors::recurrence_limits::RecurrenceLimits;
pub use attractors::recurrences::{Attractor, Attractors};
pub use attractors::state_grid::StateGrid;
pub use attractors::state_map::{ArrayMap, OrbitFeature, StateMap, array_map, step_by_step};
pub use attractors::unmatched::{Border, Remedy, Unmatched, UnmatchedReason};
pub use attractors::watched_map::{WatchedMap, watched_map};
pub use boundaries::boundary_between::{BoundaryBracket, boundary_between};
pub use boundaries::boxes::{BoxCount, occupied_boxes};
pub use boundaries::chaotic_saddle::{SaddleOrbit, SaddleSearch, saddle_orbit};
pub use boundaries::edge_tracking::{EdgeEnd, EdgeLimits, EdgeTrack, track_edge};
pub use boundaries::entropy::entropy;
pub use boundaries::escape_times::{EscapeTimes, Inside};
pub use boundaries::fatal_shock::{
    FatalShock, ShockSearch, minimal_fatal_shock, minimal_fatal_shock_watched,
};
pub use boundaries::ln_2_criterion::Ln2Criterion;
pub use boundaries::region_boxes::region_boxes;
pub use boundaries::region_uncertainty::{
    PairCount, UncertaintyExponent, uncertain_pairs, uncertainty_exponent,
};
pub use boundaries::smooth_boundary::{
    BallEntropy, BoundaryShape, RandomBalls, ball_entropy, smooth_boundary_entropy,
};
pub use boundaries::uncertainty::uncertain_fraction;
pub use boundaries::wada::{LineWadaTest, WadaGap, WadaTest};
pub use error::Error;
pub use features::attractor_features::{FeatureAttractor, FeatureAttractors, FeatureLimits};
pub use features::feature_groups::FeatureGroups;
pub use features::intermingledness::intermingledness;
pub use features::metric::Metric;
pub use features::suggested_radius::{SuggestedRadius, suggested_radius, suggested_radius_by};
pub use interval_arithmetic::Enclosure;
pub use line::basin_search::{interval_basins, interval_basins_from_known};
pub use line::boundary_distance::{BoundaryDistance, BoundaryDistances};
pub use line::branches::{Branch, monotone_branches};
pub use line::fate::{Fate, TrapSet, Traps, classify};
pub use line::gap_lengths::GapLengths;
pub use line::interval_basins::{IntervalBasins, LabelledInterval};
pub use line::itineraries::Itineraries;
pub use line::kneading::{KneadingSequence, Side};
pub use line::pixel_shares::PixelShares;
pub use line::preimage::{preimage_levels, preimage_levels_from_known};
pub use line::preimage_tree::{PreimageTree, ResidualSet, TreeNode, geometric_limit};
pub use line::probes::{TrapGround, check_branches, check_trap};
pub use line::refinement::{Refinement, StopReason};
pub use line::repeller::{Repeller, repeller};
pub use line::repeller_bounds::{RepellerBounds, repeller_bounds};
pub use line::scalar_map::{Image, ScalarMap};
pub use parameters::attractor_match::{AttractorMatch, match_attractors, match_by};
pub use parameters::attractors_along::{
    AlongProgress, AlongSearch, AttractorsAlong, attractors_along, attractors_along_watched,
};
pub use parameters::fractions_along::{
    CurveLimits, FractionsAlong, UnmatchedAttractor, UnresolvedReason, UnresolvedStep,
    fractions_along, fractions_along_matched,
};
pub use parameters::matching::{LabelAt, Matching, Unlike};
pub use parameters::tipping::{Tipping, TippingCounts, label_after_drift, random_tipping};
pub use shares::fractions::{FractionRange, Fractions};
pub use shares::low_discrepancy::{
    low_discrepancy_fractions, stratified_fractions, stratified_points,
};
pub use shares::region_fractions::{LabelCounts, region_fractions};
pub use shares::sampling::{
    EquallySpacedFraction, equally_spaced_counts, equally_spaced_fractions, random_fractions,
};
pub use shares::stability::{AttractorStability, LongestTime, Shock, Stability};
pub use space::hyperrectangle::Hyperrectangle;
pub use space::interval::{Interval, IntervalSet};
pub use space::label::Label;
#[cfg(feature = "figures")]
pub use space::pictures::{AxisNames, share_picture};
pub use space::raster::{Grid, LabelImage, columns_in_parallel, raster, raster_by_strips};
pub use space::undecided_reason::UndecidedReason;
pub use space::value_image::{ValueImage, value_raster};
pub use statistics::bounds::Bounds;
pub use statistics::confidence_interval::{
    ConfidenceInterval, proportion_interval, student_interval, wilson_interval,
};
pub use statistics::power_law::{NoInterval, PowerLaw, power_law};
pub use statistics::split_mix::SplitMix64;
