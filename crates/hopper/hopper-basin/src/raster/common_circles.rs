//! Circles of fates for all mass ratios of a narrow raster at once.
//!
//! Next to an edge every column needs the circle of the same fixed point, at nearly the same mass ratio. Here an
//! orbit is followed for all mass ratios at once, with a bound on how far apart they are. Two offsets whose orbits
//! agree for all mass ratios bound an arc of every column's circle.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use crate::raster::arcs::Arcs;
use crate::raster::itinerary::Itinerary;
use crate::raster::known_intervals::KnownFate;
use crate::raster::laps::{HUMPS_WITH_LAPS, Laps};
use crate::raster::rising_windows::trap_with_window;
use crate::raster::speed_within::{is_inside, speed_at};
use crate::traps::trap_index::{Lookup, TrapIndex};
use passive_hopper::{HopWithin, MassRatio};
use std::collections::VecDeque;
use std::sync::OnceLock;

/// The largest width in M, as a part of M. The orbits from one offset end some 10 to 100 times as far apart as
/// their mass ratios, and the ends of the arcs are open that far. It affects the time only, as do the next
/// constants.
const WIDEST: f64 = 2e-3;

/// The first offsets on a turn, and the parts of it up to which a gap is halved: between two orbits that are known
/// for all mass ratios, and beside one that is not.
const FIRST: u32 = 16;
const FINEST: f64 = 1.0 / 8192.0;
const FINEST_BESIDE_UNKNOWN: f64 = 1.0 / 512.0;

/// Most offsets on a turn. Each takes some 10 to 50 µs.
const MOST: usize = 2000;

/// Most hops of an orbit after its slow hops: those of a phase, and some dozen beside a lower fixed point.
const MOST_HOPS: usize = 256;

/// Most hops along the slow side from the turn of jumps.
const MOST_SLOW_HOPS: usize = 256;

/// The turn of every mass ratio lies in the common turn with this margin, as a part of it.
const MARGIN: f64 = 0.02;

/// The outer end of the outermost turn, as a part of the range of slow hops. From there one or two hops lead out.
const OUTERMOST: f64 = 0.7;

/// Halvings of an interval to the last bit.
const HALVINGS: usize = 64;

/// What is needed to follow orbits at one mass ratio.
struct End {
    fates: Fates,
    traps: TrapIndex,
    laps: Laps,
}

/// The circles of α*_1, α*_2, … for all mass ratios of a range, each computed at its first use.
pub(crate) struct CommonCircles {
    middle: Fates,
    /// At the first and the last mass ratio.
    ends: [End; 2],
    circles: [OnceLock<Arcs>; HUMPS_WITH_LAPS as usize + 1],
}

/// The orbits from an offset left of a fixed point at all mass ratios.
struct Orbit {
    offset: f64,
    /// The offsets after each hop along the slow side, from the first one on, with bounds on their errors.
    walk: Vec<(f64, f64)>,
    /// Their fate; `None` if they differ, or are not known.
    known: Option<KnownFate>,
}

impl CommonCircles {
    /// The circles for the mass ratios from `first` to `last` and speeds up to `largest`; `None` for a range that
    /// is too wide, for one mass ratio alone, and where there are no laps.
    pub(crate) fn new(first: f64, last: f64, largest: f64) -> Result<Option<Self>, Error> {
        if !(last > first && last - first <= WIDEST * first) {
            return Ok(None);
        }
        let end = |m: f64| {
            let fates = Fates::new(MassRatio::new(m)?)?;
            let traps = TrapIndex::new(largest, |n| trap_with_window(&fates, n))?;
            let laps = Laps::below(fates.map().mass_ratio(), largest)?;
            Ok::<_, Error>(laps.map(|laps| End { fates, traps, laps }))
        };
        let (Some(lower), Some(upper)) = (end(first)?, end(last)?) else { return Ok(None) };
        let middle = Fates::new(MassRatio::new(first.midpoint(last))?)?;
        let circles = [const { OnceLock::new() }; HUMPS_WITH_LAPS as usize + 1];
        Ok(Some(CommonCircles { middle, ends: [lower, upper], circles }))
    }

    /// The circle left of α*_n, on all turns from that of the jumps outwards; `None` where orbits from one offset
    /// lie too far apart.
    pub(crate) fn circle(&self, n: u64) -> Option<&Arcs> {
        let slot = self.circles.get(usize::try_from(n).ok()?)?;
        let arcs = slot.get_or_init(|| self.new_circle(n).unwrap_or_default());
        (!arcs.is_empty()).then_some(arcs)
    }

