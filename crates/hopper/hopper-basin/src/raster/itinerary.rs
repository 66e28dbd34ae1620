//! Itineraries: the laps that an orbit visits, and its end.
//!
//! If the exact orbits of two speeds have the same itinerary, every exact orbit that starts between them has their fate
//! (docs/theory.md, Theorem 52). README.md has the proof; its invariants are cited here by name.

use crate::raster::laps::ID_BITS;

/// The end of an itinerary that is not complete. Indices of traps are smaller than this and [`GROUND`].
const NO_END: u32 = u32::MAX - 1;

/// The end of an itinerary that ends on the ground.
const GROUND: u32 = u32::MAX - 2;

/// The laps an exact orbit visits, and its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Itinerary {
    /// A leading one bit, then for each hop a zero bit if it was on the lap of the hop before, else a one bit and
    /// the number of the lap, [`ID_BITS`] bits. 64 bits hold ten different laps, or more hops on fewer. [`NO_LAPS`]
    /// if a hop was on no lap, or if the fate was computed alone: the itinerary then agrees with no other.
    laps: u64,
    /// The lap of the last hop; [`NO_LAP`] if the next hop must give its number.
    last: u8,
    /// The index of the trap, [`GROUND`] or [`NO_END`].
    end: u32,
    /// The hops left of a fixed point that the orbit jumped over: n and their number; 0 if there were none.
    slow: u64,
}

/// The bits of the number of hops in [`Itinerary::slow`], with n above them.
const SLOW_BITS: u32 = 53;

/// The value of [`Itinerary::laps`] of an orbit that has left the laps.
const NO_LAPS: u64 = 0;

/// No number of a lap.
const NO_LAP: u8 = u8::MAX;

impl Itinerary {
    /// The itinerary of an orbit that has not hopped yet.
    pub(crate) const START: Itinerary = Itinerary { laps: 1, last: NO_LAP, end: NO_END, slow: 0 };

    /// The itinerary of an orbit that starts in trap n.
    pub(crate) fn in_trap(n: u32) -> Self {
        Itinerary { end: n, ..Itinerary::START }
    }

    /// Adds a hop of an orbit that is on `lap`.
    #[inline]
    pub(crate) fn hop(&mut self, lap: Option<u8>) {
        // If the bits are used up, the laps are unknown, and the raster follows the orbits beside this one. This is
        // rare: an orbit of Fig. 6's window hops 3.9 times on the average.
        let room = self.laps.leading_zeros();
        // LAP: the exact speed must be on one lap.
        self.laps = match lap {
            Some(lap) if lap == self.last && room >= 1 && self.is_known() => self.laps << 1,
            Some(lap) if room > ID_BITS && self.is_known() => {
                self.last = lap;
                self.laps << (ID_BITS + 1) | 1 << ID_BITS | u64::from(lap)
            }
            _ => NO_LAPS,
        };
    }

    /// Completes the itinerary of an orbit that is grounded.
    #[inline]
    pub(crate) fn end_on_ground(&mut self) {
        self.end = GROUND;
    }

    /// Adds a jump over `hops` hops left of α*_n. All of them are on one lap, the last one that the orbit was on or
    /// the next lower one. Laps only descend, so that the place of the jump among them need not be known. An
    /// itinerary has room for one jump.
    pub(crate) fn jump(&mut self, n: u64, hops: u64) {
        if self.slow != 0 || n >> (64 - SLOW_BITS) != 0 || hops >> SLOW_BITS != 0 {
            self.give_up();
        } else {
            self.slow = n << SLOW_BITS | hops;
        }
    }

    /// The itinerary without its first `hops` hops, if these and the hop after them are on one lap.
    pub(crate) fn after(&self, hops: u32) -> Option<Self> {
        if !self.is_known() {
            return None;
        }
        let below_first = (63 - self.laps.leading_zeros()).checked_sub(ID_BITS + 1)?;
        let rest = self.laps & ((1 << below_first) - 1);
        // The zeros after the first lap's number are the hops that stay on it.
        let zeros = below_first - (64 - rest.leading_zeros());
        let first = self.laps >> below_first;
        (hops <= zeros).then(|| Itinerary { laps: first << (below_first - hops) | rest, ..*self })
    }

    /// True if the itinerary can agree with another.
    #[inline]
    fn is_known(&self) -> bool {
        self.laps != NO_LAPS
    }

    /// Marks the itinerary as unknown: it agrees with no other from now on.
    #[inline]
    pub(crate) fn give_up(&mut self) {
        self.laps = NO_LAPS;
    }

