//! The motion of a model by its equations.

use super::label::Label;
use super::part::vector;
use super::programs::{ModeProgram, Programs};
use super::start::Start;
use crate::crossing::{NextEvent, Search};
use crate::error::Error;
use crate::execution::Execution;
use crate::guard::Role;
use crate::model::{Model, ModelPart, Motion};
use crate::ode::{Tolerances, last_time, taylor_crossing, taylor_states};
use crate::state::StateVector;
use crate::system::{HybridSystem, default_search};
use equations::Series;
use std::sync::Arc;

/// The tolerance of a model that states none, relative and absolute. Taylor's method takes a quarter more time for it than
/// for 1e-10; a smaller one is lost in rounding.
const TOLERANCE: f64 = 1e-12;

/// A motion whose field is formulas: it is integrated by Taylor's method.
#[derive(Debug, Clone)]
pub struct TaylorMotion {
    pub(super) programs: Arc<Programs>,
    pub(super) tolerances: Tolerances,
}

impl TaylorMotion {
    pub(super) fn new(programs: Arc<Programs>) -> Self {
        TaylorMotion { programs, tolerances: Tolerances::both(TOLERANCE) }
    }

    /// True if the time is the last component of the state.
    fn is_timed(&self) -> bool {
        self.programs.dimension > self.programs.equations.names().states.len()
    }

    /// The error of a state with another number of components.
    fn other_dimension(&self, found: usize) -> Error {
        let expected = self.programs.dimension;
        let what = match self.is_timed() {
            true => "the state, or its type, with the time as the last component,",
            false => "the state, or its type,",
        };
        Error::Dimension { what, expected, found }
    }

    pub(super) fn mode(&self, mode: Label) -> Result<&ModeProgram, Error> {
        self.programs.mode(mode).ok_or_else(|| Error::NoVectorField { mode: format!("{mode:?}") })
    }
}

impl<X: StateVector> Motion<Label, X> for TaylorMotion {
    /// All components are NaN if the integration fails.
    fn flow<T>(&self, system: &T, mode: Label, start: &X, time: f64) -> X
    where
        T: HybridSystem<Mode = Label, State = X>,
    {
        let states = self.states(system, mode, start, &[time]);
        let end = states.ok().and_then(|mut states| states.pop());
        end.unwrap_or_else(|| start.filled(|_| f64::NAN))
    }

    fn states<T>(&self, _: &T, mode: Label, start: &X, times: &[f64]) -> Result<Vec<X>, Error>
    where
        T: HybridSystem<Mode = Label, State = X>,
    {
        let program = self.mode(mode)?;
        let last = last_time(times)?.unwrap_or(0.0);
        let motion = program.closed_form(start.components());
        let Some(motion) = motion.filter(|own| own.is_sharp_until(last, &self.tolerances)) else {
            let of = |series: &Series| taylor_states(series, start, times, &self.tolerances);
            // Steps end where a guard has no value. The motion goes on.
            return of(&program.series).or_else(|error| match program.guards.is_empty() {
                true => Err(error),
                false => of(&Series::new(&program.field, None)?),
            });
        };
        let at = |time: f64| start.filled(|axis| motion.components[axis].value(time));
        Ok(times.iter().map(|&time| if time == 0.0 { start.clone() } else { at(time) }).collect())
    }

    fn field(&self, mode: Label, state: &X) -> Option<X> {
        Some(vector(&self.programs.mode(mode)?.field, state))
    }

    fn first_crossing<T>(
        &self,
        system: &T,
        mode: Label,
        start: &X,
        search: &Search<T::Surface>,
    ) -> Result<NextEvent<T::Surface, X>, Error>
    where
        T: HybridSystem<Mode = Label, State = X>,
    {
        let program = self.mode(mode)?;
        // The equations' guards come first among those of a mode.
        let own = program.guards.len();
        let searched = || system.guards(mode).iter().filter(|guard| guard.role != Role::Clock);
        if searched().count() == own
            && search.horizon.is_finite()
            && let Some(motion) = program.closed_form(start.components())
        {
            let found = default_search(system, mode, start, search);
            let end = match &found {
                Ok(NextEvent::Crossing(crossing)) => crossing.time,
                Ok(NextEvent::Unfinished { time, .. }) => *time,
                Ok(NextEvent::None { .. }) | Err(_) => search.horizon,
            };
            if motion.is_sharp_until(end, &self.tolerances) {
                return found;
            }
        }
        let watched = searched().enumerate().map(|(place, _)| (place < own).then_some(place));
        let motion = (&program.series, watched.collect());
        match taylor_crossing(system, mode, start, (search, self.tolerances), motion) {
            // Without guards nothing was integrated: the end of the arc, or why it is not reached.
            Ok(NextEvent::None { state: None, certainty }) if search.horizon.is_finite() => {
                let state = self.states(system, mode, start, &[search.horizon])?.pop();
                Ok(NextEvent::None { state, certainty })
            }
            Err(Error::NotFinite { at, value }) => {
                let state = self.states(system, mode, start, &[at]).ok().and_then(|mut s| s.pop());
                let part = state.and_then(|state| guard_without_value(program, &state));
                Err(part.map_or(Error::NotFinite { at, value }, |error| error.later(at).into()))
            }
            found => found,
        }
        .map_err(|error| match error {
            // The time of an arc begins at zero.
            Error::Formula(error) => Error::Formula(error.later(search.time)),
            other => other,
        })
    }

