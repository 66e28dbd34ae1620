//! Traps, fates and basins of the passive hopper.
//!
//! ```text
//!   f(α) ≤ α      orbits descend past the fixed points … > α*_2 > α*_1 > α*_0 = 0
//!   trap of α*_n = [α*_n, α*_n + Δ_n(M)]: f ≥ α*_n on it, so that an orbit that enters stays and converges to α*_n
//! ```
//!
//! The paper calls the trap an interval of attraction. It is a trapping region: f maps it into itself.
//!
//! | item | role |
//! |---|---|
//! | [`ONE_SUDDEN`] | M₁, up to which a hop has at most one sudden lift-off |
//! | [`Trap`] | the trap of α*_n: its length Δ_n, and the kind of its end |
//! | [`crisis`], [`grounding`] | mass ratios from which orbits of a hump fall below its fixed point, or to the ground |
//! | [`immediate_basin`], [`ImmediateBasin`] | the trap continued into the sudden window, by a scan of stated spacing |
//! | [`upper_crisis_bracket`] | the mass ratio above 1 from which no orbit of a hump falls, by such scans |
//! | [`Fates`], [`HopperFate`] | incessant(n), decaying, grounded, or undecided and why |
//! | [`Fates::fates_within`] | fates and numbers of hops of many speeds |
//! | [`Fates::labels`] | the fates of many speeds, whose orbits hop together |
//! | [`basin_raster`], [`basin_columns`] | basins over the (M, α) plane, whole or some columns at a time |
//! | [`hop_columns`] | the number of hops until each of these fates is known |
//! | [`RASTER_VERSION`], [`SHARE_VERSION`] | raised when a raster gets other bits, for work that is continued later |
//! | [`coverage_raster`], [`CoverageRaster`], [`CoverageColumn`] | the share of every basin in each pixel, with bounds: needles thinner than a pixel are not missed |
//! | [`CoverageLimits`], [`CoverageGround`], [`CoverageSummary`] | how far pixels are resolved, and what their shares stand on |
//! | [`basin_fractions`], [`BasinFractions`] | basin fractions by the paper's protocol |
//! | [`hump_fractions`], [`fractions_over_mass_ratio`] | basin fractions with bounds or 95 % intervals, at one M and over M with [`known_kinks`] |
//! | [`minima_on_fixed_points`], [`MinimumOnFixedPoint`] | why a fraction has an infinite slope at some M: an orbit from a minimum of the map falls onto α*_n |
//! | [`tipping`], [`random_tipping`], [`tipping_along_drift`] | the fate of a speed after M changes, at once or from hop to hop |
//! | [`hopper_basins`], [`HopperBasins`] | all basins at one M as intervals, with what is undecided |
//! | [`BranchGround`], [`Probes`] | what these intervals rest on, and how they agree with single fates |
//! | [`basin_levels`], [`branches`] | one basin level by level, from the branches of the map |
//! | [`PhaseBasins`], [`CircleLimits`] | the circle of fates left of α*_n: the basins as intervals of phase, at every scale |
//! | [`BoundaryPhase`], [`UndecidedPhases`], [`FallsOnto`] | its boundary points and what they come to; what is undecided |
//! | [`LocalFractions`], [`Ground`] | the shares of the fates next to α*_n, with bounds, and what the bounds stand on |
//! | [`share_raster`], [`ShareRaster`], [`ShareColumn`], [`Upwards`] | the shares over mass ratio and phase, or over mass ratio and log |δ| |
//! | [`GapCount`] | how many boundary points are seen left of α*_n at a given scale, and the law of their number |
//! | [`EdgeChart`], [`edge_window`], [`edge_phase`], [`edge_phases`] | windows of any width about a speed that comes to α*_n exactly, and their pixels |
//! | [`GroundingEdge`] | speeds from which a hop just uses up the energy, with the law beside them |
//! | [`FollowedEdge`], [`edge_frame`], [`frame_slant`] | such a speed over the mass ratio, and windows of (M, α) about it |
//! | [`first_humps`] | the lift-off speeds [α*_1, α*_{k+1}]; the paper's window has k = 5 |
//! | [`FIG_8`], [`FIG_9`] | the (M, α) windows of these figures of the paper |
//!
//! ```
//! use hopper_basin::basin_fractions;
//! use passive_hopper::MassRatio;
//! // The paper's 0.037 at M = 0.2.
//! let fraction = basin_fractions(MassRatio::new(0.2)?, 1, 6, 10_000)?.incessant();
//! assert!((fraction - 0.037).abs() < 0.0005);
//! # Ok::<(), hopper_basin::Error>(())
//! ```
//!
//! # Accuracy
//! Only traps and grounding decide a fate; closeness to a fixed point does not. If the budget of hops or up to 1024
//! bits do not suffice, the fate is [`HopperFate::Undecided`], with the reason. For M ≳ 10 the map has needles
//! (canards) narrower than any spacing of `f64`. A scan there finds only needles wider than its spacing.
//!
//! # Not here
//! Dimensions, entropies and distances to the boundary are in the generic crate `basin_of_attraction`, and work on
//! these basins.
//!
//! # References
//! C. K. Reddy, R. Pratap, *Multimodal map and complex basin of attraction of a simple hopper*,
//! Phys. Rev. E, Secs. V and VI.

