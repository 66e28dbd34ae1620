//! The choice of the scheme.

use super::scheme::Scheme;
use super::{eight, nine, six};

/// The pair 8(7) is used from [`TIGHT`] to [`MIDDLE`]. Where stability limits the steps it needs the fewest evaluations of
/// the field, on the pressure relief valve of the crate `example-systems` for example, but it misses weak kinks of the field:
/// behind a contact force max(0, x)^1.5 its error at 1e-8 and 1e-9 is 400 times the tolerance, with the others at most 34. With a
/// value of `TIGHT` below 1e-12 the rounding of the pair would be as large as the tolerance (see the head of `schemes`). With a
/// larger one flows at 1e-10 would take longer, and with a larger `MIDDLE` more flows would have such errors.
const TIGHT: f64 = 2e-11;

/// See [`TIGHT`].
const MIDDLE: f64 = 5e-10;

/// The tolerance from which on order six is used. It needs more steps than order nine, but fewer stages for the
/// interpolant. With a smaller value flows at 1e-8 would take longer.
const LOOSE: f64 = 1e-7;

/// The scheme for a relative tolerance.
pub(in crate::ode) fn scheme_for(tolerance: f64) -> &'static Scheme {
    if tolerance >= LOOSE {
        &six::PAIR
    } else if (TIGHT..MIDDLE).contains(&tolerance) {
        &eight::PAIR
    } else {
        &nine::PAIR
    }
}
