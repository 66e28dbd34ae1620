//! One hop.
//!
//! ```text
//!   hop.rs               the hop: first flight, later flights, decision on α′²
//!   hop_from_interval.rs the hop of all speeds within an error; bound on the error of α′²
//!   bounded_next.rs      α′² with a bound, and its root
//!   later_flight.rs      from (x, V) to the landing: steps, first-order correction, error bound
//!   landing_bracket.rs   the interval that holds the landing
//!   initial_guess.rs     fitted polynomials for the start of the search
//!   half_angle.rs        sine and cosine of half the time, D and u
//!   ground_state.rs      (x, V) with an error bound
//! ```

pub(crate) mod bounded_next;
pub(crate) mod ground_state;
pub(crate) mod half_angle;
pub(crate) mod hop;
pub(crate) mod hop_from_interval;
pub(crate) mod initial_guess;
pub(crate) mod landing_bracket;
pub(crate) mod later_flight;
