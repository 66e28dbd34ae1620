//! The choice of the scheme.

use super::scheme::Scheme;

/// The pair of orders 9(8).
pub(super) static NINE: Scheme = include!("nine.in");

/// The pair of orders 6(5).
pub(super) static SIX: Scheme = include!("six.in");

/// The tolerance from which on order six is used. It needs more steps than order nine, but fewer stages for the
/// interpolant. With a smaller value flows at 1e-8 would take longer.
///
/// Verner's pair 8(7) would take 2 to 20 % fewer evaluations at 1e-10 than the pair 9(8). It is not used: its nodes
/// leave a gap from 0.49 to 0.96 of the step, so that it misses kinks of the field. The errors there were up to 82
/// times the tolerance. Its weights reach 15 000 and cancel, with a rounding of 3·10⁻¹² of a step's change.
const LOOSE: f64 = 1e-7;

/// The scheme for a relative tolerance.
pub(in crate::ode) fn scheme_for(tolerance: f64) -> &'static Scheme {
    if tolerance >= LOOSE { &SIX } else { &NINE }
}
