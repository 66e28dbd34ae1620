//! What a strip does with orbits on the slow side of a fixed point: they jump, and the circle of fates decides.

use crate::fates::beside_edge::BesideEdge;
use crate::fates::hopper_fate::HopperFate;
use crate::fates::slow_sides::SlowZone;
use crate::raster::arcs::Arc;
use crate::raster::column::Column;
use crate::raster::itinerary::Itinerary;
use crate::raster::known_intervals::{KnownFate, NO_INTERVAL};
use crate::raster::strip::{Strip, is_inside};
use crate::traps::trap::TrapSide;
use hopper_asymptotics::{HopCount, SlowJump};
use passive_hopper::{FixedPointSpeed, HopWithin, LiftOffMap, alpha_star};

/// The error of a phase above which a reference orbit in 106 bits is made for the starts beside it. A reference takes about a
/// tenth of a millisecond; a fate alone, where an error reaches a boundary, takes some tenths. It affects the time only.
const LARGEST_ERROR: f64 = 1e-4;

/// The first phases that are followed on a circle, beyond both ends of a turn by the largest error of a phase. It affects the
/// time only.
const FIRST_PHASES: u32 = 16;
const BEYOND: f64 = 0.011;

/// The speeds of a column over the number of orbits that come to a slow side, too far for a jump, before its series is made. Next to
/// an edge most orbits come there; in a whole window some do, for which the series would take longer than it saves. It affects the
/// time only.
const SPEEDS_OVER_WALKERS: usize = 64;

/// Most searches for edges of a column that find none. Then its orbits are labelled alone. It affects the time only.
const MOST_MISSED_EDGES: usize = 4;

/// Most hops of a followed phase: an orbit leaves the turn of jumps after some 15 hops. Beyond it the phase stays open.
const MOST_HOPS: usize = 2048;

