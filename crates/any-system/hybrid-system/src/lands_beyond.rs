//! The error of a jump beyond a guard that says neither that it is a contact nor that it is a crossing.

use crate::number::Number;
use thiserror::Error;

/// A reset leads to a state on the far side of a surface, and the guard does not say what that means.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "{place} guard {surface} of mode {mode}, at time {time}, with the value {value} and a rounding of {rounding}: \
     declare the guard a `contact` if it holds, so that the event happens at once, or a `crossing` if it is an event \
     only where the flow crosses it",
    place = if *.on_surface { "a jump leads through" } else { "a jump leads beyond" },
    time = Number(*.time), value = Number(*.value), rounding = Number(*.rounding)
)]
pub struct LandsBeyond {
    /// The mode after the jump.
    pub mode: String,
    /// The guard's surface.
    pub surface: String,
    /// Continuous time t.
    pub time: f64,
    /// The value of the guard after the jump.
    pub value: f64,
    /// The part of the value that may be rounding.
    pub rounding: f64,
    /// True if the state is on the surface within rounding, and the flow leads beyond it.
    pub on_surface: bool,
}
