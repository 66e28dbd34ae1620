//! A run of a set of states: step after step, event after event.

use crate::certificate::Record;
use crate::event::{ProvedEvent, holds, jumped};
use crate::limits::Limits;
use crate::matrix::Matrix;
use crate::piece::Piece;
use crate::set::{AffineSet, Chain};
use crate::surface_image::{OnSurface, on_surface};
use crate::system::{ValidatedMode, ValidatedSystem};
use crate::tube::Tube;
use crate::undecided::{Error, Reason};
use crate::window::{Crossing, First, Guards};
use hybrid_system::Label;
use interval_arithmetic::Enclosure;
use std::ops::ControlFlow;

/// A run of all states of a set. Each event that it returns is one of all states, with none before.
#[derive(Debug, Clone)]
pub struct ValidatedRun<'s> {
    system: &'s ValidatedSystem,
    limits: Limits,
    mode: usize,
    set: AffineSet,
    /// The derivatives of the states with respect to the first ones, if they are wanted.
    chain: Option<Chain>,
    time: Enclosure,
    /// For each guard of the mode, true if it is 0 at all states.
    on: Vec<bool>,
    /// True if the states have had an event that changed them at different times: at one time their derivatives are others then.
    apart: bool,
    /// True until the guards have been looked at in this arc.
    begins: bool,
    steps: usize,
    events: usize,
    ended: Option<Label>,
    /// What a certificate says of the run, if one is wanted.
    record: Option<Record>,
}

/// The part of the first step of an arc on which a flow that leads beyond a surface is recognised. A longer part would not recognise one that
/// comes back soon; the search calls this undecided.
const SOON: f64 = 1e-3;

/// What a run does in a step.
enum Moved {
    Flowed,
    Event(Box<ProvedEvent>),
}

impl<'s> ValidatedRun<'s> {
    /// A run of these states, of which guards in `on` are 0.
    pub(crate) fn new(
        system: &'s ValidatedSystem,
        mode: usize,
        set: AffineSet,
        chain: Option<Chain>,
        on: Vec<bool>,
    ) -> Self {
        let limits = Limits::default();
        ValidatedRun {
            system,
            limits,
            mode,
            set,
            chain,
            time: Enclosure::ZERO,
            on,
            apart: false,
            begins: true,
            steps: 0,
            events: 0,
            ended: None,
            record: None,
        }
    }

    /// The same run, which writes each step down. Its sets are the written ones, which are wider.
    pub(crate) fn recorded(mut self, mut record: Record) -> Self {
        self.set = record.begin(&self.set);
        self.record = Some(record);
        self
    }

    /// What was written down, without the flow behind the last event.
    pub(crate) fn into_record(self) -> Option<Record> {
        self.record
    }

    /// The same run within other limits.
    #[must_use]
    pub fn within(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// The time since the start.
    pub fn time(&self) -> Enclosure {
        self.time
    }

    /// The states.
    pub fn set(&self) -> &AffineSet {
        &self.set
    }

    /// The mode.
    pub fn mode(&self) -> Label {
        self.own().name
    }

    /// The same run without derivatives with respect to the start, in less time.
    #[must_use]
    pub fn without_derivatives(mut self) -> Self {
        self.chain = None;
        self
    }

    /// The derivatives of the states with respect to the variables of the start's box; `None` for a run without them.
    pub fn derivatives(&self) -> Option<Matrix> {
        self.chain.as_ref().map(Chain::matrix)
    }

    /// The steps that were made.
    pub fn steps(&self) -> usize {
        self.steps
    }

    fn own(&self) -> &'s ValidatedMode {
        &self.system.modes[self.mode]
    }

    /// The next event of all states. If it changes nothing, the run is a moment later afterwards: when all states have crossed the surface.
    ///
    /// # Errors
    /// [`Error::Undecided`] with what is not proved, where and when.
    pub fn next_event(&mut self) -> Result<ProvedEvent, Error> {
        self.next_event_watched(&mut |_| ControlFlow::Continue(()))
    }

