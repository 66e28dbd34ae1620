//! Errors of a hopper's parameters, states and hops.

use thiserror::Error;

/// Why a hopper cannot be built, or a hop not be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The mass ratio is not a positive number with a representable inverse.
    #[error("the mass ratio must be positive and finite, with a finite inverse, not {value:?}")]
    MassRatio {
        /// The given value.
        value: f64,
    },
    /// A dimensional parameter is not positive and finite.
    #[error("{name} must be positive and finite, not {value:?}")]
    Parameter {
        /// The symbol of the parameter.
        name: &'static str,
        /// The given value.
        value: f64,
    },
    /// The lift-off speed is not positive and finite.
    #[error("the lift-off speed must be positive and finite, not {value:?}")]
    LiftOffSpeed {
        /// The given value.
        value: f64,
    },
    /// The lift-off speed is so large that an ulp of it is too coarse for the spring's phase.
    #[error(
        "the lift-off speed {value:?} is over {largest}, above which an f64 does not resolve the motion"
    )]
    LiftOffSpeedTooLarge {
        /// The given value.
        value: f64,
        /// The largest accepted value.
        largest: f64,
    },
    /// The offset from a fixed point reaches beyond nπ or (n+1)π, or is too small to be resolved.
    #[error(
        "the offset from α*_{n} must be zero or at least 1e-300 in size, and in ({left}, {right}), \
         with n ≥ 1; not {delta:?}"
    )]
    Offset {
        /// Index of the fixed point.
        n: u64,
        /// The given offset.
        delta: f64,
        /// nπ − α*_n.
        left: f64,
        /// (n+1)π − α*_n.
        right: f64,
    },
    /// A state so large that an f64 does not resolve the spring's phase, or not finite.
    #[error(
        "a coordinate of the motion is {value:?}; it must be finite and at most {largest}, above which an f64 \
         does not resolve the motion"
    )]
    MotionTooLarge {
        /// The coordinate or rate, in the model's units; coordinates and rates of the height are multiplied by 1+M.
        value: f64,
        /// The largest accepted value.
        largest: f64,
    },
    /// A state with the lower mass below the ground.
    #[error("the lower mass is below the ground: y2 = {height:?}")]
    BelowGround {
        /// Its height.
        height: f64,
    },
    /// A contact phase with the lower mass off the ground or moving.
    #[error(
        "in contact the lower mass must rest on the ground, not have y2 = {height:?}, velocity {velocity:?}"
    )]
    NotInContact {
        /// Its height.
        height: f64,
        /// Its velocity.
        velocity: f64,
    },
    /// A decision of the hop (sudden or not, on which branch, grounded or not) depends on a number that is smaller than
    /// the bound on its error. The bound is for 1024 bits, or for fewer bits if more would take minutes.
    #[error(
        "the hop from {alpha:?}, with about {sudden} sudden lift-offs, cannot be decided with 1024 bits \
         in some seconds"
    )]
    Undecided {
        /// The lift-off speed.
        alpha: f64,
        /// Sudden lift-offs that were computed; the true number may differ.
        sudden: usize,
    },
    /// No touch of the map's minimum next to a time of flight.
    #[error(
        "no minimum of hump {n} touches its target next to a flight of {time:?}: give the time of the touch to some \
         digits"
    )]
    NoTouch {
        /// The index of the hump.
        n: u64,
        /// The time of flight that was given.
        time: f64,
    },
    /// As [`Undecided`](Self::Undecided), for one flight from a given state on the ground.
    #[error(
        "the landing after a lift-off at stretch 1 + {excess:?} with velocity {velocity:?} cannot be decided with 1024 \
         bits: it is nearly a touch without speed, or lands nearly at stretch 1"
    )]
    UndecidedLanding {
        /// Stretch minus one at the start of the flight.
        excess: f64,
        /// Velocity of the upper mass at the start of the flight.
        velocity: f64,
    },
    /// Speeds and results in slices of different lengths.
    #[error(
        "there are {speeds} speeds and room for {results} results; both must be the same number"
    )]
    Lengths {
        /// The number of speeds.
        speeds: usize,
        /// The room for results.
        results: usize,
    },
    /// A number is not finite, but must be.
    #[error("{name} must be finite, not {value:?}")]
    NotFinite {
        /// The name of the number.
        name: &'static str,
        /// The given value.
        value: f64,
    },
    /// More sudden lift-offs in one hop than the budget allows; the computation stops before the hop ends.
    #[error(
        "{sudden} sudden lift-offs and no gradual one: the computation stopped at stretch 1 + {excess:?}, \
         velocity {velocity:?}"
    )]
    SuddenLiftOffBudget {
        /// Sudden lift-offs so far: the budget.
        sudden: usize,
        /// Stretch minus one at the last landing.
        excess: f64,
        /// Velocity of the upper mass at the last landing.
        velocity: f64,
    },
    /// Rounding errors hid the sign change on an interval that holds a landing (docs/theory.md, Theorem 7 and
    /// Theorem 12). Only the printed equations give this error.
    #[error(
        "a landing could not be bracketed from stretch 1 + {excess:?}, velocity {velocity:?}: {source}"
    )]
    Landing {
        /// Stretch minus one at the start of the flight.
        excess: f64,
        /// Velocity of the upper mass at the start of the flight.
        velocity: f64,
        /// The error of the root finder.
        source: interval_arithmetic::Error,
    },
}
