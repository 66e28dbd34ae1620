//! What comes before a Zeno limit, and what is passed at it?
//!
//! Infinitely many events lead to the limit. A clock, and a guard that none of them belongs to, may have its event
//! before:
//!
//! | the event comes | the flow can be followed | rounding hides the next event |
//! |---|---|---|
//! | clearly before the limit | the flow is followed on | on the straight path to the limit; a guard has the remaining time as its error |
//! | within the error of the limit, a guard | at the start of the next arc, if that has the guard | the same |
//! | within the error of the limit, a clock | at the limit's state, behind such guards | on the straight path |
//!
//! A guard belongs to the events that lead to the limit if it has had two within three periods. It is looked at now and
//! at the limit: two zeros on the way, after the last event that can be followed, are not seen.

use crate::arrival::Arrival;
use crate::crossing::{
    Certainty, Crossing, EventKind, GuardedFlow, LeavingGuards, change_by_components,
};
use crate::error::Error;
use crate::execution::{AnArc, Execution};
use crate::guard::{Guard, Role};
use crate::start_rule::ArcStart;
use crate::state::StateVector;
use crate::system::HybridSystem;
use crate::zeno::ZenoLimit;
use interval_arithmetic::root_beyond;
use smallvec::SmallVec;

/// Guards that are kept without allocating.
const FEW: usize = 4;

/// A guard that is on another side at a Zeno limit than now.
pub(crate) struct Passing<S> {
    pub(crate) surface: S,
    /// The side from which it comes, ±1.
    pub(crate) from: f64,
    /// False if the error of the limit hides whether it passes before or behind.
    clearly: bool,
}

pub(crate) type PassingGuards<S> = SmallVec<[Passing<S>; FEW]>;

type Limit<T> = ZenoLimit<<T as HybridSystem>::State>;
type MaybeArc<T> = Result<Option<AnArc<T>>, Error>;
type CrossingOf<T> = Crossing<<T as HybridSystem>::Surface, <T as HybridSystem>::State>;
type MaybeCrossing<T> = Result<Option<CrossingOf<T>>, Error>;

