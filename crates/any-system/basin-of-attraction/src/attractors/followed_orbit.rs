//! Where does an orbit end: at a known attractor, at a candidate for a new one, or nowhere?
//!
//! An orbit that visits only cells that it visited before has come to an attractor, or passes slowly. The
//! difference shows itself later:
//!
//! ```text
//!   0 ──────────── pace ─────────────────────────── 6 · pace ─────────── 8.5 · pace ────────── 11 · pace
//!     until it recurs        approach                    one quarter               another quarter
//! ```
//!
//! It is followed ten times as long as it took to be found. It has settled if the cells of the last two quarters
//! are the same. If not, it was a transient, and the search goes on from its end.

use crate::attractors::confirmation::{CONFIRMED, Confirmation};
use crate::attractors::first_steps::Unended;
use crate::attractors::known_cells::{CellSet, KnownCells, Place};
use crate::attractors::recurrence_limits::RecurrenceLimits;
use crate::attractors::state_map::{Moving, Repeats, StateMap};
use crate::attractors::unmatched::{Border, UnmatchedReason};

/// Steps after which the cells of an orbit are remembered. Most orbits have come to a known attractor by then, and a step without it takes
/// half of the time.
pub(crate) const UNTRACKED: usize = 64;

/// An orbit, with the steps since its start.
///
/// [`see`](Self::see) looks at the point where it is, and says when it has ended; else a step is to be made. So one orbit can be followed
/// alone, and several side by side.
pub(crate) struct Orbit {
    point: Moving,
    steps: usize,
    outside: usize,
    /// The map had no value.
    is_stopped: bool,
    /// A state in the region is finite and has not escaped.
    is_within: bool,
    /// What most orbits do not need, out of the way of what each step needs.
    track: Box<Track>,
}

/// What is remembered of an orbit to see that it recurs.
#[derive(Default)]
struct Track {
    /// Where it was outside the region while it recurred, and still moved.
    cut: Option<Border>,
    visited: CellSet,
    /// Consecutive steps to visited cells.
    recurrences: usize,
    /// Where coordinates are hidden, the attractor in whose cells it is, and since which step.
    stay: Option<(usize, usize)>,
    repeats: Repeats,
    confirmation: Option<Confirmation>,
}

/// Where an orbit ends.
pub(crate) enum End {
    /// At the attractor with this index.
    Known(usize),
    /// Beyond the distance of escape.
    Escaped,
    Unmatched(UnmatchedReason),
    /// Nowhere within the budget.
    Budget,
    /// It recurs.
    Settled(Settled),
}

/// An orbit that recurs.
pub(crate) struct Settled {
    /// A point in the middle of the confirmation.
    pub(crate) half: Vec<f64>,
    /// The steps until it was found.
    pub(crate) pace: usize,
    /// An end of its windows moves in one direction all the time: a slow approach, or a slow passage.
    pub(crate) drifts: bool,
}

/// What a look at a point shows.
enum Look {
    Inside,
    Outside,
    End(End),
}

impl Orbit {
    pub(crate) fn new(known: &KnownCells, limits: &RecurrenceLimits, start: &[f64]) -> Self {
        let mut point = Moving::from(start);
        known.wrap(&mut point.at);
        Orbit {
            point,
            steps: 0,
            outside: 0,
            is_stopped: false,
            is_within: known.is_within(limits.escape),
            track: Box::default(),
        }
    }

    /// The same memory for another orbit.
    pub(crate) fn restart(&mut self, known: &KnownCells, start: &[f64]) {
        self.point.at.copy_from_slice(start);
        known.wrap(&mut self.point.at);
        if !self.track.repeats.is_new() {
            self.track.cut = None;
            self.go_on();
        }
        self.track.stay = None;
        (self.steps, self.outside, self.is_stopped) = (0, 0, false);
    }

    /// The same for an orbit that has made some steps, the last ones outside the region.
    pub(crate) fn resume(&mut self, known: &KnownCells, from: &Unended) {
        self.restart(known, &from.at);
        (self.steps, self.outside) = (from.steps, from.outside);
    }

    /// Forgets what recurred: a transient, from whose end the search goes on.
    pub(crate) fn go_on(&mut self) {
        let track = &mut self.track;
        track.visited.clear();
        track.recurrences = 0;
        track.repeats.forget();
        track.confirmation = None;
    }

    /// Where it is.
    pub(crate) fn at(&self) -> &[f64] {
        &self.point.at
    }

    /// Where it is, to be moved by one step.
    pub(crate) fn point(&mut self) -> &mut Moving {
        &mut self.point
    }

    /// The steps so far; until it came to an attractor, if it is at one.
    pub(crate) fn steps(&self) -> usize {
        self.track.stay.map_or(self.steps, |(_, since)| since)
    }

    /// Follows the orbit from where it is.
    pub(crate) fn follow(
        &mut self,
        known: &KnownCells,
        limits: &RecurrenceLimits,
        map: &dyn StateMap,
    ) -> End {
        loop {
            if let Some(end) = self.see(known, limits) {
                return end;
            }
            let has_image = self.point.step(map);
            self.moved(known, has_image);
        }
    }

