//! What can be wrong with a hopper's parameters, states and hops.

use thiserror::Error;

/// Why a hopper cannot be built, or a hop not be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The mass ratio is not a positive number with a representable inverse.
    #[error("the mass ratio must be positive and finite, with a finite inverse, not {value}")]
    MassRatio {
        /// The value given.
        value: f64,
    },
    /// A dimensional parameter is not positive and finite.
    #[error("{name} must be positive and finite, not {value}")]
    Parameter {
        /// Its symbol.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// The lift-off speed is not positive and finite.
    #[error("the lift-off speed must be positive and finite, not {value}")]
    LiftOffSpeed {
        /// The value given.
        value: f64,
    },
    /// The lift-off speed is so large that neighbouring numbers belong to different motions.
    #[error(
        "the lift-off speed {value} is over {largest}, where an f64 no longer resolves the motion"
    )]
    LiftOffSpeedTooLarge {
        /// The value given.
        value: f64,
        /// The largest accepted.
        largest: f64,
    },
    /// An offset outside the cell of its fixed point, or too small to be resolved.
    #[error(
        "an offset from α*_{n} must be zero or of size 1e-300 at least, and in ({left}, {right}), \
         with n ≥ 1; not {delta}"
    )]
    Offset {
        /// Index of the fixed point.
        n: u64,
        /// The offset given.
        delta: f64,
        /// nπ − α*_n.
        left: f64,
        /// (n+1)π − α*_n.
        right: f64,
    },
    /// A state so large that an f64 no longer resolves the spring's phase, or not finite.
    #[error(
        "a coordinate of the motion is {value}, over {largest}, where an f64 no longer resolves it"
    )]
    MotionTooLarge {
        /// The coordinate, in the model's units (times 1+M for the height).
        value: f64,
        /// The largest accepted.
        largest: f64,
    },
    /// A state with the lower mass under the ground.
    #[error("the lower mass is below the ground: y2 = {height}")]
    BelowGround {
        /// Its height.
        height: f64,
    },
    /// A contact phase with the lower mass off the ground or moving.
    #[error("in contact the lower mass rests on the ground: y2 = {height}, velocity {velocity}")]
    NotInContact {
        /// Its height.
        height: f64,
        /// Its velocity.
        velocity: f64,
    },
    /// A hop on whose way a verdict is smaller than the rounding error of 1024 bits, or of fewer if
    /// more would take minutes.
    #[error(
        "the hop from {alpha}, with about {sudden} sudden lift-offs, cannot be decided within 1024 bits \
         and some seconds"
    )]
    Undecided {
        /// The lift-off speed.
        alpha: f64,
        /// Sudden lift-offs, as far as they could be told.
        sudden: usize,
    },
    /// A number that must be finite is not.
    #[error("{name} must be finite, not {value}")]
    NotFinite {
        /// What it is.
        name: &'static str,
        /// The value given.
        value: f64,
    },
    /// More sudden lift-offs in one hop than the budget allows; the hop is left unfinished.
    #[error(
        "{sudden} sudden lift-offs and no gradual one: the hop is left at stretch 1 + {excess}, \
         velocity {velocity}"
    )]
    SuddenLiftOffBudget {
        /// Sudden lift-offs so far, the budget.
        sudden: usize,
        /// Stretch minus one at the last landing.
        excess: f64,
        /// Velocity of the upper mass at the last landing.
        velocity: f64,
    },
    /// A bracket that the theory guarantees did not hold numerically.
    #[error(
        "a landing could not be bracketed from stretch 1 + {excess}, velocity {velocity}: {source}"
    )]
    Landing {
        /// Stretch minus one at the start of the flight.
        excess: f64,
        /// Velocity of the upper mass at the start of the flight.
        velocity: f64,
        /// What the root finder said.
        source: hybrid_system::Error,
    },
}
