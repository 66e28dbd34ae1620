//! What is α′ = f(α; M), the next gradual lift-off speed?
//!
//! ```text
//!   lift_off_map.rs       one hop: by the kernel, or by the general solver if the kernel leaves it undecided
//!   plain_landings.rs     its landings in f64, without bounds
//!   many_at_once.rs       many hops, in blocks of the kernel
//!   near_fixed_point.rs   a hop in (n, δ), α = α*_n + δ
//!   extended_hop.rs       a hop in 106 to 1024 bits
//!   hop_within.rs         a hop in f64 from a speed with an error; the error of the next speed
//!   extended_orbit.rs     an orbit in 106 to 1024 bits, with a bound on its error
//!   bounded_orbit.rs      an orbit in the shortest arithmetic that suffices, with a bound on its error
//!   speed_error.rs        how far an error of α moves α′²
//!   slopes.rs             ∂α′/∂α and ∂α′/∂M
//!   printed.rs            the paper's own equations, for comparison
//!   limits.rs             limits of all of these
//! ```

pub(crate) mod bounded_orbit;
pub(crate) mod extended_hop;
pub(crate) mod extended_orbit;
pub(crate) mod hop_within;
pub(crate) mod lift_off_map;
pub(crate) mod limits;
pub(crate) mod many_at_once;
pub(crate) mod near_fixed_point;
pub(crate) mod plain_landings;
pub(crate) mod printed;
pub(crate) mod slopes;
pub(crate) mod speed_error;
