//! Rounding outwards: one `f64` beyond the result of rounding to nearest. Sums, whose rounding error is known, are
//! rounded outwards only if it is on that side.

/// A number that is not above the exact value whose rounding to nearest is `rounded`.
///
/// NaN comes from ends without bounds, such as ∞ − ∞. Then nothing is known: −∞.
#[inline]
pub(crate) fn down(rounded: f64) -> f64 {
    if rounded.is_nan() { f64::NEG_INFINITY } else { rounded.next_down() }
}

/// A number that is not below the exact value whose rounding to nearest is `rounded`.
#[inline]
pub(crate) fn up(rounded: f64) -> f64 {
    if rounded.is_nan() { f64::INFINITY } else { rounded.next_up() }
}

/// One `f64` more than the half ulp that pxfm claims, downwards.
#[inline]
pub(crate) fn below(claimed: f64) -> f64 {
    down(down(claimed))
}

/// One `f64` more than the half ulp that pxfm claims, upwards.
#[inline]
pub(crate) fn above(claimed: f64) -> f64 {
    up(up(claimed))
}

/// The largest `f64` that is not above a + b, or one below it if a, b or the sum is not finite.
#[inline]
pub(crate) fn sum_down(a: f64, b: f64) -> f64 {
    let (sum, error) = with_error(a, b);
    if error >= 0.0 { sum } else { down(sum) }
}

/// The smallest `f64` that is not below a + b, or one above it if a, b or the sum is not finite.
#[inline]
pub(crate) fn sum_up(a: f64, b: f64) -> f64 {
    let (sum, error) = with_error(a, b);
    if error <= 0.0 { sum } else { up(sum) }
}

/// The rounded sum, and what is left of the exact one (D. E. Knuth, The Art of Computer Programming 2, Section
/// 4.2.2, Theorem B); NaN if one of them is not finite.
#[inline]
fn with_error(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}
