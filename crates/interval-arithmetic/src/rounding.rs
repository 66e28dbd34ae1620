//! Rounding outwards: one `f64` beyond the result of rounding to nearest.

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