    /// Notes that a step was made, or that the map had no value.
    pub(crate) fn moved(&mut self, known: &KnownCells, has_image: bool) {
        self.is_stopped = !has_image;
        self.steps += usize::from(has_image);
        known.wrap(&mut self.point.at);
    }

    /// Looks at the point where the orbit is; `None` if it is to be followed further.
    #[inline]
    pub(crate) fn see(&mut self, known: &KnownCells, limits: &RecurrenceLimits) -> Option<End> {
        let place = known.place(&self.point.at);
        if self.is_within && self.steps < UNTRACKED && !self.is_stopped {
            match place {
                Place::Owned(own) => return Some(End::Known(own)),
                Place::Inside if self.steps < limits.budget / 100 => {
                    self.outside = 0;
                    return None;
                }
                _ => {}
            }
        }
        self.see_more(known, limits, place)
    }

    #[inline(never)]
    fn see_more(
        &mut self,
        known: &KnownCells,
        limits: &RecurrenceLimits,
        place: Place,
    ) -> Option<End> {
        if self.track.confirmation.as_ref().is_some_and(Confirmation::is_complete) {
            let confirmation = self.track.confirmation.take()?;
            // A cycle that repeats itself to the last bit is confirmed before an orbit has stayed for long.
            if let Some((own, since)) = self.track.stay
                && self.steps - since >= confirmation.length
            {
                return Some(End::Known(own));
            }
            let verdict = confirmation.verdict(&mut self.track.cut);
            if verdict.is_some() {
                return verdict;
            }
            // Each turn takes eleven times as long as all before it.
            self.go_on();
        }
        let is_inside = match self.look(known, limits, place) {
            Look::End(end) => return Some(end),
            Look::Inside => true,
            Look::Outside => false,
        };
        if self.steps < UNTRACKED.min(limits.budget / 100) {
            return None;
        }
        let pace = self.pace(limits);
        let track = &mut *self.track;
        let long = pace.saturating_mul(CONFIRMED);
        let recurs = track.recurrences >= limits.recurrences.max(1);
        // A turn of a cycle shows all that it does.
        let turns = track.repeats.see(&self.point.at).map(|turn| turn.saturating_mul(CONFIRMED));
        let length = turns.map_or(long, |turns| turns.min(long));
        let is_shorter = track.confirmation.as_ref().is_none_or(|own| length < own.length);
        if (turns.is_some() || recurs) && is_shorter {
            track.confirmation = Some(Confirmation::new(known.dimension(), pace, length));
        }
        if let Some(confirmation) = &mut track.confirmation {
            confirmation.add(&self.point.at, known);
            return None;
        }
        if self.steps >= limits.budget {
            let cut = |border| End::Unmatched(UnmatchedReason::CutByBorder(border));
            return Some(track.cut.map_or(End::Budget, cut));
        }
        if is_inside {
            let is_new = known.cell(&self.point.at).is_none_or(|cell| track.visited.insert(cell));
            track.recurrences = if is_new { 0 } else { track.recurrences + 1 };
        }
        None
    }

    /// How long it took to be found.
    fn pace(&self, limits: &RecurrenceLimits) -> usize {
        self.steps.max(limits.locate).max(1)
    }

    /// The attractor in whose cells it is; where coordinates are hidden, if it has been there for long enough. Cells of others on its way do not count.
    fn arrived(
        &mut self,
        known: &KnownCells,
        limits: &RecurrenceLimits,
        place: Place,
    ) -> Option<usize> {
        let first = match place {
            Place::Owned(first) => Some(first),
            _ => None,
        };
        if !known.has_hidden() {
            return first;
        }
        let (before, first) = (self.track.stay.take(), first?);
        let at = &self.point.at;
        let goes_on = before.filter(|(own, _)| known.is_in_cells_of(*own, at));
        let (own, since) = goes_on.unwrap_or((first, self.steps));
        self.track.stay = Some((own, since));
        (self.steps - since >= limits.recurrences.max(1)).then_some(own)
    }

    #[inline]
    fn look(&mut self, known: &KnownCells, limits: &RecurrenceLimits, place: Place) -> Look {
        let at = &self.point.at;
        let is_certain = !matches!(place, Place::Outside) && self.is_within;
        if self.is_stopped || !is_certain && at.iter().any(|x| !x.is_finite()) {
            return Look::End(End::Unmatched(UnmatchedReason::Stopped));
        }
        let beyond = |escape: f64| at.iter().any(|x| x.abs() > escape);
        if !is_certain && limits.escape.is_some_and(beyond) {
            return Look::End(End::Escaped);
        }
        if let Some(own) = self.arrived(known, limits, place) {
            return Look::End(End::Known(own));
        }
        let at = &self.point.at;
        match place {
            Place::Owned(_) | Place::Inside => {
                self.outside = 0;
                Look::Inside
            }
            Place::Outside => {
                self.outside += 1;
                let lost = (self.outside > limits.lost).then(|| known.beyond(at)).flatten();
                lost.map_or(Look::Outside, |border| {
                    Look::End(End::Unmatched(UnmatchedReason::LeftRegion(border)))
                })
            }
        }
    }
}
