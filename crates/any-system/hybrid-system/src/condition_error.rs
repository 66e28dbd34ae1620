//! The errors of conditions.

use crate::number::Number;
use thiserror::Error;

/// Why a condition gives no answer.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ConditionError {
    /// The sign of the condition is lost in its error.
    #[error(
        "whether the event of {surface} at {time} counts is not decided: its condition is {value}, with an error of {error}; \
         move the condition away from the event, or give what happens at both a guard of its own",
        time = Number(*.time), value = Number(*.value), error = Number(*.error)
    )]
    Undecided {
        /// The surface.
        surface: String,
        /// The time of the event.
        time: f64,
        /// The value of the condition.
        value: f64,
        /// Its error: by rounding, and by the time of the event.
        error: f64,
    },
    /// The guard is no crossing: beyond its surface its mode would not flow.
    #[error(
        "the guard of {surface} has a condition, so that its mode flows on both sides: make it a crossing"
    )]
    OfBound {
        /// The surface.
        surface: String,
    },
}
