//! Steps of models as maps of states, whose attractors and basins are found without Python.

use super::equations::{Equations, Model};
use super::returns::ReturnMap;
use super::trace::Formulas;
use crate::errors::{InputError, of_hybrid, value_error};
use crate::interruptible::{Watch, in_background};
use crate::pickling::Reduced;
use basin_of_attraction::{Label, StateMap};
use hybrid_system::Label as Name;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use return_map::{ExecutionSteps, FamilySteps, FlowSteps, FormulaSteps, OrbitEnd};
use std::sync::Arc;

/// A map of states: of formulas, of a flow over some time, or of returns to a surface.
///
/// Orbits that end at a surface which ends the run have a label of their own: 65001 for the first one of `ends`, 65002 for the second, and so on; of a
/// surface that is not among them ESCAPED.
#[pyclass(frozen, module = "nonsmooth")]
pub(crate) struct Steps {
    pub(crate) map: Arc<dyn StateMap + Send + Sync>,
    /// The method and the arguments that make it again, for pickles.
    made_by: (Py<PyAny>, Py<PyTuple>),
}

/// Attractors have the labels before.
const FIRST_END: u16 = 65_001;

/// Ends behind would take labels that mean other things.
const MOST_ENDS: usize = 500;

/// The label of an end, by the names of the surfaces that have one of their own.
fn label(ends: &[String], end: &OrbitEnd) -> Label {
    let OrbitEnd::Terminal(surface) = end else { return Label::UNDECIDED_MAP };
    let place = ends.iter().take(MOST_ENDS).position(|known| known == surface);
    place.map_or(Label::ESCAPED, |place| Label::from_code(FIRST_END + place as u16))
}

/// The executions of a model over some time, which the map owns.
struct Flow {
    model: Arc<Model>,
    modes: Vec<Name>,
    dimension: usize,
    times: (f64, f64),
    ends: Arc<[String]>,
}

impl Flow {
    /// What `see` finds in the map of the library.
    fn seen<T>(&self, see: impl FnOnce(&dyn StateMap) -> T) -> T {
        let ends = Arc::clone(&self.ends);
        let run =
            |mode: Name, x: &[f64]| self.model.start_at(mode.as_str(), x.to_vec(), self.times);
        see(&ExecutionSteps::new(self.dimension, &self.modes, run)
            .label_ends(move |end| label(&ends, end)))
    }
}

impl StateMap for Flow {
    fn dimension(&self) -> Option<usize> {
        Some(self.dimension + usize::from(self.modes.len() > 1))
    }

    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        self.seen(|map| map.image(state, image))
    }

    fn label_of_end(&self, state: &[f64]) -> Label {
        self.seen(|map| map.label_of_end(state))
    }
}

/// The returns to a surface at a parameter, which the map owns.
struct Returns {
    map: Arc<return_map::EquationReturns>,
    parameter: f64,
    ends: Arc<[String]>,
}

impl Returns {
    fn seen<T>(&self, see: impl FnOnce(&dyn StateMap) -> T) -> T {
        let ends = Arc::clone(&self.ends);
        let map = FamilySteps::new(&*self.map, self.parameter);
        see(&map.label_ends(move |end| label(&ends, end)))
    }
}

impl StateMap for Returns {
    fn dimension(&self) -> Option<usize> {
        self.seen(|map| map.dimension())
    }

    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        self.seen(|map| map.image(state, image))
    }

    fn label_of_end(&self, state: &[f64]) -> Label {
        self.seen(|map| map.label_of_end(state))
    }
}

/// The field of a model with one mode and no guards: its flow is followed many states at a time.
fn smooth_field(model: &Model, modes: &[Name]) -> Option<equations::Formulas> {
    let equations = model.equations();
    let &[mode] = modes else { return None };
    if equations.surfaces().next().is_some() {
        return None;
    }
    equations.field(mode).ok().cloned()
}

