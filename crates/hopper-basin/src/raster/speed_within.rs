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

/// The offset from α*_n of a speed that is known to within `error`, and the bound on its error: the offset is rounded once.
pub(crate) fn offset_from(n: u64, (speed, error): (f64, f64)) -> (f64, f64) {
    let offset = FixedPointSpeed::new(n).offset_of(speed);
    (offset, error + f64::EPSILON * offset.abs())
}

/// α*_n plus an offset, and the bound on the error of the sum: half an ulp each for α*_n and for the sum.
pub(crate) fn speed_at(n: u64, (offset, error): (f64, f64)) -> (f64, f64) {
    let speed = alpha_star(n) + offset;
    (speed, error + f64::EPSILON * speed)
}

/// A hop whose error is larger than the first number, and grows by more than the second, is computed with the second bound, which has
/// the signs of the derivative. It takes about half a microsecond, and a fate alone, where an error grows too large, some hundred microseconds.
const LARGE_ERROR: f64 = 1e-9;
const LARGE_GROWTH: f64 = 8.0;

/// The `hop` that was made from a speed with its error; with the second bound if its error has grown much.
#[inline]
pub(crate) fn with_signs(map: &LiftOffMap, before: (f64, f64), hop: HopWithin) -> HopWithin {
    let error = match hop {
        HopWithin::Next { error, .. } => error,
        HopWithin::Grounded => return hop,
        HopWithin::Inconclusive => f64::INFINITY,
    };
    if error <= LARGE_ERROR || error <= LARGE_GROWTH * before.1 {
        return hop;
    }
    match map.signed_hop_within(before.0, before.1) {
        HopWithin::Inconclusive => hop,
        found => found,
    }
}

/// The hop from a speed with its error. Where the error is large, the first bound would mostly be computed in vain.
pub(crate) fn hop_within(map: &LiftOffMap, (speed, error): (f64, f64)) -> HopWithin {
    if error > LARGE_ERROR {
        let found = map.signed_hop_within(speed, error);
        if found != HopWithin::Inconclusive {
            return found;
        }
    }
    with_signs(map, (speed, error), map.hop_within(speed, error))
}
