//! The motion of both masses, as arrays and as an animation.

use crate::arrays::shaped;
use crate::errors::{InputError, value_error};
use crate::interruptible::{Watch, in_background, progress_function};
use crate::whole::whole;
use hopper_figures::{
    AnimationForm, Motion, MotionEvent, Sample, animation, animation_frame, frame_times,
};
use passive_hopper::{HopperState, MassRatio, Phase};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::ops::ControlFlow;

/// The events of a motion: the code in arrays, and the name.
const EVENTS: [(MotionEvent, u8, &str); 3] = [
    (MotionEvent::GradualLiftOff, 0, "gradual_lift_off"),
    (MotionEvent::Landing, 1, "landing"),
    (MotionEvent::SuddenLiftOff, 2, "sudden_lift_off"),
];

/// The motion over some hops as a dictionary of arrays: times (units of 1/ω), hops, contact (whether the lower mass
/// is on the ground), states with the columns y₁, ẏ₁, y₂, ẏ₂ (units of m₂g/k and m₂gω/k), event_times and
/// event_kinds; and grounded.
///
/// A landing has two samples at the same time, before the collision and after it. motion(…) is the same as an
/// xarray.Dataset.
#[pyfunction]
#[pyo3(signature = (alpha, mass_ratio, hops = 10))]
pub(crate) fn motion_arrays(
    py: Python<'_>,
    alpha: f64,
    mass_ratio: f64,
    #[pyo3(from_py_with = whole)] hops: usize,
) -> PyResult<Bound<'_, PyDict>> {
    let work = move |_: &Watch| motion_of(alpha, mass_ratio, hops);
    let motion = in_background(py, work, value_error, |_| Ok(()))?;
    let samples = &motion.samples;
    let count = samples.len();
    let states = samples.iter().flat_map(|sample| {
        let s = sample.state;
        [s.upper_position, s.upper_velocity, s.lower_position, s.lower_velocity]
    });
    let code = |event: MotionEvent| EVENTS.iter().find(|own| own.0 == event).map(|own| own.1);
    let kinds: Vec<u8> = motion.events.iter().filter_map(|&(_, event)| code(event)).collect();
    let event_times: Vec<f64> = motion.events.iter().map(|&(time, _)| time).collect();
    let events = event_times.len();
    let found = PyDict::new(py);
    let times: Vec<f64> = samples.iter().map(|sample| sample.time).collect();
    found.set_item("times", shaped(py, times, &[count])?)?;
    let hop_numbers: Vec<u64> = samples.iter().map(|sample| sample.hop as u64).collect();
    found.set_item("hops", shaped(py, hop_numbers, &[count])?)?;
    let contact: Vec<bool> = samples.iter().map(|s| s.phase == Phase::Contact).collect();
    found.set_item("contact", shaped(py, contact, &[count])?)?;
    found.set_item("states", shaped(py, states.collect(), &[count, 4])?)?;
    found.set_item("event_times", shaped(py, event_times, &[events])?)?;
    found.set_item("event_kinds", shaped(py, kinds, &[events])?)?;
    found.set_item("grounded", motion.grounded)?;
    Ok(found)
}

/// The meanings of event_kinds: pairs of a code and a name.
#[pyfunction]
pub(crate) fn motion_event_names() -> Vec<(u8, &'static str)> {
    EVENTS.iter().map(|&(_, code, name)| (code, name)).collect()
}

/// The animation of a motion as the bytes of a file; `form` is "gif" or "apng". `progress(done, all)` counts the
/// frames.
///
/// The motion is given by its samples: times, numbers of hops, whether the lower mass is on the ground, and states
/// with the columns y₁, ẏ₁, y₂, ẏ₂, as motion_arrays gives them.
#[pyfunction]
#[pyo3(signature = (mass_ratio, times, hops, contact, states, form = "gif", progress = None))]
#[expect(clippy::too_many_arguments, reason = "they are the arrays of motion_arrays")]
pub(crate) fn animation_bytes<'py>(
    py: Python<'py>,
    mass_ratio: f64,
    times: Vec<f64>,
    hops: Vec<usize>,
    contact: Vec<bool>,
    states: Vec<[f64; 4]>,
    form: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyBytes>> {
    let count = times.len();
    if [hops.len(), contact.len(), states.len()] != [count; 3] {
        return Err(InputError::new_err(format!(
            "the samples of a motion have one length: {count} times, {} hops, {} contacts and {} states",
            hops.len(),
            contact.len(),
            states.len()
        )));
    }
    let rows = times.into_iter().zip(hops).zip(contact).zip(states);
    let samples = rows.map(|(((time, hop), contact), state)| {
        let [upper_position, upper_velocity, lower_position, lower_velocity] = state;
        let state = HopperState { upper_position, upper_velocity, lower_position, lower_velocity };
        Sample { time, hop, phase: if contact { Phase::Contact } else { Phase::Flight }, state }
    });
    let ratio = MassRatio::new(mass_ratio).map_err(value_error)?;
    let motion = Motion::from_samples(ratio, samples.collect()).map_err(value_error)?;
    let form = match form {
        "gif" => AnimationForm::Gif,
        "apng" => AnimationForm::Apng,
        other => {
            let text = format!("an animation is a gif or an apng file, not {other:?}");
            return Err(InputError::new_err(text));
        }
    };
    let progress = progress_function(py, progress)?;
    let times = frame_times(&motion).map_err(value_error)?;
    let all = times.len();
    let work = move |watch: &Watch| {
        let frame = |k: usize| animation_frame(&motion, times[k], form).map_err(Failure::Figure);
        let count = |_: usize| {
            watch.finished(1);
            if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let frames = basin_of_attraction::columns_in_parallel(times.len(), frame, count)?;
        animation(&frames, form).map_err(Failure::Figure)
    };
    let bytes = in_background(py, work, value_error, |done| match &progress {
        Some(progress) => progress.call1((done, all)).map(drop),
        None => Ok(()),
    })?;
    Ok(PyBytes::new(py, &bytes))
}

/// Why an animation could not be made.
#[derive(Debug)]
enum Failure {
    Figure(hopper_figures::Error),
    Frames(basin_of_attraction::Error),
}

impl From<basin_of_attraction::Error> for Failure {
    fn from(error: basin_of_attraction::Error) -> Self {
        Failure::Frames(error)
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Failure::Figure(error) => error.fmt(f),
            Failure::Frames(error) => error.fmt(f),
        }
    }
}

fn motion_of(
    alpha: f64,
    mass_ratio: f64,
    hops: usize,
) -> Result<hopper_figures::Motion, hopper_figures::Error> {
    hopper_figures::Motion::new(MassRatio::new(mass_ratio)?, alpha, hops)
}
