//! Return maps of equations, their periodic points, branches and diagrams.

use super::equations::Equations;
use crate::arrays::shaped;
use crate::errors::{InputError, of_hybrid, value_error};
use crate::hybrid::{certainty, numbers};
use crate::interruptible::{Watch, in_background, progress_function};
use crate::pickling::Reduced;
use crate::whole::whole;
use nalgebra::{Complex, DMatrix};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use return_map::{
    Branch, BranchEnd, BranchPoint, BranchSteps, EquationReturns, Error, MapFamily, OrbitLength,
    Seeds, bifurcation_diagram, branch_point, follow_branch, lyapunov_exponents,
};
use std::ops::ControlFlow;
use std::sync::Arc;

/// The exception of an error of a return map: that of the hybrid system, if it comes from there.
fn raised(error: &Error) -> PyErr {
    match error {
        Error::Execution(error) => of_hybrid(error),
        other => value_error(other),
    }
}

/// The map from a section to the next event of a surface, as a parameter changes.
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct ReturnMap {
    pub(super) map: Arc<EquationReturns>,
    made_of: Py<PyTuple>,
}

fn matrix<'py>(py: Python<'py>, matrix: &DMatrix<f64>) -> PyResult<Bound<'py, PyAny>> {
    shaped(py, matrix.transpose().as_slice().to_vec(), &[matrix.nrows(), matrix.ncols()])
}

fn vector<'py>(py: Python<'py>, numbers: &[f64]) -> PyResult<Bound<'py, PyAny>> {
    shaped(py, numbers.to_vec(), &[numbers.len()])
}

/// A point of a branch as a dictionary.
fn of_point<'py>(py: Python<'py>, own: &BranchPoint) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    all.set_item("point", vector(py, &own.point)?)?;
    all.set_item("parameter", own.parameter)?;
    let multipliers: Vec<Complex<f64>> = own.multipliers.clone();
    let parts = |part: fn(&Complex<f64>) -> f64| multipliers.iter().map(part).collect::<Vec<_>>();
    all.set_item("multipliers", (vector(py, &parts(|m| m.re))?, vector(py, &parts(|m| m.im))?))?;
    all.set_item("multiplier_errors", vector(py, &own.multiplier_errors)?)?;
    all.set_item("is_stable", own.is_stable)?;
    all.set_item("itinerary", own.itinerary.clone())?;
    all.set_item("error", own.error)?;
    Ok(all)
}

fn end_text(end: &BranchEnd) -> String {
    match end {
        BranchEnd::Window => "window".to_owned(),
        BranchEnd::Closed => "closed".to_owned(),
        BranchEnd::Doubling => "doubling".to_owned(),
        BranchEnd::PointLimit => "point limit".to_owned(),
        BranchEnd::Stopped => "stopped".to_owned(),
        BranchEnd::Border { border, .. } => border.to_string(),
        BranchEnd::Lost { .. } => "lost".to_owned(),
    }
}

impl ReturnMap {
    /// The result of work in the background, with a look for Ctrl-C at each of its points.
    fn watched<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&EquationReturns, &Watch) -> Result<T, Error> + Send + 'static,
    ) -> PyResult<T> {
        let map = Arc::clone(&self.map);
        in_background(py, move |watch| work(&map, watch), |error| raised(&error), |_| Ok(()))
    }

    fn checked(&self, point: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
        let (found, dimension) = (numbers(point)?, self.map.dimension());
        if found.len() != dimension {
            let text =
                format!("a point of the section has {dimension} coordinates, not {}", found.len());
            return Err(InputError::new_err(text));
        }
        Ok(found)
    }
}

