//! The functions of a hybrid system, with the guards of each mode.

use super::guards::{After, Clock, Guard};
use super::names::{ExecutionMode, ExecutionSurface, Mode, Modes, Surface};
use super::sliding_mode::SlidingMode;
use crate::errors::{InputError, of_hybrid_with};
use hybrid_system::{Error, FilippovMode, FilippovSurface, Tolerances};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// A guard or a clock.
#[derive(Debug)]
pub(crate) enum Watched {
    Guard(Py<Guard>),
    Clock(Py<Clock>),
}

impl Watched {
    pub(crate) fn name(&self) -> &str {
        match self {
            Watched::Guard(guard) => guard.get().name(),
            Watched::Clock(clock) => clock.get().name(),
        }
    }

    pub(crate) fn after(&self) -> &After {
        match self {
            Watched::Guard(guard) => &guard.get().after,
            Watched::Clock(clock) => &clock.get().after,
        }
    }

    fn modes(&self) -> Option<&[Py<PyAny>]> {
        match self {
            Watched::Guard(guard) => guard.get().modes.as_deref(),
            Watched::Clock(clock) => clock.get().modes.as_deref(),
        }
    }

    fn guard(&self, surface: Surface) -> hybrid_system::Guard<Surface> {
        match self {
            Watched::Guard(guard) => {
                let Guard { direction, role, touch, .. } = *guard.get();
                hybrid_system::Guard { surface, direction, role, touch }
            }
            Watched::Clock(_) => hybrid_system::Guard::clock(surface),
        }
    }
}

/// The functions of a user besides those of the guards.
#[derive(Debug)]
pub(crate) struct Functions {
    pub(crate) flow: Option<Py<PyAny>>,
    pub(crate) field: Option<Py<PyAny>>,
    pub(crate) rest: Option<Py<PyAny>>,
    pub(crate) slide: Option<Py<PyAny>>,
}

/// A model: the functions, the guards, and the names of the modes.
#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) functions: Functions,
    pub(crate) tolerances: Tolerances,
    /// Whether executions go on along surfaces, by Filippov's convention.
    pub(crate) follows: bool,
    pub(crate) watched: Vec<Watched>,
    pub(crate) modes: Modes,
    /// The guards of each mode that some guard names.
    lists: Vec<Vec<hybrid_system::Guard<Surface>>>,
    /// The guards of all other modes.
    everywhere: Vec<hybrid_system::Guard<Surface>>,
}

