//! What two lift-off speeds have in common with all that lie between them.
//!
//! If the orbits of two speeds visit the same arcs on which the map is monotone and continuous, one after the other,
//! and then enter the same interval of known fate, a trap to begin with, so does every orbit that starts between them: it stays between theirs. That is true
//! of the orbits that `f64` computes as well if the two keep away from the ends of arcs and intervals by more than the
//! errors handed on: from hop to hop a distance g becomes at most
//!
//! ```text
//!   (α/α′) (s g + 8ε (s + 2) α)          s = |α′ (dα′/dα)/α| at most, 8ε … twice the error of one hop
//! ```
//!
//! and a quarter more for the curvature of the root, while it is under a tenth of α′.

use crate::arcs::Arcs;
use crate::orbits::Known;
use passive_hopper::LiftOffMap;

/// Hops that an itinerary can hold.
const LONGEST: u32 = 12;

/// The arcs an orbit visits, as far as it has gone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Itinerary {
    /// Five bits an arc.
    arcs: u64,
    hops: u32,
    /// The interval of known fate that it ends in; none for the ground.
    end: u32,
    /// Whether it has come to its end.
    pub(crate) ended: bool,
    /// Whether it keeps away from all ends.
    pub(crate) sure: bool,
    /// Distance within which computed orbits stay.
    pad: f64,
}

impl Itinerary {
    /// Before the first hop.
    pub(crate) const START: Itinerary =
        Itinerary { arcs: 0, hops: 0, end: u32::MAX, ended: false, sure: true, pad: 0.0 };

    /// Goes on with a hop from `alpha` to `next`, or to the ground.
    #[inline]
    pub(crate) fn hop(&mut self, alpha: f64, next: Option<f64>, arcs: &Arcs, map: &LiftOffMap) {
        if !self.sure {
            return;
        }
        let Some(arc) = arcs.arc(alpha, self.pad).filter(|_| self.hops < LONGEST) else {
            self.sure = false;
            return;
        };
        self.arcs = self.arcs << 5 | u64::from(arc.id);
        self.hops += 1;
        let handed_on = arc.slope * self.pad + 8.0 * f64::EPSILON * (arc.slope + 2.0) * alpha;
        match next {
            Some(next) => {
                self.pad = 1.25 * (alpha / next) * handed_on;
                self.sure = self.pad < 0.1 * next;
            }
            // All between are grounded if α′² < 0 by more than what the distance can change of it.
            None => {
                let margin = 4.0 * alpha * handed_on;
                self.sure = map.hop(alpha).is_ok_and(|hop| hop.radicand < -margin);
            }
        }
    }

    /// Ends in an interval of known fate.
    #[inline]
    pub(crate) fn ends_in(&mut self, alpha: f64, known: &Known) {
        let (left, right) = known.between;
        self.end = known.id;
        self.sure &= alpha - left > self.pad && right - alpha > self.pad;
    }

    /// Whether what lies between ends as the two do.
    #[inline]
    pub(crate) fn leads_as(&self, other: &Self) -> bool {
        let same = self.hops == other.hops && self.arcs == other.arcs && self.end == other.end;
        same && self.sure && other.sure
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
            let a = alpha_star(1).high + 20.0 * (f64::from(k) * 0.618_033_988_75).fract();
            let b = a + 0.02 * (f64::from(k) * 0.754_877_666_25).fract();
            let ((first, from), (second, to)) = (follow(a), follow(b));
            if !first.leads_as(&second) || from.len() != to.len() {
                continue;
            }
            common += 1;
            for part in [0.1, 0.5, 0.9] {
                let (between, orbit) = follow(a + part * (b - a));
                assert!(between.leads_as(&first) || !between.sure, "{a} {b}");
                assert_eq!(orbit.len(), from.len());
                for ((low, high), at) in from.iter().zip(&to).zip(orbit) {
                    let (low, high) = (low.min(*high), low.max(*high));
                    assert!(at >= low - first.pad && at <= high + first.pad, "{a} {b}: {at}");
                }
            }
        }
        assert!(common > 300, "{common}");
    }
}
