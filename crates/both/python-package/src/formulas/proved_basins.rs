//! Basins that are proved cell by cell.

use super::equations::Equations;
use super::proofs::{Ends, Found, Question, found, of_proof};
use crate::errors::value_error;
use crate::interruptible::{Watch, in_background, progress_function};
use numpy::{PyArray1, PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use validated_dynamics::{
    Certificate, Division, Enclosure, Error, Progress, ProvedFate, Trap, fixed_point,
};

/// The images that a trap may use to grow.
const TRAP_IMAGES: usize = 20_000;

/// The code of what is open.
const OPEN: i64 = -1;

/// The orbit of a trap, its centre, its directions as rows of a matrix, and its size.
type FoundTrap = (Found, Vec<f64>, Vec<Vec<f64>>, f64);

/// The ends of cells, and the codes of their fates.
type FoundCells<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i64>>);

/// The basins of nonsmooth.proved_basins. Codes count the traps, and then the surfaces.
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct ProvedBasins {
    basins: validated_dynamics::ProvedBasins,
    orbits: Vec<Found>,
    fates: Vec<ProvedFate>,
    text: Option<String>,
}

#[pymethods]
impl ProvedBasins {
    /// The traps.
    fn traps(&self) -> Vec<FoundTrap> {
        let rows = |trap: &Trap| {
            let directions = trap.directions();
            let row = |row| directions.row(row).iter().copied().collect();
            (0..directions.nrows()).map(row).collect()
        };
        let one = |(trap, orbit): (&Trap, &Found)| {
            (orbit.clone(), trap.centre().to_vec(), rows(trap), trap.size())
        };
        self.basins.traps().iter().zip(&self.orbits).map(one).collect()
    }

    /// The surfaces at which points stop.
    fn surfaces(&self) -> Vec<String> {
        let name = |fate: &ProvedFate| match fate {
            ProvedFate::Stopped(surface) => Some(surface.to_string()),
            ProvedFate::Trap(_) => None,
        };
        self.fates.iter().filter_map(name).collect()
    }

    /// The images that were computed.
    fn images(&self) -> usize {
        self.basins.images
    }

    /// A lower bound of the share of each fate.
    fn shares(&self) -> Vec<f64> {
        self.fates.iter().map(|fate| self.basins.share(*fate)).collect()
    }

    /// The certificate.
    fn certificate(&self) -> Option<&str> {
        self.text.as_deref()
    }

    /// The codes of the fates of points, each a row.
    fn codes<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
    ) -> Bound<'py, PyArray1<i64>> {
        let code = |point: &[f64]| self.basins.fate(0, point).map_or(OPEN, |fate| self.code(fate));
        let rows = points.as_array();
        let codes = rows.outer_iter().map(|row| code(&row.to_vec())).collect();
        PyArray1::from_vec(py, codes)
    }

    /// The cells with a fate, with the low and then the high ends of each one in a row, and the codes of their fates.
    fn cells<'py>(&self, py: Python<'py>) -> PyResult<FoundCells<'py>> {
        let cells = self.basins.cells();
        let row = |points: &[Enclosure]| {
            let low = points.iter().map(|x| x.low());
            low.chain(points.iter().map(|x| x.high())).collect::<Vec<_>>()
        };
        let rows: Vec<Vec<f64>> = cells.iter().map(|cell| row(&cell.points)).collect();
        let codes = cells.iter().map(|cell| self.code(cell.fate)).collect();
        let rows = PyArray2::from_vec2(py, &rows).map_err(value_error)?;
        Ok((rows, PyArray1::from_vec(py, codes)))
    }
}

impl ProvedBasins {
    fn code(&self, fate: ProvedFate) -> i64 {
        let place = self.fates.iter().position(|known| *known == fate);
        place.map_or(OPEN, |place| place as i64)
    }
}

/// As nonsmooth.proved_basins.
#[pyfunction]
pub(crate) fn _proved_basins(
    py: Python<'_>,
    equations: &Equations,
    question: Question,
    guesses: Vec<Vec<f64>>,
    window: Vec<Ends>,
    division: (u32, u32, usize),
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<ProvedBasins> {
    let progress = progress_function(py, progress)?;
    let own = equations.equations().clone();
    let division = Division { first: division.0, last: division.1, images: division.2 };
    let work = move |watch: &Watch| {
        let mut done = 0;
        let mut told = |progress: Progress| {
            watch.finished(progress.images - done);
            done = progress.images;
            if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        prove(&own, &question, (&guesses, &window), division, watch, &mut told)
    };
    let report = |done| match &progress {
        Some(progress) => progress.call1((done, division.images)).map(drop),
        None => Ok(()),
    };
    let found = in_background(py, work, of_proof, report)?;
    // Cells that are left over end it before all images are used up.
    if let Some(progress) = &progress {
        progress.call1((found.basins.images, found.basins.images))?;
    }
    Ok(found)
}

fn prove(
    equations: &hybrid_system::Equations,
    question: &Question,
    (guesses, window): (&[Vec<f64>], &[Ends]),
    division: Division,
    watch: &Watch,
    told: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<ProvedBasins, Error> {
    question.answer(equations, watch, |map, _| {
        let window: Vec<Enclosure> = window
            .iter()
            .map(|&(low, high)| Enclosure::between(low, high))
            .collect::<Result<_, _>>()?;
        // Before the traps, which take seconds.
        division.check(&[map], &[&window])?;
        let mut certificate = question.certificate.as_deref().map(Certificate::new);
        let (mut traps, mut orbits, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
        for guess in guesses {
            let orbit = fixed_point(map, guess, &[])?;
            let trap = Trap::new(map, &orbit, TRAP_IMAGES)?;
            if let Some(other) = traps.iter().position(|other: &Trap| other.contains(&orbit.point))
            {
                let reason = format!(
                    "number {} leads to the fixed point of number {}",
                    traps.len() + 1,
                    other + 1
                );
                return Err(Error::Argument { what: "guesses".to_owned(), reason });
            }
            if let Some(certificate) = &mut certificate {
                numbers.push(certificate.trap(map, &trap)?);
            }
            traps.push(trap);
            orbits.push(found(&orbit));
        }
        let basins =
            validated_dynamics::ProvedBasins::watched(&[map], traps, &[&window], division, told)?;
        if let Some(certificate) = &mut certificate {
            certificate.basins(map, &basins, &numbers)?;
        }
        let mut stopped: Vec<ProvedFate> = basins.cells().iter().map(|cell| cell.fate).collect();
        stopped.retain(|fate| matches!(fate, ProvedFate::Stopped(_)));
        stopped.sort_unstable();
        stopped.dedup();
        let fates = (0..guesses.len()).map(ProvedFate::Trap).chain(stopped).collect();
        let text = certificate.map(|own| own.text());
        Ok(ProvedBasins { basins, orbits, fates, text })
    })
}