fn go_on(watch: &Watch) -> ControlFlow<()> {
    if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

#[pymethods]
impl ReturnMap {
    /// start has a text for each component of the state, and perhaps one for the time; image one for each coordinate.
    #[new]
    #[pyo3(signature = (equations, parameter, mode, surface, coordinates, start = None, image = None))]
    #[expect(clippy::too_many_arguments, reason = "the front in Python names them")]
    fn new(
        py: Python<'_>,
        equations: Py<Equations>,
        parameter: String,
        mode: String,
        surface: String,
        coordinates: Vec<String>,
        start: Option<Vec<String>>,
        image: Option<Vec<String>>,
    ) -> PyResult<Self> {
        fn texts(all: &[String]) -> Vec<&str> {
            all.iter().map(String::as_str).collect()
        }
        let own = equations.get();
        let mut map = EquationReturns::new(
            own.model.equations(),
            &parameter,
            (&mode, &surface),
            &texts(&coordinates),
        )
        .map_err(|error| raised(&error))?;
        if let Some(start) = &start {
            map = map.starting_text(&texts(start)).map_err(|error| raised(&error))?;
        }
        if let Some(image) = &image {
            map = map.coordinates_text(&texts(image)).map_err(|error| raised(&error))?;
        }
        let map = Arc::new(map.tolerances(own.tolerances()));
        let made_of = (equations, parameter, mode, surface, coordinates, start, image);
        Ok(ReturnMap { map, made_of: made_of.into_pyobject(py)?.unbind() })
    }

    /// The number of coordinates.
    #[getter]
    fn dimension(&self) -> usize {
        self.map.dimension()
    }

    /// The image of a point: a dictionary with the point, the return time, the itinerary and the certainty.
    fn image<'py>(
        &self,
        py: Python<'py>,
        point: &Bound<'py, PyAny>,
        parameter: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let point = self.checked(point)?;
        let found = self.watched(py, move |map, _| map.image(&point, parameter))?;
        let all = PyDict::new(py);
        all.set_item("point", vector(py, &found.point)?)?;
        all.set_item("time", found.time)?;
        all.set_item("itinerary", found.itinerary)?;
        all.set_item("certainty", certainty(found.certainty))?;
        Ok(all)
    }

    /// The image of a point, its derivatives by the point and by the parameter, and their errors.
    fn linearized<'py>(
        &self,
        py: Python<'py>,
        point: &Bound<'py, PyAny>,
        parameter: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let point = self.checked(point)?;
        let found = self.watched(py, move |map, _| map.linearized(&point, parameter))?;
        let (all, last) = (PyDict::new(py), found.slopes.ncols() - 1);
        all.set_item("point", vector(py, &found.image.point)?)?;
        all.set_item("slopes", matrix(py, &found.slopes.clone().remove_column(last))?)?;
        all.set_item("parameter_slopes", vector(py, found.slopes.column(last).as_slice())?)?;
        all.set_item("errors", matrix(py, &found.errors)?)?;
        Ok(all)
    }

    /// The points of an orbit, one a row: the start, and its images.
    fn orbit<'py>(
        &self,
        py: Python<'py>,
        point: &Bound<'py, PyAny>,
        parameter: f64,
        #[pyo3(from_py_with = whole)] images: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let start = self.checked(point)?;
        let points = self.watched(py, move |map, watch| {
            let mut points = start.clone();
            map.orbit(&start, parameter, images, &mut |image| {
                points.extend(&image.point);
                go_on(watch)
            })?;
            Ok(points)
        })?;
        let rows = points.len() / self.dimension().max(1);
        shaped(py, points, &[rows, self.dimension()])
    }

    /// The point of a period near a start: a dictionary.
    fn periodic_point<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        parameter: f64,
        #[pyo3(from_py_with = whole)] period: usize,
    ) -> PyResult<Bound<'py, PyDict>> {
        let start = self.checked(start)?;
        let found =
            self.watched(py, move |map, _| branch_point(map, period, (&start, parameter)))?;
        of_point(py, &found)
    }

    /// The branch of periodic points through one near a start, in a window of parameters: dictionaries of its points and of its bifurcations, and the
    /// reasons of its ends.
    #[expect(clippy::type_complexity, reason = "the front in Python makes a class of it")]
    fn branch<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        parameter: f64,
        #[pyo3(from_py_with = whole)] period: usize,
        window: (f64, f64),
        longest: f64,
    ) -> PyResult<(Vec<Bound<'py, PyDict>>, Vec<Bound<'py, PyDict>>, [String; 2])> {
        let start = self.checked(start)?;
        let steps = BranchSteps { longest, ..BranchSteps::default() };
        let found: Branch = self.watched(py, move |map, watch| {
            follow_branch(map, period, (&start, parameter), window, steps, |_| go_on(watch))
        })?;
        let points = found.points.iter().map(|point| of_point(py, point));
        let bifurcations = found.bifurcations.iter().map(|own| {
            let all = of_point(py, &own.at)?;
            all.set_item("kind", own.kind.to_string())?;
            all.set_item("parameter_error", own.error)?;
            all.set_item("coefficient", own.coefficient)?;
            Ok(all)
        });
        let ends = found.ends.each_ref().map(end_text);
        Ok((points.collect::<PyResult<_>>()?, bifurcations.collect::<PyResult<_>>()?, ends))
    }

    /// The bifurcation diagram: parameters and points that belong together, with the texts of errors of orbits that failed.
    #[pyo3(signature = (parameters, seeds, transient, keep, carried = false, progress = None))]
    #[expect(
        clippy::too_many_arguments,
        clippy::type_complexity,
        reason = "the front in Python names them"
    )]
    fn diagram<'py>(
        &self,
        py: Python<'py>,
        parameters: Vec<f64>,
        seeds: Vec<Vec<f64>>,
        #[pyo3(from_py_with = whole)] transient: usize,
        #[pyo3(from_py_with = whole)] keep: usize,
        carried: bool,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>, Vec<(f64, String)>)> {
        let (map, count) = (Arc::clone(&self.map), parameters.len());
        let dimension = self.dimension();
        if seeds.is_empty() || seeds.iter().any(|seed| seed.len() != dimension) {
            let text =
                format!("seeds are points of the section, with {dimension} coordinates each");
            return Err(InputError::new_err(text));
        }
        let progress = progress_function(py, progress)?;
        let report = |done| match &progress {
            Some(progress) => progress.call1((done, count)).map(drop),
            None => Ok(()),
        };
        let work = move |watch: &Watch| {
            let from = if carried { Seeds::Carried } else { Seeds::Fresh };
            let length = OrbitLength { transient, keep };
            Ok::<_, Error>(bifurcation_diagram(&*map, &parameters, (&seeds, from), length, |_| {
                watch.finished(1);
                go_on(watch)
            }))
        };
        let columns = in_background(py, work, |error| raised(&error), report)?;
        let (mut at, mut points, mut failed) = (Vec::new(), Vec::new(), Vec::new());
        for column in columns {
            for orbit in column.orbits {
                match orbit {
                    Ok(orbit) => {
                        at.extend(orbit.iter().map(|_| column.parameter));
                        points.extend(orbit.into_iter().flatten());
                    }
                    Err(error) => failed.push((column.parameter, error.to_string())),
                }
            }
        }
        let shape = [at.len(), dimension];
        Ok((vector(py, &at)?, shaped(py, points, &shape)?, failed))
    }

    /// Lyapunov exponents of an orbit: for each image, with the lower and upper ends of their intervals.
    fn lyapunov<'py>(
        &self,
        py: Python<'py>,
        start: &Bound<'py, PyAny>,
        parameter: f64,
        #[pyo3(from_py_with = whole)] transient: usize,
        #[pyo3(from_py_with = whole)] images: usize,
    ) -> PyResult<Vec<(f64, f64, f64)>> {
        let start = self.checked(start)?;
        let found = self.watched(py, move |map, _| {
            lyapunov_exponents(map, (&start, parameter), transient, images)
        })?;
        Ok(found.per_image.iter().map(|own| (own.value, own.lower, own.upper)).collect())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let made_of = slf.get().made_of.bind(slf.py()).clone();
        Ok((slf.get_type().into_any(), made_of))
    }

    fn __repr__(&self) -> String {
        format!("ReturnMap(dimension={})", self.dimension())
    }
}
