//! The errors of this crate.

use thiserror::Error;

impl Error {
    /// The same error of a motion whose times begin so much later.
    #[must_use]
    pub fn later(mut self, by: f64) -> Error {
        if let Error::NoValue { time, .. } = &mut self
            && let Ok(own) = time.parse::<f64>()
        {
            *time = format!("{:?}", own + by);
        }
        self
    }
}

/// Why a formula was not made, read or evaluated.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// A text is no formula.
    #[error("column {column} of {text:?}: {reason}")]
    Text {
        /// The column, from 1 on, in characters.
        column: usize,
        /// The text, or its beginning.
        text: String,
        /// What is wrong there.
        reason: String,
    },
    /// A name is used twice, or is one of those that have a meaning.
    #[error("the name {name:?} is {reason}")]
    Name {
        /// The name.
        name: String,
        /// Why it cannot be used.
        reason: &'static str,
    },
    /// A vector has another length than the formulas need.
    #[error("{needed} {what} are needed, and {given} are given")]
    Length {
        /// Components of the state, parameters, outputs or field.
        what: &'static str,
        /// The number that is needed.
        needed: usize,
        /// The number that was given.
        given: usize,
    },
    /// A value is not finite, or an argument is outside the domain of its function.
    #[error(
        "{part} has no finite value, or no finite derivative, at t = {time}, state ({state}), parameters ({parameters})"
    )]
    NoValue {
        /// The part of the formula from which this comes.
        part: String,
        /// The time.
        time: String,
        /// The state.
        state: String,
        /// The parameters.
        parameters: String,
    },
    /// A closure used a symbol of other formulas.
    #[error(
        "a symbol of other formulas is used in these: give it to this closure as a state or a parameter"
    )]
    Foreign,
    /// A number of a closure, or of a direction, is not finite.
    #[error("the number {value} is no number of a formula: it must be finite")]
    Number {
        /// The number.
        value: f64,
    },
    /// More terms of a series are asked for than the limit.
    #[error("a series of order {order} is asked for; at most {most} are computed")]
    Order {
        /// The order that was asked for.
        order: usize,
        /// The limit.
        most: usize,
    },
    /// A derivative or a series of a function with a kink or a jump is asked for.
    #[error(
        "{part} has a kink or a jump, and no derivative there: make it a guard between two modes"
    )]
    Kink {
        /// The part of the formula.
        part: String,
    },
    /// Formulas would have more parts than the limit.
    #[error("the formulas have more than {limit} parts; write them with fewer")]
    TooLarge {
        /// The limit.
        limit: usize,
    },
    /// Tolerances that no step can meet.
    #[error(
        "the tolerances are {relative} and {absolute}: the relative one must be from 1e-17 to 0.1, the absolute one \
         at or above 0"
    )]
    Tolerance {
        /// The relative tolerance that was given.
        relative: f64,
        /// The absolute tolerance that was given.
        absolute: f64,
    },
    /// The longest step of a motion is no length.
    #[error("the longest step is {longest}: it must be positive")]
    LongestStep {
        /// The step that was given.
        longest: f64,
    },
    /// A time is not finite.
    #[error("the times {time} and {end} must be finite")]
    Time {
        /// The time of the start.
        time: f64,
        /// The time of the end.
        end: f64,
    },
    /// The steps of a motion do not reach its end.
    #[error(
        "the motion towards t = {end} comes no further than t = {time}: it has a pole or is stiff; end before it, or take \
         larger tolerances"
    )]
    Stuck {
        /// The time that is reached.
        time: f64,
        /// The time of the end.
        end: f64,
    },
    /// A file is no formulas.
    #[error("{place}: {reason}")]
    File {
        /// The place in the file.
        place: String,
        /// What is wrong there.
        reason: String,
    },
}
