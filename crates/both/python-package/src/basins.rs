//! Basins over the plane and at one mass ratio.

use crate::arrays::shaped;
use crate::errors::{InputError, value_error};
use crate::interruptible::{Watch, in_background};
use crate::pickling::{Reduced, plain, reduced, restoring};
use crate::whole::{room_for, two_whole, whole};
use basin_of_attraction::{Grid, Interval, Label, LabelledInterval, Refinement, StopReason};
use hopper_basin::{BranchGround, Fates, HopperBasins, HopperFate, Probes};
use passive_hopper::MassRatio;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::collections::BTreeMap;

type Labels<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>);
type Middles<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>);
/// The window of speeds of the paper, from α*_1 to α*_6.
#[pyfunction]
pub(crate) fn first_window() -> [f64; 2] {
    let speeds = hopper_basin::first_humps(5);
    [speeds.left, speeds.right]
}

type Window = [[f64; 2]; 2];

pub(crate) fn grid_of(
    [[left, right], [bottom, top]]: Window,
    [columns, rows]: [usize; 2],
) -> PyResult<Grid> {
    let x = Interval::new(left, right).map_err(value_error)?;
    let y = Interval::new(bottom, top).map_err(value_error)?;
    let grid = Grid { x, y, columns, rows };
    grid.pixels().map_err(value_error)?;
    Ok(grid)
}

/// The middles of the pixels of a window ((left, right), (bottom, top)): an array for each side.
#[pyfunction]
pub(crate) fn pixel_middles<'py>(
    py: Python<'py>,
    window: Window,
    #[pyo3(from_py_with = two_whole)] shape: [usize; 2],
) -> PyResult<Middles<'py>> {
    let grid = grid_of(window, shape)?;
    room_for(grid.columns.max(grid.rows), 2 * size_of::<f64>())?;
    let across = (0..grid.columns).map(|column| grid.x_at(column)).collect();
    let up = (0..grid.rows).map(|row| grid.y_at(row)).collect();
    Ok((shaped::<f64>(py, across, &[grid.columns])?, shaped::<f64>(py, up, &[grid.rows])?))
}

/// A number between two bounds.
#[pyclass(frozen, get_all, eq, module = "passive_hopper")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Bounds {
    /// The lower bound.
    pub(crate) lower: f64,
    /// The upper bound.
    pub(crate) upper: f64,
}

plain!(Bounds { lower, upper });

#[pymethods]
impl Bounds {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __repr__(&self) -> String {
        format!("Bounds(lower={:?}, upper={:?})", self.lower, self.upper)
    }

    fn __contains__(&self, number: f64) -> bool {
        self.lower <= number && number <= self.upper
    }
}

/// All basins at one mass ratio, as intervals of the lift-off speed.
#[pyclass(frozen, eq, module = "passive_hopper")]
#[derive(PartialEq)]
pub(crate) struct IntervalBasins {
    found: HopperBasins,
}

/// An interval for pickle: its ends, its label and its level.
type PickledInterval = (f64, f64, u16, Option<usize>);
/// All intervals for pickle: the window, the intervals, the numbers of the reason and of the ground, and the probes.
type Stored = ((f64, f64), Vec<PickledInterval>, usize, usize, (usize, usize, Option<f64>));

const REASONS: [StopReason; 7] = [
    StopReason::Resolved,
    StopReason::AllFollowed,
    StopReason::SampledBranches,
    StopReason::Contradiction,
    StopReason::ShortestInterval,
    StopReason::LevelLimit,
    StopReason::IntervalLimit,
];
const GROUNDS: [BranchGround; 3] =
    [BranchGround::Proved, BranchGround::Enclosures, BranchGround::ContactParts];

/// The number of a value in a list that has them all.
fn number_of<T: PartialEq>(all: &[T], value: &T) -> usize {
    all.iter().position(|own| own == value).unwrap_or(all.len())
}

