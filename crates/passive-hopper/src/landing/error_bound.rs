//! Whether the verdicts of a hop, and its value, are larger than their rounding errors.

use crate::landing::from_ground::Landing;
use crate::landing::from_ground::TakeOff;
use crate::landing::from_ground::maximum_test;
use crate::map::slopes::{Tangent, Variation};
use std::f64::consts::PI;

/// Roundings of one landing, in ulps of the largest quantity in it.
pub(crate) const LANDING_ULPS: f64 = 16.0;

/// A running bound on the errors of the state on the ground.
///
/// The first landing's verdict is decided on 100 bits; doubts begin with the second.
#[derive(Debug, Clone)]
pub(crate) struct Doubt {
    start: TakeOff,
    error: Variation,
    doubtful: bool,
    flights: f64,
    /// Relative rounding error of the arithmetic.
    epsilon: f64,
    /// Whether sines are right at the argument as it is stored, as those of `f64` are.
    plain: bool,
    /// Bound on the error of Σ Γ² handed on from flight to flight.
    loss: f64,
}

impl Doubt {
    /// For a hop from `alpha` in `f64`.
    pub(crate) fn plain(alpha: f64) -> Self {
        Self::new(alpha, f64::EPSILON, true)
    }

    /// For a hop from `alpha` in an arithmetic with relative error `epsilon`.
    pub(crate) fn wide(alpha: f64, epsilon: f64) -> Self {
        Self::new(alpha, epsilon, false)
    }

    fn new(alpha: f64, epsilon: f64, plain: bool) -> Self {
        Doubt {
            start: TakeOff { excess: 0.0, velocity: alpha },
            error: Variation { excess: 0.0, velocity: 0.0 },
            doubtful: false,
            flights: 0.0,
            epsilon,
            plain,
            loss: 0.0,
        }
    }

    /// Takes the errors through a flight to its landing, in `f64`.
    pub(crate) fn pass(&mut self, landing: &Landing, kappa: f64) {
        let test = if self.start.velocity >= PI { maximum_test(self.start) } else { f64::INFINITY };
        self.pass_on_branch(landing, kappa, test);
    }

    /// The same with the sign that decided the branch, or infinity where none was asked for.
    pub(crate) fn pass_on_branch(&mut self, landing: &Landing, kappa: f64, test: f64) {
        let first = self.flights == 0.0;
        self.flights += 1.0;
        let TakeOff { excess, velocity } = self.start;
        let size = 1.0 + excess + velocity.abs() + landing.time + landing.closing_speed;
        let rounding = LANDING_ULPS * self.epsilon * size;
        if !first {
            // On which branch it lands, for a flight that passes near a touch.
            let slack = rounding + self.error.excess + size * self.error.velocity;
            self.doubtful |= test.abs() <= slack;
        }
        if landing.sudden || !first {
            // A rounding in h acts like one in V: the residual is a backward error. In `f64` sines are
            // exact, and the rest of an ulp of h is corrected to first order; else the phase is rounded.
            let ulp = self.epsilon * size;
            let backward = if self.plain { self.epsilon + 4.0 * ulp * ulp } else { ulp };
            let change =
                Variation { excess: self.error.excess, velocity: self.error.velocity + backward };
            let (after, closing) = self.carry(landing, kappa, change);
            self.loss += 2.0 * landing.closing_speed * closing;
            self.error =
                Variation { excess: rounding + after.excess, velocity: rounding + after.velocity };
        }
        if !first {
            self.doubtful |= !(landing.excess.abs() > self.error.excess);
        }
        self.start = TakeOff { excess: landing.excess, velocity: landing.velocity };
    }

    /// What a flight makes of errors bounded by `change`: its linear map, and a small part of the bound
    /// without cancellation for the rounding of that map's coefficients.
    fn carry(&self, landing: &Landing, kappa: f64, change: Variation) -> (Variation, f64) {
        let by_excess = Variation { velocity: 0.0, ..change };
        let by_velocity = Variation { excess: 0.0, ..change };
        let tangent = Tangent::new(self.start, landing, kappa);
        let (a, a_closing) = tangent.carry(by_excess);
        let (b, b_closing) = tangent.carry(by_velocity);
        let (most, most_closing) = tangent.bound(change);
        let part = 1e-6 + 4.0 * f64::EPSILON * landing.time;
        let after = Variation {
            excess: a.excess.abs() + b.excess.abs() + part * most.excess,
            velocity: a.velocity.abs() + b.velocity.abs() + part * most.velocity,
        };
        (after, a_closing.abs() + b_closing.abs() + part * most_closing)
    }

    /// Whether the verdict of a landing was in doubt, on the way so far.
    pub(crate) fn is_doubtful(&self) -> bool {
        self.doubtful
    }

    /// Whether a verdict is in doubt, the sign of `share` = α′²/α² = 1 − μ Σ Γ²/α² included.
    pub(crate) fn is_real(&self, share: f64, mu: f64, alpha: f64) -> bool {
        self.doubtful || !(share.abs() > self.share_error(mu, alpha))
    }

    /// Bound on the error of α′²/α².
    pub(crate) fn share_error(&self, mu: f64, alpha: f64) -> f64 {
        LANDING_ULPS * self.epsilon * (2.0 + self.flights) + self.handed_on(mu, alpha)
    }

    /// The part of it that came from flight to flight.
    pub(crate) fn handed_on(&self, mu: f64, alpha: f64) -> f64 {
        mu * (self.loss / alpha / alpha)
    }
}
