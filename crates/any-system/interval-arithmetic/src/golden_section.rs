//! The minimum of a function of one variable.

/// (√5 − 1)/2, the inverse of the golden ratio.
///
/// A golden-section search divides its interval in this ratio. Its continued fraction has only ones, so that a rotation
/// of the circle by it has low discrepancy.
pub const INVERSE_GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;

/// Steps of the search. 0.618¹⁰⁰ ≈ 10⁻²¹, so that the last interval is shorter than an ulp of any place inside the
/// first one, unless the minimum is close to 0. Fewer steps would return a place with fewer digits; more would not
/// move it.
const STEPS: usize = 100;

/// Where `function` has its minimum in [`left`, `right`], by golden-section search.
///
/// The function must fall to one minimum and rise after it; otherwise the result is some place of the interval. The
/// place of a smooth minimum is known to the square root of an ulp only, because the function is flat there. Not a
/// number counts as larger than any value on its left.
///
/// ```
/// let place = interval_arithmetic::golden_section_minimum(|x| (x - 0.3) * (x - 0.3), 0.0, 1.0);
/// assert!((place - 0.3).abs() < 1e-7);
/// ```
pub fn golden_section_minimum(function: impl Fn(f64) -> f64, mut left: f64, mut right: f64) -> f64 {
    for _ in 0..STEPS {
        let inner_left = right - INVERSE_GOLDEN_RATIO * (right - left);
        let inner_right = left + INVERSE_GOLDEN_RATIO * (right - left);
        if function(inner_left) < function(inner_right) {
            right = inner_right
        } else {
            left = inner_left
        }
    }
    0.5 * (left + right)
}
