//! Are the decisions of a hop, and its value, larger than their errors?
//!
//! A *decision* of a hop is the sign of a computed number: whether a landing is sudden (x′), on which branch a flight
//! lands (the maximum test), whether the hopper lifts off again (α′²). A decision is *inconclusive* if the number is
//! not larger than the bound on its error. The hop is then computed again in longer arithmetic.
//!
//! The error has two parts. Each flight adds the roundings of its own landing. And it propagates the error of its
//! start to its end, by the derivative of the flight. The second part grows along a chain of sudden lift-offs.

use crate::landing::flight_derivative::{FlightDerivative, Variation};
use crate::landing::flight_ends::{Landing, TakeOff};
use crate::landing::next_landing::maximum_test;
use std::f64::consts::PI;

/// Bound on the rounding error of one landing, in ulps of the largest quantity in it. Not derived; docs/accuracy.md has
/// the errors measured against reference hops, which it exceeds. A larger value sends more hops to the longer
/// arithmetic; a smaller one risks wrong decisions.
pub(crate) const LANDING_ULPS: f64 = 16.0;

/// The part of the bound without cancellation that is added to the propagated error: it stands for the roundings of the
/// derivative's own coefficients. Not derived: its coefficients are right to some ulps of the time, and 10⁻⁶ is far more.
const DERIVATIVE_ERROR: f64 = 1e-6;

/// A running bound on the error of the state on the ground.
///
/// The first landing is decided on the 100 bits of α*_n. Inconclusive decisions begin with the second landing.
#[derive(Debug, Clone)]
pub(crate) struct ErrorBound {
    start: TakeOff,
    error: Variation,
    inconclusive: bool,
    flights: f64,
    /// Relative rounding error of the arithmetic.
    epsilon: f64,
    /// Whether the sine of the stored argument is right to an ulp of the sine, as that of `f64` is. The longer
    /// arithmetics err by an ulp of the argument.
    sines_are_exact: bool,
    /// Bound on the error of Σ Γ² that was propagated from flight to flight.
    loss: f64,
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
        }
    }

    /// Propagates the bound through a flight to its landing. The branch is tested in `f64`.
    pub(crate) fn add_flight(&mut self, landing: &Landing, kappa: f64) {
        let TakeOff { excess, velocity } = self.start;
        let test = if velocity >= PI { maximum_test(excess, velocity) } else { f64::INFINITY };
        self.add_flight_on_branch(landing, kappa, test);
    }

    /// The same with the maximum test that decided the branch, or infinity where only one branch was possible.
    pub(crate) fn add_flight_on_branch(&mut self, landing: &Landing, kappa: f64, test: f64) {
        let first = self.flights == 0.0;
        self.flights += 1.0;
        let TakeOff { excess, velocity } = self.start;
        let size = 1.0 + excess + velocity.abs() + landing.time + landing.closing_speed;
        let rounding = LANDING_ULPS * self.epsilon * size;
        if !first {
            // The test is V cos V − Y sin V. An error of Y changes it by at most as much, one of V by at most 1 + Y + V
            // times as much.
            let slack = rounding + self.error.excess + size * self.error.velocity;
            self.inconclusive |= test.abs() <= slack;
        }
        if landing.sudden || !first {
            // A rounding of h acts like one of V: the residual of the landing is a backward error in V. With exact sines
            // the rest of an ulp of h is corrected to first order, and its square remains. Else the phase is rounded
            // to an ulp of its size.
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

    /// Bounds after a flight on errors bounded by `change` before it, and the bound on the error of Γ: by the linear
    /// map of the flight, with a small part of the bound without cancellation for the roundings of that map.
    fn propagate(&self, landing: &Landing, kappa: f64, change: Variation) -> (Variation, f64) {
        let by_excess = Variation { velocity: 0.0, ..change };
        let by_velocity = Variation { excess: 0.0, ..change };
        let derivative = FlightDerivative::new(self.start, landing, kappa);
        let (a, a_closing) = derivative.carry(by_excess);
        let (b, b_closing) = derivative.carry(by_velocity);
        let (most, most_closing) = derivative.bound(change);
        let part = DERIVATIVE_ERROR + 4.0 * f64::EPSILON * landing.time;
        let after = Variation {
            excess: a.excess.abs() + b.excess.abs() + part * most.excess,
            velocity: a.velocity.abs() + b.velocity.abs() + part * most.velocity,
        };
        (after, a_closing.abs() + b_closing.abs() + part * most_closing)
    }

    /// Whether the decision of a landing, sudden or not and on which branch, was inconclusive.
    pub(crate) fn landing_inconclusive(&self) -> bool {
        self.inconclusive
    }

    /// Whether any decision is inconclusive, with the sign of `ratio` = α′²/α² = 1 − μ Σ Γ²/α² among them.
    pub(crate) fn inconclusive(&self, ratio: f64, mu: f64, alpha: f64) -> bool {
        self.inconclusive || !(ratio.abs() > self.ratio_error(mu, alpha))
    }

    /// Bound on the error of α′²/α²: the roundings of each landing and of the sum, and the propagated part.
    fn ratio_error(&self, mu: f64, alpha: f64) -> f64 {
        LANDING_ULPS * self.epsilon * (2.0 + self.flights) + self.propagated(mu, alpha)
    }

    /// The part of it that was propagated from flight to flight.
    pub(crate) fn propagated(&self, mu: f64, alpha: f64) -> f64 {
        mu * (self.loss / alpha / alpha)
    }
}
