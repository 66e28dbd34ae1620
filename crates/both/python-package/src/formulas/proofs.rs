//! Periodic orbits that exist.

use super::equations::Equations;
use crate::errors::{UndecidedError, of_hybrid, value_error};
use crate::interruptible::{Watch, in_background};
use pyo3::prelude::*;
use validated_dynamics::{
    Certificate, Enclosure, Error, Multiplier, ProvedEvent, ProvedFixedPoint, SectionMap,
    ValidatedSystem, fixed_point,
};

/// A map from a section to a surface. Parameters with intervals are the last variables.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Question {
    mode: String,
    surface: String,
    variables: Vec<String>,
    states: Vec<String>,
    read: Vec<String>,
    intervals: Vec<(String, f64, f64)>,
    #[pyo3(from_py_with = crate::whole::whole)]
    count: usize,
    /// The name of a certificate, if one is wanted.
    pub(crate) certificate: Option<String>,
}

/// An interval as two numbers.
pub(crate) type Ends = (f64, f64);

/// The box of the point, the box in which it is the only one, the multipliers as discs, whether all are inside the unit circle, whether it is a saddle, and
/// the surfaces of the events with their times.
pub(crate) type Found =
    (Vec<Ends>, Vec<Ends>, Vec<(f64, f64, f64)>, bool, bool, Vec<(String, Ends, Vec<Ends>)>);

fn ends(all: &[Enclosure]) -> Vec<Ends> {
    all.iter().map(|x| (x.low(), x.high())).collect()
}

pub(crate) fn found(orbit: &ProvedFixedPoint) -> Found {
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
pub(crate) fn of_proof(error: Error) -> PyErr {
    match error {
        Error::Undecided(_) => UndecidedError::new_err(error.to_string()),
        Error::Equations(error) => of_hybrid(&error),
        Error::Formula(error) => of_hybrid(&error.into()),
        other => value_error(other),
    }
}

impl Question {
    /// What `work` finds of the map, which ends soon after the result is no longer wanted, and of the intervals.
    pub(crate) fn answer<T>(
        &self,
        equations: &hybrid_system::Equations,
        watch: &Watch,
        work: impl FnOnce(&SectionMap<'_>, &[Enclosure]) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let [variables, states, read] = [&self.variables, &self.states, &self.read]
            .map(|list| list.iter().map(String::as_str).collect::<Vec<_>>());
        let names: Vec<&str> = self.intervals.iter().map(|own| own.0.as_str()).collect();
        let system = ValidatedSystem::with_interval_parameters(equations, &names)?;
        let chart = system.chart(&self.mode, &variables, &states)?;
        let stop = || watch.is_stopped();
        let map = SectionMap::new(&system, chart, &self.surface, self.count, &read)?;
        let map = map.stopped_by(&stop);
        let map = if self.certificate.is_some() { map.recorded() } else { map };
        let intervals: Vec<Enclosure> =
            self.intervals.iter().map(|own| Enclosure::new(own.1, own.2)).collect();
        work(&map, &intervals)
    }
}

/// As nonsmooth.proved_orbit, and the text of the certificate.
#[pyfunction]
pub(crate) fn _proved_orbit(
    py: Python<'_>,
    equations: &Equations,
    question: Question,
    guess: Vec<f64>,
) -> PyResult<(Found, Option<String>)> {
    let own = equations.equations().clone();
    let work = move |watch: &Watch| {
        question.answer(&own, watch, |map, intervals| {
            let orbit = fixed_point(map, &guess, intervals)?;
            let Some(name) = &question.certificate else { return Ok((found(&orbit), None)) };
            let mut certificate = Certificate::new(name);
            certificate.fixed_point(map, &orbit)?;
            Ok((found(&orbit), Some(certificate.text())))
        })
    };
    in_background(py, work, of_proof, |_| Ok(()))
}
