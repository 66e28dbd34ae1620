//! Arcs and their ends as Python objects.

use super::callables::Callables;
use super::model::Model;
use super::names::{ExecutionMode, ExecutionSurface};
use super::quasi_polynomial::name_of;
use super::sliding::Sliding;
use super::vectors::{State, copied, numbers, state_rows};
use crate::errors::InputError;
use crate::pickling::{Reduced, equal, plain, reduced, refused};
use hybrid_system::{Arc as LibraryArc, ArcEnd, Certainty, EventKind, StateVector};
use pyo3::prelude::*;
use std::sync::Arc;

/// An event: a jump between two arcs.
#[pyclass(frozen, get_all, module = "nonsmooth.hybrid")]
#[derive(Debug)]
pub(crate) struct Event {
    /// The name of the guard; "NAME: end of sliding" where the field of one side turns tangent to the guard of this
    /// name.
    surface: String,
    /// The time.
    time: f64,
    /// The error of the duration of the arc before it: a bound for closed forms, an estimate for integrated flows.
    time_error: f64,
    /// How far the zero of the guard along the computed trajectory may be, by rounding.
    time_rounding: f64,
    /// Whether the limit on time lies within time_error of the event.
    at_time_limit: bool,
    /// The number of events before this one.
    jump: usize,
    /// The state before the jump.
    before: Py<PyAny>,
    /// The mode after it; None if the execution ends here.
    next_mode: Option<Py<PyAny>>,
    /// The state after it; None if the execution ends here.
    after: Option<Py<PyAny>>,
    /// "crossing", "touch", "at start" or "clock".
    kind: String,
    /// How the guard has changed its sign, "rising" or "falling"; None for a touch and a clock.
    direction: Option<String>,
    /// How certain it is that no event came before: "exact", "certain", "interpolated" or "sampled".
    certainty: String,
}

/// The limit of infinitely many events in finite time.
#[pyclass(frozen, get_all, module = "nonsmooth.hybrid")]
#[derive(Debug)]
pub(crate) struct Zeno {
    /// The time of the limit.
    time: f64,
    /// Bound on its error, if the series of durations goes on as it was.
    time_error: f64,
    /// The state at the limit, extrapolated.
    state: Py<PyAny>,
    /// Estimate of its error.
    state_error: f64,
    /// The factor by which the time to the limit shrinks in one period.
    ratio: f64,
    /// The number of events in one period.
    period: usize,
    /// The mode after the limit; None if the execution ends there.
    next_mode: Option<Py<PyAny>>,
    /// The state after the limit; None if the execution ends there.
    after: Option<Py<PyAny>>,
}

/// A piece of continuous motion in one mode, between two events.
#[pyclass(frozen, name = "Arc", module = "nonsmooth.hybrid")]
#[derive(Debug)]
pub(crate) struct HybridArc {
    model: Arc<Model>,
    own: OwnArc,
}

/// The mode and the state after an event or a limit, if the execution goes on.
type Next = (Option<Py<PyAny>>, Option<Py<PyAny>>);

/// An arc of the library.
pub(crate) type OwnArc = LibraryArc<ExecutionMode, ExecutionSurface, State>;

#[pymethods]
impl HybridArc {
    /// The mode; a SlidingMode along a surface.
    #[getter]
    fn mode(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.model.mode_object(py, self.own.mode)
    }

    /// The time at the start.
    #[getter]
    fn time(&self) -> f64 {
        self.own.time
    }

    /// The number of events before the arc.
    #[getter]
    fn jump(&self) -> usize {
        self.own.jump
    }

    /// The state at the start.
    #[getter]
    fn start(&self, py: Python<'_>) -> Py<PyAny> {
        copied(py, &self.own.start)
    }

    /// The duration; infinite if the arc never ends.
    #[getter]
    fn duration(&self) -> f64 {
        self.own.duration
    }

