//! The choice of the scheme.

use super::scheme::Scheme;
use super::{eight, nine};

/// The tolerance below which order nine takes less time. Chosen by measurement, on the pressure relief valve of the
/// crate `return-map`, whose steps are limited by stability. With a value below 1e-12 the rounding of the pair 8(7)
/// would be as large as the tolerance (see the head of `schemes`). With a larger value flows at 1e-10 would take longer.
const TIGHT: f64 = 2e-11;

/// The scheme for a relative tolerance.
pub(in crate::ode) fn scheme_for(tolerance: f64) -> &'static Scheme {
    if tolerance < TIGHT { &nine::PAIR } else { &eight::PAIR }
}
