//! How often do the intervals of `basin-of-attraction` contain the true number?
//!
//! `cargo xtask interval-coverage` repeats every interval on scenes with known answers, with other seeds and
//! offsets each time:
//!
//! ```text
//!   proportions.rs       fractions from random and from stratified points, tipping, and pairs of starts
//!   exponents.rs         power laws of sets whose dimension is known
//!   boundaries.rs        means of replicates, balls on smooth boundaries, and bounds that are certain
//!   interval_bounds.rs   bounds from basins as intervals
//!   shocks.rs            stability by random shocks
//!   cantor_sets.rs       rates of escape, entropies and lengths of Cantor sets
//! ```
//!
//! `known_sets.rs` has the sets, `tally.rs` counts, `table.rs` writes the rows down.

pub(crate) mod boundaries;
pub(crate) mod cantor_sets;
pub(crate) mod exponents;
pub(crate) mod interval_bounds;
mod known_sets;
pub(crate) mod proportions;
pub(crate) mod shocks;
pub(crate) mod table;
pub(crate) mod tally;
