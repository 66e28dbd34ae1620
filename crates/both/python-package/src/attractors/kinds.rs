//! The ways in which attractors are known: by recurrences, by points, or by features of orbits.

use super::state_map::PythonFeature;
use crate::errors::{InputError, value_error};
use basin_of_attraction::{Attractors, FeatureAttractors, KnownAttractors, Label, StateMap};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Successive points of an orbit on each attractor.
pub(super) type Points = BTreeMap<Label, Vec<Vec<f64>>>;

/// Attractors, as they are known.
pub(super) enum Kind {
    Recurrences(Attractors),
    Points(Points, KnownAttractors),
    Features(FeatureAttractors, PythonFeature),
}

/// The labels of many starts, and the steps of each to its attractor. Features tell no steps.
pub(super) type Convergences = (Vec<Label>, Option<Vec<u64>>);

impl Kind {
    pub(super) fn points(&self) -> Points {
        match self {
            Kind::Recurrences(found) => found.positions(),
            Kind::Points(points, _) => points.clone(),
            Kind::Features(found, _) => found.positions(),
        }
    }

    /// The label of a state.
    pub(super) fn label(&self, map: &dyn StateMap, state: &[f64]) -> Label {
        match self {
            Kind::Recurrences(found) => found.label(map, state),
            Kind::Points(_, known) => known.label(map, state),
            Kind::Features(found, feature) => {
                found.label(map, &|points: &[Vec<f64>]| feature.of(points), state)
            }
        }
    }

    /// The labels of many states, of which `start` writes the one with a number.
    pub(super) fn convergences(
        &self,
        map: &dyn StateMap,
        (count, dimension): (usize, usize),
        start: impl Fn(usize, &mut [f64]) + Sync,
    ) -> Result<Convergences, basin_of_attraction::Error> {
        let all = match self {
            Kind::Recurrences(found) => found.convergences(map, count, start)?,
            Kind::Points(_, known) => known.convergences(map, count, start)?,
            Kind::Features(..) => {
                let label = |k: usize| {
                    let mut state = vec![0.0; dimension];
                    start(k, &mut state);
                    self.label(map, &state)
                };
                return Ok(((0..count).into_par_iter().map(label).collect(), None));
            }
        };
        let (labels, steps) = all.into_iter().map(|(label, steps)| (label, steps as u64)).unzip();
        Ok((labels, Some(steps)))
    }

    /// What was found, unless a function of Python has raised an exception.
    pub(super) fn unless_raised<T>(&self, found: T) -> PyResult<T> {
        match self {
            Kind::Features(_, feature) => feature.unless_raised(found),
            Kind::Recurrences(_) | Kind::Points(..) => Ok(found),
        }
    }
}

/// The labels of a user's dictionary, which are those of basins.
pub(super) fn points_by_label(points: BTreeMap<u16, Vec<Vec<f64>>>) -> PyResult<Points> {
    if points.is_empty() {
        return Err(InputError::new_err(
            "points= has a list of points for each attractor, by its label: {1: [[0, 0]]}",
        ));
    }
    Ok(points.into_iter().map(|(code, own)| (Label::from_code(code), own)).collect())
}

/// The error of steps where attractors are known by features.
pub(super) fn no_steps() -> PyErr {
    value_error(
        "attractors that are known by features tell no steps: use labels(), or attractors by recurrences or points",
    )
}