impl Model {
    /// The model with these guards and clocks.
    ///
    /// # Errors
    /// TypeError for a guard that is neither; ValueError for two with one name.
    pub(crate) fn new(
        py: Python<'_>,
        functions: Functions,
        guards: &[Bound<'_, PyAny>],
        (tolerances, follows): (Tolerances, bool),
    ) -> PyResult<Self> {
        let mut watched: Vec<Watched> = Vec::new();
        for object in guards {
            let own = if let Ok(guard) = object.cast::<Guard>() {
                Watched::Guard(guard.clone().unbind())
            } else if let Ok(clock) = object.cast::<Clock>() {
                Watched::Clock(clock.clone().unbind())
            } else {
                let found = object.get_type().name()?;
                let text = format!("guards are of Guard and Clock, not {found}");
                return Err(PyTypeError::new_err(text));
            };
            if watched.iter().any(|other| other.name() == own.name()) {
                let text =
                    format!("two guards are named {:?}: an event could not be told", own.name());
                return Err(InputError::new_err(text));
            }
            watched.push(own);
        }
        let modes = Modes::new(py);
        for mode in watched.iter().filter_map(Watched::modes).flatten() {
            modes.number(mode.bind(py))?;
        }
        let mut lists = vec![Vec::new(); modes.count()];
        let mut everywhere = Vec::new();
        for (number, own) in watched.iter().enumerate() {
            let guard = own.guard(Surface(number));
            match own.modes() {
                None => {
                    everywhere.push(guard);
                    lists.iter_mut().for_each(|list| list.push(guard));
                }
                Some(named) => {
                    for mode in named {
                        let at = modes.number(mode.bind(py))?.0;
                        // A mode that is named twice has the guard once.
                        if lists[at].last().is_none_or(|last| last.surface != guard.surface) {
                            lists[at].push(guard);
                        }
                    }
                }
            }
        }
        Ok(Model { functions, tolerances, follows, watched, modes, lists, everywhere })
    }

    /// The functions of the user, by their names.
    pub(crate) fn functions(&self) -> Vec<(String, &Py<PyAny>)> {
        let Functions { flow, field, rest, slide } = &self.functions;
        let own = [("flow", flow), ("field", field), ("rest", rest), ("slide", slide)];
        let own = own.into_iter().filter_map(|(name, own)| Some((name.to_owned(), own.as_ref()?)));
        let of_guards = self.watched.iter().flat_map(|watched| {
            let functions = match watched {
                Watched::Guard(guard) => guard.get().functions(),
                Watched::Clock(clock) => clock.get().functions(),
            };
            functions
                .into_iter()
                .map(move |(name, own)| (format!("{} of {:?}", name, watched.name()), own))
        });
        own.chain(of_guards).collect()
    }

    /// The name of a guard.
    pub(crate) fn surface_name(&self, surface: Surface) -> String {
        self.watched.get(surface.0).map_or_else(String::new, |watched| watched.name().to_owned())
    }

    /// The name of a surface of an execution.
    pub(crate) fn event_name(&self, surface: ExecutionSurface) -> String {
        match surface {
            FilippovSurface::Model(surface) => self.surface_name(surface),
            FilippovSurface::Tangent { surface, .. } => {
                format!("{}: end of sliding", self.surface_name(surface))
            }
        }
    }

    /// The mode as Python sees it: the user's own object, or a SlidingMode.
    pub(crate) fn mode_object(&self, py: Python<'_>, mode: ExecutionMode) -> PyResult<Py<PyAny>> {
        match mode {
            FilippovMode::Free(mode) => Ok(self.modes.name(py, mode)),
            FilippovMode::Sliding { surface, below, above, .. } => {
                let (below, above) = (self.modes.name(py, below), self.modes.name(py, above));
                let mode = SlidingMode { surface: self.surface_name(surface), below, above };
                Ok(Py::new(py, mode)?.into_any())
            }
        }
    }

    /// The guards of a mode.
    pub(crate) fn guards(&self, mode: Mode) -> &[hybrid_system::Guard<Surface>] {
        self.lists.get(mode.0).unwrap_or(&self.everywhere)
    }

    /// The exception of an error: UndecidedError where rounding hides what happens, ArithmeticError where a
    /// computation cannot go on, ValueError for wrong input. Modes and guards have their names in the message.
    pub(crate) fn exception(&self, py: Python<'_>, error: &Error, cause: Option<String>) -> PyErr {
        let mut text = error.to_string();
        for number in 0..self.modes.count() {
            let name = self.modes.name(py, Mode(number));
            let shown = name.bind(py).repr().map_or_else(|_| "?".into(), |shown| shown.to_string());
            for own in [
                format!("{:?}", FilippovMode::<_, Surface>::Free(Mode(number))),
                format!("{:?}", Mode(number)),
            ] {
                text = text.replace(&own, &shown);
            }
        }
        for (number, watched) in self.watched.iter().enumerate() {
            let shown = format!("{:?}", watched.name());
            for own in [
                format!("{:?}", FilippovSurface::<Mode, _>::Model(Surface(number))),
                format!("{:?}", Surface(number)),
            ] {
                text = text.replace(&own, &shown);
            }
        }
        // A number that is not finite matters only where the library met one.
        let of_number = matches!(
            error,
            Error::StateNotFinite { .. }
                | Error::FieldNotFinite { .. }
                | Error::NotFinite { .. }
                | Error::NoSensitivity { .. }
        );
        if let Some(cause) = cause.filter(|_| of_number) {
            text = format!("{cause}; so {text}");
        }
        of_hybrid_with(error, text)
    }
}
