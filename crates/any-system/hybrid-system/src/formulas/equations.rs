//! A hybrid system by its equations: what a user writes, and what is stored.

use super::label::Label;
use super::motion::TaylorMotion;
use super::part::FormulaPart;
use super::programs::Programs;
use crate::clock::{ClockTimes, PeriodicTimes, PresetTimes};
use crate::error::Error;
use crate::guard::{Guard, Role};
use crate::model::Model;
use crate::state::StateVector;
use equations::{Formulas, Function, Names, Node};
use std::sync::Arc;

/// A hybrid system by its equations, written once, with the names of its variables, parameters, modes and surfaces.
///
/// Each closure is called once, with symbols for the time, the state and the parameters. So the equations are data: they
/// print, compare, and are written to JSON. [`model`](Self::model) makes the [`Model`] that is run. Its field is
/// integrated by Taylor's method, no zero of a guard along a Taylor polynomial is missed, and its derivatives are exact.
///
/// A thermostat. A room warms towards 30° and cools towards 10°:
///
/// ```
/// use hybrid_system::{Equations, State};
///
/// let room = Equations::new(&["room"], &[("outside", "10"), ("heater", "20")])
///     .mode("on", |_, x, p| [p["outside"] + p["heater"] - x[0]])
///     .rising("warm", |_, x, _| x[0] - 21.0)
///     .to("off")
///     .mode("off", |_, x, p| [p["outside"] - x[0]])
///     .falling("cold", |_, x, _| x[0] - 19.0)
///     .to("on")
///     .model::<State<1>>()?;
/// let mut events = Vec::new();
/// for arc in room.start("on", [15.0], 2.0)? {
///     events.extend(arc?.event().map(|event| (event.surface.to_string(), event.time)));
/// }
/// assert_eq!(events[0].0, "warm");
/// assert!((events[0].1 - (15f64 / 9.0).ln()).abs() < 1e-10);
/// assert_eq!(events[1].0, "cold");
/// # Ok::<(), hybrid_system::Error>(())
/// ```
///
/// A guard belongs to the mode that was declared last, and to all modes if none was. Behind it stands what its event does:
/// [`to`](Self::to) leads to another mode, [`resets`](Self::resets) gives the state after it, [`stops`](Self::stops) ends
/// the execution. A guard without any of these is an observer. Names of modes and surfaces have at most 31 bytes.
///
/// If a formula uses the time t, the state of the model has one component more than names, the time: of two names it is
/// [`State<3>`](crate::State). Derivatives know it then. [`start`](Model::start) and [`start_at`](Model::start_at) give its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Equations {
    pub(super) names: Names,
    /// The guards of all modes.
    pub(super) everywhere: Vec<GuardEquations>,
    pub(super) modes: Vec<ModeEquations>,
    /// What was wrong first.
    pub(super) wrong: Option<Error>,
    /// True for equations backward in time.
    pub(super) backward: bool,
}

/// The model of some [`Equations`], without closures.
pub type EquationsModel<X> = Model<Label, Label, X, TaylorMotion, FormulaPart>;

/// A mode by its equations.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ModeEquations {
    pub(super) name: Label,
    pub(super) field: Formulas,
    pub(super) guards: Vec<GuardEquations>,
    /// Where the execution goes on after a Zeno limit.
    pub(super) after_limit: Option<Jump>,
}

/// A guard by its equations.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct GuardEquations {
    pub(super) guard: Guard<Label>,
    pub(super) function: Formulas,
    /// Of a clock: true if the formulas are all its times, false if they are the first one and the period.
    pub(super) listed: bool,
    /// Its events count where this is positive.
    pub(super) condition: Option<Formulas>,
    /// What its event does; `None` ends the execution.
    pub(super) jump: Option<Jump>,
}

/// What an event does.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Jump {
    /// The next mode, if it is another one.
    pub(super) mode: Option<Label>,
    /// The next state, if it is another one.
    pub(super) state: Option<Formulas>,
    /// The state before, from the next one.
    pub(super) inverse: Option<Formulas>,
}

impl GuardEquations {
    /// True if its events change nothing.
    pub(super) fn observes(&self) -> bool {
        self.jump.as_ref().is_some_and(|jump| *jump == Jump::default())
    }

    /// The guard as a model lists it: an observer bounds no flow.
    fn declared(&self) -> Guard<Label> {
        match self.guard.role {
            Role::Switch if self.observes() => self.guard.crossing(),
            _ => self.guard,
        }
    }

    /// The times of a clock.
    pub(super) fn times(&self) -> Result<ClockTimes, Error> {
        let function = &self.function;
        let moves = |node: &Node| matches!(node, Node::Time | Node::State(_));
        if function.nodes().0.iter().any(moves) {
            return self.bad("the times of a clock follow from numbers and parameters alone");
        }
        let found = function.values(0.0, &vec![0.0; function.names().states.len()])?;
        if self.listed {
            return PresetTimes::new(found).map(ClockTimes::Preset);
        }
        let [first, period] = found[..] else {
            return self.bad("a clock has two formulas, its first time and its period");
        };
        PeriodicTimes::new(first, period).map(ClockTimes::Periodic)
    }

    fn check(&self) -> Result<(), Error> {
        if self.condition.as_ref().is_some_and(|condition| condition.count() != 1) {
            return self.bad("a condition has one formula");
        }
        if self.condition.is_some() && self.guard.role.bounds_flow() {
            return self
                .bad("a guard with a condition is a crossing: its mode flows on both sides");
        }
        match self.function.count() {
            _ if self.guard.role == Role::Clock => self.times().map(|_| ()),
            1 => Ok(()),
            _ => self.bad("a guard has one formula"),
        }
    }

