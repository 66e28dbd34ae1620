//! The arcs of an execution by their ends: an event, a limit, a sliding surface, a Zeno limit.

use crate::arc::{Arc, ArcEnd, Event};
use crate::arrival::{Arrival, DurationOfArc};
use crate::before_limit::Passing;
use crate::crossing::{Certainty, Crossing, EventKind, LeavingGuards};
use crate::error::Error;
use crate::execution::{AnArc, Execution};
use crate::guard::Role;
use crate::limits::Stop;
use crate::missed::check_missed;
use crate::next_event::{ClockEvent, flow_to};
use crate::sliding::{AtOnce, Sliding, sliding_point};
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem, Reset};
use crate::time_sum::TimeSum;
use crate::zeno::ZenoLimit;

impl<T: HybridSystem> Execution<'_, T> {
    /// An arc that ends in an event, before a clock if there is one.
    pub(crate) fn event_arc(
        &mut self,
        mut crossing: Crossing<T::Surface, T::State>,
        (horizon, clock): (f64, Option<ClockEvent<T::Surface>>),
        leaving: LeavingGuards<T::Surface>,
    ) -> Result<AnArc<T>, Error> {
        let own_error = crossing.time_error;
        crossing.time_error += self.error_by_passed(&crossing);
        let counts = self.counts(&crossing)?;
        if !counts {
            self.pass(&crossing, own_error);
        }
        let Crossing {
            surface,
            time: duration,
            time_rounding,
            time_error,
            state,
            kind,
            from,
            certainty,
        } = crossing;
        let before = self.at.time.value();
        self.check_state(before + duration, &state)?;
        // The searches of this crate certify less, and miss no change of sign.
        if certainty == Certainty::Exact && kind != EventKind::AtStart {
            check_missed(
                &self.flow(),
                &self.at.residues,
                Some(surface),
                &state,
                (duration, time_rounding),
            )?;
        }
        // The sum of the rounded duration may miss the time of a clock, or the limit, by a rounding. The clock would
        // then have its time once more, or a time that is over.
        let mut time = self.at.time.plus(duration);
        let latest = clock.map_or(self.limits.time, |clock| clock.time);
        let is_tick = clock.is_some_and(|clock| clock.surface == surface);
        if time.value() > latest || is_tick && kind == EventKind::Clock {
            time = TimeSum::new(latest);
        }
        let time_passes = time.value() > before;
        if time_passes {
            self.at.time_changes();
        } else if time.since(self.at.time) > 0.0 && duration > time_rounding {
            self.at.chain.moves_on();
        }
        self.at.chain.push(self.at.mode, surface);
        self.at.chain.check(time.value())?;
        let mut resizes = false;
        let after = match self.system.reset(self.at.mode, surface, &state) {
            _ if !counts => Some((self.at.mode, state.clone())),
            Reset::Jump { mode, state: after } => {
                check_dimension("the state after a reset that is no `Resize`", &state, &after)?;
                Some((mode, after))
            }
            Reset::Resize { mode, state: after } => {
                resizes = true;
                Some((mode, after))
            }
            Reset::Stop => None,
        };
        if after.as_ref().is_some_and(|(_, after)| !after.is_finite())
            && let Some(error) =
                self.system.reset_error(self.at.mode, Some(surface), &state, time.value())
        {
            return Err(error);
        }
        let direction = self.direction(surface, (kind, from), &leaving);
        let end = ArcEnd::Event(Event {
            surface,
            time: time.value(),
            time_rounding,
            time_error,
            at_time_limit: (horizon - duration).abs() <= time_error,
            jump: self.at.jump,
            before: state.clone(),
            after: after.clone(),
            kind,
            direction,
            certainty,
        });
        let arc = self.new_arc(duration, end);
        if kind != EventKind::Clock {
            self.at.history.event(surface, time.value());
        }
        let solved = certainty == Certainty::Exact;
        let since_event = self.at.history.since_event;
        let length =
            DurationOfArc { duration, since_event, time_rounding, time_error, solved, from };
        self.remember((kind, surface), (&state, after.as_ref()), (length, leaving), time_passes);
        if let Some((_, after)) = &after
            && !resizes
        {
            // A reset that moves a guard off its surface leaves no residue.
            self.forget_residues(None, after, 0.0);
            let next = FlowFrom { system: self.system, mode: self.at.mode, start: after };
            let arrival = self.at.arrival.as_ref();
            if arrival.is_some_and(|arrival| arrival.is_beyond_jump(&next)) {
                self.at.residues.forget(surface);
            }
        }
        let same = |(mode, after): &(T::Mode, T::State)| *mode == self.at.mode && *after == state;
        let changes_nothing = after.as_ref().is_some_and(same);
        self.at.time = time;
        self.at.jump += usize::from(counts);
        self.at.initial = false;
        match after {
            Some((mode, after)) => {
                // An event that changes nothing, as that of an observer, divides one flow in two.
                if resizes {
                    self.forget_guards();
                } else if changes_nothing {
                    self.at.history.pass(duration);
                } else {
                    let by_division = match kind {
                        EventKind::Clock => 0.0,
                        _ => self.error_by_division(surface, &state, duration),
                    };
                    let error = time_error + by_division;
                    self.at.history.push(duration, error, time, after.clone());
                }
                (self.at.mode, self.at.state) = (mode, after);
            }
            None => {
                self.at.state = state;
                self.stop = Some(Stop::Terminal);
            }
        }
        Ok(arc)
    }

    /// An arc up to the limit on time, or for ever.
    ///
    /// # Errors
    /// [`Error::StateNotFinite`] if the flow is not defined at the limit.
    pub(crate) fn arc_without_event(
        &mut self,
        horizon: f64,
        end: Option<T::State>,
        certainty: Certainty,
        leaving: LeavingGuards<T::Surface>,
    ) -> Result<AnArc<T>, Error> {
        if !horizon.is_finite() {
            self.stop = Some(Stop::NoFurtherEvent);
            return Ok(self.new_arc(horizon, ArcEnd::Never { certainty }));
        }
        let flow = self.flow();
        let state = end.unwrap_or_else(|| flow_to(&flow, horizon));
        self.check_state(self.at.time.value() + horizon, &state)?;
        if certainty == Certainty::Exact {
            check_missed(&flow, &self.at.residues, None, &state, (horizon, 0.0))?;
        }
        let arc = self.new_arc(horizon, ArcEnd::TimeLimit { certainty });
        self.stop = Some(Stop::TimeLimit);
        self.advance(horizon, state, leaving);
        // The sum of the rounded duration may miss the limit.
        if self.at.time.value() != self.limits.time {
            self.at.time = TimeSum::new(self.limits.time);
        }
        Ok(arc)
    }

    /// Moves on to a state without an event.
    pub(crate) fn advance(
        &mut self,
        duration: f64,
        state: T::State,
        leaving: LeavingGuards<T::Surface>,
    ) {
        if duration > 0.0 {
            // A guard that reaches its surface just here, and passes through it after the limit, must not lose its
            // event.
            let (flow, length) =
                (self.flow(), DurationOfArc::given(duration, self.at.history.since_event));
            self.at.arrival = Some(Arrival::new(&flow, None, &state, (length, leaving)));
            self.forget_residues(None, &state, duration);
            self.at.history.pass(duration);
            self.at.time = self.at.time.plus(duration);
            self.at.state = state;
            self.at.time_changes();
            self.at.initial = false;
        }
    }

    /// The flow from the present state.
    pub(crate) fn flow(&self) -> FlowFrom<'_, T> {
        FlowFrom { system: self.system, mode: self.at.mode, start: &self.at.state }
    }

    /// An arc from the present state.
    pub(crate) fn new_arc(
        &self,
        duration: f64,
        end: ArcEnd<T::Mode, T::Surface, T::State>,
    ) -> AnArc<T> {
        Arc {
            mode: self.at.mode,
            time: self.at.time.value(),
            jump: self.at.jump,
            start: self.at.state.clone(),
            duration,
            end,
        }
    }

    /// The sliding point at which the execution is, if an event of `surface` at once leads back to the mode before.
    pub(crate) fn sliding(
        &self,
        surface: T::Surface,
    ) -> Option<Sliding<T::Mode, T::Surface, T::State>> {
        let last = self.at.chain.last();
        // A crossing of another surface says nothing about the distance from this one.
        let of_last = |arrival: &&Arrival<T::Mode, T::Surface, T::State>| {
            last.is_some_and(|(_, surface)| Some(surface) == arrival.surface())
        };
        let at = AtOnce {
            mode: self.at.mode,
            surface,
            state: &self.at.state,
            time: self.at.time.value(),
            last,
            before: self.at.arrival.as_ref().filter(of_last).and_then(Arrival::before),
        };
        sliding_point(self.system, &at)
    }

    /// The arc of no duration that ends on a sliding surface. The execution continues after it if the model gives a
    /// mode.
    pub(crate) fn sliding_arc(
        &mut self,
        sliding: Sliding<T::Mode, T::Surface, T::State>,
    ) -> AnArc<T> {
        let after = self.system.slide(&sliding);
        let arc = self.new_arc(0.0, ArcEnd::Sliding { sliding, after: after.clone() });
        self.at.jump += 1;
        self.at.initial = false;
        self.at.history.clear();
        match after {
            Some((mode, state)) => (self.at.mode, self.at.state) = (mode, state),
            None => self.stop = Some(Stop::Sliding),
        }
        arc
    }

    /// The arc that replaces infinitely many events up to their limit. The execution continues after it if the model
    /// gives a mode.
    pub(crate) fn zeno_arc(
        &mut self,
        limit: ZenoLimit<T::State>,
        passing: &[Passing<T::Surface>],
    ) -> Result<AnArc<T>, Error> {
        let after = self.system.rest(self.at.mode, &limit.state);
        if let Some((_, after)) = &after {
            check_dimension("the state after a Zeno limit", &limit.state, after)?;
            let time = self.at.time.plus(limit.remainder).value();
            if !after.is_finite()
                && let Some(error) = self.system.reset_error(self.at.mode, None, &limit.state, time)
            {
                return Err(error);
            }
        }
        let (remainder, state) = (limit.remainder, limit.state.clone());
        let passed = passing.iter().map(|guard| (guard.surface, guard.from)).collect();
        let arrival = Arrival::at_zeno(self.at.mode, &state, limit.time_error, passed);
        let end = ArcEnd::Zeno { limit, after: after.clone() };
        let arc = self.new_arc(remainder, end);
        let before = self.at.time.value();
        self.at.time = self.at.time.plus(remainder);
        self.at.jump += 1;
        self.at.initial = false;
        self.at.history.clear();
        let guards = self.system.guards(self.at.mode).iter();
        let clocks = guards.filter(|guard| guard.role == Role::Clock);
        // A clock that has ticked at the time of the limit does not tick again.
        match self.at.time.value() > before {
            true => self.at.time_changes(),
            false => {
                self.at.chain.keep(|surface| clocks.clone().any(|clock| clock.surface == surface))
            }
        }
        self.at.arrival = Some(arrival);
        self.at.residues.clear();
        match after {
            Some((mode, state)) => (self.at.mode, self.at.state) = (mode, state),
            None => {
                self.at.state = state;
                self.stop = Some(Stop::Zeno);
            }
        }
        Ok(arc)
    }
}

/// An error unless a vector has the dimension of the state.
fn check_dimension<X: StateVector>(what: &'static str, state: &X, other: &X) -> Result<(), Error> {
    let (expected, found) = (state.dimension(), other.dimension());
    if expected == found { Ok(()) } else { Err(Error::Dimension { what, expected, found }) }
}