    fn new_circle(&self, n: u64) -> Option<Arcs> {
        let none = Arcs::default();
        let mut points = self.turn(n, self.outermost_turn(n)?, &none)?;
        let outermost = Arcs::from_points(points.clone());
        if let Some(inner) = self.turn_of_jumps(n) {
            points.extend(self.turn(n, inner, &outermost).unwrap_or_default());
        }
        Some(Arcs::from_points(points))
    }

    /// Follows orbits from the offsets of a turn, outwards to `known` arcs, and halves the gaps between those that
    /// do not agree. Gives the points of all known orbits.
    fn turn(
        &self,
        n: u64,
        (outer, inner): (f64, f64),
        known: &Arcs,
    ) -> Option<Vec<((f64, f64), KnownFate)>> {
        let width = inner - outer;
        let at = |part: f64| self.follow(n, outer + part * width, known);
        let mut orbits: Vec<Orbit> =
            (0..=FIRST).map(|k| at(f64::from(k) / f64::from(FIRST))).collect();
        // The range is too wide, and halving would not help.
        if orbits.iter().filter(|orbit| orbit.known.is_some()).count() < orbits.len() / 2 {
            return None;
        }
        let mut gaps: VecDeque<(usize, usize)> = (1..orbits.len()).map(|k| (k - 1, k)).collect();
        while let Some((left, right)) = gaps.pop_front() {
            let (from, to) = (&orbits[left], &orbits[right]);
            let finest = match (from.known, to.known) {
                (Some(a), Some(b)) if a.itinerary.agrees_with(&b.itinerary) => continue,
                (Some(_), Some(_)) => FINEST,
                (None, None) => continue,
                _ => FINEST_BESIDE_UNKNOWN,
            };
            if to.offset - from.offset <= finest * width || orbits.len() >= MOST {
                continue;
            }
            let middle = self.follow(n, from.offset.midpoint(to.offset), known);
            gaps.extend([(left, orbits.len()), (orbits.len(), right)]);
            orbits.push(middle);
        }
        Some(orbits.iter().flat_map(Orbit::points).collect())
    }

    /// Offsets between which all mass ratios have their turn of jumps left of α*_n.
    fn turn_of_jumps(&self, n: u64) -> Option<(f64, f64)> {
        let (mut outer, mut inner) = (f64::INFINITY, f64::NEG_INFINITY);
        for end in &self.ends {
            let sides = end.fates.slow_sides();
            let first = sides.turn(n)?;
            outer = outer.min(sides.offset(n, first)?.0);
            inner = inner.max(sides.offset(n, first + 1.0)?.0);
        }
        let margin = MARGIN * (inner - outer);
        Some((outer - margin, inner + margin))
    }

    /// Offsets between which all mass ratios have a turn from which orbits leave α*_n.
    fn outermost_turn(&self, n: u64) -> Option<(f64, f64)> {
        let sides = self.middle.slow_sides();
        let outer = -OUTERMOST * sides.walk_range(n)?;
        // The offset that hops to the outer end.
        let (mut left, mut right) = (outer, 0.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (left + right);
            if sides.walk(n, (middle, 0.0))?.0 < outer {
                left = middle;
            } else {
                right = middle;
            }
        }
        let margin = MARGIN * (right - outer);
        Some((outer - margin, right + margin))
    }

    /// Follows the orbits from an offset left of α*_n at all mass ratios, up to `known` arcs.
    fn follow(&self, n: u64, offset: f64, known: &Arcs) -> Orbit {
        let (mut walk, mut itinerary, mut at) = (Vec::new(), Itinerary::START, (offset, 0.0));
        while let Some(next) = self.walk(n, at)
            && walk.len() < MOST_SLOW_HOPS
        {
            itinerary.hop(self.lap(speed_at(n, at)));
            walk.push(next);
            at = next;
            if let Some(known) = known.known(at.0, at.1) {
                itinerary.end_in(&known.itinerary);
                return Orbit { offset, walk, known: Some(KnownFate { itinerary, ..known }) };
            }
        }
        let known = self.follow_from(speed_at(n, at), itinerary);
        Orbit { offset, walk, known }
    }

    /// The offset after a hop left of α*_n, and a bound on its error at all mass ratios; `None` where an orbit
    /// leaves. α′ rises with the offset, and falls with κ (docs/theory.md, Theorem 81 and Corollary 93).
    fn walk(&self, n: u64, (offset, error): (f64, f64)) -> Option<(f64, f64)> {
        let [first, last] = self.ends.each_ref().map(|end| end.fates.slow_sides());
        let (least, below) = last.walk(n, (offset - error, 0.0))?;
        let (most, above) = first.walk(n, (offset + error, 0.0))?;
        let (least, most) = (least - below, most + above);
        // The roundings of both ends and of the start.
        let rounding = 4.0 * f64::EPSILON * least.abs();
        Some((least.midpoint(most), 0.5 * (most - least) + rounding))
    }

