//! One hop.
//!
//! ```text
//!   hop.rs               the hop: first flight, later flights, verdict on α′²
//!   later_flight.rs      from (x, V) to the landing: steps, first-order correction, error bound
//!   landing_bracket.rs   the interval that holds the landing
//!   initial_guess.rs     polynomials that start the search
//!   half_angle.rs        sine and cosine of half the time, D and u
//!   ground_state.rs      (x, V) with an error bound
//! ```

pub(crate) mod ground_state;
pub(crate) mod half_angle;
pub(crate) mod hop;
pub(crate) mod initial_guess;
pub(crate) mod landing_bracket;
pub(crate) mod later_flight;
