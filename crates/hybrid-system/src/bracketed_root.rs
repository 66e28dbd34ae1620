//! The root of a function on a bracket that is already certain.
//!
//! This is the only file that calls the `roots` crate. Two of its habits are kept out: it decides
//! signs by products, which underflow for values around 1e-166, and it may return an iterate older
//! than its last bracket.

use crate::Error;
use roots::{Convergency, SearchError, find_root_brent};

/// Enough for halvings down to the smallest numbers, where a flat root is at zero.
const ITERATIONS: usize = 1200;

/// Where values are cut off from below, relative to the larger end value, so that the product of
/// two of them cannot underflow. Far under any rounding error.
const SMALLEST_VALUE: f64 = 1e-150;

/// Stops at an exact zero or when the bracket is two ulps wide.
struct FullPrecision;

impl Convergency<f64> for FullPrecision {
    fn is_root_found(&mut self, y: f64) -> bool {
        y == 0.0
    }
    fn is_converged(&mut self, x1: f64, x2: f64) -> bool {
        (x1 - x2).abs() <= 2.0 * f64::EPSILON * x1.abs().max(x2.abs())
    }
    fn is_iteration_limit_reached(&mut self, iteration: usize) -> bool {
        iteration >= ITERATIONS
    }
}

/// The root of `function` between `left` and `right`, to about two ulps, by Brent's method.
///
/// The values at the two ends must differ in sign, or one of them must be zero; then that end is
/// the root. Values of any size are welcome: only their signs and ratios are used.
///
/// ```
/// let root = hybrid_system::bracketed_root(|x| x * x - 2.0, 1.0, 2.0)?;
/// assert!((root - 2f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), hybrid_system::Error>(())
/// ```
///
/// # Errors
/// [`Error::NoSignChange`] without a sign change, [`Error::NotFinite`] if the function is,
/// [`Error::NoConvergence`] if 1200 iterations do not suffice.
pub fn bracketed_root(
    mut function: impl FnMut(f64) -> f64,
    left: f64,
    right: f64,
) -> Result<f64, Error> {
    let (at_left, at_right) = (function(left), function(right));
    for (at, value) in [(left, at_left), (right, at_right)] {
        if !value.is_finite() || !at.is_finite() {
            return Err(Error::NotFinite { at, value });
        }
        if value == 0.0 {
            return Ok(at);
        }
    }
    if at_left.signum() == at_right.signum() {
        return Err(Error::NoSignChange { left, right, at_left, at_right });
    }

    let scale = at_left.abs().max(at_right.abs());
    // The tightest bracket among all points seen: its ends are neighbours of the sign change, even
    // where the function jumps.
    let mut low = (left, at_left);
    let mut high = (right, at_right);
    let mut broken = None;
    let scaled = |x: f64| {
        let value = function(x);
        if !value.is_finite() {
            broken.get_or_insert((x, value));
            return 0.0; // ends the search; reported below
        }
        if (low.0.min(high.0)..=low.0.max(high.0)).contains(&x) {
            if value.signum() == low.1.signum() && value != 0.0 {
                low = (x, value);
            } else {
                high = (x, value);
            }
        }
        let y = value / scale;
        if value == 0.0 { 0.0 } else { y.abs().max(SMALLEST_VALUE).copysign(value) }
    };
    let outcome = find_root_brent(left, right, scaled, &mut FullPrecision);
    if let Some((at, value)) = broken {
        return Err(Error::NotFinite { at, value });
    }
    match outcome {
        Ok(_) => Ok(if low.1.abs() < high.1.abs() { low.0 } else { high.0 }),
        Err(SearchError::NoConvergency) => {
            Err(Error::NoConvergence { left, right, iterations: ITERATIONS })
        }
        Err(_) => Err(Error::NoSignChange { left, right, at_left, at_right }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn values_around_1e_minus_166_still_change_sign() {
        let root = bracketed_root(|x| 1e-166 * (x - 0.3), 0.0, 1.0).unwrap();
        assert_eq!(root, 0.3);
    }

    #[test]
    fn a_jump_is_located() {
        let sign = bracketed_root(|x| if x < 0.3 { -1.0 } else { 1.0 }, 0.0, 1.0).unwrap();
        assert!((sign - 0.3).abs() < 1e-15);
        let jump = |x: f64| if x < 0.3 { -(1.0 + x) } else { 1.0 };
        assert!((bracketed_root(jump, 0.0, 1.0).unwrap() - 0.3).abs() < 1e-15);
    }

    #[test]
    fn an_end_that_is_a_root_is_returned() {
        assert_eq!(bracketed_root(|x| x, 0.0, 1.0), Ok(0.0));
        assert_eq!(bracketed_root(|x| x - 1.0, 0.0, 1.0), Ok(1.0));
    }

    #[test]
    fn no_sign_change_is_an_error_with_the_numbers() {
        let error = bracketed_root(|x| x * x + 1.0, 0.0, 1.0).unwrap_err();
        assert_eq!(error.to_string(), "no sign change on [0, 1]: values 1 and 2");
    }

    #[test]
    fn a_function_that_breaks_down_is_an_error() {
        let broken = |x: f64| if x > 0.4 && x < 0.6 { f64::NAN } else { x - 0.5 };
        assert!(matches!(bracketed_root(broken, 0.0, 1.0), Err(Error::NotFinite { .. })));
    }

    proptest! {
        /// Planted roots over 600 orders of magnitude, with triple roots among them.
        #[test]
        fn planted_roots_are_found(root in -1e3..1e3f64, width in 1e-6..10f64, cubic: bool) {
            let f = |x: f64| if cubic { (x - root).powi(3) } else { x - root };
            let found = bracketed_root(f, root - width, root + 0.7 * width).unwrap();
            prop_assert!((found - root).abs() <= 4.0 * f64::EPSILON * root.abs().max(width),
                         "{found} instead of {root}");
        }
    }
}
