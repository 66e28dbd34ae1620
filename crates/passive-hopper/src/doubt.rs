//! Whether the verdicts of a hop are larger than their rounding errors.

use crate::landing::maximum_test;
use crate::variation::{Variation, carry};
use crate::{Landing, TakeOff};
use std::f64::consts::PI;

/// Roundings of one landing, in ulps of the largest quantity in it.
const LANDING_ULPS: f64 = 16.0;

/// A running bound on the errors of the state on the ground.
///
/// The first landing's verdict is decided on 100 bits; doubts begin with the second.
pub(crate) struct Doubt {
    start: TakeOff,
    error: Variation,
    doubtful: bool,
    flights: f64,
    /// Relative rounding error of the arithmetic.
    epsilon: f64,
    /// Bound on the error of Σ Γ² handed on from flight to flight.
    loss: f64,
}

impl Doubt {
    /// For a hop from `alpha` in an arithmetic with relative error `epsilon`.
    pub(crate) fn new(alpha: f64, epsilon: f64) -> Self {
        Doubt {
            start: TakeOff { excess: 0.0, velocity: alpha },
            error: Variation { excess: 0.0, velocity: 0.0 },
            doubtful: false,
            flights: 0.0,
            epsilon,
            loss: 0.0,
        }
    }

    /// Takes the errors through a flight to its landing.
    pub(crate) fn pass(&mut self, landing: &Landing, kappa: f64) {
        let first = self.flights == 0.0;
        self.flights += 1.0;
        let TakeOff { excess, velocity } = self.start;
        let size = 1.0 + excess + velocity.abs() + landing.time + landing.closing_speed;
        let rounding = LANDING_ULPS * self.epsilon * size;
        if !first {
            // On which branch it lands, for a flight that passes near a touch.
            let slack = rounding + self.error.excess + size * self.error.velocity;
            self.doubtful |= velocity >= PI && maximum_test(self.start).abs() <= slack;
        }
        if landing.sudden || !first {
            let by_excess = Variation { excess: self.error.excess, velocity: 0.0 };
            // A rounding in h acts like one in V: the residual is a backward error.
            let by_velocity =
                Variation { excess: 0.0, velocity: self.error.velocity + self.epsilon };
            let (a, a_closing) = carry(self.start, landing, kappa, by_excess);
            let (b, b_closing) = carry(self.start, landing, kappa, by_velocity);
            self.loss += 2.0 * landing.closing_speed * (a_closing.abs() + b_closing.abs());
            self.error = Variation {
                excess: rounding + a.excess.abs() + b.excess.abs(),
                velocity: rounding + a.velocity.abs() + b.velocity.abs(),
            };
        }
        if !first {
            self.doubtful |= !(landing.excess.abs() > self.error.excess);
        }
        self.start = TakeOff { excess: landing.excess, velocity: landing.velocity };
    }

    /// Whether a verdict is in doubt, the sign of `share` = α′²/α² = 1 − μ Σ Γ²/α² included.
    pub(crate) fn is_real(&self, share: f64, mu: f64, alpha: f64) -> bool {
        let rounding = LANDING_ULPS * self.epsilon * (2.0 + self.flights);
        let handed_on = mu * (self.loss / alpha / alpha);
        self.doubtful || !(share.abs() > rounding + handed_on)
    }
}
