//! How is a hop computed fast? With almost no branches, no iteration until a tolerance is met, no libm and no fused
//! multiply-add. The same source computes a single hop and, compiled for wider vectors, many hops at once, with the
//! same bits.
//!
//! ```text
//!   first flight    one parameter, δ = α − α*_n: tables of α − h and Γ     landing/first_flight_table.rs
//!   later flights   two parameters, (x, V): a guess, two steps, a landing  scalar/later_flight.rs
//!   decisions       by a bound on the errors propagated from flight to flight
//! ```
//!
//! Hops with an inconclusive decision, and speeds outside the tables, are left to the general solver,
//! [`LiftOffMap::careful_image`](crate::map::lift_off_map::LiftOffMap::careful_image). The README in this folder has
//! the idea, a picture, and the invariants I1 to I9 that the code cites.

pub(crate) mod batch;
pub(crate) mod scalar;
