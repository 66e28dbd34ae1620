//! What a strip does with orbits on the slow side of a fixed point: they jump, and the circle of fates decides.

use crate::fates::beside_edge::BesideEdge;
use crate::fates::hopper_fate::HopperFate;
use crate::fates::slow_sides::{LARGEST_ERROR, SlowZone};
use crate::raster::arcs::{Arc, Arcs};
use crate::raster::column::Column;
use crate::raster::itinerary::Itinerary;
use crate::raster::known_intervals::{KnownFate, NO_INTERVAL};
use crate::raster::speed_within::{hop_within, is_inside, offset_from, speed_at};
use crate::raster::strip::ColumnStrip;
use crate::traps::trap::TrapSide;
use passive_hopper::HopWithin;

/// The error of a phase above which a reference orbit in 106 bits is made for the starts beside it. A reference
/// takes about a tenth of a millisecond; a fate alone, where an error reaches a boundary, takes some tenths. It
/// affects the time only.
const SMALL_ERROR: f64 = 1e-4;

/// The first phases that are followed on a circle, beyond both ends of a turn by the largest error of a phase. It
/// affects the time only.
const FIRST_PHASES: u32 = 16;
const BEYOND: f64 = 0.011;

/// The least length of a gap between two orbits that is halved, as a part of the offset.
const FINEST: f64 = 1e-10;

/// The speeds of a column over the number of orbits that come to a slow side, too far for a jump, before its series
/// is made. Next to an edge most orbits come there; in a whole window some do, for which the series would take
/// longer than it saves. It affects the time only. In a narrow window the series is made at once.
const SPEEDS_OVER_WALKERS: usize = 64;

/// Most searches for edges of a column that find none. Then its orbits are labelled alone. It affects the time only.
const MOST_MISSED_EDGES: usize = 4;

/// The orbits of a strip that jump left of one fixed point, over its columns, before its circle is computed. Up to
/// there each of them is followed alone: a circle takes as long as some dozen orbits. It affects the time only.
const FIRST_JUMPS: usize = 2;

/// The same for a circle that all columns of a raster share, in all columns of a strip.
const FIRST_JUMPS_TOGETHER: usize = 8;

/// A hop along the slow side by its polynomials is given up for a plain one if it multiplies the error of the speed
/// by more than this. Far from the fixed point the polynomials err more than a plain hop does.
const PLAIN_GROWTH: f64 = 16.0;

/// Most hops of a followed phase: an orbit leaves the turn of jumps after some 15 hops. Beyond it the phase stays open.
const MOST_HOPS: usize = 2048;

impl<'a> ColumnStrip<'a> {
    /// Where the orbit is on the slow side of a fixed point, if it may be: n, its offset, and the error of the offset.
    #[inline]
    pub(crate) fn slow_side(&mut self, at: u32, hop: HopWithin) -> Option<(u64, f64, f64)> {
        let HopWithin::Next { speed, error } = hop else { return None };
        let column = &mut self.columns[self.orbits.all[at as usize].column as usize];
        let SlowZone { n, jumps } = column.zones.find(speed)?;
        if !jumps {
            column.walkers += 1;
            if self.common.is_none() && column.walkers <= self.speeds.len() / SPEEDS_OVER_WALKERS {
                return None;
            }
        }
        let (offset, error) = offset_from(n, (speed, error));
        (offset < error).then_some((n, offset, error))
    }