    /// The same, with each step shown as it is proved: for dense output, progress, and interruption by
    /// [`ControlFlow::Break`].
    ///
    /// # Errors
    /// As [`next_event`](Self::next_event), with [`Reason::Interrupted`].
    pub fn next_event_watched(
        &mut self,
        watch: &mut dyn FnMut(&Piece<'_>) -> ControlFlow<()>,
    ) -> Result<ProvedEvent, Error> {
        loop {
            if let Moved::Event(event) = self.step(None, watch)? {
                return Ok(*event);
            }
            if self.time.low() > self.limits.time {
                return self.undecided(Reason::NoEvent { time: self.limits.time });
            }
        }
    }

    /// The states at a time since the start, and the events until then.
    ///
    /// After an event that changes the states, which happens at different times, they have no derivatives at a common time: these are `None` then. A
    /// model whose formulas use the time has them at a guard of the time.
    ///
    /// # Errors
    /// As [`next_event`](Self::next_event); [`Error::Argument`] for a time before that of the states.
    pub fn advance(&mut self, time: Enclosure) -> Result<Vec<ProvedEvent>, Error> {
        if !(time.low() >= self.time.high() && time.low() <= time.high() && time.high().is_finite())
        {
            return Error::argument(
                "time",
                format!("it must be finite, and at or after {}", self.time.high()),
            );
        }
        let mut events = Vec::new();
        while self.time != time {
            let moved = self.step(Some(time), &mut |_| ControlFlow::Continue(()))?;
            if let Moved::Event(event) = moved {
                events.push(*event);
            }
        }
        if self.apart {
            self.chain = None;
        }
        Ok(events)
    }

    /// One step, to `end` at most: up to its end, or up to an event.
    fn step(
        &mut self,
        end: Option<Enclosure>,
        watch: &mut dyn FnMut(&Piece<'_>) -> ControlFlow<()>,
    ) -> Result<Moved, Error> {
        if let Some(surface) = self.ended {
            return self.undecided(Reason::Stopped { surface });
        }
        if self.steps == self.limits.steps {
            return self.undecided(Reason::Steps { steps: self.limits.steps });
        }
        let width = self.set.hull().iter().map(Enclosure::width).fold(0.0, f64::max);
        if width > self.limits.width {
            return self.undecided(Reason::Wide { width, limit: self.limits.width });
        }
        self.steps += 1;
        let left = end.map(|end| end - self.time);
        // No step goes beyond the end for some states.
        let too_apart = Reason::Times { width: self.time.width() };
        let is_too_long = |length: f64| left.is_some_and(|left| length > left.low());
        if left.is_some_and(|left| !(left.low() > 0.0)) {
            return self.undecided(too_apart);
        }
        let longest = left.map_or(f64::INFINITY, |left| left.high());
        let set = self.set.clone();
        let mode = self.own();
        let (tube, first) = match self.proved_step(mode, &set, longest) {
            Ok(found) => found,
            Err(reason) => return self.undecided(reason),
        };
        let piece = Piece::new(&tube, self.time, &self.system.names.states, mode.name);
        if watch(&piece).is_break() {
            return self.undecided(Reason::Interrupted);
        }
        self.begins = false;
        let on = self.on.clone();
        let guards = Guards { tube: &tube, guards: &mode.guards, on: &on };
        match first {
            Err(reason) => self.undecided(reason),
            Ok(First::Crossing(crossing)) => {
                let surface = mode.guards[crossing.guard].surface;
                if left.is_some_and(|left| crossing.beyond >= left.low()) {
                    return self.undecided(Reason::EventAtEnd { surface });
                }
                match on_surface(&tube, mode, crossing.guard, crossing.times) {
                    Ok(found) => self.event(&guards, crossing, found),
                    Err(reason) => self.undecided(reason),
                }
            }
            Ok(First::Cut(time)) if is_too_long(time) => self.undecided(too_apart),
            Ok(First::Cut(time)) => self.flow(&tube, time),
            Ok(First::Nothing) => match left.filter(|left| tube.length >= left.high()) {
                Some(left) => self.flow_until(&tube, left, end),
                None if is_too_long(tube.length) => self.undecided(too_apart),
                None => self.flow(&tube, tube.length),
            },
        }
    }

    /// A step of at most this length, with what happens first on it. If this is an event, the step has derivatives.
    fn proved_step<'t>(
        &self,
        mode: &'t ValidatedMode,
        set: &'t AffineSet,
        longest: f64,
    ) -> Result<(Tube<'t>, Result<First, Reason>), Reason> {
        let look = |tube: &Tube<'_>| {
            if self.begins {
                self.check_begin(tube)?;
            }
            Guards { tube, guards: &mode.guards, on: &self.on }.first()
        };
        let for_others = self.record.is_some();
        let mut tube = Tube::new(&mode.series, set, longest, for_others, self.chain.is_some())?;
        let mut first = look(&tube);
        // Most often the derivatives are proved for the same step, which has the same event then.
        if matches!(first, Ok(First::Crossing(_))) && !tube.add_derivatives() {
            tube = Tube::new(&mode.series, set, tube.length, for_others, true)?;
            first = look(&tube);
        }
        Ok((tube, first))
    }

