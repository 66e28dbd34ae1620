//! How do both masses move?
//!
//! ```text
//!   mass_ratio.rs     M = m₂/m₁, the only parameter         units.rs          kilograms, metres, seconds
//!   state.rs          (y₁, ẏ₁, y₂, ẏ₂)                      energy.rs         and the loss of a landing
//!   motion.rs         the flight in closed form             contact.rs        the contact in closed form
//!   fixed_points.rs   the lossless hops: tan α*_n = α*_n, to 100 bits and more
//! ```
//!
//! This room uses `precision` alone.

pub(crate) mod contact;
pub(crate) mod energy;
pub(crate) mod fixed_points;
pub(crate) mod mass_ratio;
pub(crate) mod motion;
pub(crate) mod phase;
pub(crate) mod state;
pub(crate) mod units;
