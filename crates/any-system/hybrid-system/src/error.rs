//! The errors of this crate.

use crate::condition_error::ConditionError;
use crate::lands_beyond::LandsBeyond;
use crate::looked::Looked;
use crate::number::{Number, Numbers};
use thiserror::Error;

/// Why an execution, a search or an integration failed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// A formula has no value, or is none.
    #[cfg(feature = "ode")]
    #[error(transparent)]
    Formula(#[from] equations::Error),
    /// The equations of a model do not fit together.
    #[error("{what}: {reason}")]
    BadEquations {
        /// The mode or the surface, or the place in a file.
        what: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A root was not found between two values.
    #[error(transparent)]
    Root(interval_arithmetic::Error),
    /// A function, a bracket or a coefficient is infinite or NaN.
    #[error("the function is {value} at {at}", at = Number(*.at), value = Number(*.value))]
    NotFinite {
        /// Argument of the function.
        at: f64,
        /// Its value.
        value: f64,
    },
    /// The bounds that a model gives on a guard are those of another function.
    #[error(
        "the bounds of guard {surface} at the start are {low} to {high}, and its value is {value}: give those of its \
         function",
        value = Number(*.value), low = Number(*.low), high = Number(*.high)
    )]
    WrongBounds {
        /// The guard's surface.
        surface: String,
        /// The value of the guard at the start.
        value: f64,
        /// The lower bound there.
        low: f64,
        /// The upper bound.
        high: f64,
    },
    /// A derivative of a quasi-polynomial overflows, and with it the bounds of the search.
    #[error(
        "a derivative of the quasi-polynomial overflows up to time {horizon}: search a small multiple of the function",
        horizon = Number(*.horizon)
    )]
    DerivativeOverflows {
        /// The end of the search.
        horizon: f64,
    },
    /// A guard must be sampled, because the model gives no bounds on it, and there is no sampling interval.
    #[error(
        "guard {surface} has neither bounds nor a solution: set a sampling interval in the limits of the execution, or \
         by `sampled` for `Model::run`"
    )]
    NoSamplingInterval {
        /// Name of the guard's surface.
        surface: String,
    },
    /// A sampling interval that is not positive, or too short to reach the horizon, or a horizon that is not finite.
    #[error("cannot sample guards at an interval of {} up to time {}", Number(*.interval), Number(*.horizon))]
    BadSamplingInterval {
        /// The interval.
        interval: f64,
        /// The time up to which the guards are searched.
        horizon: f64,
    },
    /// A guard starts at zero and is beyond its surface a little later: crossed at once, or gone and come back.
    #[error(
        "guard {surface} is zero at the start and beyond its surface {interval} later: {advice}",
        interval = Number(*.interval), advice = looked.advice()
    )]
    UndecidedStart {
        /// Name of the guard's surface.
        surface: String,
        /// The sampling interval, or the time up to which rounding hides the guard.
        interval: f64,
        /// How the guard was looked at.
        looked: Looked,
    },
    /// A guard under bounds starts at zero, and rounding hides to which side it leaves.
    #[error(
        "rounding hides to which side the guard leaves its zero at the start: derivative {order} is {value}; move the \
         state off the surface in the reset, or decide in `HybridSystem::leaving_side`",
        value = Number(*.value)
    )]
    UndecidedSign {
        /// Order of the first derivative that is not zero within rounding; 0 under enclosures, for the guard itself.
        order: u32,
        /// Its value.
        value: f64,
    },
    /// A condition that is not decided, or whose guard is no crossing.
    #[error(transparent)]
    Condition(#[from] ConditionError),
    /// An enclosure whose lower bound is above its upper bound, or whose bounds are NaN.
    #[error(
        "the enclosure of derivative {order} of the guard on [{from}, {to}] is no interval: [{low}, {high}]",
        from = Number(*.from), to = Number(*.to), low = Number(*.low), high = Number(*.high)
    )]
    BadEnclosure {
        /// Order of the derivative.
        order: u32,
        /// Start of the interval of time.
        from: f64,
        /// Its end.
        to: f64,
        /// Lower bound.
        low: f64,
        /// Upper bound.
        high: f64,
    },
    /// A guard comes so close to its surface that rounding hides whether it crosses.
    #[error(
        "guard {surface} grazes its surface at time {time}, with value {value}",
        time = Number(*.time), value = Number(*.value)
    )]
    Grazing {
        /// Name of the guard's surface.
        surface: String,
        /// Time since the start of the arc.
        time: f64,
        /// The value of the guard at that time.
        value: f64,
    },
    /// Too many events in a row without time passing.
    #[error(
        "{events} events in a row at time {time}, and the resets lead back to each other: {cycle}. Let a reset move \
         the state away from the surface, or declare a guard a `crossing`, or an observer if it only watches",
        time = Number(*.time)
    )]
    TimelessChain {
        /// Time of the events.
        time: f64,
        /// Number of events.
        events: usize,
        /// The last events, as mode ─surface→ mode, up to one period of the cycle.
        cycle: String,
    },
    /// An execution starts beyond a surface, where its mode cannot flow.
    #[error(
        "the start is beyond the surface {surface} of mode {mode}: the guard is {value}, with a rounding error of \
         {rounding}. Start on the other side, or declare the guard a `crossing`",
        value = Number(*.value), rounding = Number(*.rounding)
    )]
    StartsBeyond {
        /// Name of the mode.
        mode: String,
        /// Name of the surface.
        surface: String,
        /// Value of the guard.
        value: f64,
        /// Its rounding error.
        rounding: f64,
    },
    /// The model's own search has found no event of a surface, and the state at the end of the arc is beyond it.
    #[error(
        "first_crossing of the model has missed an event of the surface {surface} in mode {mode}: after {duration} the \
         guard \
         is {value}, with an error of {error}. Let it return the first event of all guards, or call default_search",
        duration = Number(*.duration), value = Number(*.value), error = Number(*.error)
    )]
    MissedEvent {
        /// Name of the mode.
        mode: String,
        /// Name of the surface.
        surface: String,
        /// Duration of the arc.
        duration: f64,
        /// Value of the guard at its end.
        value: f64,
        /// The error of this value, by rounding and by the error of the duration.
        error: f64,
    },
    /// A model without a vector field where one is needed.
    #[error("mode {mode} has no vector field: implement HybridSystem::vector_field")]
    NoVectorField {
        /// Name of the mode.
        mode: String,
    },
    /// A vector of another dimension than the state.
    #[error("{what} has {found} components, and the state of the model has {expected}")]
    Dimension {
        /// The vector.
        what: &'static str,
        /// Number of components of the state.
        expected: usize,
        /// Number of components of the vector.
        found: usize,
    },
    /// A guard is crossed too slowly for a derivative: nearby orbits may miss the event.
    #[error(
        "no sensitivity through the event at time {time}: the guard changes at a rate of {rate}",
        time = Number(*.time), rate = Number(*.rate)
    )]
    GrazingSensitivity {
        /// Time of the event.
        time: f64,
        /// The rate, ∇g·f⁻.
        rate: f64,
    },
    /// Two surfaces, or a surface and the limit on time, are reached at one instant: there is no derivative.
    #[error(
        "no sensitivity at time {time}: the surface {surface} is reached at the same instant as another one or as the \
         limit on time, and nearby orbits reach them in either order. Take another start, or another time",
        time = Number(*.time)
    )]
    CornerSensitivity {
        /// Time of both events.
        time: f64,
        /// Name of the surface, the second one of two.
        surface: String,
    },
    /// A derivative by parameters through an event at a preset time.
    #[error(
        "no derivative by parameters through the clock at time {time}: let time be a component, and the clock a guard",
        time = Number(*.time)
    )]
    ClockSensitivity {
        /// Time of the event.
        time: f64,
    },
    /// A sensitivity along an arc without an event at its end, or with a flow that has no derivative.
    #[error(
        "no sensitivity along the arc from time {time}: it does not end in one event, or its flow has no derivative",
        time = Number(*.time)
    )]
    NoSensitivity {
        /// Start of the arc.
        time: f64,
    },
    /// An error of the model itself.
    #[error("the model failed: {reason}")]
    Model {
        /// The message of the model, with its numbers.
        reason: String,
    },
    /// A limit, horizon or time that is negative or NaN, or infinite where a search needs a finite one.
    #[error("{what} cannot be {value}", value = Number(*.value))]
    BadLimit {
        /// The quantity.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A tolerance that is not positive and finite.
    #[error("a tolerance must be positive and finite, not {value}", value = Number(*.value))]
    BadTolerance {
        /// The tolerance.
        value: f64,
    },
    /// An integration failed.
    #[error("the integration stopped at time {time}: {reason}", time = Number(*.time))]
    Integration {
        /// The reason.
        reason: &'static str,
        /// Time since the start of the integration.
        time: f64,
    },
    /// A component of a state is infinite or NaN.
    #[error(
        "the state is not finite after {time} time units and {jumps} jumps: [{state}]",
        time = Number(*.time), state = Numbers(.state)
    )]
    StateNotFinite {
        /// Continuous time t.
        time: f64,
        /// Number of jumps j.
        jumps: usize,
        /// The components of the state.
        state: Vec<f64>,
    },
    /// A search under bounds reached its budget of intervals.
    #[error(
        "no zero up to {time}; up to {horizon} it takes more than {intervals} intervals: a larger budget, or less time",
        time = Number(*.time), horizon = Number(*.horizon)
    )]
    IntervalBudget {
        /// The time up to which there is no zero.
        time: f64,
        /// The horizon of the search.
        horizon: f64,
        /// The budget.
        intervals: usize,
    },
    /// The budgets of an execution end before its search for the next event makes any progress.
    #[error(
        "{intervals} intervals and {steps} steps are too few for any progress up to {horizon}: set larger budgets",
        horizon = Number(*.horizon)
    )]
    BudgetTooSmall {
        /// The horizon of the search.
        horizon: f64,
        /// The budget of intervals.
        intervals: usize,
        /// The budget of steps.
        steps: usize,
    },
    /// An integration cannot go on: the field is infinite or NaN just after this state, however short the step.
    #[error(
        "the field is not finite just after time {time}, where the last state is {state:?}: let an event end the arc \
         before, or limit its time"
    )]
    FieldNotFinite {
        /// Time of the last state.
        time: f64,
        /// Its components.
        state: Vec<f64>,
    },
    /// A list of preset times that does not rise.
    #[error("preset time {index} is {time}, after {before}: times must be finite and rise")]
    BadClock {
        /// Position in the list, from 0.
        index: usize,
        /// The time.
        time: f64,
        /// The time before it; −∞ for the first one.
        before: f64,
    },
    /// A sliding motion that starts beside its surface.
    #[error(
        "a sliding motion cannot start beside its surface {surface}: the guard is {value:e}, and the tolerances of the \
         flow allow {largest:e}; start in a free mode"
    )]
    OffSurface {
        /// Name of the surface.
        surface: String,
        /// The value of its guard.
        value: f64,
        /// The largest value that counts as zero.
        largest: f64,
    },
    /// A sliding motion that has more than one continuation.
    #[error(
        "the motion along surface {surface} is not unique from time {time} of its arc on: {reason}; the model must \
         have a mode for it"
    )]
    SlidingNotUnique {
        /// Name of the surface.
        surface: String,
        /// Time since the start of the arc.
        time: f64,
        /// The reason.
        reason: &'static str,
    },
    /// A reset leads to the far side of a surface, and the guard does not say what that means.
    #[error(transparent)]
    LandsBeyond(#[from] LandsBeyond),
    /// Two guards of one mode have the same surface: their events could not be told apart.
    #[error("surface {surface} has two guards in one mode: give each of them a name of its own")]
    SurfaceTwice {
        /// Name of the surface.
        surface: String,
    },
    /// A part of a model belongs to a surface that no guard has.
    #[error("{part} is given for surface {surface}, which no guard has: use a guard's name")]
    NoSuchGuard {
        /// The part.
        part: &'static str,
        /// Name of the surface.
        surface: String,
    },
    /// A guard that is a clock, in a model that gives it no times.
    #[error("the clock {surface} has a guard function and no times: add it by `Model::clock`")]
    ClockWithoutTimes {
        /// Name of the surface.
        surface: String,
    },
    /// Guards of different modes have the same surface and different functions.
    #[error(
        "surface {surface} has two guard functions, with values {first} and {second} at one state: name each of them"
    )]
    TwoGuardFunctions {
        /// Name of the surface.
        surface: String,
        /// The value of one function, at the initial state or at a state near it.
        first: f64,
        /// The value of another one there.
        second: f64,
    },
}

impl From<interval_arithmetic::Error> for Error {
    fn from(error: interval_arithmetic::Error) -> Self {
        match error {
            interval_arithmetic::Error::NotFinite { at, value } => Error::NotFinite { at, value },
            other => Error::Root(other),
        }
    }
}
