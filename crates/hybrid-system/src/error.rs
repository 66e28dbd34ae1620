//! What can go wrong while following a hybrid system.

use thiserror::Error;

/// Why an execution or a root search could not go on.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The ends of a bracket do not have opposite signs.
    #[error("no sign change on [{left}, {right}]: values {at_left} and {at_right}")]
    NoSignChange {
        /// Left end of the bracket.
        left: f64,
        /// Right end of the bracket.
        right: f64,
        /// Function value at the left end.
        at_left: f64,
        /// Function value at the right end.
        at_right: f64,
    },
    /// A function that must be finite was not.
    #[error("the function is {value} at {at}")]
    NotFinite {
        /// Where it was evaluated.
        at: f64,
        /// What it returned.
        value: f64,
    },
    /// The root finder used up its iterations.
    #[error("no root to full precision on [{left}, {right}] within {iterations} iterations")]
    NoConvergence {
        /// Left end of the bracket.
        left: f64,
        /// Right end of the bracket.
        right: f64,
        /// Iterations allowed.
        iterations: usize,
    },
    /// A guard without a closed-form crossing was to be searched, and no sampling interval was given.
    #[error("guard {surface} has no closed-form crossing: give a sampling interval")]
    NoSamplingInterval {
        /// Name of the guard's surface.
        surface: String,
    },
    /// A sampling interval that cannot be stepped with.
    #[error("cannot sample guards at an interval of {interval} up to time {horizon}")]
    BadSamplingInterval {
        /// The interval asked for.
        interval: f64,
        /// The time up to which the guards were to be watched.
        horizon: f64,
    },
    /// A guard starts at zero and lies beyond its surface a little later: it may have crossed at once, or
    /// gone up and come back within a sampling interval or within rounding.
    #[error(
        "guard {surface} starts at zero and is on its other side {interval} later: sample it more often, or \
         let the model solve this crossing"
    )]
    UndecidedStart {
        /// Name of the guard's surface.
        surface: String,
        /// The sampling interval in use, or the time by which it is clear of rounding.
        interval: f64,
    },
    /// A signal whose first derivative that is not zero at the start is hidden by its rounding.
    #[error("derivative {order} of the signal is {value} at the start, within its rounding error")]
    UndecidedSign {
        /// Order of the derivative.
        order: u32,
        /// Its value.
        value: f64,
    },
    /// A bound on a guard that is no interval.
    #[error("the guard's bounds of order {order} on [{from}, {to}] are [{low}, {high}]")]
    BadEnclosure {
        /// Order of the derivative.
        order: u32,
        /// Start of the stretch of time.
        from: f64,
        /// Its end.
        to: f64,
        /// Lower bound.
        low: f64,
        /// Upper bound.
        high: f64,
    },
    /// A guard that comes so close to its surface that rounding hides whether it crosses.
    #[error("guard {surface} grazes its surface at time {time}, with value {value}")]
    Grazing {
        /// Name of the guard's surface.
        surface: String,
        /// When, since the start of the arc.
        time: f64,
        /// The value of the guard there.
        value: f64,
    },
    /// Events that follow one another without time passing.
    #[error("{events} events in a row at time {time}: the resets lead in a circle")]
    TimelessChain {
        /// When.
        time: f64,
        /// How many.
        events: usize,
    },
    /// An event at which the guard is crossed too slowly for a derivative: nearby orbits may miss it.
    #[error(
        "no sensitivity through the event at time {time}: the guard changes at a rate of {rate}"
    )]
    GrazingSensitivity {
        /// When.
        time: f64,
        /// ∇g·f⁻.
        rate: f64,
    },
    /// An arc without an end that a change of its start could be followed to.
    #[error("no sensitivity along the arc from time {time}: it does not end in one event")]
    NoSensitivity {
        /// Its start.
        time: f64,
    },
    /// The model could not answer.
    #[error("the model failed: {reason}")]
    Model {
        /// The model's own words, with its numbers.
        reason: String,
    },
    /// A start state or a limit that is not a number, or a negative limit.
    #[error("{what} must be a non-negative number, not {value}")]
    BadLimit {
        /// Which limit.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A tolerance that no integrator can meet.
    #[error("a tolerance must be positive and finite, not {value}")]
    BadTolerance {
        /// The value given.
        value: f64,
    },
    /// An integration that could not go on.
    #[error("the integration stopped at time {time}: {reason}")]
    Integration {
        /// Why.
        reason: &'static str,
        /// Where, since its start.
        time: f64,
    },
    /// A state with a component that is infinite or not a number.
    #[error("the state is not finite after {time} time units and {jumps} jumps: {state:?}")]
    StateNotFinite {
        /// Continuous time t.
        time: f64,
        /// Number of jumps j.
        jumps: usize,
        /// The components of the state.
        state: Vec<f64>,
    },
}
