//! What two lift-off speeds have in common with all that lie between them.
//!
//! If the orbits of two speeds visit the same arcs on which the map is monotone and continuous, one after the other,
//! and then enter the same trap, or are grounded, so does every orbit that starts between them: it stays between
//! theirs. That is true of the orbits that `f64` computes as well if the two keep away from the ends of arcs and traps
//! by more than the errors handed on: from hop to hop a distance g becomes at most
//!
//! ```text
//!   (α/α′) (s g + 8ε (s + 2) α)          s = |α′ (dα′/dα)/α| at most, 8ε … twice the error of one hop
//! ```
//!
//! and a quarter more for the curvature of the root, while it is under a tenth of α′.

use crate::arcs::Arcs;
use passive_hopper::LiftOffMap;

/// An end that is none yet.
const ON_THE_WAY: u32 = u32::MAX - 1;

/// The ground.
const GROUND: u32 = u32::MAX - 2;

/// The arcs an orbit visits, and its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Itinerary {
    /// Five bits an arc, after a one.
    arcs: u64,
    /// The trap.
    end: u32,
    /// Distance within which computed orbits stay; infinite if nothing is sure.
    pad: f32,
}

impl Itinerary {
    /// Before the first hop.
    pub(crate) const START: Itinerary = Itinerary { arcs: 1, end: ON_THE_WAY, pad: 0.0 };

    /// Of what is in trap n already.
    pub(crate) fn in_trap(n: u32) -> Self {
        Itinerary { end: n, ..Itinerary::START }
    }

    /// Goes on with a hop from `alpha` to `next`, or to the ground.
    #[inline]
    pub(crate) fn hop(&mut self, alpha: f64, next: Option<f64>, arcs: &Arcs, map: &LiftOffMap) {
        if self.pad == f32::INFINITY {
            return;
        }
        let pad = f64::from(self.pad);
        let room = self.arcs >> 59 == 0;
        let Some(arc) = arcs.arc(alpha, pad).filter(|_| room) else {
            return self.give_up();
        };
        self.arcs = self.arcs << 5 | u64::from(arc.id);
        let handed_on = arc.slope * pad + 8.0 * f64::EPSILON * (arc.slope + 2.0) * alpha;
        match next {
            Some(next) => {
                let pad = 1.25 * (alpha / next) * handed_on;
                // Rounded up.
                self.pad = if pad < 0.1 * next { (1.000_001 * pad) as f32 } else { f32::INFINITY };
            }
            // All between are grounded if α′² < 0 by more than what the distance can change of it.
            None => {
                let margin = 4.0 * alpha * handed_on;
                self.end = GROUND;
                // A first hop starts between the two, and no verdict is in doubt.
                if pad > 0.0 && !map.hop(alpha).is_ok_and(|hop| hop.next_speed_squared < -margin) {
                    self.give_up();
                }
            }
        }
    }

    /// Nothing is sure any more.
    #[inline]
    pub(crate) fn give_up(&mut self) {
        self.pad = f32::INFINITY;
    }

    /// Comes to `alpha` in an interval of known fate, and goes on as all do from there.
    #[inline]
    pub(crate) fn end_in(&mut self, alpha: f64, known: &Itinerary, (left, right): (f64, f64)) {
        let pad = f64::from(self.pad);
        let follow = 63 - known.arcs.leading_zeros();
        let room = self.arcs.leading_zeros() >= follow;
        self.end = known.end;
        self.arcs = self.arcs << follow | (known.arcs ^ 1 << follow);
        if !(room & (alpha - left > pad) & (right - alpha > pad)) {
            self.give_up();
        }
    }

    /// Whether what lies between ends as the two do.
    #[inline]
    pub(crate) fn leads_as(&self, other: &Self) -> bool {
        let sure = self.pad.max(other.pad) < f32::INFINITY;
        sure && self.arcs == other.arcs && self.end == other.end
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use passive_hopper::{MassRatio, alpha_star};

    /// Between two speeds with the same itinerary all have it, and hop by hop lie between.
    #[test]
    fn what_lies_between_stays_between() {
        let ratio = MassRatio::new(0.4).unwrap();
        let map = LiftOffMap::new(ratio);
        let arcs = Arcs::below(ratio, 25.0).unwrap().unwrap();
        let follow = |start: f64| {
            let (mut itinerary, mut orbit) = (Itinerary::START, vec![start]);
            for _ in 0..6 {
                let alpha = orbit[orbit.len() - 1];
                let next = map.image(alpha).unwrap();
                itinerary.hop(alpha, next, &arcs, &map);
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
            if !first.leads_as(&second) || from.len() != to.len() {
                continue;
            }
            common += 1;
            for part in [0.1, 0.5, 0.9] {
                let (between, orbit) = follow(a + part * (b - a));
                assert!(between.leads_as(&first) || between.pad == f32::INFINITY, "{a} {b}");
                assert_eq!(orbit.len(), from.len());
                for ((low, high), at) in from.iter().zip(&to).zip(orbit) {
                    let (low, high, pad) = (low.min(*high), low.max(*high), f64::from(first.pad));
                    assert!(at >= low - pad && at <= high + pad, "{a} {b}: {at}");
                }
            }
        }
        assert!(common > 300, "{common}");
    }
}