mod basins;
mod circle;
mod coverage;
mod error;
mod fates;
mod raster;
mod traps;

pub use basins::branches::branches;
pub use basins::fractions::{BasinFractions, basin_fractions};
pub use basins::fractions_over_mass_ratio::{
    FractionGround, FractionLimits, fractions_over_mass_ratio, hump_fractions, known_kinks,
};
pub use basins::hop_counts::hop_columns;
pub use basins::intervals::{BranchGround, HopperBasins, Probes, hopper_basins};
pub use basins::levels::basin_levels;
pub use basins::minimum_on_fixed_point::{MinimumOnFixedPoint, minima_on_fixed_points};
pub use basins::rasters::{RASTER_VERSION, basin_columns, basin_raster};
pub use basins::tipping::{HopperTipping, random_tipping, tipping, tipping_along_drift};
pub use basins::window::{FIG_8, FIG_9, FigureWindow, first_humps};
pub use circle::circle_limits::{CircleLimits, Ground};
pub use circle::edge_chart::EdgeChart;
pub use circle::edge_path::{FollowedEdge, enclosed_edge_slope};
pub use circle::edge_phases::edge_phases;
pub use circle::edge_window::{edge_frame, edge_label, edge_phase, edge_window, frame_slant};
pub use circle::falls_onto::FallsOnto;
pub use circle::gap_count::GapCount;
pub use circle::grounding_edge::GroundingEdge;
pub use circle::local_fractions::LocalFractions;
pub use circle::phase_basins::{BoundaryPhase, PhaseBasins, UndecidedPhases};
pub use circle::phase_shares::PhasePart;
pub use circle::share_column::{SHARE_VERSION, ShareColumn};
pub use circle::share_raster::{ShareRaster, share_raster};
pub use circle::upwards::Upwards;
pub use coverage::coverage_column::CoverageColumn;
pub use coverage::coverage_limits::{CoverageGround, CoverageLimits};
pub use coverage::coverage_raster::{CoverageRaster, coverage_raster};
pub use coverage::coverage_summary::CoverageSummary;
pub use coverage::images::{ImagedSpeed, SpeedImage, SpeedImages, falling_laps};
pub use coverage::laps_sweep::{LapsSweep, Resolution};
pub use error::Error;
pub use fates::fates_at_mass_ratio::{Fates, HOP_BUDGET};
pub use fates::hopper_fate::HopperFate;
pub use raster::rising_windows::{RisingWindow, rising_window};
pub use traps::crisis::{Crisis, crisis, grounding};
pub use traps::immediate_basin::{
    ImmediateBasin, ImmediateBasinEdge, immediate_basin, upper_crisis_bracket,
};
pub use traps::trap::{ONE_SUDDEN, Trap, TrapEdge, TrapSide};
