//! Exponentials and powers of numbers, also where the results are next to the smallest ones.
//!
//! There pxfm 0.1.30 is not as near as it claims: its exponential of −709.7411184795164 is 9.45·10⁻³¹⁰ and not
//! 5.80·10⁻³⁰⁹, and its power −2 of 10¹⁶⁰ is 0 and not 10⁻³²⁰.

/// Results below this size are squares of others. Four times the smallest normal number: results above are right.
pub(crate) const SMALLEST_CLAIMED: f64 = 4.0 * f64::MIN_POSITIVE;

/// The exponential, within half an ulp, and within 2 ulps where it is below 10⁻³⁰⁷; the same bits on every machine.
///
/// ```
/// assert_eq!(interval_arithmetic::exp(-709.7411184795164), 5.79894065768322e-309);
/// assert!(interval_arithmetic::exp(f64::NAN).is_nan());
/// ```
#[inline]
pub fn exp(x: f64) -> f64 {
    let claimed = pxfm::f_exp(x);
    if claimed < SMALLEST_CLAIMED {
        let root = pxfm::f_exp(0.5 * x);
        root * root
    } else {
        claimed
    }
}

/// The power x^y, within half an ulp, and within 2 ulps where its size is below 10⁻³⁰⁷; NaN for a base below zero with
/// an exponent that is no integer. The same bits on every machine.
///
/// ```
/// assert_eq!(interval_arithmetic::pow(1e160, -2.0), 1e-320);
/// assert_eq!(interval_arithmetic::pow(-1e107, -3.0), -1e-321);
/// ```
#[inline]
pub fn pow(x: f64, y: f64) -> f64 {
    let claimed = pxfm::f_pow(x, y);
    if claimed.abs() < SMALLEST_CLAIMED && x != 0.0 {
        // Half of an exponent is exact. Odd powers of numbers below zero are below zero.
        let root = pxfm::f_pow(x.abs(), 0.5 * y);
        let size = root * root;
        if is_odd_power_below_zero(x, y) { -size } else { size }
    } else {
        claimed
    }
}

/// The sign of x^y is that of x.
#[inline]
pub(crate) fn is_odd_power_below_zero(x: f64, y: f64) -> bool {
    x < 0.0 && y % 2.0 != 0.0
}
