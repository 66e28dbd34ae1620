//! The class of attractors.

use super::kinds::{Convergences, Kind, no_steps, points_by_label};
use super::state_map::{PythonFeature, on_map};
use crate::arrays::{Numbers, shaped};
use crate::errors::value_error;
use crate::formulas::Steps;
use crate::labelling::region_of;
use crate::pickling::{Reduced, refused};
use crate::whole::{threads_of, whole};
use basin_of_attraction::{
    Error, FeatureAttractors, FeatureLimits, KnownAttractors, KnownLimits, Label, RecurrenceLimits,
    StateGrid, StateMap,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A dictionary of these variables by their names.
macro_rules! settings {
    ($py:expr, $($name:ident),*) => {{
        let settings = PyDict::new($py);
        $(settings.set_item(stringify!($name), &$name)?;)*
        settings.unbind()
    }};
}

/// The attractors of a map of several variables, found by recurrences to cells of a grid and tested as traps.
///
/// map(x) is a step: a map, a return map, or a flow over some time. Steps of a System need no Python, and run on all processors. A function takes an array, and returns a list, a tuple
/// or an array, or None where it has no value. region has the ends of each coordinate; starts is an array with one
/// start a row. The basins have the labels 1, 2, … in the order in which the attractors are found; ESCAPED is the
/// label of an orbit that passes the distance `escape` from the origin.
///
/// periodic has the coordinates, from 0, whose side of the region is one period, such as angles.
///
/// cells along every side of the region locate an attractor; an orbit of `recurrences` steps within visited cells
/// is a candidate, which is followed ten times as long as it took to be found, and which `tests` random orbits
/// test. No orbit takes more than `budget` steps to a candidate. Attractors closer than three cells of the finest
/// grid tried, of 16 times as many cells, may be found as one. If no attractor is found, `remedy` says what would
/// help.
///
/// >>> from nonsmooth.labelling import Attractors
/// >>> newton = lambda x: (x - (x ** 2 - 2) / (2 * x)) if x[0] else None
/// >>> found = Attractors(newton, region=[(-3.1, 3)], starts=[[1.0], [-1.0]], tests=20)
/// >>> [round(float(points[0, 0]), 6) for points in found.points.values()]
/// [1.414214, -1.414214]
/// >>> found.labels([[0.3], [-7.0]]).tolist()
/// [1, 2]
#[pyclass(frozen, module = "nonsmooth.labelling")]
pub(crate) struct Attractors {
    pub(super) map: Py<PyAny>,
    dimension: usize,
    pub(super) kind: Arc<Kind>,
    /// The method that makes it of the map, and its other arguments, for pickles.
    made_by: (&'static str, Py<PyDict>),
}

#[pymethods]
impl Attractors {
    #[new]
    #[pyo3(signature = (map, *, region, starts, cells = 100, recurrences = 100, locate = 1000, budget = 100_000, lost = 1000, tests = 200,
                        escape = None, periodic = Vec::new(), threads = None),
           text_signature = "(map, *, region, starts, cells=100, recurrences=100, locate=1000, budget=100000, lost=1000, tests=200, escape=None, periodic=(), threads=None)")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        py: Python<'_>,
        map: Py<PyAny>,
        region: Vec<[f64; 2]>,
        starts: Vec<Vec<f64>>,
        #[pyo3(from_py_with = whole)] cells: usize,
        #[pyo3(from_py_with = whole)] recurrences: usize,
        #[pyo3(from_py_with = whole)] locate: usize,
        #[pyo3(from_py_with = whole)] budget: usize,
        #[pyo3(from_py_with = whole)] lost: usize,
        #[pyo3(from_py_with = whole)] tests: usize,
        escape: Option<f64>,
        periodic: Vec<usize>,
        #[pyo3(from_py_with = threads_of)] threads: Option<usize>,
    ) -> PyResult<Self> {
        let settings = settings!(
            py,
            region,
            starts,
            cells,
            recurrences,
            locate,
            budget,
            lost,
            tests,
            escape,
            periodic
        );
        let limits = RecurrenceLimits { recurrences, locate, budget, lost, tests, escape };
        let grid = grid(&region, cells, periodic)?;
        let dimension = grid.dimension();
        let search = move |map: &dyn StateMap| {
            basin_of_attraction::Attractors::search(map, grid, &starts, limits)
        };
        let found = on_map(py, &map, threads, search)?.map_err(value_error)?;
        let kind = Arc::new(Kind::Recurrences(found));
        Ok(Attractors { map, dimension, kind, made_by: ("", settings) })
    }

    /// Attractors that are known by some of their points: fixed points, cycles, clouds of points. `points` has them by label, one a row.
    ///
    /// An orbit has come to one as soon as it is within `distance` of one of its points. Orbits from random states within it test that: they must come back.
    /// Without a distance the largest one that passes is taken, of halves of the distance between two attractors. `stretch` is a number of steps within which an orbit on an
    /// attractor comes near to its points again, `budget` the most steps of an orbit.
    ///
    /// >>> from nonsmooth.labelling import Attractors
    /// >>> cubic = lambda x: 1.5 * x - 0.5 * x**3
    /// >>> known = Attractors.of_points(cubic, {1: [[1.0]], 2: [[-1.0]]}, tests=20)
    /// >>> known.labels([[0.3], [-0.2], [0.0]]).tolist()
    /// [1, 2, 65535]
    #[staticmethod]
    #[pyo3(signature = (map, points, distance = None, *, budget = 100_000, stretch = 1000, tests = 200, threads = None),
           text_signature = "(map, points, distance=None, *, budget=100000, stretch=1000, tests=200, threads=None)")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn of_points(
        py: Python<'_>,
        map: Py<PyAny>,
        points: BTreeMap<u16, Vec<Vec<f64>>>,
        distance: Option<f64>,
        #[pyo3(from_py_with = whole)] budget: usize,
        #[pyo3(from_py_with = whole)] stretch: usize,
        #[pyo3(from_py_with = whole)] tests: usize,
        #[pyo3(from_py_with = threads_of)] threads: Option<usize>,
    ) -> PyResult<Self> {
        let settings = settings!(py, points, distance, budget, stretch, tests);
        let limits = KnownLimits { budget, stretch, tests };
        let points = points_by_label(points)?;
        let dimension = points.values().flatten().next().map_or(0, Vec::len);
        let own = points.clone();
        let test = move |map: &dyn StateMap| match distance {
            Some(distance) => KnownAttractors::new(map, &own, distance, limits),
            None => KnownAttractors::suggested(map, &own, limits),
        };
        let known = on_map(py, &map, threads, test)?.map_err(value_error)?;
        let kind = Arc::new(Kind::Points(points, known));
        Ok(Attractors { map, dimension, kind, made_by: ("of_points", settings) })
    }

    /// Attractors by features of their orbits. `features` makes some numbers of an array with the points of a stretch of an orbit, one a row, such as their mean.
    /// Orbits whose features are within `radius` of each other are of one attractor, if `agree` successive stretches are, and if orbits that start within `beside` of its states
    /// come to it.
    ///
    /// Each start is followed for `transient` steps, and then in stretches of `stretch` steps, at most `budget` of them. A group has `fewest` orbits at least.
    ///
    /// >>> from nonsmooth.labelling import Attractors
    /// >>> cubic = lambda x: 1.5 * x - 0.5 * x**3
    /// >>> starts = [[0.15 * k] for k in range(-10, 11) if k]
    /// >>> found = Attractors.of_features(cubic, lambda points: points.mean(axis=0), starts, radius=0.1, beside=0.01,
    /// ...                                transient=100, stretch=10, tests=20)
    /// >>> found.labels([[0.3], [-0.2]]).tolist()
    /// [2, 1]
    #[staticmethod]
    #[pyo3(signature = (map, features, starts, *, radius, beside, transient = 1000, stretch = 1000, agree = 3, budget = 30, fewest = 4, tests = 100, threads = None))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn of_features(
        py: Python<'_>,
        map: Py<PyAny>,
        features: Py<PyAny>,
        starts: Vec<Vec<f64>>,
        radius: f64,
        beside: f64,
        #[pyo3(from_py_with = whole)] transient: usize,
        #[pyo3(from_py_with = whole)] stretch: usize,
        #[pyo3(from_py_with = whole)] agree: usize,
        #[pyo3(from_py_with = whole)] budget: usize,
        #[pyo3(from_py_with = whole)] fewest: usize,
        #[pyo3(from_py_with = whole)] tests: usize,
        #[pyo3(from_py_with = threads_of)] threads: Option<usize>,
    ) -> PyResult<Self> {
        let settings = settings!(
            py, features, starts, radius, beside, transient, stretch, agree, budget, fewest, tests
        );
        let limits =
            FeatureLimits { transient, stretch, agree, budget, radius, fewest, tests, beside };
        let dimension = starts.first().map_or(0, Vec::len);
        let feature = PythonFeature::new(features);
        let search = move |map: &dyn StateMap| {
            let of = |points: &[Vec<f64>]| feature.of(points);
            let found = FeatureAttractors::search(map, &of, &starts, limits);
            (found, feature)
        };
        let (found, feature) = on_map(py, &map, threads, search)?;
        let found = feature.unless_raised(found)?.map_err(value_error)?;
        let kind = Arc::new(Kind::Features(found, feature));
        Ok(Attractors { map, dimension, kind, made_by: ("of_features", settings) })
    }

    /// The successive points of an orbit on each attractor, by label: arrays with one point a row.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<BTreeMap<u16, Bound<'py, PyAny>>> {
        let rows = |(label, points): (Label, Vec<Vec<f64>>)| {
            let shape = [points.len(), points.first().map_or(0, Vec::len)];
            Ok((label.code(), shaped(py, points.concat(), &shape)?))
        };
        self.kind.points().into_iter().map(rows).collect()
    }

    /// The starts whose orbits belong to no attractor, each with the reason: "left the region: …", "cut by the
    /// region: …", "stopped", "not settled: …" with the drift a step, or "no trap".
    #[getter]
    fn unmatched(&self) -> Vec<(Vec<f64>, String)> {
        let own = match &*self.kind {
            Kind::Recurrences(found) => found.unmatched(),
            Kind::Features(found, _) => found.unmatched(),
            Kind::Points(..) => &[],
        };
        own.iter().map(|own| (own.start.clone(), own.reason.to_string())).collect()
    }

    /// What would help if no attractor was found: a larger region, more cells, or a larger budget; None if one was
    /// found.
    #[getter]
    fn remedy(&self) -> Option<String> {
        match &*self.kind {
            Kind::Recurrences(found) => found.remedy().map(|remedy| remedy.to_string()),
            Kind::Points(..) | Kind::Features(..) => None,
        }
    }

    /// The number of steps after which each attractor repeats itself, by label; None for one that does not, and where attractors are known
    /// by points or features.
    #[getter]
    fn periods(&self) -> BTreeMap<u16, Option<usize>> {
        match &*self.kind {
            Kind::Recurrences(found) => {
                let all = found.attractors().iter();
                all.map(|attractor| (attractor.label.code(), attractor.period)).collect()
            }
            other => other.points().keys().map(|label| (label.code(), None)).collect(),
        }
    }

    /// How they are known: "recurrences", "points" or "features".
    #[getter]
    fn kind(&self) -> &'static str {
        match &*self.kind {
            Kind::Recurrences(_) => "recurrences",
            Kind::Points(..) => "points",
            Kind::Features(..) => "features",
        }
    }

    /// The distance within which an orbit has come to an attractor that is known by points; None for other attractors.
    #[getter]
    fn distance(&self) -> Option<f64> {
        match &*self.kind {
            Kind::Points(_, known) => Some(known.distance()),
            Kind::Recurrences(_) | Kind::Features(..) => None,
        }
    }

    /// The labels of starts, one a row: an array of uint16. A start that comes to no attractor is undecided.
    #[pyo3(signature = (starts, threads = None))]
    fn labels<'py>(
        &self,
        py: Python<'py>,
        starts: &Bound<'py, PyAny>,
        #[pyo3(from_py_with = threads_of)] threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (labels, _) = self.all_convergences(py, starts, threads)?;
        codes(py, &labels)
    }

    /// The labels of starts, and the numbers of steps after which each is at its attractor.
    #[pyo3(signature = (starts, threads = None))]
    fn convergences<'py>(
        &self,
        py: Python<'py>,
        starts: &Bound<'py, PyAny>,
        #[pyo3(from_py_with = threads_of)] threads: Option<usize>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        if matches!(&*self.kind, Kind::Features(..)) {
            return Err(no_steps());
        }
        let (labels, steps) = self.all_convergences(py, starts, threads)?;
        let steps = steps.unwrap_or_default();
        let count = steps.len();
        Ok((codes(py, &labels)?, shaped(py, steps, &[count])?))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        if !self.map.bind(py).is_instance_of::<Steps>() {
            return Err(refused(py, "Attractors", &[("map".to_owned(), &self.map)]));
        }
        let (method, settings) = &self.made_by;
        let class = py.get_type::<Attractors>().into_any();
        let make = if method.is_empty() { class } else { class.getattr(*method)? };
        let make =
            py.import("functools")?.getattr("partial")?.call((make,), Some(settings.bind(py)))?;
        Ok((make, (&self.map,).into_pyobject(py)?))
    }

    /// It never changes.
    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: Py<PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(&self) -> String {
        let (count, unmatched) = (self.kind.points().len(), self.unmatched().len());
        match (self.remedy(), &*self.kind) {
            (Some(remedy), _) => {
                format!("Attractors(none found, {unmatched} starts unmatched; try {remedy})")
            }
            (None, Kind::Points(_, known)) => {
                format!("Attractors({count} known, distance={:?})", known.distance())
            }
            (None, _) => format!("Attractors({count} found, {unmatched} starts unmatched)"),
        }
    }
}