impl<T: HybridSystem> Execution<'_, T> {
    /// The arc up to a Zeno limit, or to a clock within the error of the limit; `None` if the flow has to be followed.
    pub(crate) fn arc_to_limit(&mut self, limit: Limit<T>, horizon: f64) -> MaybeArc<T> {
        // What has come to its surface at the instant of the last event has its event first.
        let pending = self.at.arrival.as_ref().is_some_and(Arrival::has_pending);
        if pending && !matches!(self.start_of_arc(horizon).0, Ok(ArcStart::Flows)) {
            return Ok(None);
        }
        let passing = self.passing(&limit);
        if passing.iter().any(|guard| guard.clearly) {
            return Ok(None);
        }
        match self.next_clock(limit.remainder)? {
            None => self.zeno_arc(limit, &passing).map(Some),
            Some(clock) if clock.until < limit.remainder - limit.time_error => Ok(None),
            // Within the error of the limit the order is not known. A guard must not be lost at the state of the clock.
            Some(clock) => {
                let event = match self.first_on_path(&limit, &passing)? {
                    Some(mut event) => {
                        event.time = event.time.min(clock.until);
                        event
                    }
                    None => clock.crossing(limit.state, Certainty::Interpolated),
                };
                self.event_arc(event, (horizon, Some(clock)), LeavingGuards::new()).map(Some)
            }
        }
    }

    /// The next arc if rounding hides the next event on the way to a Zeno limit, and with it how far the events up to
    /// a clock, a guard or the limit on time move the state.
    pub(crate) fn hidden_arc(&mut self, limit: Limit<T>, horizon: f64) -> Result<AnArc<T>, Error> {
        let (leaving, certainty) = (LeavingGuards::new(), Certainty::Interpolated);
        let passing = self.passing(&limit);
        let clock = self.next_clock(limit.remainder.min(horizon))?;
        let ends_at_limit = clock.is_none() && limit.remainder <= horizon;
        let latest = clock.map_or(horizon, |clock| clock.until);
        // Those that pass within the error of the limit pass at it, if nothing else moves the state there before.
        let before = passing.iter().filter(|guard| guard.clearly || !ends_at_limit);
        if let Some(event) = self.first_on_path(&limit, before)?
            && event.time <= latest
        {
            return self.event_arc(event, (horizon, clock), leaving);
        }
        if ends_at_limit {
            return self.zeno_arc(limit, &passing);
        }
        let part = if limit.remainder > 0.0 { latest / limit.remainder } else { 1.0 };
        let state = self.path_to(&limit)(part);
        match clock {
            Some(tick) => {
                self.event_arc(tick.crossing(state, certainty), (horizon, clock), leaving)
            }
            None => self.arc_without_event(horizon, Some(state), certainty, leaving),
        }
    }

    /// The guards that change their side, in a direction that counts, between now and a Zeno limit, and whose events do
    /// not lead there.
    fn passing(&self, limit: &Limit<T>) -> PassingGuards<T::Surface> {
        let flow = self.flow();
        // The state at the limit is extrapolated as far as the time.
        let error = limit.time_error / limit.remainder;
        let error_of_state = self.at.history.error_of_state(limit);
        let arrival = self.at.arrival.as_ref();
        let passes = |guard: &Guard<T::Surface>| {
            let surface = guard.surface;
            let value = |state: &T::State| flow.guard_value(surface, state);
            let [now, then] = [&self.at.state, &limit.state].map(value);
            let pending = arrival.and_then(|arrival| arrival.came_from(surface));
            let from = pending.unwrap_or(now.signum());
            // At zero it passes in the next arc, or not at all.
            let other = now != 0.0 && now * then <= 0.0 || pending.is_some() && from * then < 0.0;
            if !other
                || !guard.direction.admits(from, -from)
                || pending.is_none() && self.at.history.leads_to_limit(limit.period, surface)
            {
                return None;
            }
            let by_state = error_of_state.as_ref().map_or(f64::INFINITY, |error| {
                change_by_components(&limit.state, |axis| error.components()[axis], &value)
            });
            let rounding = flow.rounding_at(surface, &limit.state);
            let hidden = rounding + by_state + error * (then - now).abs();
            Some(Passing { surface, from, clearly: then.abs() > hidden })
        };
        let guards = flow.guards().iter().filter(|guard| guard.role != Role::Clock);
        guards.filter_map(passes).collect()
    }

    /// The straight path from the present state to that of a limit, by the part of the time to it.
    fn path_to(&self, limit: &Limit<T>) -> impl Fn(f64) -> T::State {
        let from = self.at.state.clone();
        let mut step = limit.state.clone();
        step.add_scaled(-1.0, &from);
        move |part| {
            let mut state = from.clone();
            state.add_scaled(part, &step);
            state
        }
    }

    /// The first event of these guards on the straight path to a limit.
    fn first_on_path<'a>(
        &self,
        limit: &Limit<T>,
        passing: impl IntoIterator<Item = &'a Passing<T::Surface>>,
    ) -> MaybeCrossing<T>
    where
        T::Surface: 'a,
    {
        let (flow, path) = (self.flow(), self.path_to(limit));
        let mut first: Option<(f64, &Passing<T::Surface>)> = None;
        for guard in passing {
            let along = |part: f64| flow.guard_value(guard.surface, &path(part));
            let [now, then] = [0.0, 1.0].map(along);
            let part = if now * guard.from <= 0.0 {
                // It has come to its surface at the last event.
                0.0
            } else if now * then < 0.0 {
                root_beyond(&along, (0.0, now), (1.0, then))?
            } else {
                // The sum of the state and the step rounds: the limit itself is on the other side.
                1.0
            };
            if first.is_none_or(|(earlier, _)| part < earlier) {
                first = Some((part, guard));
            }
        }
        let crossing = |(part, guard): (f64, &Passing<T::Surface>)| Crossing {
            surface: guard.surface,
            time: part * limit.remainder,
            // A point of the path has no rounding by a search.
            time_rounding: 0.0,
            time_error: limit.remainder + limit.time_error,
            state: path(part),
            kind: EventKind::Crossing,
            from: Some(guard.from),
            certainty: Certainty::Interpolated,
        };
        Ok(first.map(crossing))
    }
}