/// The intervals that pickle has stored.
pub(crate) fn restored_basins(py: Python<'_>, values: &Bound<'_, PyTuple>) -> PyResult<Py<PyAny>> {
    let ((left, right), parts, reason, ground, probes): Stored = values.extract()?;
    let wrong = || InputError::new_err("the pickle of these intervals has a wrong number");
    let window = Interval::new(left, right).map_err(value_error)?;
    let part = |(left, right, label, level): PickledInterval| {
        let interval = Interval::new(left, right).map_err(value_error)?;
        Ok(LabelledInterval { interval, label: Label::from_code(label), level })
    };
    let parts = parts.into_iter().map(part).collect::<PyResult<Vec<_>>>()?;
    let reason = *REASONS.get(reason).ok_or_else(wrong)?;
    let basins = basin_of_attraction::IntervalBasins::from_parts(window, parts, reason)
        .map_err(value_error)?;
    let (compared, wrong_probes, first_wrong) = probes;
    let probes = Probes { compared, wrong: wrong_probes, first_wrong };
    let found = HopperBasins { basins, ground: *GROUNDS.get(ground).ok_or_else(wrong)?, probes };
    Ok(Py::new(py, IntervalBasins { found })?.into_any())
}

#[pymethods]
impl IntervalBasins {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, HopperBasins { basins, ground, probes }) = (slf.py(), &slf.get().found);
        let part = |part: &LabelledInterval| {
            (part.interval.left, part.interval.right, part.label.code(), part.level)
        };
        let window = (basins.window().left, basins.window().right);
        let parts: Vec<PickledInterval> = basins.intervals().iter().map(part).collect();
        let numbers = (number_of(&REASONS, &basins.stop_reason()), number_of(&GROUNDS, ground));
        let probes = (probes.compared, probes.wrong, probes.first_wrong);
        let stored: Stored = (window, parts, numbers.0, numbers.1, probes);
        restoring(py, "IntervalBasins", stored.into_pyobject(py)?)
    }

    /// The lower ends, the upper ends and the labels (uint16) of all intervals, from below.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Labels<'py>> {
        let parts = self.found.basins.intervals();
        let shape = [parts.len()];
        let left = parts.iter().map(|part| part.interval.left).collect::<Vec<f64>>();
        let right = parts.iter().map(|part| part.interval.right).collect::<Vec<f64>>();
        let labels = parts.iter().map(|part| part.label.code()).collect::<Vec<u16>>();
        Ok((shaped(py, left, &shape)?, shaped(py, right, &shape)?, shaped(py, labels, &shape)?))
    }

    fn __len__(&self) -> usize {
        self.found.basins.intervals().len()
    }

    /// The window of speeds.
    #[getter]
    fn window(&self) -> (f64, f64) {
        let window = self.found.basins.window();
        (window.left, window.right)
    }

    /// The total length that belongs to no interval.
    #[getter]
    fn undecided(&self) -> f64 {
        self.found.basins.undecided()
    }

    /// Why the search stopped.
    #[getter]
    fn stop_reason(&self) -> String {
        format!("{:?}", self.found.basins.stop_reason())
    }

    /// What the labels stand on: "branches" of the map that are proved to be all, "enclosures" of images of
    /// intervals, or "contact parts" alone, at M > 50, where the sudden windows stay undecided.
    #[getter]
    fn ground(&self) -> &'static str {
        match self.found.ground {
            BranchGround::Proved => "branches",
            BranchGround::Enclosures => "enclosures",
            BranchGround::ContactParts => "contact parts",
        }
    }

    /// The number of random speeds whose fate was compared with their interval, and the number of those that differ.
    #[getter]
    fn probes(&self) -> (usize, usize) {
        (self.found.probes.compared, self.found.probes.wrong)
    }

    /// Bounds on the fraction of the window that has this label. They hold as the labels do: see `ground`.
    fn fraction(&self, #[pyo3(from_py_with = whole)] label: u16) -> Bounds {
        let basins = &self.found.basins;
        let bounds = basins.basin_length(Label::from_code(label));
        let length = basins.window().length();
        Bounds { lower: bounds.lower / length, upper: (bounds.upper / length).min(1.0) }
    }

    /// The probability that a speed of one basin is in another after the mass ratio has changed to that of `after`:
    /// a dictionary from pairs (label before, label after) to Bounds. Both have the same window.
    fn tipping_to(&self, after: &Self) -> PyResult<BTreeMap<(u16, u16), Bounds>> {
        let (one, two) = (&self.found.basins, &after.found.basins);
        let tipping = one.tipping_to(two).map_err(value_error)?;
        let pairs = one.labels().into_iter().flat_map(|before| {
            two.labels().into_iter().map(move |after| (before, after)).collect::<Vec<_>>()
        });
        let found = pairs.filter_map(|(before, after)| {
            let probability = tipping.probability(before, after)?;
            let bounds = Bounds { lower: probability.lower, upper: probability.upper };
            Some(((before.code(), after.code()), bounds))
        });
        Ok(found.collect())
    }

    /// The label of the interval that contains α; None where it is undecided.
    fn label(&self, alpha: f64) -> Option<u16> {
        self.found.basins.label(alpha).map(Label::code)
    }

    fn __repr__(&self) -> String {
        let (left, right) = self.window();
        format!(
            "IntervalBasins({} intervals on [{left:?}, {right:?}], undecided {:e}, {})",
            self.__len__(),
            self.undecided(),
            self.ground()
        )
    }
}

