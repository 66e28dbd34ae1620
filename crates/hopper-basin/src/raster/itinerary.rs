//! Itineraries: the laps that an orbit visits, and how it ends.
//!
//! If the orbits of two speeds have the same itinerary, every orbit that starts between them has their fate. This holds
//! for orbits as `f64` computes them, because an itinerary carries a bound on the rounding errors. README.md has the
//! proof; its invariants are cited here by name.

use crate::raster::laps::{ID_BITS, Laps};
use passive_hopper::LiftOffMap;

/// The end of an itinerary that is not complete. Indices of traps are smaller than this and [`GROUND`].
const NO_END: u32 = u32::MAX - 1;

/// The end of an itinerary that ends on the ground.
const GROUND: u32 = u32::MAX - 2;

/// The laps an orbit visits, its end, and a bound on the errors of orbits beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Itinerary {
    /// A leading one bit, then the numbers of the laps, [`ID_BITS`] bits each. 64 bits hold twelve laps.
    laps: u64,
    /// The index of the trap, [`GROUND`] or [`NO_END`].
    end: u32,
    /// The bound of invariant BETWEEN: how far a computed orbit may lie outside the two that enclose it. Infinite if
    /// nothing is known; then the itinerary agrees with no other.
    ///
    /// An `f32` keeps an itinerary at 16 bytes. It is rounded up.
    error: f32,
}

/// The errors of two hops, one of the orbit between and one of the orbit beside it, in units of (α/α′) (s + 2) α.
///
/// `LiftOffMap` errs by at most 4 (1 + sudden lift-offs) · 2⁻⁵³ of its unit. On a lap a hop has at most one sudden
/// lift-off, and the unit is at most (s + 2) (α/α′) α; a test below checks both. ε = 2⁻⁵².
const TWO_HOP_ERRORS: f64 = 8.0 * f64::EPSILON;

/// A factor for the curvature of α′ = √(α′²), and for speeds within the error bound that exceed α. 1.17 would do
/// (README.md).
const CURVATURE: f64 = 1.25;

/// The largest error bound allowed, relative to α′; the proof of [`CURVATURE`] relies on it. Orbits that come near the
/// ground exceed it, because α/α′ is large there.
const LARGEST_ERROR: f64 = 0.1;

/// Rounds an `f64` up on its conversion to `f32`, whose half ulp is a relative 6 · 10⁻⁸.
const ROUND_UP: f64 = 1.000_001;

/// How far below zero α′² must lie so that all orbits between are grounded, in units of α times the propagated error.
/// The proof needs 2.1.
const GROUND_MARGIN: f64 = 4.0;

impl Itinerary {
    /// The itinerary of an orbit that has not hopped yet.
    pub(crate) const START: Itinerary = Itinerary { laps: 1, end: NO_END, error: 0.0 };

    /// The itinerary of an orbit that starts in trap n.
    pub(crate) fn in_trap(n: u32) -> Self {
        Itinerary { end: n, ..Itinerary::START }
    }

    /// Adds a hop from `alpha` to `next`, or to the ground if `next` is `None`.
    #[inline]
    pub(crate) fn hop(&mut self, alpha: f64, next: Option<f64>, laps: &Laps, map: &LiftOffMap) {
        if self.error == f32::INFINITY {
            return;
        }
        let error = f64::from(self.error);
        // After twelve laps the leading one is at bit 60, and no thirteenth lap fits. The itinerary is then given
        // up, and the raster follows the orbits beside this one. This is rare: an orbit of Fig. 6's window hops 3.9
        // times on the average.
        let room = self.laps >> (64 - ID_BITS) == 0;
        // LAP: all orbits between must be on one lap.
        let Some(lap) = laps.lap(alpha, error).filter(|_| room) else {
            return self.give_up();
        };
        self.laps = self.laps << ID_BITS | u64::from(lap.id);
        // BETWEEN: with g the error bound before the hop, 5/4 (α/α′) (s g + 8ε (s + 2) α) is one after it.
        let propagated = lap.slope * error + TWO_HOP_ERRORS * (lap.slope + 2.0) * alpha;
        match next {
            Some(next) => {
                let error = CURVATURE * (alpha / next) * propagated;
                self.error = if error < LARGEST_ERROR * next {
                    (ROUND_UP * error) as f32
                } else {
                    f32::INFINITY
                };
            }
            None => {
                self.end = GROUND;
                // GROUND: at the first hop the orbits between start between the two, and α′² is monotone: they are
                // grounded as well, and the verdicts of the map are certain. At later hops α′² must be negative by
                // more than the errors can change it.
                let margin = GROUND_MARGIN * alpha * propagated;
                if error > 0.0 && !map.hop(alpha).is_ok_and(|hop| hop.next_speed_squared < -margin)
                {
                    self.give_up();
                }
            }
        }
    }

