//! When and how the lower mass lands, and how large the error of the answer is.

pub(crate) mod error_bound;
pub(crate) mod first_flight_table;
pub(crate) mod from_air;
pub(crate) mod from_ground;
pub(crate) mod half_flight;