/// All basins between α*_first and α*_last at one mass ratio, as intervals with ends to an ulp.
///
/// The search stops as soon as no more than the length `undecided` is open or about `most` intervals are found, and
/// does not follow intervals below `shortest`. `samples` points search each sudden window for branches of the map.
/// No label is wrong, at any M.
///
/// >>> from passive_hopper import interval_basins
/// >>> basins = interval_basins(0.2, last=2)
/// >>> basins.ground
/// 'branches'
/// >>> basins.fraction(1)
/// Bounds(lower=0.046297011493017744, upper=0.04629728650865171)
#[pyfunction]
#[pyo3(signature = (mass_ratio, first = 1, last = 6, undecided = 1e-6, shortest = 1e-12, samples = 400, most = 100_000))]
#[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
pub(crate) fn interval_basins(
    py: Python<'_>,
    mass_ratio: f64,
    #[pyo3(from_py_with = whole)] first: u64,
    #[pyo3(from_py_with = whole)] last: u64,
    undecided: f64,
    shortest: f64,
    #[pyo3(from_py_with = whole)] samples: usize,
    #[pyo3(from_py_with = whole)] most: usize,
) -> PyResult<IntervalBasins> {
    let refinement = Refinement { undecided, shortest, intervals: most, ..Refinement::default() };
    let work = move |_: &Watch| {
        let fates = Fates::new(MassRatio::new(mass_ratio)?)?;
        hopper_proof::basins_at_every_mass_ratio(&fates, first, last, samples, refinement)
    };
    in_background(py, work, value_error, |_| Ok(())).map(|found| IntervalBasins { found })
}

/// The basin fractions by the paper's protocol: `points` equally spaced speeds between any two neighbouring fixed
/// points. A dictionary from names of fates to fractions.
#[pyfunction]
#[pyo3(signature = (mass_ratio, first = 1, last = 6, points = 10_000))]
pub(crate) fn fractions(
    py: Python<'_>,
    mass_ratio: f64,
    #[pyo3(from_py_with = whole)] first: u64,
    #[pyo3(from_py_with = whole)] last: u64,
    #[pyo3(from_py_with = whole)] points: usize,
) -> PyResult<BTreeMap<String, f64>> {
    let work = move |_: &Watch| {
        hopper_basin::basin_fractions(MassRatio::new(mass_ratio)?, first, last, points)
    };
    let found = in_background(py, work, value_error, |_| Ok(()))?;
    Ok(found.counts.keys().map(|&label| (HopperFate::label_name(label), found.of(label))).collect())
}
