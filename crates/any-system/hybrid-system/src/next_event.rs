//! Which event does an execution meet next?

use crate::crossing::LeavingGuards;
use crate::crossing::{Certainty, Crossing, EventKind, NextEvent, Search};
use crate::error::Error;
use crate::execution::Execution;
use crate::guard::{Direction, Role};
use crate::lands_beyond::LandsBeyond;
use crate::point::Point;
use crate::start_rule::{ArcStart, Undeclared, start_of_arc};
use crate::system::{FlowFrom, HybridSystem};

/// The next event of an arc, the guards on whose surfaces it starts, and the clock up to which it was looked for.
type NextAndLeaving<T> = (
    NextEvent<<T as HybridSystem>::Surface, <T as HybridSystem>::State>,
    LeavingGuards<<T as HybridSystem>::Surface>,
    Option<ClockEvent<<T as HybridSystem>::Surface>>,
);

type StartAndLeaving<T> = (
    Result<ArcStart<<T as HybridSystem>::Surface>, Error>,
    LeavingGuards<<T as HybridSystem>::Surface>,
);

impl<T: HybridSystem> Execution<'_, T> {
    /// The next event: at once, at a preset time, or the first crossing.
    pub(crate) fn next_event(&self, horizon: f64) -> Result<NextAndLeaving<T>, Error> {
        let Point { mode, ref state, ref time, .. } = self.at;
        let flow = self.flow();
        let (start, leaving) = self.start_of_arc(horizon);
        if let ArcStart::Event {
            surface,
            certainty,
            errors: (time_rounding, time_error),
            undeclared,
        } = start?
        {
            if let Some(Undeclared { value, rounding, on_surface }) = undeclared
                && self.sliding(surface).is_none()
            {
                return Err(Error::LandsBeyond(LandsBeyond {
                    mode: format!("{mode:?}"),
                    surface: format!("{surface:?}"),
                    time: time.value(),
                    value,
                    rounding,
                    on_surface,
                }));
            }
            let at_once = Crossing {
                surface,
                time: 0.0,
                time_rounding,
                time_error,
                state: state.clone(),
                kind: EventKind::AtStart,
                from: None,
                certainty,
            };
            return Ok((NextEvent::Crossing(at_once), leaving, None));
        }
        let clock = self.next_clock(horizon)?;
        let until = clock.map_or(horizon, |clock| clock.until);
        let search = Search {
            horizon: until,
            sampling_interval: self.limits.sampling_interval,
            intervals: self.limits.intervals,
            steps: self.limits.steps,
            time: time.value(),
            leaving: &leaving,
            #[cfg(feature = "ode")]
            ahead: self.ahead.steps(until),
        };
        // No time is left: the rules of the start have decided.
        let found = match search.horizon == 0.0 {
            true => NextEvent::None { state: Some(state.clone()), certainty: Certainty::Certain },
            false => self.system.first_crossing(mode, state, &search)?,
        };
        if let (NextEvent::Crossing(crossing), Some(clock)) = (&found, clock) {
            self.check_order(crossing, clock)?;
        }
        let found = match (found, clock) {
            (NextEvent::None { state: end, certainty }, Some(clock)) => {
                let state = end.unwrap_or_else(|| flow_to(&flow, clock.until));
                NextEvent::Crossing(clock.crossing(state, certainty))
            }
            (found, _) => found,
        };
        Ok((found, leaving, clock))
    }

    /// An error for a jump that is undone at the instant of a tick: forward the tick came after the jump, so that it would have to be
    /// undone before.
    fn check_order(
        &self,
        crossing: &Crossing<T::Surface, T::State>,
        clock: ClockEvent<T::Surface>,
    ) -> Result<(), Error> {
        let mut guards = self.system.guards(self.at.mode).iter();
        let undoes = guards.any(|g| g.surface == crossing.surface && g.role == Role::Undone);
        if !undoes || crossing.time + crossing.time_rounding < clock.until {
            return Ok(());
        }
        let (jump, clock) = (crossing.surface, clock.surface);
        let time = self.at.time.value() + crossing.time;
        let reason = format!(
            "backward the jump of {jump:?} and the tick of {clock:?} are at one instant, {time}: in which order they are undone is \
             not decided; end the run before"
        );
        Err(Error::Model { reason })
    }

    /// The time from here to the limit, or to the next tick of a clock.
    ///
    /// # Errors
    /// Those of a clock that does not move on.
    #[cfg(feature = "ode")]
    pub(crate) fn horizon(&self) -> Result<f64, Error> {
        let horizon = self.at.time.up_to(self.limits.time);
        Ok(self.next_clock(horizon)?.map_or(horizon, |clock| clock.until))
    }

    /// How the next arc starts, and the guards on whose surfaces it does.
    pub(crate) fn start_of_arc(&self, horizon: f64) -> StartAndLeaving<T> {
        let Point { ref arrival, ref residues, initial, .. } = self.at;
        let mut leaving = LeavingGuards::new();
        let times = (horizon, self.limits.sampling_interval);
        let had = &|surface| self.at.chain.contains(surface);
        let start = start_of_arc(
            &self.flow(),
            arrival.as_ref(),
            residues,
            initial,
            times,
            had,
            &mut leaving,
        );
        (start, leaving)
    }

    /// The direction in which a guard has its event, if it comes `from` a side. A guard that counts both ways, in a model that
    /// solves for its events, comes from the side of its value at the start of the arc, or of that to which it left its zero.
    pub(crate) fn direction(
        &self,
        surface: T::Surface,
        (kind, from): (EventKind, Option<f64>),
        leaving: &LeavingGuards<T::Surface>,
    ) -> Option<Direction> {
        let mut guards = self.system.guards(self.at.mode).iter();
        let guard = guards.find(|guard| guard.surface == surface)?;
        match (kind, guard.direction) {
            (EventKind::Touch | EventKind::Clock, _) => None,
            (_, directed @ (Direction::Rising | Direction::Falling)) => Some(directed),
            (_, Direction::Either) => {
                let arrival = self.at.arrival.as_ref();
                let pending = arrival.and_then(|arrival| arrival.came_from(surface));
                let left = leaving.iter().find(|leaving| leaving.surface == surface);
                let now = || self.system.guard_value(surface, &self.at.state);
                let left = || left.map_or_else(now, |leaving| leaving.side);
                let from = from.or(pending).unwrap_or_else(left);
                (from != 0.0).then_some(match from < 0.0 {
                    true => Direction::Rising,
                    false => Direction::Falling,
                })
            }
        }
    }

    /// The clock with the earliest preset time, if that is within `horizon`.
    ///
    /// # Errors
    /// [`Error::BadLimit`] for a time that is not later than the present: the clock would never move on.
    pub(crate) fn next_clock(&self, horizon: f64) -> Result<Option<ClockEvent<T::Surface>>, Error> {
        let now = self.at.time.value();
        let guards = self.system.guards(self.at.mode).iter();
        let end = self.limits.time;
        let latest = if self.limits.ticks_at_end { end } else { end.next_down() };
        let mut earliest: Option<ClockEvent<T::Surface>> = None;
        for guard in guards.filter(|guard| guard.role == Role::Clock) {
            // A clock whose time is now, and that has not had its event yet, must not be lost.
            let before_all = self.at.at_start && !self.limits.ticks_at_start;
            let had_its_event = before_all || self.at.chain.contains(guard.surface);
            let after = if had_its_event { now } else { now.next_down() };
            let Some(time) = self.system.next_time(self.at.mode, guard.surface, after) else {
                continue;
            };
            if !(time > after) {
                let what = "a time of a clock that is not later than the time before it";
                return Err(Error::BadLimit { what, value: time });
            }
            // An infinite time never comes. Durations round: two times may have the same one, and so may a time and
            // the limit before it.
            let until = self.at.time.up_to(time);
            if time.is_finite()
                && until <= horizon
                && time <= latest
                && earliest.is_none_or(|first| time < first.time)
            {
                earliest = Some(ClockEvent { surface: guard.surface, until, time });
            }
        }
        Ok(earliest)
    }
}

/// The next event of a clock.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ClockEvent<S> {
    pub(crate) surface: S,
    /// Duration up to it.
    pub(crate) until: f64,
    /// Its time t.
    pub(crate) time: f64,
}

impl<S> ClockEvent<S> {
    /// The event, at a state. Its time has no error.
    pub(crate) fn crossing<X>(self, state: X, certainty: Certainty) -> Crossing<S, X> {
        Crossing {
            surface: self.surface,
            time: self.until,
            time_rounding: 0.0,
            time_error: 0.0,
            state,
            kind: EventKind::Clock,
            from: None,
            certainty,
        }
    }
}

/// The state at a time of a flow; the start itself at time zero.
pub(crate) fn flow_to<T: HybridSystem>(flow: &FlowFrom<T>, time: f64) -> T::State {
    if time == 0.0 { flow.start.clone() } else { flow.system.flow(flow.mode, flow.start, time) }
}