#[pymethods]
impl Steps {
    /// The flow of equations between two times. With several modes the number of the mode is the last coordinate of a state.
    #[staticmethod]
    fn of_flow(
        py: Python<'_>,
        equations: Py<Equations>,
        modes: Vec<String>,
        times: (f64, f64),
        ends: Vec<String>,
    ) -> PyResult<Steps> {
        let model = Arc::clone(&equations.get().model);
        if !(times.0.is_finite() && times.1.is_finite() && times.0 < times.1) {
            let text = format!(
                "a step lasts a positive and finite time, not from {:?} to {:?}",
                times.0, times.1
            );
            return Err(InputError::new_err(text));
        }
        let names = modes.iter().map(|mode| Name::new(mode));
        let names = names.collect::<Result<Vec<_>, _>>().map_err(|error| of_hybrid(&error))?;
        let dimension = model.equations().names().states.len();
        let map: Arc<dyn StateMap + Send + Sync> = match smooth_field(&model, &names) {
            Some(field) => {
                let own = equations.get().tolerances();
                let of = |list: Option<&[f64]>, axis: usize, all: f64| {
                    list.and_then(|list| list.get(axis)).copied().unwrap_or(all)
                };
                let each = |axis| {
                    (
                        of(own.absolute_each, axis, own.absolute),
                        of(own.relative_each, axis, own.relative),
                    )
                };
                // As a run takes it.
                let relative = own.relative.clamp(1e-17, 0.1);
                let steps = FlowSteps::new(&field, times, relative).map_err(value_error)?;
                let steps = steps.tolerances((0..dimension).map(each).collect(), own.longest_step);
                Arc::new(steps.map_err(value_error)?)
            }
            None => {
                let ends = ends.clone().into();
                Arc::new(Flow { model, modes: names, dimension, times, ends })
            }
        };
        let arguments = (equations, modes, times, ends).into_pyobject(py)?.unbind();
        Ok(Steps { map, made_by: (Steps::maker(py, "of_flow")?, arguments) })
    }

    /// The returns of a return map at a value of its parameter.
    #[staticmethod]
    fn of_returns(
        py: Python<'_>,
        returns: Py<ReturnMap>,
        parameter: f64,
        ends: Vec<String>,
    ) -> PyResult<Steps> {
        let map = Arc::clone(&returns.get().map);
        let own = Returns { map, parameter, ends: ends.clone().into() };
        let arguments = (returns, parameter, ends).into_pyobject(py)?.unbind();
        Ok(Steps { map: Arc::new(own), made_by: (Steps::maker(py, "of_returns")?, arguments) })
    }

    /// The map of formulas, one for each component of the state.
    #[staticmethod]
    fn of_formulas(py: Python<'_>, formulas: Py<Formulas>) -> PyResult<Steps> {
        let map = FormulaSteps::new(&formulas.get().own).map_err(value_error)?;
        let arguments = (formulas,).into_pyobject(py)?.unbind();
        Ok(Steps { map: Arc::new(map), made_by: (Steps::maker(py, "of_formulas")?, arguments) })
    }

    /// The number of coordinates of a state.
    #[getter]
    fn dimension(&self) -> usize {
        self.map.dimension().unwrap_or(0)
    }

    /// The image of a state; None where it has none. No Python runs meanwhile, and Ctrl-C ends it.
    fn __call__(&self, py: Python<'_>, state: Vec<f64>) -> PyResult<Option<Vec<f64>>> {
        if self.map.dimension().is_some_and(|dimension| dimension != state.len()) {
            let text = format!("a state has {} coordinates, not {}", self.dimension(), state.len());
            return Err(InputError::new_err(text));
        }
        let map = Arc::clone(&self.map);
        let work = move |_: &Watch| {
            let mut image = vec![0.0; state.len()];
            Ok::<_, String>(map.image(&state, &mut image).then_some(image))
        };
        in_background(py, work, value_error, |_| Ok(()))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let (make, arguments) = &self.made_by;
        Ok((make.bind(py).clone(), arguments.bind(py).clone()))
    }

    fn __repr__(&self) -> String {
        format!("Steps(dimension={})", self.dimension())
    }
}

impl Steps {
    fn maker(py: Python<'_>, name: &str) -> PyResult<Py<PyAny>> {
        Ok(py.get_type::<Steps>().getattr(name)?.unbind())
    }
}
