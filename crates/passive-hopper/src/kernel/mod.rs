//! The hop in straight lines: no loop that waits for a tolerance, hardly a branch, nothing of the system's
//! libm and no fused multiply-add, so that one text serves a single hop and, compiled for wider vectors, many
//! at once, with the same bits.
//!
//! ```text
//!   first flight    one parameter, δ = α − α*_n: tables of α − h and Γ                       table.rs
//!   later flights   two parameters, (x, V): a start by a polynomial, two steps, a landing    start.rs, flight.rs
//!   verdicts        by a bound on the errors handed from flight to flight                    flight.rs, hop.rs
//! ```
//!
//! Whatever is near a verdict, or outside the tables, is left to the careful path of
//! [`LiftOffMap::hop`](crate::map::lift_off_map::LiftOffMap::hop).

pub(crate) mod batch;
pub(crate) mod scalar;
