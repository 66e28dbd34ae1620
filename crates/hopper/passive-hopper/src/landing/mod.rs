//! When and how does the lower mass land, and how large is the error of the answer?
//!
//! ```text
//!   flight_ends.rs, flight_derivative.rs  the start and the end of a flight, and the derivative between them
//!   half_time.rs, half_flight.rs          the closed forms, in half the time of flight; their public form
//!   half_time_root.rs                     the root search that all landings from the ground share
//!   fixed_point_interval.rs, first_flight_table.rs, first_landing.rs      after a gradual lift-off
//!   chebyshev_interpolation.rs            polynomials of the table
//!   next_landing.rs                       after a sudden lift-off
//!   local_flight.rs, extended_landing.rs  near a fixed point; in extended arithmetic
//!   from_air.rs, printed_bracket.rs       from any state; for the printed equations
//!   error_bound.rs                        which decisions are larger than their errors
//!   decided_landing.rs                    one landing with its decisions larger than their errors, for both masses
//! ```
//!
//! `decided_landing.rs` and `from_air.rs` serve the hybrid system alone, and are built with it.
//!
//! This room uses `precision` and `model`.

pub(crate) mod chebyshev_interpolation;
#[cfg(feature = "hybrid-system")]
pub(crate) mod decided_landing;
pub(crate) mod error_bound;
pub(crate) mod extended_landing;
pub(crate) mod first_flight_table;
pub(crate) mod first_landing;
pub(crate) mod fixed_point_interval;
pub(crate) mod flight_derivative;
pub(crate) mod flight_ends;
#[cfg(feature = "hybrid-system")]
pub(crate) mod from_air;
pub(crate) mod half_flight;
pub(crate) mod half_time;
pub(crate) mod half_time_root;
pub(crate) mod local_flight;
pub(crate) mod next_landing;
pub(crate) mod printed_bracket;