    /// Marks the itinerary as unknown: it agrees with no other from now on.
    #[inline]
    pub(crate) fn give_up(&mut self) {
        self.error = f32::INFINITY;
    }

    /// Completes the itinerary of an orbit that has come to `alpha`, in an interval (`left`, `right`) all of whose
    /// orbits have the itinerary `known`.
    #[inline]
    pub(crate) fn end_in(&mut self, alpha: f64, known: &Itinerary, (left, right): (f64, f64)) {
        let error = f64::from(self.error);
        // The bits of the known laps, without their leading one.
        let bits = 63 - known.laps.leading_zeros();
        // The laps of both must fit below bit 63.
        let room = self.laps.leading_zeros() >= bits;
        self.end = known.end;
        self.laps = self.laps << bits | (known.laps ^ 1 << bits);
        // KNOWN: all speeds within the error bound must lie in the interval too.
        if !(room & (alpha - left > error) & (right - alpha > error)) {
            self.give_up();
        }
    }

    /// True if every orbit that starts between these two has their fate (README.md, the theorem).
    #[inline]
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        let both_known = self.error.max(other.error) < f32::INFINITY;
        both_known && self.laps == other.laps && self.end == other.end
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use passive_hopper::{MassRatio, alpha_star};

    /// Every orbit that starts between two with the same itinerary has that itinerary, and lies between them at every
    /// hop, up to the error bound.
    #[test]
    fn orbits_between_two_with_one_itinerary_stay_between() {
        let ratio = MassRatio::new(0.4).unwrap();
        let map = LiftOffMap::new(ratio);
        let laps = Laps::below(ratio, 25.0).unwrap().unwrap();
        let follow = |start: f64| {
            let (mut itinerary, mut orbit) = (Itinerary::START, vec![start]);
            for _ in 0..6 {
                let alpha = orbit[orbit.len() - 1];
                let next = map.image(alpha).unwrap();
                itinerary.hop(alpha, next, &laps, &map);
                match next {
                    Some(next) => orbit.push(next),
                    None => break,
                }
            }
            (itinerary, orbit)
        };
        let mut common = 0;
        for k in 0..3000u32 {
            let a = alpha_star(1) + 20.0 * (f64::from(k) * 0.618_033_988_75).fract();
            let b = a + 0.02 * (f64::from(k) * 0.754_877_666_25).fract();
            let ((first, from), (second, to)) = (follow(a), follow(b));
            if !first.agrees_with(&second) || from.len() != to.len() {
                continue;
            }
            common += 1;
            for part in [0.1, 0.5, 0.9] {
                let (between, orbit) = follow(a + part * (b - a));
                assert!(between.agrees_with(&first) || between.error == f32::INFINITY, "{a} {b}");
                assert_eq!(orbit.len(), from.len());
                for ((low, high), at) in from.iter().zip(&to).zip(orbit) {
                    let error = f64::from(first.error);
                    let (low, high) = (low.min(*high), low.max(*high));
                    assert!(at >= low - error && at <= high + error, "{a} {b}: {at}");
                }
            }
        }
        assert!(common > 300, "{common}");
    }

    /// The unit of the map's error, |α′| + |∂α′/∂α| α + |∂α′/∂M| M + α²/|α′|, is at most (s + 2) α²/α′ on every lap.
    #[test]
    fn the_error_of_a_hop_is_at_most_the_one_assumed() {
        let mut seen = 0;
        for k in 0..40_000u32 {
            let m = 0.001 + 0.999 * (f64::from(k) * 0.754_877_666_25).fract();
            let alpha = 0.1 + 33.0 * (f64::from(k) * 0.618_033_988_75).fract();
            let ratio = MassRatio::new(m).unwrap();
            let map = LiftOffMap::new(ratio);
            let Some(lap) = Laps::below(ratio, 34.0).unwrap().unwrap().lap(alpha, 0.0) else {
                continue;
            };
            let (Some(next), Some(slopes)) =
                (map.image(alpha).unwrap(), map.slopes(alpha).unwrap())
            else {
                continue;
            };
            assert!(map.hop(alpha).unwrap().sudden <= 1);
            let unit = next
                + slopes.by_speed.abs() * alpha
                + slopes.by_mass_ratio.abs() * m
                + alpha * (alpha / next);
            // The last digits are those of the computed slopes.
            let assumed = (lap.slope + 2.0) * alpha * (alpha / next) * (1.0 + 1e-9);
            assert!(unit <= assumed, "M = {m}, α = {alpha}: {unit} {assumed}");
            seen += 1;
        }
        assert!(seen > 20_000, "{seen}");
    }
}