impl Strip<'_> {
    /// Where the orbit is on the slow side of a fixed point, if it may be: n, its offset, and the error of the offset.
    #[inline]
    pub(crate) fn slow_side(&mut self, at: u32, hop: HopWithin) -> Option<(u64, f64, f64)> {
        let HopWithin::Next { speed, error } = hop else { return None };
        let column = &mut self.columns[self.orbits.all[at as usize].column as usize];
        let SlowZone { n, jumps } = column.zones.find(speed)?;
        if !jumps {
            column.walkers += 1;
            if column.walkers <= self.speeds.len() / SPEEDS_OVER_WALKERS {
                return None;
            }
        }
        let offset = FixedPointSpeed::new(n).offset_of(speed);
        let error = error + f64::EPSILON * offset.abs();
        (offset < error).then_some((n, offset, error))
    }

    /// The orbit after its hops along the slow side of α*_n; as it is if it leaves with the next hop. `None` if it has ended.
    pub(crate) fn jump(
        &mut self,
        at: u32,
        (n, offset, error): (u64, f64, f64),
        hop: HopWithin,
    ) -> Option<HopWithin> {
        let column = self.orbits.all[at as usize].column as usize;
        let sides = self.columns[column].fates.slow_sides();
        if !self.columns[column].has_lap_below(n) {
            // Without laps no two orbits agree: each is followed alone.
            let Some((_, offset, error)) = sides.leave(n, offset, error) else { return Some(hop) };
            let (speed, error) = speed_at(n, (offset, error));
            return Some(HopWithin::Next { speed, error });
        }
        if sides.is_beyond_jumps(n, offset) {
            let known = self.follow_from(column, n, (offset, error));
            self.end_with(at, known, 0, n);
            return None;
        }
        let jump = sides.jump(n, offset, error);
        let near = jump.is_none_or(|jump| jump.count.error > LARGEST_ERROR);
        if near && (self.end_beside_edge(at) || self.find_edge(at, n) && self.end_beside_edge(at)) {
            return None;
        }
        match jump {
            Some(jump) => self.end_on_circle(at, n, jump),
            None => self.end_alone(at),
        }
        None
    }

    /// Ends the orbit in a known fate, after `hops` hops left of α*_n that were jumped over; alone if the fate is not known.
    fn end_with(&mut self, at: u32, known: Option<KnownFate>, hops: u64, n: u64) {
        let Some(known) = known else { return self.end_alone(at) };
        let followed = &mut self.orbits.all[at as usize];
        if hops > 0 {
            followed.itinerary.jump(n, hops);
        }
        followed.itinerary.end_in(&known.itinerary);
        self.columns[followed.column as usize].labels[followed.at as usize] = known.label;
    }

    /// Ends the orbit by its phase after a jump.
    fn end_on_circle(&mut self, at: u32, n: u64, jump: SlowJump) {
        let column = self.orbits.all[at as usize].column as usize;
        let known = self.arc(column, n, jump.count);
        self.end_with(at, known, jump.hops, n);
    }

    /// Ends an orbit that starts beside a known edge; false if it does not, or `f64` does not decide it.
    fn end_beside_edge(&mut self, at: u32) -> bool {
        let followed = self.orbits.all[at as usize];
        let column = &self.columns[followed.column as usize];
        let start = self.speeds[followed.at as usize];
        let found = column.edges.iter().find_map(|(edge, itinerary)| {
            edge.offset(start).map(|offset| (edge.n, offset, *itinerary))
        });
        let Some((n, (offset, error), itinerary)) = found else { return false };
        let in_trap = column
            .fates
            .trap(n)
            .is_ok_and(|trap| trap.side_of_offset(offset, error) == TrapSide::Inside);
        if in_trap {
            self.orbits.all[at as usize].itinerary = itinerary;
            let known = KnownFate {
                itinerary: Itinerary::in_trap(n as u32),
                label: HopperFate::label_of_fixed_point(n),
            };
            self.end_with(at, Some(known), 0, n);
            return true;
        }
        let Some(jump) = column.fates.slow_sides().jump(n, offset, error) else { return false };
        self.orbits.all[at as usize].itinerary = itinerary;
        self.end_on_circle(at, n, jump);
        true
    }

    /// Finds the edge beside the start of an orbit that has come next to α*_n; false if there is none, or it is known.
    fn find_edge(&mut self, at: u32, n: u64) -> bool {
        let followed = self.orbits.all[at as usize];
        let hops = self.orbits.count.saturating_sub(followed.since);
        let column = &mut self.columns[followed.column as usize];
        let Some(laps) = &column.laps else { return false };
        let start = self.speeds[followed.at as usize];
        let searched = column.edges.iter().any(|(known, _)| known.is_near(n, start));
        if searched || column.missed_edges >= MOST_MISSED_EDGES {
            return false;
        }
        let mut itinerary = Itinerary::START;
        let see = |speed: f64, reach: f64| itinerary.hop((speed, reach), laps);
        let edge = BesideEdge::new(column.fates.map(), start, (n, hops), see);
        match edge {
            Some(edge) => column.edges.push((edge, itinerary)),
            None => column.missed_edges += 1,
        }
        edge.is_some()
    }

    /// The fate of the phases of `count` left of α*_n, from the known arcs, and from as many more orbits as it needs.
    fn arc(&mut self, column: usize, n: u64, count: HopCount) -> Option<KnownFate> {
        if self.columns[column].arcs(n).is_empty() {
            let turn = self.columns[column].fates.slow_sides().turn(n)?;
            for k in 0..=FIRST_PHASES {
                let part = f64::from(k) / f64::from(FIRST_PHASES);
                self.add_phase(column, n, turn - BEYOND + part * (1.0 + 2.0 * BEYOND));
            }
        }
        loop {
            match self.columns[column].arcs(n).find(count.hops, count.error) {
                Arc::Known(known) => return Some(known),
                // A smaller gap would not show more: the phases reach beyond it.
                Arc::Open(left, right) if right - left > 2.0 * count.error.max(1e-9) => {
                    self.add_phase(column, n, left.midpoint(right));
                }
                _ => return None,
            }
        }
    }

    /// Follows the orbit of a phase and adds it to the arcs.
    fn add_phase(&mut self, column: usize, n: u64, phase: f64) {
        let known = self.columns[column]
            .fates
            .slow_sides()
            .offset(n, phase)
            .and_then(|offset| self.follow_from(column, n, offset))
            .unwrap_or_else(|| {
                let mut itinerary = Itinerary::START;
                itinerary.give_up();
                KnownFate { itinerary, label: HopperFate::UNDECIDED_PRECISION }
            });
        self.columns[column].arcs(n).add(phase, known.itinerary, known.label);
    }

    /// The fate from an offset left of α*_n that is known to within an error; `None` if `f64` does not decide it.
    fn follow_from(&mut self, column: usize, n: u64, offset: (f64, f64)) -> Option<KnownFate> {
        let Column { fates, laps, .. } = &self.columns[column];
        let laps = laps.as_ref()?;
        let (mut itinerary, mut offset) = (Itinerary::START, offset);
        while let Some(next) = fates.slow_sides().walk(n, offset) {
            itinerary.hop(speed_at(n, offset), laps);
            offset = next;
        }
        let start = speed_at(n, offset);
        // The second bound takes ten times as long, and decides nearly all of the rest.
        self.follow(column, start, itinerary, LiftOffMap::hop_within)
            .or_else(|| self.follow(column, start, itinerary, LiftOffMap::signed_hop_within))
    }

    /// The fate of all speeds within `error` of `speed`, hop by hop; `None` if `f64` does not decide it.
    fn follow(
        &mut self,
        column: usize,
        (mut speed, mut error): (f64, f64),
        mut itinerary: Itinerary,
        hop: fn(&LiftOffMap, f64, f64) -> HopWithin,
    ) -> Option<KnownFate> {
        for hops in 0..MOST_HOPS {
            let found = self.intervals.find(column, speed);
            let known = match found {
                NO_INTERVAL => self.columns[column].trap(speed),
                found => Some(self.intervals.get(found)),
            };
            if let Some((known, ends)) = known
                && is_inside(speed, error, ends)
            {
                itinerary.end_in(&known.itinerary);
                return Some(KnownFate { itinerary, label: known.label });
            }
            let sides = self.columns[column].fates.slow_sides();
            // A phase beyond the turn would jump back to it.
            if hops > 0
                && let Some(SlowZone { n, jumps: true }) = self.columns[column].zones.find(speed)
            {
                let offset = FixedPointSpeed::new(n).offset_of(speed);
                if offset < 0.0 && !sides.is_beyond_jumps(n, offset) {
                    let jump = sides.jump(n, offset, error + f64::EPSILON * -offset)?;
                    if jump.hops > 0 {
                        // A circle inside the circle.
                        let known = self.arc(column, n, jump.count)?;
                        itinerary.jump(n, jump.hops);
                        itinerary.end_in(&known.itinerary);
                        return Some(KnownFate { itinerary, label: known.label });
                    }
                }
            }
            let column = &self.columns[column];
            itinerary.hop((speed, error), column.laps.as_ref()?);
            let map = column.fates.map();
            match hop(map, speed, error) {
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
}

/// α*_n plus an offset, and the bound on the error of the sum: half an ulp each for α*_n and for the sum.
fn speed_at(n: u64, (offset, error): (f64, f64)) -> (f64, f64) {
    let speed = alpha_star(n) + offset;
    (speed, error + f64::EPSILON * speed)
}
