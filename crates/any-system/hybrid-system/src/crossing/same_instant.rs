//! Which of two crossing times is earlier, beyond rounding.

/// Two times within this many ulps count as the same instant. A crossing time is right to a few ulps: `bracketed_root`
/// stops at a bracket of two ulps, and the step past the root adds one or two. A larger number would swap the order of
/// events whose times differ by more than rounding.
const SAME_INSTANT_ULPS: f64 = 4.0;

/// True if `time` comes before `other` by more than a few ulps.
///
/// Guards are searched in the order in which the model lists them. This comparison is strict by a margin. Therefore the
/// guard listed first is returned among crossings at the same instant.
pub(crate) fn sooner(time: f64, other: f64) -> bool {
    time < other * (1.0 - SAME_INSTANT_ULPS * f64::EPSILON)
}
