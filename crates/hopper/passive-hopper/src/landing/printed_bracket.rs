//! The interval of τ that holds the first landing, for a solver of the paper's Eq. (8).

use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::landing::flight_ends::TakeOff;
use crate::landing::half_time::HalfTime;
use crate::landing::next_landing::{before_maximum, half_time_bracket};
use std::f64::consts::PI;

/// The interval of τ that holds the first landing.
pub(crate) fn time_bracket(start: TakeOff) -> (f64, f64) {
    let (left, right) = if start.excess > 0.0 {
        let (left, right) = half_time_bracket(start, before_maximum(start));
        // The lift-off itself is a root of Eq. (8), at τ = 0: the bracket must not reach it.
        (if left > 0.0 { left } else { before_landing(start, right) }, right)
    } else {
        // The whole interval (nπ, (n+1)π), and not a bracket that ends at α: near α*_n the landing is so close to
        // α that rounding hides the sign of Eq. (8) there. At τ = 2nπ it is 2nπ (nπ − α), far from rounding.
        // For n = 0 the lift-off is a root at τ = 0, and the landing has h > α.
        let n = FixedPointInterval::of(start.velocity).n as f64;
        let left = if n == 0.0 { start.velocity } else { n * PI };
        (left, (n + 1.0) * PI)
    };
    (2.0 * left, 2.0 * right)
}

/// An h > 0 before the landing on branch 1: V(h) falls to −∞ towards the lift-off at h = 0.
fn before_landing(start: TakeOff, right: f64) -> f64 {
    let mut h = 0.5 * right;
    while h > f64::MIN_POSITIVE && HalfTime::at(h).start_speed(start.excess) >= start.velocity {
        h *= 0.5;
    }
    h
}
