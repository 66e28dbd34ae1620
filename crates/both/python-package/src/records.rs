//! Results of arrays of speeds: records with a field for each number.

use crate::arrays::{Numbers, like, shaped};
use crate::errors::{map_error, value_error};
use crate::interruptible::{Watch, in_background};
use hopper_basin::{Fates, HOP_BUDGET, HopperFate};
use passive_hopper::{BoundedHop, LiftOffMap, MassRatio};
use pyo3::prelude::*;
use std::sync::Arc;

/// Speeds between two looks whether the results are still wanted: less than 10 ms, at 160 µs for the slowest hop.
const PIECE: usize = 64;

/// The values of a function of each speed, in the background.
fn each<T: Send + 'static, E: Send + 'static>(
    py: Python<'_>,
    speeds: Vec<f64>,
    mut value: impl FnMut(f64) -> Result<T, E> + Send + 'static,
    error: impl Fn(E) -> PyErr,
) -> PyResult<Vec<T>> {
    let work = move |watch: &Watch| {
        let mut values = Vec::with_capacity(speeds.len());
        for piece in speeds.chunks(PIECE) {
            if watch.is_stopped() {
                break;
            }
            for speed in piece {
                values.push(value(*speed)?);
            }
        }
        Ok(values)
    };
    in_background(py, work, error, |_| Ok(()))
}

/// An array of records with these fields, each an array of this shape.
fn records<'py>(
    py: Python<'py>,
    fields: &[(&str, Bound<'py, PyAny>)],
) -> PyResult<Bound<'py, PyAny>> {
    let names: Vec<&str> = fields.iter().map(|(name, _)| *name).collect();
    let arrays: Vec<_> = fields.iter().map(|(_, array)| array.clone()).collect();
    py.import("numpy")?
        .getattr("rec")?
        .call_method1("fromarrays", (arrays, py.None(), py.None(), py.None(), names))
}

/// The hops of many speeds: records with `speed`, `next`, `next_error`, `loss`, `sudden` and `flight_time`. NaN where there is none.
pub(crate) fn hops<'py>(
    py: Python<'py>,
    map: LiftOffMap,
    Numbers { values, shape }: Numbers,
) -> PyResult<Bound<'py, PyAny>> {
    let hop = move |speed: f64| match speed.is_nan() {
        true => Ok(None),
        false => map.bounded_hop(speed).map(Some),
    };
    let speeds = values.clone();
    let hops = each(py, values, hop, map_error)?;
    let numbers = |of: fn(&BoundedHop) -> Option<f64>| {
        let all = hops.iter().map(|hop| hop.as_ref().and_then(of).unwrap_or(f64::NAN));
        shaped(py, all.collect(), &shape)
    };
    let sudden = hops.iter().map(|own| own.as_ref().map_or(0, |own| own.hop.sudden as u64));
    records(
        py,
        &[
            ("speed", shaped(py, speeds, &shape)?),
            ("next", numbers(|own| own.hop.next)?),
            ("next_error", numbers(|own| own.next_error)?),
            ("loss", numbers(|own| own.hop.loss)?),
            ("sudden", shaped(py, sudden.collect(), &shape)?),
            ("flight_time", numbers(|own| Some(own.hop.flight_time))?),
        ],
    )
}

/// The fates of many speeds: records with `label` and `hops`. NaN is grounded.
pub(crate) fn fates<'py>(
    py: Python<'py>,
    fates: Arc<Fates>,
    Numbers { values, shape }: Numbers,
) -> PyResult<Bound<'py, PyAny>> {
    let fate = move |speed: f64| match speed.is_nan() {
        true => Ok((HopperFate::GROUNDED, 0)),
        false => fates.fate_within(speed, HOP_BUDGET).map(|(fate, hops)| (fate.label(), hops)),
    };
    let all = each(py, values, fate, value_error)?;
    let labels: Vec<u16> = all.iter().map(|(label, _)| label.code()).collect();
    let hops: Vec<u64> = all.iter().map(|(_, hops)| *hops as u64).collect();
    records(py, &[("label", shaped(py, labels, &shape)?), ("hops", shaped(py, hops, &shape)?)])
}

/// The derivatives at many speeds: records with `by_speed` and `by_mass_ratio`. NaN where the hopper is grounded.
pub(crate) fn slopes<'py>(
    py: Python<'py>,
    map: LiftOffMap,
    Numbers { values, shape }: Numbers,
) -> PyResult<Bound<'py, PyAny>> {
    let slopes = move |speed: f64| match speed.is_nan() {
        true => Ok(None),
        false => map.slopes(speed),
    };
    let all = each(py, values, slopes, map_error)?;
    let numbers = |of: fn(&passive_hopper::Slopes) -> f64| {
        shaped(py, all.iter().map(|own| own.as_ref().map_or(f64::NAN, of)).collect(), &shape)
    };
    let fields = [
        ("by_speed", numbers(|own| own.by_speed)?),
        ("by_mass_ratio", numbers(|own| own.by_mass_ratio)?),
    ];
    records(py, &fields)
}

/// α′ = f(α; M) for arrays of speeds and of mass ratios, which are broadcast against each other; NaN where the hopper is grounded.
///
/// >>> import numpy as np
/// >>> from passive_hopper import images
/// >>> images([[5.5], [7.0]], [0.2, 0.4]).shape
/// (2, 2)
#[pyfunction]
#[pyo3(signature = (alpha, M))]
#[expect(non_snake_case, reason = "the mass ratio is M in all papers")]
pub(crate) fn images<'py>(
    py: Python<'py>,
    alpha: &Bound<'py, PyAny>,
    M: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let both = py.import("numpy")?.call_method1("broadcast_arrays", (alpha, M))?;
    let [alpha, ratio]: [Numbers; 2] = both.extract()?;
    let shape = alpha.shape;
    let mut pairs = ratio.values.into_iter();
    let mut last: Option<LiftOffMap> = None;
    let image = move |speed: f64| {
        let ratio = pairs.next().unwrap_or(f64::NAN);
        let map = match last.take().filter(|map| map.mass_ratio().value() == ratio) {
            Some(map) => map,
            None => LiftOffMap::new(MassRatio::new(ratio)?),
        };
        let found = if speed.is_nan() { None } else { map.image(speed)? };
        last = Some(map);
        Ok(found.unwrap_or(f64::NAN))
    };
    like(py, each(py, alpha.values, image, map_error)?, &shape)
}
