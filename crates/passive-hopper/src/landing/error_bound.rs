//! Are the decisions of a hop, and its value, larger than their errors?
//!
//! A *decision* of a hop is the sign of a computed number: whether a landing is sudden (x′), on which branch a flight
//! lands (the maximum test), whether the hopper lifts off again (α′²). A decision is *inconclusive* if the number is
//! not larger than the bound on its error. The hop is then computed again in longer arithmetic.
//!
//! The error has two parts. Each flight adds the rounding errors of its own landing. Each flight also propagates the
//! error of its start to its end, by its derivative. The propagated part grows along a chain of sudden lift-offs.

use crate::landing::flight_derivative::{FlightDerivative, Variation};
use crate::landing::flight_ends::{Landing, TakeOff};
use crate::landing::next_landing::maximum_test;
use std::f64::consts::PI;

/// Bound on the rounding error of one landing, in ulps of the largest quantity in it. The value is not derived. It
/// exceeds the errors measured against reference hops (docs/accuracy.md). A larger value sends more hops to the longer
/// arithmetic; a smaller one risks wrong decisions.
pub(crate) const LANDING_ULPS: f64 = 16.0;

/// The propagated error is increased by this part of its bound without cancellation, for the rounding errors of the
/// derivative's coefficients. The value is not derived: the coefficients are right to some ulps of the time, and 10⁻⁶
/// is far more.
const DERIVATIVE_ERROR: f64 = 1e-6;

/// A running bound on the error of the state on the ground.
///
/// The first landing is decided on the 100 bits of α*_n and is never inconclusive. The decisions after it can be.
#[derive(Debug, Clone)]
pub(crate) struct ErrorBound {
    start: TakeOff,
    error: Variation,
    inconclusive: bool,
    flights: f64,
    /// Relative rounding error of the arithmetic.
    epsilon: f64,
    /// True if the sine of a stored argument is right to an ulp of the sine, as in `f64`. In the longer arithmetics the
    /// error of the sine is an ulp of the argument.
    sines_are_exact: bool,
    /// Bound on the error of Σ Γ² that was propagated from flight to flight.
    loss: f64,
    /// The maximum test of the last flight that had two possible branches.
    last_test: Option<MaximumTest>,
}

/// The number whose sign decides on which of two branches a flight lands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaximumTest {
    /// (−1)^m (V cos V − Y sin V), m = ⌊V/π⌋, at the start (Y, V) of the flight.
    pub value: f64,
    /// Bound on its error.
    pub error: f64,
}

impl ErrorBound {
    /// For a hop from `alpha` in `f64`.
    pub(crate) fn of_f64(alpha: f64) -> Self {
        Self::new(alpha, f64::EPSILON, true)
    }

    /// For a hop from `alpha` in an arithmetic with relative error `epsilon`.
    pub(crate) fn of_extended(alpha: f64, epsilon: f64) -> Self {
        Self::new(alpha, epsilon, false)
    }

    fn new(alpha: f64, epsilon: f64, sines_are_exact: bool) -> Self {
        ErrorBound {
            start: TakeOff { excess: 0.0, velocity: alpha },
            error: Variation { excess: 0.0, velocity: 0.0 },
            inconclusive: false,
            flights: 0.0,
            epsilon,
            sines_are_exact,
            loss: 0.0,
            last_test: None,
        }
    }

    /// Propagates the bound through a flight to its landing. The maximum test of the branch is computed in `f64`.
    pub(crate) fn add_flight(&mut self, landing: &Landing, kappa: f64) {
        let TakeOff { excess, velocity } = self.start;
        let test = if velocity >= PI { maximum_test(excess, velocity) } else { f64::INFINITY };
        self.add_flight_on_branch(landing, kappa, test);
    }

