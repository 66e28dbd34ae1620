//! The landing of a flight that starts with a sudden lift-off, at stretch Y = 1 + x, x > 0.
//!
//! In h, half the time of flight, the landing is a root of V(h) = V. The first root lies on an increasing branch of
//! V(h), and the following intervals hold it and no other root (docs/theory.md, Theorem 12):
//!
//! ```text
//!   branch b    h in                      because
//!   m           [mπ, V]                   V(mπ) = mπ ≤ V ≤ the local maximum of V(h) on the branch
//!   m + 1       (max(V, α*_m), (m+1)π)    V((m+1)π) = (m+1)π > V
//! ```
//!
//! with m = ⌊V/π⌋, or 0 for V < π. The branch is m only if m ≥ 1, V < (m+½)π and (−1)^m (V cos V − Y sin V) ≥ 0:
//! then V is not above the local maximum of branch m. That maximum lies on the diagonal V(h) = h, so that
//! V(h) − h = S (hC − YS)/D changes its sign there.

use crate::landing::flight_ends::{Landing, TakeOff};
use crate::landing::half_time_root::HalfTimeRoot;
use crate::model::fixed_points::alpha_star;
use crate::precision::real::Real;
use std::f64::consts::PI;

/// The first landing after a sudden lift-off, `excess` > 0.
pub(crate) fn next_landing(start: TakeOff, kappa: f64) -> Landing {
    let root = next_root(start, before_maximum(start));
    root.landing(start.excess, start.velocity, kappa, None)
}

/// Half the time of the flight, on branch m if `before_maximum`, else on branch m + 1.
pub(crate) fn next_root(start: TakeOff, before_maximum: bool) -> HalfTimeRoot {
    let TakeOff { excess, velocity } = start;
    let bracket = half_time_bracket(start, before_maximum);
    // On branch 1, V ≈ h/2 − 3x/(2h); elsewhere the search starts in the middle.
    let guess = if velocity < PI {
        let root = pxfm::f_hypot(velocity, (3.0 * excess).sqrt());
        // h = V + √(V² + 3x). For V < 0 this sum cancels. The equal form 3x/(√(V² + 3x) − V) does not.
        if velocity < 0.0 { 3.0 * excess / (root - velocity) } else { velocity + root }
    } else {
        0.5 * (bracket.0 + bracket.1)
    };
    HalfTimeRoot::solve(excess, velocity, bracket, guess)
}

/// The number whose sign decides on which of two branches a flight lands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaximumTest {
    /// (−1)^m (V cos V − Y sin V), m = ⌊V/π⌋, at the start (Y, V) of the flight.
    pub value: f64,
    /// Bound on its error.
    pub error: f64,
}

/// (−1)^m (V cos V − Y sin V), m = ⌊V/π⌋: not negative up to the maximum of branch m. Rounded to `f64`.
pub(crate) fn maximum_test<R: Real>(excess: R, velocity: R) -> f64 {
    let (sin, cos) = velocity.sin_cos();
    let test = (velocity * cos - (excess + 1.0) * sin).nearest();
    if (velocity.nearest() / PI).floor() % 2.0 == 0.0 { test } else { -test }
}

/// Whether the flight may land on branch m. For V < π there is no such branch.
pub(crate) fn before_maximum(start: TakeOff) -> bool {
    start.velocity >= PI && maximum_test(start.excess, start.velocity) >= 0.0
}

/// The interval of h that holds the landing.
pub(crate) fn half_time_bracket(start: TakeOff, before_maximum: bool) -> (f64, f64) {
    let velocity = start.velocity;
    if velocity < PI {
        return (velocity.max(0.0), PI);
    }
    let m = (velocity / PI).floor();
    if velocity < (m + 0.5) * PI && before_maximum {
        (m * PI, velocity)
    } else {
        (velocity.max(alpha_star(m as u64)), (m + 1.0) * PI)
    }
}
