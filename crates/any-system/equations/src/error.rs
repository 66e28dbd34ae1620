//! The errors of this crate.

use thiserror::Error;

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
    /// A file is no formulas.
    #[error("{place}: {reason}")]
    File {
        /// The place in the file.
        place: String,
        /// What is wrong there.
        reason: String,
    },
}
