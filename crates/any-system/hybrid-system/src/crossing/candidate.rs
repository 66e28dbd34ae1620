//! A candidate for the earliest event of a mode.

use super::guarded_flow::GuardedFlow;
use super::under_bounds::as_searched;

/// A candidate for the earliest event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    /// Time of the event.
    pub(crate) time: f64,
    /// Bound on the error of the time.
    pub(crate) error: f64,
    /// Index of the guard in the list of the mode.
    pub(crate) index: usize,
    /// The value of the guard, if this is a touch.
    pub(crate) touch: Option<f64>,
    /// The side from which the guard comes, if it is crossed.
    pub(crate) from: Option<f64>,
}

impl Candidate {
    /// This event, or the one found before, if that guard has left its side at this time as well: rounding gives one
    /// zero several times, and the guard that is listed first has its event first.
    pub(crate) fn or_same<F: GuardedFlow>(self, other: Option<Candidate>, flow: &F) -> Candidate {
        let has_passed = |other: &Candidate| {
            let surface = flow.guards()[other.index].surface;
            let side = other.from.unwrap_or(0.0);
            other.index < self.index
                && self.time < other.time
                && other.time - self.time <= self.error + other.error
                && side * as_searched(flow, surface, self.time) <= 0.0
        };
        match other.filter(has_passed) {
            Some(other) => Candidate { time: self.time, ..other },
            None => self,
        }
    }

    /// True if this event comes before the other one: at an earlier double, or at the same one if the model lists
    /// its guard first. The errors of the two times do not count: both are on one computed trajectory.
    pub(crate) fn is_sooner_than(&self, other: &Candidate) -> bool {
        self.time < other.time || self.time == other.time && self.index < other.index
    }
}