    fn validate(&self, mode: Label, start: &X) -> Result<(), Error> {
        self.mode(mode)?;
        let (expected, found) = (self.programs.dimension, start.dimension());
        if expected != found {
            return Err(self.other_dimension(found));
        }
        self.tolerances.check(found)
    }
}

/// The error of the first guard that has no value at a state.
fn guard_without_value<X: StateVector>(
    program: &ModeProgram,
    state: &X,
) -> Option<equations::Error> {
    let values = program.guards.iter().map(|guard| guard.function.values(0.0, state.components()));
    values.filter_map(Result::err).next()
}

impl<X, P> Model<Label, Label, X, TaylorMotion, P> {
    /// The same model, integrated with this relative and absolute tolerance. Default: 1e-12.
    pub fn tolerance(self, tolerance: f64) -> Self {
        self.tolerances(Tolerances::both(tolerance))
    }

    /// The same model, integrated with these tolerances.
    pub fn tolerances(mut self, tolerances: Tolerances) -> Self {
        self.motion.tolerances = tolerances;
        self
    }

    /// The equations of the model.
    pub fn equations(&self) -> &super::Equations {
        &self.motion.programs.equations
    }

    /// The number of components of a state, with the time if formulas use it.
    pub fn dimension(&self) -> usize {
        self.motion.programs.dimension
    }

    /// The series of a mode, with its guards as watched formulas; `None` if the equations have no such mode.
    pub fn series(&self, mode: &str) -> Option<&Series> {
        Some(&self.motion.programs.mode(Label::new(mode).ok()?)?.series)
    }
}

impl<X, P> Model<Label, Label, X, TaylorMotion, P>
where
    X: StateVector,
    P: ModelPart<Label, Label, X>,
{
    /// The execution from `start` in the mode with this name, up to the time `time` and at most a million events: an
    /// iterator over its arcs. It begins at the time zero. A start that contains a time keeps it for the formulas, while events
    /// and clocks count from zero: [`start_at`](Self::start_at) gives one time to both.
    ///
    /// # Errors
    /// [`Error::NoVectorField`] for a mode that the equations do not have; [`Error::Dimension`] for a start with another
    /// number of components.
    pub fn start(
        &self,
        mode: &str,
        start: impl Start<X>,
        time: f64,
    ) -> Result<Execution<'_, Self>, Error> {
        let (mode, start) = (Label::new(mode)?, self.start_state(start, 0.0)?);
        self.validate(mode, &start)?;
        Ok(self.with_ticks(self.run(mode, start, time)))
    }

    /// The same from a time on, up to another one. Formulas have this time, also if the start has another one.
    ///
    /// ```
    /// use hybrid_system::{Equations, State};
    /// let ramp = Equations::new(&["x"], &[]).mode("m", |t, _, _| [t]).model::<State<2>>()?;
    /// let end = ramp.start_at("m", [0.0], (1.0, 3.0))?.fate();
    /// // ∫ t dt from 1 to 3.
    /// assert!((end.state[0] - 4.0).abs() < 1e-12 && end.time == 3.0);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`start`](Self::start).
    pub fn start_at(
        &self,
        mode: &str,
        start: impl Start<X>,
        (from, to): (f64, f64),
    ) -> Result<Execution<'_, Self>, Error> {
        let (mode, mut start) = (Label::new(mode)?, self.start_state(start, from)?);
        if self.motion.is_timed()
            && let Some(time) = start.components_mut().last_mut()
        {
            *time = from;
        }
        self.validate(mode, &start)?;
        Ok(self.with_ticks(self.run(mode, start, to)).starting_at(from))
    }

    /// Backward a tick at the start has been one at the end, and the other way round.
    fn with_ticks<'m>(&self, mut run: Execution<'m, Self>) -> Execution<'m, Self> {
        if self.equations().backward {
            (run.limits.ticks_at_start, run.limits.ticks_at_end) = (true, false);
        }
        run
    }

    fn start_state(&self, start: impl Start<X>, time: f64) -> Result<X, Error> {
        let dimension = self.motion.programs.dimension;
        start
            .state(dimension, self.motion.is_timed().then_some(time))
            .map_err(|found| self.motion.other_dimension(found))
    }
}
