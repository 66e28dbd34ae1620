//! Periodic orbits that exist.

use super::equations::Equations;
use crate::errors::{UndecidedError, of_hybrid, value_error};
use crate::interruptible::{Watch, in_background};
use pyo3::prelude::*;
use validated_dynamics::{
    Enclosure, Error, Multiplier, ProvedEvent, ProvedFixedPoint, SectionMap, ValidatedSystem,
    fixed_point,
};

/// What is asked. Parameters with intervals are the last variables.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Question {
    mode: String,
    surface: String,
    variables: Vec<String>,
    guess: Vec<f64>,
    states: Vec<String>,
    read: Vec<String>,
    intervals: Vec<(String, f64, f64)>,
    #[pyo3(from_py_with = crate::whole::whole)]
    count: usize,
}

/// An interval as two numbers.
type Ends = (f64, f64);

/// The box of the point, the box in which it is the only one, the multipliers as discs, whether all are inside the unit circle, whether it is a saddle, and
/// the surfaces of the events with their times.
type Found =
    (Vec<Ends>, Vec<Ends>, Vec<(f64, f64, f64)>, bool, bool, Vec<(String, Ends, Vec<Ends>)>);

fn ends(all: &[Enclosure]) -> Vec<Ends> {
    all.iter().map(|x| (x.low(), x.high())).collect()
}

fn found(orbit: &ProvedFixedPoint) -> Found {
    let disc = |own: &Multiplier| (own.real, own.imaginary, own.radius);
    let event = |own: &ProvedEvent| {
        (own.surface.to_string(), (own.time.low(), own.time.high()), ends(&own.after))
    };
    (
        ends(&orbit.point),
        ends(&orbit.unique_in),
        orbit.multipliers.iter().map(disc).collect(),
        orbit.is_attracting(),
        orbit.is_saddle(),
        orbit.image.events.iter().map(event).collect(),
    )
}

/// The exception of an error of the library.
fn of_proof(error: Error) -> PyErr {
    match error {
        Error::Undecided(_) => UndecidedError::new_err(error.to_string()),
        Error::Equations(error) => of_hybrid(&error),
        Error::Formula(error) => of_hybrid(&error.into()),
        other => value_error(other),
    }
}

fn prove(
    equations: &hybrid_system::Equations,
    question: &Question,
    watch: &Watch,
) -> Result<Found, Error> {
    let [variables, states, read] = [&question.variables, &question.states, &question.read]
        .map(|list| list.iter().map(String::as_str).collect::<Vec<_>>());
    let names: Vec<&str> = question.intervals.iter().map(|own| own.0.as_str()).collect();
    let system = ValidatedSystem::with_interval_parameters(equations, &names)?;
    let chart = system.chart(&question.mode, &variables, &states)?;
    let stop = || watch.is_stopped();
    let map = SectionMap::new(&system, chart, &question.surface, question.count, &read)?;
    let intervals: Vec<Enclosure> =
        question.intervals.iter().map(|own| Enclosure::new(own.1, own.2)).collect();
    fixed_point(&map.stopped_by(&stop), &question.guess, &intervals).map(|orbit| found(&orbit))
}

/// As nonsmooth.proved_orbit.
#[pyfunction]
pub(crate) fn _proved_orbit(
    py: Python<'_>,
    equations: &Equations,
    question: Question,
) -> PyResult<Found> {
    let own = equations.equations().clone();
    in_background(py, move |watch: &Watch| prove(&own, &question, watch), of_proof, |_| Ok(()))
}