    /// Completes the itinerary of an orbit that has reached an interval whose orbits all have the itinerary `known`.
    #[inline]
    pub(crate) fn end_in(&mut self, known: &Itinerary) {
        if !known.is_known() {
            return self.give_up();
        }
        // The bits of the known laps, without their leading one.
        let mut bits = 63 - known.laps.leading_zeros();
        let mut laps = known.laps ^ 1 << bits;
        // They begin with a one bit and the number of a lap. If this orbit is on that lap, it goes on with a zero
        // bit: the same hops have the same form, wherever the known laps begin.
        if let Some(below) = bits.checked_sub(ID_BITS + 1)
            && laps >> below == 1 << ID_BITS | u64::from(self.last)
        {
            (bits, laps) = (below + 1, laps & ((1 << below) - 1));
        }
        // The laps of both must fit below bit 63.
        let one_jump = (self.slow == 0) | (known.slow == 0);
        let room = (self.laps.leading_zeros() >= bits) & (self.laps != NO_LAPS) & one_jump;
        self.slow |= known.slow;
        self.end = known.end;
        self.last = known.last;
        self.laps = if room { self.laps << bits | laps } else { NO_LAPS };
    }

    /// True if every orbit that starts between these two has their fate (README.md, the theorem).
    #[inline]
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        self.laps == other.laps
            && self.laps != NO_LAPS
            && self.end == other.end
            && self.slow == other.slow
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::laps::Laps;
    use passive_hopper::{HopWithin, LiftOffMap, MassRatio, alpha_star};

    /// Every orbit that starts between two with the same itinerary has that itinerary, and lies between them at every
    /// hop, up to the error bound.
    #[test]
    fn orbits_between_two_with_one_itinerary_stay_between() {
        let ratio = MassRatio::new(0.4).unwrap();
        let map = LiftOffMap::new(ratio);
        let laps = Laps::below(ratio, 25.0).unwrap().unwrap();
        let follow = |start: f64| {
            let (mut itinerary, mut orbit) = (Itinerary::START, vec![(start, 0.0)]);
            for _ in 0..6 {
                let (alpha, error) = orbit[orbit.len() - 1];
                itinerary.hop(laps.lap(alpha, error));
                match map.hop_within(alpha, error) {
                    HopWithin::Next { speed, error } => orbit.push((speed, error)),
                    HopWithin::Grounded => {
                        itinerary.end_on_ground();
                        break;
                    }
                    HopWithin::Inconclusive => {
                        itinerary.give_up();
                        break;
                    }
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
                assert!(between.agrees_with(&first) || between.laps == NO_LAPS, "{a} {b}");
                // An orbit whose error grows too large is followed no further.
                assert!(orbit.len() == from.len() || between.laps == NO_LAPS, "{a} {b}");
                for ((low, high), at) in from.iter().zip(&to).zip(orbit) {
                    let error = low.1.max(high.1) + at.1;
                    let (low, high) = (low.0.min(high.0), low.0.max(high.0));
                    assert!(at.0 >= low - error && at.0 <= high + error, "{a} {b}: {at:?}");
                }
            }
        }
        assert!(common > 300, "{common}");
    }

    /// The itinerary of an orbit has one form: however it is put together, and whether its first hops are cut off
    /// or were not made.
    #[test]
    fn parts_of_an_orbit_have_the_itinerary_of_the_whole() {
        let ratio = MassRatio::new(0.4).unwrap();
        let map = LiftOffMap::new(ratio);
        let laps = Laps::below(ratio, 25.0).unwrap().unwrap();
        let along = |orbit: &[f64]| {
            let mut itinerary = Itinerary::START;
            orbit.iter().for_each(|&alpha| itinerary.hop(laps.lap(alpha, 0.0)));
            itinerary
        };
        let (mut joined, mut cut) = (0, 0);
        for k in 0..2000u32 {
            let start = 25.0 * (f64::from(k) * 0.618_033_988_75).fract() + 0.1;
            let next = |alpha: &f64| map.image(*alpha).unwrap();
            let orbit: Vec<f64> = std::iter::successors(Some(start), next).take(8).collect();
            let whole = along(&orbit);
            for at in 1..orbit.len() {
                let rest = along(&orbit[at..]);
                let mut parts = along(&orbit[..at]);
                parts.end_in(&rest);
                assert!(parts.agrees_with(&whole) || !whole.is_known(), "{orbit:?}");
                joined += 1;
                if let Some(found) = whole.after(at as u32) {
                    assert!(found.agrees_with(&rest), "{orbit:?} after {at}");
                    cut += 1;
                }
            }
        }
        assert!(joined > 5000 && cut > 500, "{joined} {cut}");
    }
}
