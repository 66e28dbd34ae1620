//! The Jacobian of a flight: the response of its end to small changes of its start, the change of the landing
//! time included (saltation).
//!
//! For a flight from stretch Y = 1 + x and velocity V to a landing at τ = 2h with closing speed Γ,
//!
//! ```text
//!   dτ  = [(1 − cos τ) dx + (τ − sin τ) dV]/Γ
//!   dx′ = cos τ dx + sin τ dV + ṡ dτ                  ṡ = V cos τ − Y sin τ
//!   dΓ  = −sin τ dx − (1 − cos τ) dV − x′ dτ
//!   dV′ = dV − dτ + κ dΓ + Γ dκ
//! ```
//!
//! The term Γ dκ is left to the caller: it is no function of the changes of the start.

use crate::landing::flight_ends::{Landing, TakeOff};

/// A small change of a state on the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Variation {
    pub(crate) excess: f64,
    pub(crate) velocity: f64,
}

/// The linear map from a change (dx, dV) of the start to the change (dx′, dV′) after the landing, and to dΓ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlightJacobian {
    sin: f64,
    cos: f64,
    /// 1 − cos τ.
    versine: f64,
    /// τ − sin τ.
    delay: f64,
    closing_speed: f64,
    excess: f64,
    kappa: f64,
    /// V cos τ and Y sin τ: the rate of the stretch at the landing is their difference.
    rates: (f64, f64),
}

impl FlightJacobian {
    pub(crate) fn new(start: TakeOff, landing: &Landing, kappa: f64) -> Self {
        let tau = landing.time;
        // All functions of τ from the half angle: one sine and one cosine.
        let (sin_half, cos_half) = pxfm::f_sincos(0.5 * tau);
        let versine = 2.0 * sin_half * sin_half;
        let (sin, cos) = (2.0 * sin_half * cos_half, 1.0 - versine);
        FlightJacobian {
            sin,
            cos,
            versine,
            // Below τ = 1 the difference cancels: τ − sin τ ≈ τ³/6.
            delay: if tau < 1.0 { -pxfm::f_sinmx(tau) } else { tau - sin },
            closing_speed: landing.closing_speed,
            excess: landing.excess,
            kappa,
            rates: (start.velocity * cos, (1.0 + start.excess) * sin),
        }
    }

    /// The change after the flight, and that of Γ.
    pub(crate) fn apply(&self, change: Variation) -> (Variation, f64) {
        let (dx, dv) = (change.excess, change.velocity);
        let dt = (self.versine * dx + self.delay * dv) / self.closing_speed;
        let closing = -self.sin * dx - self.versine * dv - self.excess * dt;
        let excess = self.cos * dx + self.sin * dv + (self.rates.0 - self.rates.1) * dt;
        (Variation { excess, velocity: dv - dt + self.kappa * closing }, closing)
    }

    /// Bounds on both for changes bounded by `change`. Every term is taken as positive, so that no term cancels
    /// another.
    pub(crate) fn bound(&self, change: Variation) -> (Variation, f64) {
        let (dx, dv) = (change.excess, change.velocity);
        let (sin, cos) = (self.sin.abs(), self.cos.abs());
        let dt = (self.versine * dx + self.delay.abs() * dv) / self.closing_speed;
        let closing = sin * dx + self.versine * dv + self.excess.abs() * dt;
        let excess = cos * dx + sin * dv + (self.rates.0.abs() + self.rates.1.abs()) * dt;
        (Variation { excess, velocity: dv + dt + self.kappa * closing }, closing)
    }
}