impl Attractors {
    /// Refuses a state or a region of another dimension.
    pub(super) fn check_dimension(&self, dimension: usize) -> PyResult<()> {
        match dimension == self.dimension {
            true => Ok(()),
            false => {
                let expected = self.dimension;
                Err(value_error(Error::WrongDimension { dimension, expected }))
            }
        }
    }

    fn all_convergences(
        &self,
        py: Python<'_>,
        starts: &Bound<'_, PyAny>,
        threads: Option<usize>,
    ) -> PyResult<Convergences> {
        let Numbers { values, shape } = starts.extract()?;
        let (count, expected) = (shape.first().copied().unwrap_or(0), self.dimension);
        match shape[..] {
            [0] => {}
            [_, dimension] => self.check_dimension(dimension)?,
            _ => {
                let text = format!("starts have one start a row; these have the shape {shape:?}");
                return Err(value_error(text));
            }
        }
        let kind = Arc::clone(&self.kind);
        let start = move |k: usize, state: &mut [f64]| {
            state.copy_from_slice(&values[expected * k..expected * (k + 1)]);
        };
        let all = move |map: &dyn StateMap| kind.convergences(map, (count, expected), start);
        let all = on_map(py, &self.map, threads, all)?;
        self.kind.unless_raised(all)?.map_err(value_error)
    }
}

/// Equal cells in a region, whose `periodic` coordinates have it as one period.
pub(super) fn grid(region: &[[f64; 2]], cells: usize, periodic: Vec<usize>) -> PyResult<StateGrid> {
    let grid = StateGrid::uniform(region_of(region)?, cells).map_err(value_error)?;
    periodic.into_iter().try_fold(grid, StateGrid::periodic).map_err(value_error)
}

/// The codes of labels, as an array.
pub(super) fn codes<'py>(py: Python<'py>, labels: &[Label]) -> PyResult<Bound<'py, PyAny>> {
    shaped(py, labels.iter().map(|label| label.code()).collect(), &[labels.len()])
}
