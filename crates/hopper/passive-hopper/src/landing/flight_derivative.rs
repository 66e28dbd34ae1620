//! The derivative of one flight: how a small change of its start changes its landing.
//!
//! A flight from stretch 1 + x = Y and speed V lands after τ = 2h with closing speed Γ. A change of the start also
//! moves the landing in time, by dτ. With the rate of the stretch ṡ at the landing,
//!
//! ```text
//!   dτ  = [(1 − cos τ) dx + (τ − sin τ) dV]/Γ
//!   dx′ = cos τ dx + sin τ dV + ṡ dτ                  ṡ = V cos τ − Y sin τ
//!   dΓ  = −sin τ dx − (1 − cos τ) dV − x′ dτ
//!   dV′ = dV − dτ + κ dΓ
//! ```
//!
//! The derivatives of the map (`map/slopes.rs`) and the error bounds (`error_bound.rs`) both use it.
//!
//! Proof: docs/theory.md, Lemma 16.

use crate::landing::flight_ends::{Landing, TakeOff};

/// A small change (dx, dV) of a state on the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Variation {
    pub(crate) excess: f64,
    pub(crate) velocity: f64,
}

/// The linear map from a change of a flight's start to the change of the state after it, and of Γ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlightDerivative {
    sin: f64,
    cos: f64,
    /// 1 − cos τ.
    versine: f64,
    /// τ − sin τ.
    delay: f64,
    closing_speed: f64,
    excess: f64,
    kappa: f64,
    /// V cos τ and Y sin τ: their difference is ṡ at the landing.
    rates: (f64, f64),
}

impl FlightDerivative {
    pub(crate) fn new(start: TakeOff, landing: &Landing, kappa: f64) -> Self {
        let tau = landing.time;
        // One sine and one cosine, of h = τ/2: 1 − cos τ = 2 sin² h loses no digits at small τ.
        let (sin_half, cos_half) = pxfm::f_sincos(0.5 * tau);
        let sin = 2.0 * sin_half * cos_half;
        // Below τ = 1 the plain difference cancels.
        let delay = if tau < 1.0 { -pxfm::f_sinmx(tau) } else { tau - sin };
        Self::from_functions(start, landing, kappa, (sin, 2.0 * sin_half * sin_half, delay))
    }

    /// From sin τ, 1 − cos τ and τ − sin τ. Their errors of some ulps are among those of the derivative's coefficients.
    pub(crate) fn from_functions(
        start: TakeOff,
        landing: &Landing,
        kappa: f64,
        (sin, versine, delay): (f64, f64, f64),
    ) -> Self {
        let cos = 1.0 - versine;
        FlightDerivative {
            sin,
            cos,
            versine,
            delay,
            closing_speed: landing.closing_speed,
            excess: landing.excess,
            kappa,
            rates: (start.velocity * cos, (1.0 + start.excess) * sin),
        }
    }

    /// The change of the state after the flight, and of Γ.
    pub(crate) fn carry(&self, change: Variation) -> (Variation, f64) {
        let (dx, dv) = (change.excess, change.velocity);
        let dt = (self.versine * dx + self.delay * dv) / self.closing_speed;
        let closing = -self.sin * dx - self.versine * dv - self.excess * dt;
        let excess = self.cos * dx + self.sin * dv + (self.rates.0 - self.rates.1) * dt;
        (Variation { excess, velocity: dv - dt + self.kappa * closing }, closing)
    }

    /// Bound on the change of the time to first order, N/Γ with N = (1 − cos τ) dx + (τ − sin τ) dV, for changes
    /// bounded by `change`.
    pub(crate) fn largest_delay(&self, change: Variation) -> f64 {
        (self.versine * change.excess + self.delay.abs() * change.velocity) / self.closing_speed
    }

    /// Bound on |d(Γ²)/dV| = 2 |(1 − cos τ) Γ + (τ − sin τ) x′|, which is finite where Γ = 0.
    pub(crate) fn largest_loss_slope(&self) -> f64 {
        2.0 * (self.versine * self.closing_speed + self.delay.abs() * self.excess.abs())
    }

    /// Bounds on the results of [`carry`](Self::carry) for changes bounded by `change`: the sums of the absolute values
    /// of all terms, so that no term cancels another.
    pub(crate) fn bound(&self, change: Variation) -> (Variation, f64) {
        let (dx, dv) = (change.excess, change.velocity);
        let (sin, cos) = (self.sin.abs(), self.cos.abs());
        let dt = self.largest_delay(change);
        let closing = sin * dx + self.versine * dv + self.excess.abs() * dt;
        let excess = cos * dx + sin * dv + (self.rates.0.abs() + self.rates.1.abs()) * dt;
        (Variation { excess, velocity: dv + dt + self.kappa * closing }, closing)
    }
}
