//! A stretch of time on which rounding hides a function.

use super::bounded::Bounded;
use interval_arithmetic::golden_section_minimum;

/// A time that rounding hides, with the value that is closest to zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hidden {
    /// Where the hidden interval begins.
    pub(super) from: f64,
    /// Time and value at which the function was closest to zero, on the stretches before this one.
    pub(super) closest: Option<(f64, f64)>,
}

/// Time and value at which the function is closest to zero on the part of a hidden interval that lies between `from`
/// and `until`, or before.
pub(super) fn closest(
    function: &impl Bounded,
    level: f64,
    hidden: &Hidden,
    from: f64,
    until: f64,
) -> (f64, f64) {
    let size = |time: f64| (function.value(time) - level).abs();
    let time = golden_section_minimum(size, hidden.from.max(from), until);
    let here = (time, function.value(time) - level);
    match hidden.closest {
        Some(before) if before.1.abs() <= here.1.abs() => before,
        _ => here,
    }
}