    fn masses(&self) -> (MassRatio, MassRatio) {
        let [first, last] = self.ends.each_ref().map(|end| end.fates.map().mass_ratio());
        (first, last)
    }

    /// The lap that contains all speeds within `error` of `speed` at all mass ratios. The ends of laps move in one
    /// direction with M.
    fn lap(&self, (speed, error): (f64, f64)) -> Option<u8> {
        let [lower, upper] = self.ends.each_ref().map(|end| end.laps.lap(speed, error));
        if lower == upper { lower } else { None }
    }

    /// The fate at all mass ratios and all speeds within an error; `None` if they differ, or are not known.
    fn follow_from(
        &self,
        (mut speed, mut error): (f64, f64),
        mut itinerary: Itinerary,
    ) -> Option<KnownFate> {
        for _ in 0..MOST_HOPS {
            if let Some(trap) = self.trap(speed, error) {
                itinerary.end_in(&Itinerary::in_trap(trap));
                return Some(KnownFate {
                    itinerary,
                    label: HopperFate::label_of_fixed_point(trap.into()),
                });
            }
            itinerary.hop(self.lap((speed, error)));
            match self.middle.map().hop_within_masses(speed, error, self.masses()) {
                HopWithin::Next { speed: next, error: bound } => (speed, error) = (next, bound),
                HopWithin::Grounded => {
                    itinerary.end_on_ground();
                    return Some(KnownFate { itinerary, label: HopperFate::GROUNDED });
                }
                HopWithin::Inconclusive => return None,
            }
        }
        None
    }

    /// The trap that contains all speeds within `error` of `speed` at all mass ratios. On the humps α′ falls with
    /// μ, so that the trap of the largest μ is the shortest one, and μ rises with M where there are laps.
    fn trap(&self, speed: f64, error: f64) -> Option<u32> {
        let of = |end: &End| match end.traps.find(speed) {
            Lookup::Trap(n, ends) if is_inside(speed, error, ends) => Some(n),
            _ => None,
        };
        let [lower, upper] = self.ends.each_ref().map(of);
        if lower == upper { lower } else { None }
    }
}

impl Orbit {
    /// Its points on the slow side, with what is known from there on.
    fn points(&self) -> impl Iterator<Item = ((f64, f64), KnownFate)> {
        let known = self.known.into_iter();
        let later = |known: KnownFate| {
            (1..).zip(&self.walk).map_while(move |(hops, &at)| {
                Some((at, KnownFate { itinerary: known.itinerary.after(hops)?, ..known }))
            })
        };
        known
            .flat_map(move |known| std::iter::once(((self.offset, 0.0), known)).chain(later(known)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::arcs::Arc;
    use basin_of_attraction::SplitMix64;
    use passive_hopper::alpha_star;

    /// Where a circle of many mass ratios is known, each of them has this fate; a narrow range leaves little open.
    #[test]
    fn a_common_arc_has_the_fate_of_each_mass_ratio() {
        for (n, m, width, open) in
            [(2, 0.2, 1e-6, 0.02), (3, 0.2, 1e-8, 0.02), (2, 0.12, 1e-5, 0.3), (1, 0.8, 1e-4, 0.1)]
        {
            let common = CommonCircles::new(m, m + width, alpha_star(n)).unwrap().unwrap();
            let arcs = common.circle(n).unwrap();
            let (turn, random) = (common.turn_of_jumps(n).unwrap(), SplitMix64::from_seed(n));
            let outermost = common.outermost_turn(n).unwrap();
            let (mut known, mut unknown) = (0, 0);
            for k in 0..300 {
                let (left, right) = if k % 2 == 0 { turn } else { outermost };
                let offset = left + (right - left) * random.uniform(2 * k);
                let fates =
                    Fates::new(MassRatio::new(m + width * random.uniform(2 * k + 1)).unwrap());
                let fate = fates.unwrap().fate(alpha_star(n) + offset).unwrap();
                match arcs.find(offset, 1e-15) {
                    Arc::Known(found) => {
                        assert_eq!(found.label, fate.label(), "{n} {m} {offset:e}");
                        known += 1;
                    }
                    Arc::Open(..) | Arc::Outside => unknown += 1,
                }
            }
            assert!(f64::from(unknown) < open * f64::from(known), "{n} {m}: {unknown} {known}");
        }
    }

    #[test]
    fn wide_and_empty_ranges_have_no_common_circles() {
        for (first, last) in
            [(0.2, 0.2), (0.2, 0.21), (0.3, 0.2), (2.0, 2.000_001), (0.2, f64::NAN)]
        {
            assert!(CommonCircles::new(first, last, 20.0).unwrap().is_none(), "{first} {last}");
        }
    }
}
