//! What comes before a Zeno limit, and what is passed at it?
//!
//! Infinitely many events lead to the limit. A clock, and a guard that none of them belongs to, may have its event
//! before:
//!
//! | the event comes | the flow can be followed | rounding hides the next event |
//! |---|---|---|
//! | clearly before the limit | the flow is followed on | the event is on the straight path to the limit, with the remaining time as its error |
//! | at the limit, within its error | the clock: at the limit's state; the guard: at the start of the next arc | the same |

use crate::crossing::{Certainty, Crossing, EventKind, GuardedFlow, LeavingGuards};
use crate::error::Error;
use crate::execution::{AnArc, Execution};
use crate::guard::{Guard, Role};
use crate::next_event::{ClockEvent, flow_to};
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

impl<T: HybridSystem> Execution<'_, T> {
    /// The arc up to a Zeno limit, or to a clock within the error of the limit; `None` if the flow has to be followed.
    pub(crate) fn arc_to_limit(&mut self, limit: Limit<T>, horizon: f64) -> MaybeArc<T> {
        // The times of clocks are known: they have no limit, whatever their series so far.
        if !self.at.history.has_limit(&limit) {
            return Ok(None);
        }
        let passing = self.passing(&limit);
        if passing.iter().any(|guard| guard.clearly) {
            return Ok(None);
        }
        match self.next_clock(limit.remainder)? {
            None => Ok(Some(self.zeno_arc(limit, &passing))),
            Some(clock) if clock.until < limit.remainder - limit.time_error => Ok(None),
            // Within the error of the limit the order is not known. A guard must not be lost at the state of the clock.
            Some(clock) => match self.first_on_path(&limit, &passing)? {
                Some(mut event) => {
                    event.time = event.time.min(clock.until);
                    self.event_arc(event, horizon, LeavingGuards::new()).map(Some)
                }
                None => {
                    let event = clock.crossing(limit.state, Certainty::Interpolated);
                    self.event_arc(event, horizon, LeavingGuards::new()).map(Some)
                }
            },
        }
    }

    /// The next arc if rounding hides the next event on the way to a Zeno limit, and with it how far the events up to
    /// a clock, a guard or the limit on time move the state.
    pub(crate) fn hidden_arc(&mut self, limit: Limit<T>, horizon: f64) -> Result<AnArc<T>, Error> {
        let (leaving, certainty) = (LeavingGuards::new(), Certainty::Interpolated);
        let mut passing = self.passing(&limit);
        let clock = self.next_clock(limit.remainder.min(horizon))?;
        let latest = clock.map_or(horizon, |clock: ClockEvent<T::Surface>| clock.until);
        passing.retain(|guard| guard.clearly);
        let first = self.first_on_path(&limit, &passing)?;
        if let Some(event) = first.filter(|event| event.time <= latest) {
            return self.event_arc(event, horizon, leaving);
        }
        match clock {
            Some(clock) => {
                let state = flow_to(&self.flow(), clock.until);
                self.event_arc(clock.crossing(state, certainty), horizon, leaving)
            }
            None if limit.remainder <= horizon => {
                let passing = self.passing(&limit);
                Ok(self.zeno_arc(limit, &passing))
            }
            None => self.arc_without_event(horizon, None, certainty, leaving),
        }
    }

    /// The guards that change their side, in a direction that counts, between now and a Zeno limit, and whose events do not
    /// lead there.
    fn passing(&self, limit: &Limit<T>) -> PassingGuards<T::Surface> {
        let flow = self.flow();
        // The state at the limit is extrapolated as far as the time.
        let error = limit.time_error / limit.remainder;
        let passes = |guard: &Guard<T::Surface>| {
            let surface = guard.surface;
            let [now, then] =
                [&self.at.state, &limit.state].map(|state| flow.guard_value(surface, state));
            let other = now * then < 0.0 && guard.direction.admits(now.signum(), then.signum());
            if !other || self.at.history.leads_to(limit, surface) {
                return None;
            }
            let hidden = flow.rounding_at(surface, &limit.state) + error * (then - now).abs();
            Some(Passing { surface, from: now.signum(), clearly: then.abs() > hidden })
        };
        let guards = flow.guards().iter().filter(|guard| guard.role != Role::Clock);
        guards.filter_map(passes).collect()
    }

    /// The first event of these guards on the straight path to a limit.
    fn first_on_path(
        &self,
        limit: &Limit<T>,
        passing: &PassingGuards<T::Surface>,
    ) -> Result<Option<Crossing<T::Surface, T::State>>, Error> {
        let flow = self.flow();
        let mut step = limit.state.clone();
        step.add_scaled(-1.0, &self.at.state);
        let state_at = |part: f64| {
            let mut state = self.at.state.clone();
            state.add_scaled(part, &step);
            state
        };
        let mut first: Option<(f64, &Passing<T::Surface>)> = None;
        for guard in passing {
            let along = |part: f64| flow.guard_value(guard.surface, &state_at(part));
            let [now, then] = [0.0, 1.0].map(along);
            // The sum of the state and the step rounds: the limit itself is on the other side.
            let part = match now * then < 0.0 {
                true => root_beyond(along, (0.0, now), (1.0, then))?,
                false => 1.0,
            };
            if first.is_none_or(|(earlier, _)| part < earlier) {
                first = Some((part, guard));
            }
        }
        let crossing = |(part, guard): (f64, &Passing<T::Surface>)| Crossing {
            surface: guard.surface,
            time: part * limit.remainder,
            time_rounding: 0.0,
            time_error: limit.remainder + limit.time_error,
            state: state_at(part),
            kind: EventKind::Crossing,
            from: Some(guard.from),
            certainty: Certainty::Interpolated,
        };
        Ok(first.map(crossing))
    }
}