    /// The orbit after its hops along the slow side of α*_n; as it is if it leaves with the next hop. `None` if it
    /// has ended.
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
        if let Some((known, hops)) = self.fate_from(column, n, (offset, error), SMALL_ERROR) {
            self.end_with(at, known, hops, n);
            return None;
        }
        // An edge that is not known costs most. Few speeds are so near to it that they need it, unless the window
        // is deep.
        let decided = self.end_beside_known_edge(at)
            || self.end_with_signs(at, n)
            || (self.find_edge(at, n) && self.end_beside_known_edge(at));
        if !decided {
            self.end_alone(at);
        }
        None
    }

    /// The fate from an offset left of α*_n, after a number of hops that are jumped over; `None` if it is not
    /// decided, or if the phase has an error above `largest`.
    fn fate_from(
        &mut self,
        column: usize,
        n: u64,
        (offset, error): (f64, f64),
        largest: f64,
    ) -> Option<(KnownFate, u64)> {
        let Column { fates, zones, .. } = &self.columns[column];
        let sides = fates.slow_sides();
        // Farther away the coordinate is not needed.
        if !zones.may_jump(n, offset) || sides.is_beyond_jumps(n, offset) {
            return Some((self.behind_jumps(column, (n, offset, error))?, 0));
        }
        let jump = sides.jump(n, offset, error, largest)?;
        Some((self.on_circle(column, n, (jump.delta, jump.error))?, jump.hops))
    }

    /// The fate from an offset beyond the turn on which jumps end: from the known arcs, or followed. Where the
    /// circle has a gap, halving it would cost more than the orbit.
    fn behind_jumps(
        &mut self,
        column: usize,
        (n, offset, error): (u64, f64, f64),
    ) -> Option<KnownFate> {
        self.use_circle(n);
        self.known_arc(column, n, (offset, error))
            .or_else(|| self.follow_from(column, n, (offset, error)))
    }

    /// The fate from an offset on the turn of jumps: followed, if few orbits jump, or from the circle.
    fn on_circle(&mut self, column: usize, n: u64, reached: (f64, f64)) -> Option<KnownFate> {
        let known = if self.use_circle(n) { None } else { self.follow_from(column, n, reached) };
        known.or_else(|| self.arc(column, n, reached))
    }

    /// Counts a jump left of α*_n. True if so many orbits jump there that the circle pays.
    fn use_circle(&mut self, n: u64) -> bool {
        let at = n as usize; // below the number of humps with laps
        if self.jumped.len() <= at {
            self.jumped.resize(at + 1, 0);
        }
        self.jumped[at] += 1;
        self.uses_circle(n)
    }

    fn uses_circle(&self, n: u64) -> bool {
        let own = FIRST_JUMPS * self.columns.len();
        let least = if self.common.is_some() { FIRST_JUMPS_TOGETHER } else { own };
        self.jumped.get(n as usize).is_some_and(|&jumped| jumped > least)
    }

    /// Ends the orbit in a known fate, after `hops` hops left of α*_n that were jumped over.
    fn end_with(&mut self, at: u32, known: KnownFate, hops: u64, n: u64) {
        let followed = &mut self.orbits.all[at as usize];
        if hops > 0 {
            followed.itinerary.jump(n, hops);
        }
        followed.itinerary.end_in(&known.itinerary);
        self.columns[followed.column as usize].labels[followed.at as usize] = known.label;
    }

    /// Follows an orbit that has come next to α*_n once more, with smaller errors, and ends it; false if they do
    /// not suffice.
    fn end_with_signs(&mut self, at: u32, n: u64) -> bool {
        let followed = self.orbits.all[at as usize];
        let column = followed.column as usize;
        let map = self.columns[column].fates.map();
        let (mut speed, mut error) = (self.speeds[followed.at as usize], 0.0);
        for _ in followed.since..self.orbits.count {
            match map.signed_hop_within(speed, error) {
                HopWithin::Next { speed: next, error: bound } => (speed, error) = (next, bound),
                HopWithin::Grounded | HopWithin::Inconclusive => return false,
            }
        }
        let offset = offset_from(n, (speed, error));
        let Some((known, hops)) = self.fate_from(column, n, offset, LARGEST_ERROR) else {
            return false;
        };
        self.end_with(at, known, hops, n);
        true
    }

    /// Ends an orbit that starts beside a known edge; false if it does not, or the orbit is not decided.
    fn end_beside_known_edge(&mut self, at: u32) -> bool {
        let followed = self.orbits.all[at as usize];
        let column = followed.column as usize;
        let fates = self.columns[column].fates;
        let start = self.speeds[followed.at as usize];
        let found = self.edges.iter().find_map(|(edge, itinerary)| {
            let offset = edge.offset(start, fates.map().mass_ratio())?;
            Some((edge.n, offset, *itinerary))
        });
        let Some((n, (offset, error), itinerary)) = found else { return false };
        let in_trap =
            fates.trap(n).is_ok_and(|trap| trap.side_of_offset(offset, error) == TrapSide::Inside);
        let found = if in_trap {
            let itinerary = Itinerary::in_trap(n as u32);
            Some((KnownFate { itinerary, label: HopperFate::label_of_fixed_point(n) }, 0))
        } else if offset < -error {
            self.fate_from(column, n, (offset, error), LARGEST_ERROR)
        } else {
            None
        };
        let Some((known, hops)) = found else { return false };
        self.orbits.all[at as usize].itinerary = itinerary;
        self.end_with(at, known, hops, n);
        true
    }

    /// Finds the edge beside the start of an orbit that has come next to α*_n; false if there is none, or it is known.
    fn find_edge(&mut self, at: u32, n: u64) -> bool {
        let followed = self.orbits.all[at as usize];
        let hops = self.orbits.count.saturating_sub(followed.since);
        let column = &self.columns[followed.column as usize];
        let map = column.fates.map();
        let start = self.speeds[followed.at as usize];
        let ratio = map.mass_ratio();
        let searched = self.edges.iter().any(|(known, _)| known.is_near(n, start, ratio));
        if searched || column.missed_edges >= MOST_MISSED_EDGES {
            return false;
        }
        // For all columns, if they are near enough.
        let kappas = [self.columns.first(), self.columns.last()]
            .map(|column| column.map_or(0.0, |column| column.fates.map().mass_ratio().kappa()));
        let own = map.mass_ratio().kappa();
        let radius = kappas.map(|kappa| (kappa - own).abs()).into_iter().fold(0.0, f64::max);
        let mut itinerary = Itinerary::START;
        // The lap of all columns: the ends of laps move in one direction with M.
        let lap = |speed: f64, reach: f64| {
            let of = |column: Option<&Column>| column?.laps.as_ref()?.lap(speed, reach);
            of(self.columns.first()).filter(|lap| of(self.columns.last()) == Some(*lap))
        };
        let see = |speed: f64, reach: f64| itinerary.hop(lap(speed, reach));
        let edge = BesideEdge::new(map, start, (n, hops), radius, see);
        match edge {
            Some(edge) => self.edges.push((edge, itinerary)),
            None => self.columns[followed.column as usize].missed_edges += 1,
        }
        edge.is_some()
    }

    /// The fate within an error of an offset on the turn of jumps left of α*_n, from the known arcs, and from as
    /// many more orbits as it needs.
    fn arc(&mut self, column: usize, n: u64, (offset, error): (f64, f64)) -> Option<KnownFate> {
        if let Some(known) = self.known_arc(column, n, (offset, error)) {
            return Some(known);
        }
        if let Some(arcs) = self.common_circle(n) {
            self.columns[column].arcs(n).add_around(arcs, offset, error);
        }
        if self.columns[column].arcs(n).find(offset, error) == Arc::Outside {
            self.begin_circle(column, n)?;
        }
        let finest = error.max(FINEST * offset.abs());
        loop {
            match self.columns[column].arcs(n).find(offset, error) {
                Arc::Known(known) => return Some(known),
                // A smaller gap would not show more: the offsets reach beyond it.
                Arc::Open(left, right) if right - left > 2.0 * finest => {
                    self.add_orbit(column, n, left.midpoint(right));
                }
                _ => return None,
            }
        }
    }

    /// The fate within an error of an offset left of α*_n, if the arcs that all columns share show it, or those of
    /// this column.
    fn known_arc(&self, column: usize, n: u64, (offset, error): (f64, f64)) -> Option<KnownFate> {
        let common = self.common_circle(n).and_then(|arcs| arcs.known(offset, error));
        let own = || self.columns[column].arcs.get(n as usize)?.known(offset, error);
        common.or_else(own)
    }

    /// The circle that all columns share, if so many orbits have jumped that it pays.
    fn common_circle(&self, n: u64) -> Option<&'a Arcs> {
        self.common.filter(|_| self.uses_circle(n))?.circle(n)
    }

    /// The first orbits of the circle of one column.
    fn begin_circle(&mut self, column: usize, n: u64) -> Option<()> {
        let first = self.columns[column].fates.slow_sides().turn(n)?;
        for k in 0..=FIRST_PHASES {
            let part = f64::from(k) / f64::from(FIRST_PHASES);
            let sides = self.columns[column].fates.slow_sides();
            let (offset, _) = sides.offset(n, first - BEYOND + part * (1.0 + 2.0 * BEYOND))?;
            self.add_orbit(column, n, offset);
        }
        Some(())
    }

    /// Follows the orbit from an offset and adds it to the arcs.
    fn add_orbit(&mut self, column: usize, n: u64, offset: f64) {
        let known = self.follow_from(column, n, (offset, 0.0)).unwrap_or_else(|| {
            let mut itinerary = Itinerary::START;
            itinerary.give_up();
            KnownFate { itinerary, label: HopperFate::UNDECIDED_PRECISION }
        });
        self.columns[column].arcs(n).add((offset, 0.0), known);
    }

    /// The fate from an offset left of α*_n that is known to within an error; `None` if `f64` does not decide it.
    fn follow_from(&mut self, column: usize, n: u64, offset: (f64, f64)) -> Option<KnownFate> {
        let Column { fates, laps, .. } = &self.columns[column];
        let laps = laps.as_ref()?;
        let (mut itinerary, mut offset) = (Itinerary::START, offset);
        while let Some(next) = fates.slow_sides().walk(n, offset) {
            let (speed, error) = speed_at(n, offset);
            if next.1 > PLAIN_GROWTH * error {
                break;
            }
            itinerary.hop(laps.lap(speed, error));
            offset = next;
            if let Some(known) = self.known_arc(column, n, offset) {
                itinerary.end_in(&known.itinerary);
                return Some(KnownFate { itinerary, ..known });
            }
        }
        self.follow(column, speed_at(n, offset), itinerary)
    }

    /// The fate of all speeds within `error` of `speed`, hop by hop; `None` if `f64` does not decide it.
    fn follow(
        &mut self,
        column: usize,
        (mut speed, mut error): (f64, f64),
        mut itinerary: Itinerary,
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
                let (offset, error) = offset_from(n, (speed, error));
                if offset < 0.0 && !sides.is_beyond_jumps(n, offset) {
                    let jump = sides.jump(n, offset, error, LARGEST_ERROR)?;
                    if jump.hops > 0 {
                        // A circle inside the circle.
                        let known = self.arc(column, n, (jump.delta, jump.error))?;
                        itinerary.jump(n, jump.hops);
                        itinerary.end_in(&known.itinerary);
                        return Some(KnownFate { itinerary, label: known.label });
                    }
                }
            }
            let column = &self.columns[column];
            itinerary.hop(column.laps.as_ref()?.lap(speed, error));
            let map = column.fates.map();
            match hop_within(map, (speed, error), self.large_error) {
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
