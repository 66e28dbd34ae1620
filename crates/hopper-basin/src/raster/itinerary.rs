//! Itineraries: the laps that an orbit visits, and its end.
//!
//! If the exact orbits of two speeds have the same itinerary, every exact orbit that starts between them has their fate
//! (docs/theory.md, Theorem 52). An itinerary carries a bound on the distance between the computed and the exact orbit, so
//! that it is the itinerary of the exact orbit. README.md has the proof; its invariants are cited here by name.

use crate::raster::laps::{ID_BITS, Laps};
use passive_hopper::{HopWithin, LiftOffMap};

/// The end of an itinerary that is not complete. Indices of traps are smaller than this and [`GROUND`].
const NO_END: u32 = u32::MAX - 1;

/// The end of an itinerary that ends on the ground.
const GROUND: u32 = u32::MAX - 2;

/// The laps an exact orbit visits, its end, and a bound on the error of the computed orbit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Itinerary {
    /// A leading one bit, then the numbers of the laps, [`ID_BITS`] bits each. 64 bits hold twelve laps. [`NO_LAPS`] if a
    /// hop was on no lap: the itinerary then agrees with no other.
    laps: u64,
    /// The index of the trap, [`GROUND`] or [`NO_END`].
    end: u32,
    /// The bound of invariant ERROR: how far the exact orbit may lie from the computed one. Infinite if no bound is known, or
    /// if the bound reaches a verdict: the fate of the orbit is then computed alone.
    ///
    /// An `f32`, rounded up: the itinerary then has 16 bytes.
    error: f32,
}

/// Bound on the error of α′², in units of (s + 2) α².
///
/// The error of α′ that `LiftOffMap` states is at most 4 (1 + sudden lift-offs) · 2⁻⁵³ of its unit. On a lap a hop has at
/// most one sudden lift-off, and the unit is at most (s + 2) (α/α′) α; a test below checks both. With ε = 2⁻⁵² the error of
/// α′² = α̂′² is then at most 2α′ · 4ε (s + 2) α²/α′.
const HOP_ERROR: f64 = 8.0 * f64::EPSILON;

/// The value of [`Itinerary::laps`] of an orbit that has left the laps.
const NO_LAPS: u64 = 0;

/// A factor for the curvature of α′ = √(α′²), and for speeds within the error bound that exceed α. 1.11 would suffice
/// (README.md, ERROR).
const CURVATURE: f64 = 1.25;

/// The largest error bound allowed, relative to α′; the proof of [`CURVATURE`] relies on it. Orbits that come near the
/// ground exceed it, because α/α′ is large there.
const LARGEST_ERROR: f64 = 0.1;

/// Rounds an `f64` up on its conversion to `f32`, whose half ulp is a relative 6 · 10⁻⁸.
const ROUND_UP: f64 = 1.000_001;

/// How far below zero the computed α′² must lie so that the exact orbit is grounded, in units of α times the propagated
/// error. The proof needs 2.1.
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
        // LAP: the exact speed must be on one lap.
        let Some(lap) = laps.lap(alpha, error) else {
            return self.hop_off_laps(alpha, next, map);
        };
        // After twelve laps the leading one is at bit 60, and no thirteenth lap fits. The laps are then unknown, and the
        // raster follows the orbits beside this one. This is rare: an orbit of Fig. 6's window hops 3.9 times on the
        // average.
        let room = self.laps >> (64 - ID_BITS) == 0 && self.laps != NO_LAPS;
        self.laps = if room { self.laps << ID_BITS | u64::from(lap.id) } else { NO_LAPS };
        // ERROR: if g bounds the error before the hop, 5/4 (α/α′) (s g + 8ε (s + 2) α) bounds it after the hop.
        let propagated = lap.slope * error + HOP_ERROR * (lap.slope + 2.0) * alpha;
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
                // GROUND: the first hop starts at exactly this speed, and the map decides it with certainty. At later
                // hops α′² must be negative by more than the errors can change it.
                let margin = GROUND_MARGIN * alpha * propagated;
                if error > 0.0 && !map.hop(alpha).is_ok_and(|hop| hop.next_speed_squared < -margin)
                {
                    self.give_up();
                }
            }
        }
    }

    /// Adds a hop that starts next to the end of a lap, or on no lap: its error is bounded by the map.
    #[cold]
    fn hop_off_laps(&mut self, alpha: f64, next: Option<f64>, map: &LiftOffMap) {
        self.laps = NO_LAPS;
        match (map.hop_within(alpha, f64::from(self.error)), next) {
            (HopWithin::Next { speed, error }, Some(next)) => {
                // `next` and `speed` are the same hop, perhaps by another solver.
                self.error = (ROUND_UP * (error + (next - speed).abs())) as f32;
            }
            (HopWithin::Grounded, None) => self.end = GROUND,
            _ => self.give_up(),
        }
    }

    /// Whether the exact orbit has the fate of the computed orbit.
    #[inline]
    pub(crate) fn is_certain(&self) -> bool {
        self.error < f32::INFINITY
    }

    /// Marks the itinerary as unknown: it agrees with no other from now on.
    #[inline]
    pub(crate) fn give_up(&mut self) {
        self.error = f32::INFINITY;
    }

    /// Completes the itinerary of an orbit that has reached `alpha` in the interval (`left`, `right`). All orbits from
    /// this interval have the itinerary `known`.
    #[inline]
    pub(crate) fn end_in(&mut self, alpha: f64, known: &Itinerary, (left, right): (f64, f64)) {
        let error = f64::from(self.error);
        // The bits of the known laps, without their leading one. Known intervals have laps.
        let bits = 63 - known.laps.leading_zeros();
        // The laps of both must fit below bit 63.
        let room = (self.laps.leading_zeros() >= bits) & (self.laps != NO_LAPS);
        self.end = known.end;
        self.laps = if room { self.laps << bits | (known.laps ^ 1 << bits) } else { NO_LAPS };
        // KNOWN: the exact speed must lie in the interval too. The differences are rounded; the factor covers it. An orbit
        // that has not hopped is exact.
        let error = ROUND_UP * error;
        let inside = (alpha - left > error) & (right - alpha > error);
        if !(inside | ((error == 0.0) & (alpha >= left) & (alpha <= right))) {
            self.give_up();
        }
    }

    /// True if every orbit that starts between these two has their fate (README.md, the theorem).
    #[inline]
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        let both_known = self.error.max(other.error) < f32::INFINITY;
        both_known && self.laps == other.laps && self.laps != NO_LAPS && self.end == other.end
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
            // In units of 2⁻⁵³.
            let unit = slopes.error_unit(alpha, m, next) / (0.5 * f64::EPSILON);
            // The last digits are those of the computed slopes.
            let assumed = (lap.slope + 2.0) * alpha * (alpha / next) * (1.0 + 1e-9);
            assert!(unit <= assumed, "M = {m}, α = {alpha}: {unit} {assumed}");
            seen += 1;
        }
        assert!(seen > 20_000, "{seen}");
    }
}
