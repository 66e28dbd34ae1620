//! Where a function that grazes zero is closest to it.

use crate::crossing::golden_section::golden_section_minimum;

/// The time and the value at which `function` is closest to zero, near a stretch where rounding hides its sign.
///
/// The interval [`from`, `from` + `width`] is where a search stopped. The stretch may begin later and may be longer. So
/// this function looks ahead, each time twice as far, until `clear` says that the value is clear of rounding again, or
/// the horizon is reached. `sign` is the sign of the function before the stretch.
pub(crate) fn closest_approach(
    function: impl Fn(f64) -> f64,
    clear: impl Fn(f64) -> bool,
    sign: f64,
    (from, width, horizon): (f64, f64, f64),
) -> (f64, f64) {
    // At least one ulp, also at time zero: a shorter step would not move at all.
    let mut step = width.max(f64::EPSILON * from).max(f64::MIN_POSITIVE);
    let (mut ahead, at_first) = (from, function(from).abs());
    let mut hidden = !clear(from);
    while ahead < horizon {
        ahead = (from + step).min(horizon);
        step *= 2.0;
        // Still on the way to zero: the sign is the old one, the value no larger than at first, and no hidden value was
        // seen yet. Stopping here would leave the minimum outside [from, ahead].
        let before = !hidden && function(ahead) * sign > 0.0 && function(ahead).abs() <= at_first;
        if clear(ahead) && !before {
            break;
        }
        hidden |= !clear(ahead);
    }
    let time = golden_section_minimum(|time| function(time).abs(), from, ahead);
    (time, function(time))
}