    /// As [`add_flight`](Self::add_flight), with the maximum test that decided the branch, or infinity if only one
    /// branch was possible.
    pub(crate) fn add_flight_on_branch(&mut self, landing: &Landing, kappa: f64, test: f64) {
        let first = self.flights == 0.0;
        self.flights += 1.0;
        let TakeOff { excess, velocity } = self.start;
        let size = 1.0 + excess + velocity.abs() + landing.time + landing.closing_speed;
        let rounding = LANDING_ULPS * self.epsilon * size;
        if !first {
            // The test is V cos V − Y sin V. An error e of Y changes the test by at most e. An error e of V changes it
            // by at most (1 + Y + V) e.
            let slack = rounding + self.error.excess + size * self.error.velocity;
            self.inconclusive |= test.abs() <= slack;
            let two_branches = test.is_finite();
            self.last_test = two_branches.then_some(MaximumTest { value: test, error: slack });
        }
        if landing.sudden || !first {
            // A rounding of h acts like one of V: the residual of the landing is a backward error in V. With exact sines
            // the rest of an ulp of h is corrected to first order, and its square remains; the factor 4 is a margin.
            // Else the phase is rounded to an ulp of its size.
            let ulp = self.epsilon * size;
            let backward = if self.sines_are_exact { self.epsilon + 4.0 * ulp * ulp } else { ulp };
            let change =
                Variation { excess: self.error.excess, velocity: self.error.velocity + backward };
            let (after, closing) = self.propagate(landing, kappa, change);
            self.loss += 2.0 * landing.closing_speed * closing;
            self.error =
                Variation { excess: rounding + after.excess, velocity: rounding + after.velocity };
        }
        if !first {
            self.inconclusive |= !(landing.excess.abs() > self.error.excess);
        }
        self.start = landing.take_off();
    }

    /// Bounds on the errors of the state after a flight, and of Γ, for errors before the flight that are bounded by
    /// `change`. The bounds come from the linear map of the flight. A small part of its bound without cancellation is
    /// added for the rounding errors of that map.
    fn propagate(&self, landing: &Landing, kappa: f64, change: Variation) -> (Variation, f64) {
        let by_excess = Variation { velocity: 0.0, ..change };
        let by_velocity = Variation { excess: 0.0, ..change };
        let derivative = FlightDerivative::new(self.start, landing, kappa);
        let (a, a_closing) = derivative.carry(by_excess);
        let (b, b_closing) = derivative.carry(by_velocity);
        let (most, most_closing) = derivative.bound(change);
        // The phase of the flight is right to an ulp of its time, which changes the sines of the derivative by as
        // much; the factor 4 is a margin.
        let part = DERIVATIVE_ERROR + 4.0 * f64::EPSILON * landing.time;
        let after = Variation {
            excess: a.excess.abs() + b.excess.abs() + part * most.excess,
            velocity: a.velocity.abs() + b.velocity.abs() + part * most.velocity,
        };
        (after, a_closing.abs() + b_closing.abs() + part * most_closing)
    }

    /// Bounds on the errors of x′ and V′ after the last flight; zero after a first landing that starts a contact.
    pub(crate) fn state_error(&self) -> Variation {
        self.error
    }

    /// The maximum test of the last flight, or `None` if only one branch was possible.
    pub(crate) fn last_test(&self) -> Option<MaximumTest> {
        self.last_test
    }

    /// Bound on the rounding errors of one flight in its part μ Γ²/α² of the ratio. The propagated part comes on top of
    /// it.
    pub(crate) fn rounding_of_loss(&self) -> f64 {
        LANDING_ULPS * self.epsilon
    }

    /// Whether the decision of a landing, sudden or not and on which branch, was inconclusive.
    pub(crate) fn landing_inconclusive(&self) -> bool {
        self.inconclusive
    }

    /// Whether any decision is inconclusive, including the sign of `ratio` = α′²/α² = 1 − μ Σ Γ²/α².
    pub(crate) fn inconclusive(&self, ratio: f64, mu: f64, alpha: f64) -> bool {
        self.inconclusive || !(ratio.abs() > self.ratio_error(mu, alpha))
    }

    /// Bound on the error of α′²/α²: the roundings of each landing and of the sum, and the propagated part.
    pub(crate) fn ratio_error(&self, mu: f64, alpha: f64) -> f64 {
        LANDING_ULPS * self.epsilon * (2.0 + self.flights) + self.propagated(mu, alpha)
    }

    /// The part of the bound on the error of α′²/α² that was propagated from flight to flight.
    pub(crate) fn propagated(&self, mu: f64, alpha: f64) -> f64 {
        mu * (self.loss / alpha / alpha)
    }
}
