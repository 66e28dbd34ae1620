//! Traps, fates and basins of the passive hopper.
//!
//! ```text
//!   f(α) ≤ α      orbits go down the ladder 0 = α*_0 < α*_1 < α*_2 < …
//!   trap of α*_n = [α*_n, α*_n + Δ_n(M)]: f ≥ α*_n on it, so whoever enters stays and converges
//! ```
//!
//! | item | role |
//! |---|---|
//! | [`Trap`] | Δ_n, and why the trap ends there |
//! | [`Fates`], [`HopperFate`] | incessant(n), decaying, grounded, or undecided and why |
//! | [`crisis`], [`grounding`] | mass ratios at which a hump falls through its fixed point, or to the ground |
//! | [`immediate_basin`], [`ImmediateBasin`], [`recovery`] | how far a basin reaches into the sudden windows, down to a stated width; mass ratios from which none falls through |
//! | [`hopper_basins`], [`HopperBasins`] | all basins at fixed M as intervals, with what is undecided |
//! | [`basin_fractions`], [`BasinFractions`] | measures by the paper's protocol |
//! | [`basin_raster`], [`basin_columns`] | basins over (M, α), whole or some columns at a time |
//! | [`Fates::labels`] | the fates of many speeds, hopping together |
//! | [`basin_levels`], [`branches`] | a basin as intervals, level by level, from the map itself |
//!
//! ```
//! use hopper_basin::shares;
//! use passive_hopper::MassRatio;
//! // The paper's 0.037 at M = 0.2.
//! let share = basin_fractions(MassRatio::new(0.2)?, 1, 6, 10_000)?.incessant();
//! assert!((share - 0.037).abs() < 0.0005);
//! # Ok::<(), hopper_basin::Error>(())
//! ```
//!
//! # Accuracy
//! Fates are decided by traps, never by closeness; what the budget of hops or the precision of
//! `f64` leaves open is [`HopperFate::Undecided`], with the reason. For M ≳ 10 the map has needles
//! narrower than any `f64` spacing (canards): a basin there is the one seen at that width.
//!
//! Dimensions, entropies and shares with intervals are the generic crate's, and take these basins:
//! [`basin_of_attraction::IntervalBasins`].
//!
//! # References
//! C. K. Reddy, R. Pratap, *Multimodal map and complex basin of attraction of a simple hopper*,
//! Phys. Rev. E, Secs. V and VI.

mod arcs;
mod basin;
mod column;
mod crisis;
mod error;
mod fate;
mod five_humps;
mod hump;
mod intervals;
mod itinerary;
mod known;
mod labels;
mod ladder;
mod map;
mod reach;
mod strip;
mod trap;
mod window;

pub use basin::{
    BasinFractions, basin_columns, basin_fractions, basin_levels, basin_raster, branches,
};
pub use crisis::{Crisis, crisis, grounding};
pub use error::Error;
pub use fate::{Fates, HOP_BUDGET, HopperFate};
pub use five_humps::five_humps;
pub use intervals::{HopperBasins, hopper_basins};
pub use reach::{ImmediateBasin, ImmediateBasinEdge, immediate_basin, recovery};
pub use trap::{Trap, TrapEdge};
pub use window::{RisingWindow, rising_window};
