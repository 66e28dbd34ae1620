//! Golden-section search, and the number behind it.
//!
//! `hybrid-system` has the same search for minima. This crate has its own ten lines, because a dependency on
//! `hybrid-system` would bring its linear algebra to everyone who only wants basins.

/// (√5 − 1)/2, the inverse of the golden ratio.
///
/// A golden-section search divides its interval in this ratio. Its continued fraction has only ones, so that a
/// rotation of the circle by it has low discrepancy.
pub(crate) const INVERSE_GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;

/// Where `height` has its maximum in [left, right], by golden-section search.
///
/// `height` must rise to one maximum and fall after it. Points without a height count as −∞. The place is
/// known to the square root of an ulp only, because a smooth height is flat there.
pub(crate) fn highest_point(
    height: impl Fn(f64) -> Option<f64>,
    mut left: f64,
    mut right: f64,
) -> f64 {
    /// Each step multiplies the interval by 0.618, so 100 steps shrink it by 10⁻²¹: below the spacing of `f64`,
    /// unless the maximum is close to 0. Further steps would not move the result.
    const STEPS: usize = 100;
    let height = |x: f64| height(x).unwrap_or(f64::NEG_INFINITY);
    for _ in 0..STEPS {
        let inner_left = right - INVERSE_GOLDEN_RATIO * (right - left);
        let inner_right = left + INVERSE_GOLDEN_RATIO * (right - left);
        if height(inner_left) > height(inner_right) {
            right = inner_right
        } else {
            left = inner_left
        }
    }
    0.5 * (left + right)
}
