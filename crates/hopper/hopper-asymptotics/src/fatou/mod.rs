//! How many hops does an orbit take along the slow side of a fixed point?
//!
//! ```text
//!   fatou_coordinate.rs   Ψ: the number of hops, counted continuously; its inverse; jumps over many hops
//!   escape.rs             the law of the escape to the left
//!   phase.rs, offset.rs   an integer of any size with a fraction; an offset below the smallest f64
//!   hop_count.rs          a number of hops in f64
//!   abel_series.rs        the series of Ψ in x = |δ|^{1/3}, with a bound on its error
//!   leading_term.rs       1/(A x) + c ln x to any number of digits
//!   slow_jump.rs          jumps over many hops
//!   outward_walk.rs       fast single hops, from where a jump ends
//!   slow_hops.rs          single hops, where the series has no value
//!   local_hop_model.rs    a hop as Taylor models
//!   second_flight.rs      its second flight, on the left
//!   taylor_model.rs       polynomials with bounds
//!   polynomial.rs         polynomials without bounds
//!   quotient.rs           quotients of integers of any size, rounded
//! ```

pub(crate) mod abel_series;
pub(crate) mod escape;
pub(crate) mod fatou_coordinate;
pub(crate) mod hop_count;
pub(crate) mod leading_term;
pub(crate) mod local_hop_model;
pub(crate) mod offset;
pub(crate) mod outward_walk;
pub(crate) mod phase;
pub(crate) mod polynomial;
pub(crate) mod quotient;
pub(crate) mod second_flight;
pub(crate) mod slow_hops;
pub(crate) mod slow_jump;
pub(crate) mod taylor_model;