    /// How it ends: "event", "zeno", "sliding", "time limit", "never", or "unfinished" if a budget of the search ended.
    #[getter]
    fn end(&self) -> &'static str {
        match self.own.end {
            ArcEnd::Event(_) => "event",
            ArcEnd::Zeno { .. } => "zeno",
            ArcEnd::Sliding { .. } => "sliding",
            ArcEnd::TimeLimit { .. } => "time limit",
            ArcEnd::Never { .. } => "never",
            ArcEnd::Unfinished { .. } => "unfinished",
        }
    }

    /// How certain it is that no event is missed: "exact", "certain", "interpolated" or "sampled"; None at a Zeno
    /// limit and where it slides.
    #[getter]
    fn certainty(&self) -> Option<&'static str> {
        match &self.own.end {
            ArcEnd::Event(event) => Some(certainty(event.certainty)),
            ArcEnd::TimeLimit { certainty: how }
            | ArcEnd::Never { certainty: how }
            | ArcEnd::Unfinished { certainty: how } => Some(certainty(*how)),
            ArcEnd::Zeno { .. } | ArcEnd::Sliding { .. } => None,
        }
    }

    /// The event at the end; None if the arc ends in another way.
    #[getter]
    fn event(&self, py: Python<'_>) -> PyResult<Option<Event>> {
        let Some(event) = self.own.event() else { return Ok(None) };
        let surface = |surface: &ExecutionSurface| self.model.event_name(*surface);
        Event::of(py, event, surface, |mode| self.model.mode_object(py, *mode)).map(Some)
    }

    /// The Zeno limit at the end; None if the arc ends in another way.
    #[getter]
    fn zeno(&self, py: Python<'_>) -> PyResult<Option<Zeno>> {
        let ArcEnd::Zeno { limit, after } = &self.own.end else { return Ok(None) };
        let (next_mode, after) = self.next(py, after.as_ref())?;
        Ok(Some(Zeno {
            time: limit.time,
            time_error: limit.time_error,
            state: copied(py, &limit.state),
            state_error: limit.state_error,
            ratio: limit.ratio,
            period: limit.period,
            next_mode,
            after,
        }))
    }

    /// The sliding point at the end; None if the arc ends in another way.
    #[getter]
    fn sliding(&self, py: Python<'_>) -> PyResult<Option<Sliding>> {
        match &self.own.end {
            ArcEnd::Sliding { sliding, .. } => Sliding::of(py, &self.model, sliding).map(Some),
            _ => Ok(None),
        }
    }

    /// The states at rising times after the start of the arc, one row for each.
    fn states<'py>(
        &self,
        py: Python<'py>,
        elapsed: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let elapsed = numbers(elapsed)?;
        if let Some(&bad) = elapsed.iter().find(|&&time| !(time >= 0.0 && time.is_finite())) {
            return Err(InputError::new_err(format!(
                "a time after the start of an arc must be finite and not negative, not {bad:?}"
            )));
        }
        if let Some(at) = elapsed.windows(2).position(|pair| pair[1] < pair[0]) {
            return Err(InputError::new_err(format!(
                "the times after the start of an arc must rise: elapsed[{}]={:?} is before elapsed[{at}]={:?}",
                at + 1,
                elapsed[at + 1],
                elapsed[at]
            )));
        }
        if let Some(&late) = elapsed.iter().find(|&&time| time > self.own.duration) {
            return Err(InputError::new_err(format!(
                "the arc lasts {:?}, and has no state {late:?} after its start",
                self.own.duration
            )));
        }
        let system = Callables::with_sliding(py, &self.model);
        let found = self.own.states(&system, &elapsed);
        if let Some(exception) = system.system().exception() {
            return Err(exception);
        }
        let states = found.map_err(|error| system.system().raised(&error))?;
        let dimension = self.own.start.dimension();
        state_rows(py, &states, dimension)
    }

    fn __reduce__(&self, py: Python<'_>) -> PyResult<()> {
        Err(refused(py, "an Arc, which computes its states", &self.model.functions()))
    }

    /// It never changes.
    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: Py<PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let mode = self.mode(py)?.bind(py).repr()?.to_string();
        let (time, duration, end) = (self.own.time, self.own.duration, self.end());
        Ok(format!("Arc(mode={mode}, time={time:?}, duration={duration:?}, end={end:?})"))
    }
}

impl HybridArc {
    pub(crate) fn new(model: Arc<Model>, own: OwnArc) -> Self {
        HybridArc { model, own }
    }

    fn next(&self, py: Python<'_>, after: Option<&(ExecutionMode, State)>) -> PyResult<Next> {
        let mode = after.map(|(mode, _)| self.model.mode_object(py, *mode)).transpose()?;
        Ok((mode, after.map(|(_, state)| copied(py, state))))
    }

    pub(super) fn model(&self) -> &Arc<Model> {
        &self.model
    }

    pub(super) fn own(&self) -> &OwnArc {
        &self.own
    }
}

impl Event {
    /// An event of the library, with the names of its surface and of its mode.
    pub(crate) fn of<M, S>(
        py: Python<'_>,
        event: &hybrid_system::Event<M, S, State>,
        surface: impl Fn(&S) -> String,
        mode: impl Fn(&M) -> PyResult<Py<PyAny>>,
    ) -> PyResult<Self> {
        let after = event.after.as_ref();
        Ok(Event {
            surface: surface(&event.surface),
            time: event.time,
            time_error: event.time_error,
            time_rounding: event.time_rounding,
            at_time_limit: event.at_time_limit,
            jump: event.jump,
            before: copied(py, &event.before),
            next_mode: after.map(|(next, _)| mode(next)).transpose()?,
            after: after.map(|(_, state)| copied(py, state)),
            kind: kind(event.kind).to_owned(),
            direction: event.direction.map(|direction| name_of(direction).to_owned()),
            certainty: certainty(event.certainty).to_owned(),
        })
    }
}

pub(crate) fn kind(kind: EventKind) -> &'static str {
    match kind {
        EventKind::Crossing => "crossing",
        EventKind::Touch => "touch",
        EventKind::AtStart => "at start",
        EventKind::Clock => "clock",
    }
}

pub(crate) fn certainty(certainty: Certainty) -> &'static str {
    match certainty {
        Certainty::Exact => "exact",
        Certainty::Certain => "certain",
        Certainty::Interpolated => "interpolated",
        Certainty::Sampled { .. } => "sampled",
    }
}

plain!(Event {
    surface,
    time,
    time_error,
    time_rounding,
    at_time_limit,
    jump,
    before,
    next_mode,
    after,
    kind,
    direction,
    certainty
});

#[pymethods]
impl Event {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        equal(slf, other)
    }

    fn __repr__(&self) -> String {
        let Event { surface, time, kind, certainty, .. } = self;
        format!("Event({surface:?}, time={time:?}, kind={kind:?}, certainty={certainty:?})")
    }
}

plain!(Zeno { time, time_error, state, state_error, ratio, period, next_mode, after });

#[pymethods]
impl Zeno {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        equal(slf, other)
    }

    fn __repr__(&self) -> String {
        let Zeno { time, time_error, ratio, period, .. } = self;
        format!("Zeno(time={time:?}, time_error={time_error:?}, ratio={ratio:?}, period={period})")
    }
}