    /// The states after a time of a step.
    fn flow(&mut self, tube: &Tube<'_>, time: f64) -> Result<Moved, Error> {
        let Some(record) = &mut self.record else {
            return self.flow_until(tube, Enclosure::from(time), None);
        };
        let (time, after) = record.flow(tube, &self.system.modes[self.mode].guards, time);
        let moved = self.flow_until(tube, Enclosure::from(time), None)?;
        self.set = after;
        Ok(moved)
    }

    /// The same for an interval of times; `now` is the time then, if it is known better than by sums.
    fn flow_until(
        &mut self,
        tube: &Tube<'_>,
        time: Enclosure,
        now: Option<Enclosure>,
    ) -> Result<Moved, Error> {
        let derivatives = tube.derivatives_at(time);
        self.chain = self.chain.take().zip(derivatives).map(|(chain, own)| chain.then(&own));
        self.set = tube.set_at(time);
        self.time = now.unwrap_or(self.time + time);
        // No step has the length 0: a guard that is 0 at its start is not any more.
        self.on = vec![false; self.own().guards.len()];
        Ok(Moved::Flowed)
    }

    /// An error unless the states at the start of an arc are where its mode flows: on this side of each surface that bounds the flow, or on it
    /// and leaving it.
    fn check_begin(&self, tube: &Tube<'_>) -> Result<(), Reason> {
        for (place, guard) in self.own().guards.iter().enumerate() {
            let surface = guard.surface;
            let Some(beyond) = guard.side_beyond() else { continue };
            if self.on[place] {
                let soon = Enclosure::new(0.0, tube.length * SOON);
                if tube.guard(place).over_time(soon).sign() == Some(beyond) {
                    return Err(Reason::Beyond { surface });
                }
                continue;
            }
            let value = tube.guard_at(place, Enclosure::ZERO) * beyond;
            if value.is_positive() {
                return Err(Reason::Beyond { surface });
            }
            if value.high() > 0.0 {
                return Err(Reason::OnSurface { surface });
            }
        }
        Ok(())
    }

    fn event(
        &mut self,
        guards: &Guards<'_, '_>,
        crossing: Crossing,
        found: OnSurface,
    ) -> Result<Moved, Error> {
        let mode = self.own();
        let guard = &mode.guards[crossing.guard];
        let before = found.set.hull().to_vec();
        match holds(guard, &before) {
            Ok(true) => {}
            Ok(false) => return self.pass(guards, crossing, false),
            Err(reason) => return self.undecided(reason),
        }
        if self.events == self.limits.events {
            let (events, surface) = (self.limits.events, guard.surface);
            return self.undecided(Reason::Events { events, surface });
        }
        self.events += 1;
        let time = self.time + found.times;
        let arrived = self.chain.as_ref().map(|chain| chain.then(&found.derivatives));
        let (mut set, chain) = match jumped(guard, &found.set, arrived) {
            Ok(after) => after,
            Err(reason) => return self.undecided(reason),
        };
        if let Some(record) = &mut self.record {
            set = record.event(guard.surface, crossing.beyond, &set);
        }
        let event = ProvedEvent {
            surface: guard.surface,
            mode: mode.name,
            next: (!guard.stops).then(|| self.system.modes[guard.mode].name),
            time,
            before,
            after: set.hull().to_vec(),
            set: set.clone(),
            chain: chain.clone(),
        };
        if guard.observes {
            self.pass(guards, crossing, true)?;
        } else {
            self.ended = guard.stops.then_some(guard.surface);
            (self.mode, self.begins, self.apart) = (guard.mode, true, true);
            self.on.clone_from(&guard.begins_on);
            (self.set, self.chain, self.time) = (set, chain, time);
        }
        Ok(Moved::Event(Box::new(event)))
    }

    /// The flow goes on behind a surface at which nothing changes: from a time at which all states have crossed it.
    fn pass(
        &mut self,
        guards: &Guards<'_, '_>,
        crossing: Crossing,
        is_event: bool,
    ) -> Result<Moved, Error> {
        if let Err(reason) = guards.are_others_clear(crossing.guard, crossing.beyond) {
            return self.undecided(reason);
        }
        let moved = self.flow_until(guards.tube, Enclosure::from(crossing.beyond), None)?;
        if let Some(record) = &mut self.record {
            let surface = guards.guards[crossing.guard].surface;
            self.set = record.pass(surface, (crossing.beyond, &self.set), is_event);
        }
        Ok(moved)
    }

    /// The error that says what is not proved here.
    pub(crate) fn undecided<T>(&self, reason: Reason) -> Result<T, Error> {
        let states = (&self.system.names.states[..], self.set.hull());
        Err(Error::not_proved(reason, Some(self.own().name), self.time, states))
    }
}
