//! Are the decisions of a hop, and its value, larger than their errors?
//!
//! A *decision* of a hop is the sign of a computed number: whether a landing is sudden (x′), on which branch a flight
//! lands (the maximum test), whether the hopper lifts off again (α′²). A decision is *inconclusive* if the number is
//! not larger than the bound on its error. The hop is then computed again in longer arithmetic.
//!
//! The error has three parts. Each flight adds the rounding errors of its own landing. The search for the landing leaves
//! an error that acts like one of the start speed. Each flight also propagates the error of its start to its end, by its
//! derivative and a bound on the terms of second order. The propagated part grows along a chain of sudden lift-offs.
//!
//! The bounds are derived in docs/theory.md, section 13: the rounding of a landing in Lemma 58, the kernel's in
//! Lemma 61, propagation in Theorem 60, the decisions in Theorem 66.

use crate::landing::flight_derivative::{FlightDerivative, Variation};
use crate::landing::flight_ends::{Landing, TakeOff};
use crate::landing::half_time_root::LARGE_DIFFERENCE;
use crate::landing::next_landing::maximum_test;
use std::f64::consts::PI;

/// Bound on the direct rounding errors of x′, V′ and Γ at a landing, in ulps of the sum of all quantities in it,
/// 1 + x + |V| + τ + Γ.
///
/// docs/theory.md, Lemma 58: 13 suffices for the general solver; Lemma 60: 32 suffices for the kernel up to h = 128,
/// whose last step rounds h once more. One value serves both. A larger value sends more hops to the longer arithmetic:
/// twice the value, twice the hops whose decisions are inconclusive, some in 10¹³.
pub(crate) const LANDING_ULPS: f64 = 32.0;

/// Bound on the rounding error of the residual V(h) − V, in ulps of |V − h| + min(1, τ) in the general solver, and of
/// 1 + x + |V| + τ + Γ in the kernel and in longer arithmetic. It acts like an error of V at the start of the flight.
///
/// docs/theory.md, Lemmas 58, 60 and 63. The bound is nearly reached in the worst case at h = ½ in the general solver
/// and at h = π/4 in the kernel, where D = h − sin h cos h cancels most.
pub(crate) const BACKWARD_ULPS: f64 = 16.0;

/// Largest sum q of the terms that Theorem 60 of docs/theory.md compares with Γ: with q below this number the linear map
/// of the flight, with a part 4q added, bounds the change of its landing. A flight with a larger q nearly touches the
/// ground, or is so short that its start is hardly known. It counts as inconclusive.
///
/// The theorem needs q ≤ ½. A smaller limit keeps the bound near the linear one and sends some flights in 10¹² more to
/// the longer arithmetic.
const LARGEST_NONLINEARITY: f64 = 1.0 / 16.0;

/// The propagated error is increased by this part of its bound without cancellation, for the rounding errors of the
/// derivative's coefficients in `f64`. They are below 64 ulps apart from the error of the phase, which is counted
/// separately (docs/theory.md, Theorem 60). The value 10⁻⁶ also covers the rounding of the bound itself and changes no
/// bound noticeably.
const DERIVATIVE_ERROR: f64 = 1e-6;

/// Factor of ετ in the error of the derivative's sines: their phase τ is stored with an error of ετ/2 and h = τ/2 + rest
/// with as much, and |d sin τ|, |d(1 − cos τ)| ≤ dτ, twice for each product.
const PHASE_ULPS: f64 = 4.0;

/// Factor of (1 + x + |V| + τ + Γ) T² in the terms of second order of x′ and Γ, with T a bound on the change of the time.
/// Taylor's formula gives ½; the first-order correction of the search leaves ½ T² in x′ and 14 times the sum in Γ
/// (docs/theory.md, Theorem 60). T² is 10⁻²⁶ except near a touch.
const SECOND_ORDER: f64 = 16.0;

/// Factor of α (1 + h) e^{1/3} in the change of dΓ²/dα = 8α Su over a distance e: |(Su)′| ≤ 2 (1 + h), and h changes by at
/// most 2 e^{1/3} (docs/theory.md, Lemma 62).
const LOSS_BEND: f64 = 32.0;