    pub(super) fn bad<T>(&self, reason: &'static str) -> Result<T, Error> {
        Err(Error::BadEquations { what: self.guard.surface.to_string(), reason })
    }
}

pub(super) const NO_MODE: &str = "the equations have no such mode";

impl Equations {
    /// Equations without modes, with the names of the state's components, and of parameters with their values: decimals
    /// as text.
    #[must_use]
    pub fn new(states: &[&str], parameters: &[(&str, &str)]) -> Equations {
        match Names::new(states, parameters) {
            Ok(names) => Equations::of_names(names),
            Err(error) => Equations::of_names(Names::default()).refused(error),
        }
    }

    /// The same equations, which may call these functions in texts, and read them from files.
    #[must_use]
    pub fn functions(mut self, functions: &[Function]) -> Self {
        match self.names.clone().with_functions(functions) {
            Ok(names) => {
                self.names = names;
                self
            }
            Err(error) => self.refused(error),
        }
    }

    pub(super) fn of_names(names: Names) -> Equations {
        Equations { names, everywhere: vec![], modes: vec![], wrong: None, backward: false }
    }

    /// The same equations with other values of parameters, as decimals by name.
    #[must_use]
    pub fn with_parameters(mut self, values: &[(&str, &str)]) -> Self {
        let changed = self.all_formulas().try_for_each(|formulas| {
            *formulas = formulas.clone().with_parameters(values)?;
            Ok::<(), equations::Error>(())
        });
        let names = Formulas::of_vector(self.names.clone(), |_, _, _| vec![]);
        match (changed, names.and_then(|names| names.with_parameters(values))) {
            (Ok(()), Ok(names)) => {
                self.names = names.names().clone();
                self
            }
            (Err(error), _) | (_, Err(error)) => self.refused(error),
        }
    }

    fn all_formulas(&mut self) -> impl Iterator<Item = &mut Formulas> {
        let modes = self.modes.iter_mut().flat_map(|mode| {
            let limit = mode.after_limit.iter_mut().flat_map(of_jump);
            [&mut mode.field]
                .into_iter()
                .chain(limit)
                .chain(mode.guards.iter_mut().flat_map(of_guard))
        });
        modes.chain(self.everywhere.iter_mut().flat_map(of_guard))
    }

    /// The names of the state's components, and the parameters with their values.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// An error unless all modes to which events lead are there, and all formulas have their numbers of components.
    ///
    /// # Errors
    /// What was wrong first in the equations: [`Error::Formula`], [`Error::BadEquations`].
    pub fn check(&self) -> Result<(), Error> {
        if let Some(error) = &self.wrong {
            return Err(error.clone());
        }
        let bad = |what: String, reason| Err(Error::BadEquations { what, reason });
        if self.modes.is_empty() {
            return bad("equations".to_owned(), "they have no mode: add one with its field");
        }
        let expected = self.names.states.len();
        let check_length = |what, formulas: &Formulas| match formulas.count() {
            found if found == expected => Ok(()),
            found => Err(Error::Dimension { what, expected, found }),
        };
        let check_jump = |jump: &Jump| {
            let unknown = |mode: &&Label| !self.modes.iter().any(|known| known.name == **mode);
            if let Some(mode) = jump.mode.as_ref().filter(unknown) {
                return bad(mode.to_string(), NO_MODE);
            }
            let states = [&jump.state, &jump.inverse].into_iter().flatten();
            states.clone().try_for_each(|state| check_length("the state after an event", state))
        };
        for (place, mode) in self.modes.iter().enumerate() {
            if self.modes[..place].iter().any(|other| other.name == mode.name) {
                return bad(mode.name.to_string(), "a mode has it already");
            }
            check_length("the field of a mode", &mode.field)?;
            mode.after_limit.as_ref().map_or(Ok(()), check_jump)?;
        }
        let of_modes = self.modes.iter().flat_map(|mode| &mode.guards);
        of_modes.chain(&self.everywhere).try_for_each(|guard| {
            guard.check()?;
            guard.jump.as_ref().map_or(Ok(()), check_jump)
        })
    }

    /// The model of these equations, whose state has this type: [`State<N>`](crate::State), or `DVector<f64>`.
    ///
    /// # Errors
    /// As [`check`](Self::check); [`Error::Formula`] for a function with a kink or a jump in a field or a guard.
    pub fn model<X: StateVector>(&self) -> Result<EquationsModel<X>, Error> {
        self.check()?;
        let programs = Arc::new(Programs::new(self)?);
        let guards = self.everywhere.iter().map(|guard| (None, guard.declared()));
        let of_modes = self
            .modes
            .iter()
            .flat_map(|mode| mode.guards.iter().map(|guard| (Some(mode.name), guard.declared())));
        // Modes without guards of their own have those of all modes.
        let guards: Vec<_> = guards.chain(of_modes).collect();
        Ok(Model::of_equations(
            TaylorMotion::new(Arc::clone(&programs)),
            FormulaPart(programs),
            guards,
        ))
    }
}

/// The formulas of a guard.
fn of_guard(guard: &mut GuardEquations) -> impl Iterator<Item = &mut Formulas> {
    let own = [Some(&mut guard.function), guard.condition.as_mut()].into_iter().flatten();
    own.chain(guard.jump.iter_mut().flat_map(of_jump))
}

/// The formulas of a jump.
fn of_jump(jump: &mut Jump) -> impl Iterator<Item = &mut Formulas> {
    [jump.state.as_mut(), jump.inverse.as_mut()].into_iter().flatten()
}
