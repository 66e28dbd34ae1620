//! From a root to the far side of the surface.
//!
//! A root finder returns a time at which the function may still have its old sign, within rounding. A search that
//! starts there would find the same root again. Therefore each search moves its root later, ulp by ulp, until the
//! function has left the old side.

/// The first of the times `root`, `root` + 1 ulp, + 3 ulps, + 7 ulps and so on, no later than `last`, at which `past`
/// holds; `last` if none does.
///
/// The steps double, so that a long interval hidden by rounding takes few evaluations. Times must not be negative: only
/// then does a larger bit pattern mean a later time.
pub(crate) fn step_past_root(root: f64, last: f64, past: impl Fn(f64) -> bool) -> f64 {
    let (mut time, mut ulps) = (root, 1u64);
    while time < last && !past(time) {
        time = f64::from_bits(time.to_bits().saturating_add(ulps)).min(last);
        // No overflow: all positive doubles lie within 2⁶³ ulps of each other, so that the loop ends earlier.
        ulps *= 2;
    }
    time
}

/// From `root` to the first time at which the function has the sign of `at_last`, its value at `last`, and is not zero.
pub(crate) fn step_to_sign(
    function: impl Fn(f64) -> f64,
    root: f64,
    last: f64,
    at_last: f64,
) -> f64 {
    step_past_root(root, last, |time| {
        let value = function(time);
        value != 0.0 && value.signum() == at_last.signum()
    })
}
