//! What random starts show of the stability of attractors, and of where their states go at a change.

use super::kinds::no_steps;
use super::search::Attractors;
use crate::errors::{InputError, value_error};
use crate::labelling::{Interval, region_of};
use crate::whole::{room_for, whole};
use basin_of_attraction::{
    AttractorStability, Error, Label, LabelCounts, Shock, SplitMix64, Stability, TippingCounts,
};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Random points of a region: how many, and their seed.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Sample {
    region: Vec<[f64; 2]>,
    #[pyo3(from_py_with = whole)]
    count: usize,
    #[pyo3(from_py_with = whole)]
    seed: u64,
}

impl Sample {
    /// The points, one after the other.
    fn points(&self) -> PyResult<Vec<Vec<f64>>> {
        room_for(self.count, size_of::<Vec<f64>>() + size_of::<f64>() * self.region.len())?;
        let (region, random) = (region_of(&self.region)?, SplitMix64::from_seed(self.seed));
        Ok((0..self.count as u64).map(|k| region.random_point(&random, k)).collect())
    }
}

/// The size, the nearest point of the attractor, the state after it, and its label.
type ShockRow = (f64, Vec<f64>, Vec<f64>, u16);

fn shock(own: &Shock) -> ShockRow {
    (own.size, own.from.clone(), own.state.clone(), own.label.code())
}

/// The fraction, the mean time, the longest time with its start and the share beyond, the smallest fatal shock, the largest harmless one,
/// the mean size of harmless ones, and the median time.
type StabilityRow = (
    Interval,
    Option<Interval>,
    Option<(usize, Vec<f64>, f64)>,
    Option<ShockRow>,
    Option<ShockRow>,
    Option<Interval>,
    Option<Interval>,
);

fn row(own: &AttractorStability) -> StabilityRow {
    (
        own.fraction.into(),
        own.mean_time.map(Interval::from),
        own.longest.as_ref().map(|own| (own.steps, own.start.clone(), own.longer)),
        own.fatal.as_ref().map(shock),
        own.harmless.as_ref().map(shock),
        own.mean_harmless.map(Interval::from),
        // Of few starts it has no interval.
        own.time_quantile(0.5).ok().map(Interval::from),
    )
}

/// As nonsmooth.stability_of. Without a precision the fatal shocks are those of the starts.
#[pyfunction]
pub(crate) fn _stability(
    py: Python<'_>,
    attractors: &Attractors,
    sample: Sample,
    precision: Option<f64>,
    threads: Option<usize>,
) -> PyResult<BTreeMap<u16, StabilityRow>> {
    attractors.check_dimension(sample.region.len())?;
    let starts = sample.points()?;
    let kind = Arc::clone(&attractors.kind);
    let found = attractors.with_labels(py, threads, move |map, label| {
        let dimension = starts.first().map_or(0, Vec::len);
        let start = |k: usize, state: &mut [f64]| state.copy_from_slice(&starts[k]);
        let (labels, steps) = kind.convergences(map, (starts.len(), dimension), start)?;
        let Some(steps) = steps else { return Ok(None) };
        let times: Vec<(Label, usize)> =
            labels.into_iter().zip(steps.into_iter().map(|steps| steps as usize)).collect();
        let mut found = Stability::new(&kind.points(), &starts, &times)?;
        if let Some(precision) = precision {
            found.shorten_fatal_shocks(precision, label)?;
        }
        Ok(Some(found))
    })?;
    let Some(found) = found else { return Err(no_steps()) };
    Ok(found.attractors().iter().map(|(label, own)| (label.code(), row(own))).collect())
}

/// The labels before and after, with the probability and the number of points that go this way.
type TippingRow = (u16, u16, Interval, usize);

/// As nonsmooth.tipping.
#[pyfunction]
pub(crate) fn _tipping(
    py: Python<'_>,
    before: &Attractors,
    after: &Attractors,
    sample: Sample,
    threads: Option<usize>,
) -> PyResult<Vec<TippingRow>> {
    before.check_dimension(sample.region.len())?;
    after.check_dimension(sample.region.len())?;
    let (points, dimension) = (sample.points()?, sample.region.len());
    let labels = |of: &Attractors| {
        let (points, kind) = (points.clone(), Arc::clone(&of.kind));
        of.with_labels(py, threads, move |map, _| {
            let start = |k: usize, state: &mut [f64]| state.copy_from_slice(&points[k]);
            Ok(kind.convergences(map, (points.len(), dimension), start)?.0)
        })
    };
    let (before, after) = (labels(before)?, labels(after)?);
    let (first, second) = (counted(&before)?, counted(&after)?);
    let tips = TippingCounts::new(before.into_iter().zip(after)).map_err(value_error)?;
    let mut rows = Vec::new();
    for from in first.basins() {
        for to in second.basins() {
            if let Some(own) = tips.probability(from, to).map_err(value_error)? {
                rows.push((from.code(), to.code(), own.into(), tips.count(from, to)));
            }
        }
    }
    Ok(rows)
}

fn counted(labels: &[Label]) -> PyResult<LabelCounts> {
    LabelCounts::new(labels.iter().copied())
        .map_err(|error: Error| InputError::new_err(error.to_string()))
}