/// A running bound on the error of the state on the ground.
///
/// The first landing is decided on the 100 bits of α*_n (docs/theory.md, Lemma 65). The decisions after it can be
/// inconclusive.
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
            // The test is V cos V − Y sin V. Its own rounding errors are below 2 ulps of the size, an error e of Y
            // changes it by at most e, and an error e of V by at most (x + V) e (docs/theory.md, Lemma 64).
            let slack = rounding + self.error.excess + size * self.error.velocity;
            self.inconclusive |= test.abs() <= slack;
            let two_branches = test.is_finite();
            self.last_test = two_branches.then_some(MaximumTest { value: test, error: slack });
        }
        let half = 0.5 * landing.time;
        let difference = (velocity - half).abs();
        let backward = if self.sines_are_exact {
            BACKWARD_ULPS * self.epsilon * (difference + landing.time.min(1.0))
        } else {
            BACKWARD_ULPS * self.epsilon * size
        };
        // The largest residual at which the search may stop. It is removed to first order. The rest of it is smaller than
        // the whole (docs/theory.md, Lemma 59).
        let scale = velocity.abs().min(half).min(difference + LARGE_DIFFERENCE);
        let stop = self.epsilon * (scale + landing.closing_speed);
        let change = Variation {
            excess: self.error.excess,
            velocity: self.error.velocity + backward + stop,
        };
        if first && !landing.sudden {
            self.loss += self.only_loss(landing, kappa, change.velocity);
        } else {
            let (after, closing) = self.propagate(landing, kappa, change, size);
            let closing = rounding + closing;
            self.loss += (2.0 * landing.closing_speed + closing) * closing;
            self.error = Variation {
                excess: rounding + after.excess,
                velocity: rounding + after.velocity + kappa * rounding,
            };
        }
        if !first {
            self.inconclusive |= !(landing.excess.abs() > self.error.excess);
        }
        self.start = landing.take_off();
    }

    /// Bound on the error of Γ² of a first flight that ends in contact, for an error of its speed up to `change`.
    ///
    /// The state after it does not matter, and Γ² is smooth where the time of flight is not, next to α*_n
    /// (docs/theory.md, Lemma 62).
    fn only_loss(&self, landing: &Landing, kappa: f64, change: f64) -> f64 {
        let slope = FlightDerivative::new(self.start, landing, kappa).largest_loss_slope();
        let bend = LOSS_BEND * (1.0 + 0.5 * landing.time) * pxfm::f_cbrt(change);
        change * (slope + bend * self.start.velocity)
    }

    /// Bounds on the errors of the state after a flight, and of Γ, for errors before the flight that are bounded by
    /// `change`: the linear map of the flight, a part of its bound without cancellation, and the terms of second order
    /// (docs/theory.md, Theorem 60). A flight that is too far from linear is inconclusive.
    fn propagate(
        &mut self,
        landing: &Landing,
        kappa: f64,
        change: Variation,
        size: f64,
    ) -> (Variation, f64) {
        let by_excess = Variation { velocity: 0.0, ..change };
        let by_velocity = Variation { excess: 0.0, ..change };
        let derivative = FlightDerivative::new(self.start, landing, kappa);
        let (a, a_closing) = derivative.carry(by_excess);
        let (b, b_closing) = derivative.carry(by_velocity);
        let (most, most_closing) = derivative.bound(change);
        let tau = landing.time;
        // The time changes by less than T = 2N/Γ. An ulp of τ is for the last bit of h.
        let time = 2.0 * derivative.largest_delay(change) + self.epsilon * tau;
        let later = tau + time;
        let nonlinearity = (0.5 * landing.excess.abs() * time
            + size * time * time / 6.0
            + later.min(1.0) * change.excess
            + (0.5 * later * later).min(2.0) * change.velocity)
            / landing.closing_speed;
        // `!` refuses NaN, of a landing with Γ = 0.
        self.inconclusive |= !(nonlinearity <= LARGEST_NONLINEARITY);
        let part = DERIVATIVE_ERROR + PHASE_ULPS * f64::EPSILON * tau + 4.0 * nonlinearity;
        let rest = time * (change.excess + change.velocity + SECOND_ORDER * size * time);
        let after = Variation {
            excess: a.excess.abs() + b.excess.abs() + part * most.excess + rest,
            velocity: a.velocity.abs() + b.velocity.abs() + part * most.velocity + kappa * rest,
        };
        (after, a_closing.abs() + b_closing.abs() + part * most_closing + rest)
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
