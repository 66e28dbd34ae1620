//! Speeds that are known to within an error.

use passive_hopper::{FixedPointSpeed, HopWithin, LiftOffMap, alpha_star};

/// KNOWN: whether all speeds within `error` of `alpha` lie in the interval.
#[inline]
pub(crate) fn is_inside(alpha: f64, error: f64, (left, right): (f64, f64)) -> bool {
    /// More than the rounding of the differences.
    const ROUND_UP: f64 = 1.0 + 4.0 * f64::EPSILON;
    // A speed without an error may be an end. The differences are then not negative exactly inside.
    let error = ROUND_UP * error;
    (alpha - left >= error) & (right - alpha >= error)
}

/// The offset from α*_n of a speed that is known to within `error`, and the bound on its error: the offset is
/// rounded once.
pub(crate) fn offset_from(n: u64, (speed, error): (f64, f64)) -> (f64, f64) {
    let offset = FixedPointSpeed::new(n).offset_of(speed);
    (offset, error + f64::EPSILON * offset.abs())
}

/// α*_n plus an offset, and the bound on the error of the sum: half an ulp each for α*_n and for the sum.
pub(crate) fn speed_at(n: u64, (offset, error): (f64, f64)) -> (f64, f64) {
    let speed = alpha_star(n) + offset;
    (speed, error + f64::EPSILON * speed)
}

/// The error of a speed from which a hop may need the second bound, which has the signs of the derivative: this
/// part of the distance between the speeds that are labelled, and no number outside these two. A hop with the
/// second bound takes about a third of a microsecond, three times as long as one with the first, and a fate alone,
/// where an error has grown too large to decide, some hundred microseconds.
const LARGE_PART: f64 = 0.01;
const LARGE_ERRORS: (f64, f64) = (1e-9, 1e-7);

/// A hop has the second bound if its error grows by more than this, too.
const LARGE_GROWTH: f64 = 8.0;

/// The error from which hops of orbits from `speeds`, in increasing order, may need the second bound.
pub(crate) fn large_error(speeds: &[f64]) -> f64 {
    let length = if let [first, .., last] = speeds { last - first } else { 0.0 };
    let (least, most) = LARGE_ERRORS;
    (LARGE_PART * length / speeds.len() as f64).max(least).min(most)
}

/// The `hop` that was made from a speed with its error; with the second bound if its error has grown much, to more
/// than `large`.
#[inline]
pub(crate) fn with_signs(
    map: &LiftOffMap,
    before: (f64, f64),
    hop: HopWithin,
    large: f64,
) -> HopWithin {
    let error = match hop {
        HopWithin::Next { error, .. } => error,
        HopWithin::Grounded => return hop,
        HopWithin::Inconclusive => f64::INFINITY,
    };
    if error <= large || error <= LARGE_GROWTH * before.1 {
        return hop;
    }
    match map.signed_hop_within(before.0, before.1) {
        HopWithin::Inconclusive => hop,
        found => found,
    }
}

/// The hop from a speed with its error. Where the error is `large`, the first bound would mostly be computed in vain.
pub(crate) fn hop_within(map: &LiftOffMap, (speed, error): (f64, f64), large: f64) -> HopWithin {
    if error <= large {
        return with_signs(map, (speed, error), map.hop_within(speed, error), large);
    }
    match map.signed_hop_within(speed, error) {
        HopWithin::Inconclusive => map.hop_within(speed, error),
        found => found,
    }
}
