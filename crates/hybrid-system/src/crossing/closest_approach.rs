//! The time at which a grazing function is closest to zero.

/// 1/φ, φ the golden ratio.
const INVERSE_GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;

/// Steps of a golden-section search. 0.618¹⁰⁰ ≈ 10⁻²¹, so that the last interval is shorter than an ulp of any time
/// inside the first one. Fewer steps would return a time with fewer digits.
const GOLDEN_SECTIONS: usize = 100;

/// The time and the value at which `function` is closest to zero, near an interval where rounding hides its sign.
///
/// The interval [`from`, `from` + `width`] is where a search stopped. The hidden interval may begin later and may be
/// longer. This function therefore searches ahead, each time twice as far. It stops when `clear` returns true (the
/// value is larger than its rounding error again), or at the horizon. `sign` is the sign of the function before the
/// hidden interval.
pub(crate) fn closest_approach(
    function: impl Fn(f64) -> f64,
    clear: impl Fn(f64) -> bool,
    sign: f64,
    (from, width, horizon): (f64, f64, f64),
) -> (f64, f64) {
    // At least one ulp, also at time zero: a shorter step would not change the time.
    let mut step = width.max(f64::EPSILON * from).max(f64::MIN_POSITIVE);
    let (mut ahead, at_first) = (from, function(from).abs());
    let mut hidden = !clear(from);
    while ahead < horizon {
        ahead = (from + step).min(horizon);
        step *= 2.0;
        // The function still approaches zero if its sign is the old one, its value is no larger than at first, and no
        // hidden value has been seen yet. Stopping here would leave the minimum outside [from, ahead].
        let before = !hidden && function(ahead) * sign > 0.0 && function(ahead).abs() <= at_first;
        if clear(ahead) && !before {
            break;
        }
        hidden |= !clear(ahead);
    }
    let time = golden_section_minimum(|time| function(time).abs(), from, ahead);
    (time, function(time))
}

/// The minimum of a function with one minimum on [left, right]. Near a grazing |g| is such a function.
fn golden_section_minimum(function: impl Fn(f64) -> f64, mut left: f64, mut right: f64) -> f64 {
    for _ in 0..GOLDEN_SECTIONS {
        let a = right - INVERSE_GOLDEN_RATIO * (right - left);
        let b = left + INVERSE_GOLDEN_RATIO * (right - left);
        if function(a) < function(b) { right = b } else { left = a }
    }
    0.5 * (left + right)
}
