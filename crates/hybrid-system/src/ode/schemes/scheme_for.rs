//! The choice of the scheme.

use super::scheme::Scheme;
use super::{eight, nine, six};

/// The pair 8(7) is used from [`TIGHT`] to [`MIDDLE`]. It has fewer stages than the pair 9(8). At 1e-10 a thousand turning
/// points of the pressure relief valve of the crate `example-systems` take 2 % fewer evaluations of the field than with the
/// pair 9(8) at the flow rate 1, 19 % fewer at the flow rate 7, and 37 to 43 % fewer than with the pair 6(5). A pendulum
/// takes 9 %, van der Pol's oscillator with μ = 5 20 % fewer than with 9(8).
///
/// It misses weak kinks of the field more often: its nodes leave a gap from 0.49 to 0.96 of the step. The documentation of
/// `Tolerances` has the errors. With a value of `TIGHT` below 1e-12 the rounding of the pair would be as large as the
/// tolerance (see the head of `schemes`). With a larger one flows at 1e-10 would take longer, and with a larger `MIDDLE` more
/// flows would have such errors.
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
