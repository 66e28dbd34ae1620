//! The root of a function on a bracket that is already certain.
//!
//! This is the only file that calls the `roots` crate. It works around two properties of that crate's
//! `find_root_brent`: the function decides signs by products, which underflow for values around 1e-166, and it may
//! return an iterate that is older than its last bracket.

use crate::error::Error;
use roots::{Convergency, SearchError, find_root_brent};

/// Most iterations. A bracket of length 1 around a root at zero is halved 1074 times until it reaches the smallest
/// double. At a flat root no method is faster than halving. A simple root takes about ten iterations. Beyond this
/// number the search ends with [`Error::NoConvergence`].
const MOST_ITERATIONS: usize = 1200;

/// Smaller values, relative to the larger end value, are replaced by this one with their sign. The product of two such
/// values is 1e-300, which does not underflow. The number is far below every rounding error, so that only signs are
/// affected.
const SMALLEST_VALUE: f64 = 1e-150;

/// Width of the last bracket in units of ε·|x|, which is one ulp or two. A narrower one would ask for neighbouring
/// doubles, between which Brent's steps do not move; a wider one would give away digits of the root.
const LAST_WIDTH: f64 = 2.0;

/// Stops at an exact zero or when the bracket is two ulps wide.
struct FullPrecision;

impl Convergency<f64> for FullPrecision {
    fn is_root_found(&mut self, y: f64) -> bool {
        y == 0.0
    }
    fn is_converged(&mut self, x1: f64, x2: f64) -> bool {
        (x1 - x2).abs() <= LAST_WIDTH * f64::EPSILON * x1.abs().max(x2.abs())
    }
    fn is_iteration_limit_reached(&mut self, iteration: usize) -> bool {
        iteration >= MOST_ITERATIONS
    }
}

/// The root of `function` between `left` and `right`, to about two ulps, by Brent's method.
///
/// The values at the two ends must differ in sign, or one of them must be zero; then that end is
/// the root. Values may have any size: only their signs and ratios are used.
///
/// ```
/// let root = interval_arithmetic::bracketed_root(|x| x * x - 2.0, 1.0, 2.0)?;
/// assert!((root - 2f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), interval_arithmetic::Error>(())
/// ```
///
/// # Errors
/// [`Error::NoSignChange`] if the ends have the same sign, [`Error::NotFinite`] for an end or a value that is not
/// finite, [`Error::NoConvergence`] after 1200 iterations.
pub fn bracketed_root(
    mut function: impl FnMut(f64) -> f64,
    left: f64,
    right: f64,
) -> Result<f64, Error> {
    let (at_left, at_right) = (function(left), function(right));
    let [low, high] = last_bracket(&mut function, (left, at_left), (right, at_right))?;
    // The crate's own iterate is not used: it may lie outside the last bracket.
    Ok(if low.1.abs() < high.1.abs() { low.0 } else { high.0 })
}

/// The first double behind the root between two known points: there the function is zero, or has the sign of the second
/// point. At the double before it has the sign of the first point.
///
/// A point is an argument and the value there. The second may be zero; the first is on the other side.
///
/// # Errors
/// As [`bracketed_root`].
pub fn root_beyond(
    function: &dyn Fn(f64) -> f64,
    before: (f64, f64),
    beyond: (f64, f64),
) -> Result<f64, Error> {
    let [low, high] = last_bracket(&mut |x| function(x), before, beyond)?;
    let (mut left, mut right) = (low.0, high.0);
    // The last bracket is some ulps wide.
    loop {
        let middle = left + 0.5 * (right - left);
        if middle <= left || middle >= right {
            return Ok(right);
        }
        let value = function(middle);
        if value != 0.0 && value.signum() == low.1.signum() {
            left = middle;
        } else {
            right = middle;
        }
    }
}

/// Two points, an ulp or two apart, at which the function has the signs of the two given points, or is zero at the
/// second.
///
/// Compiled once, and not for each function: the search is long, and the call is nothing beside the function's value.
fn last_bracket(
    function: &mut dyn FnMut(f64) -> f64,
    (left, at_left): (f64, f64),
    (right, at_right): (f64, f64),
) -> Result<[(f64, f64); 2], Error> {
    for (at, value) in [(left, at_left), (right, at_right)] {
        if !value.is_finite() || !at.is_finite() {
            return Err(Error::NotFinite { at, value });
        }
        if value == 0.0 {
            return Ok([(at, value), (at, value)]);
        }
    }
    if at_left.signum() == at_right.signum() {
        return Err(Error::NoSignChange { left, right, at_left, at_right });
    }

    let scale = at_left.abs().max(at_right.abs());
    // Invariant: the function has opposite signs at `low` and `high` (or is zero at `high`), and no point seen lies
    // between them. So the sign changes between these two neighbours, even if the function jumps.
    let mut low = (left, at_left);
    let mut high = (right, at_right);
    let mut not_finite = None;
    let scaled = |x: f64| {
        // The crate evaluates the ends of its bracket again.
        let value = match x {
            x if x == low.0 => low.1,
            x if x == high.0 => high.1,
            x => function(x),
        };
        if !value.is_finite() {
            not_finite.get_or_insert((x, value));
            return 0.0; // an exact zero ends the search; the error is returned below
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
    if let Some((at, value)) = not_finite {
        return Err(Error::NotFinite { at, value });
    }
    match outcome {
        Ok(_) => Ok([low, high]),
        Err(SearchError::NoConvergency) => {
            Err(Error::NoConvergence { left, right, iterations: MOST_ITERATIONS })
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
    fn a_root_at_an_end_is_returned() {
        assert_eq!(bracketed_root(|x| x, 0.0, 1.0), Ok(0.0));
        assert_eq!(bracketed_root(|x| x - 1.0, 0.0, 1.0), Ok(1.0));
    }

    #[test]
    fn no_sign_change_is_an_error_with_the_numbers() {
        let error = bracketed_root(|x| x * x + 1.0, 0.0, 1.0).unwrap_err();
        assert_eq!(error.to_string(), "no sign change on [0.0, 1.0]: values 1.0 and 2.0");
    }

    #[test]
    fn a_function_that_is_not_finite_is_an_error() {
        let broken = |x: f64| if x > 0.4 && x < 0.6 { f64::NAN } else { x - 0.5 };
        assert!(matches!(bracketed_root(broken, 0.0, 1.0), Err(Error::NotFinite { .. })));
    }

    proptest! {
        /// Simple and triple roots at known places are found to a few ulps.
        #[test]
        fn planted_roots_are_found(root in -1e3..1e3f64, width in 1e-6..10f64, cubic: bool) {
            let f = |x: f64| if cubic { (x - root).powi(3) } else { x - root };
            let found = bracketed_root(f, root - width, root + 0.7 * width).unwrap();
            prop_assert!((found - root).abs() <= 4.0 * f64::EPSILON * root.abs().max(width),
                         "{found} instead of {root}");
        }
    }
}
