//! Derivatives of the map along its flights, the landings' shift in time included (saltation).
//!
//! For a flight from stretch 1 + x and speed V to a landing at τ = 2h with closing speed Γ,
//!
//! ```text
//!   dτ  = [(1 − cos τ) dx + (τ − sin τ) dV]/Γ
//!   dx′ = cos τ dx + sin τ dV + ṡ dτ                  ṡ = V cos τ − Y sin τ
//!   dΓ  = −sin τ dx − (1 − cos τ) dV − x′ dτ
//!   dV′ = dV − dτ + κ dΓ + Γ dκ
//!   α′ dα′ = α dα − μ Σ Γ dΓ − ½ dμ Σ Γ²
//! ```

use crate::error::Error;
use crate::landing::from_ground::Landing;
use crate::landing::from_ground::TakeOff;
use crate::map::lift_off_map::LiftOffMap;

/// The derivatives of one hop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slopes {
    /// ∂α′/∂α.
    pub by_speed: f64,
    /// ∂α′/∂M.
    pub by_mass_ratio: f64,
}

/// A small change of a state on the ground.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Variation {
    pub(crate) excess: f64,
    pub(crate) velocity: f64,
}

/// What a flight makes of small changes of its start: of the state after it, and of Γ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tangent {
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

impl Tangent {
    pub(crate) fn new(start: TakeOff, landing: &Landing, kappa: f64) -> Self {
        let tau = landing.time;
        // All by the half angle: one sine and one cosine.
        let (sin_half, cos_half) = pxfm::f_sincos(0.5 * tau);
        let versine = 2.0 * sin_half * sin_half;
        let (sin, cos) = (2.0 * sin_half * cos_half, 1.0 - versine);
        Tangent {
            sin,
            cos,
            versine,
            delay: if tau < 1.0 { -pxfm::f_sinmx(tau) } else { tau - sin },
            closing_speed: landing.closing_speed,
            excess: landing.excess,
            kappa,
            rates: (start.velocity * cos, (1.0 + start.excess) * sin),
        }
    }

    /// The changes after the flight, and that of Γ.
    pub(crate) fn carry(&self, change: Variation) -> (Variation, f64) {
        let (dx, dv) = (change.excess, change.velocity);
        let dt = (self.versine * dx + self.delay * dv) / self.closing_speed;
        let closing = -self.sin * dx - self.versine * dv - self.excess * dt;
        let excess = self.cos * dx + self.sin * dv + (self.rates.0 - self.rates.1) * dt;
        (Variation { excess, velocity: dv - dt + self.kappa * closing }, closing)
    }

    /// Bounds on these for changes bounded by `change`: every term taken as positive, so that none
    /// cancels another.
    pub(crate) fn bound(&self, change: Variation) -> (Variation, f64) {
        let (dx, dv) = (change.excess, change.velocity);
        let (sin, cos) = (self.sin.abs(), self.cos.abs());
        let dt = (self.versine * dx + self.delay.abs() * dv) / self.closing_speed;
        let closing = sin * dx + self.versine * dv + self.excess.abs() * dt;
        let excess = cos * dx + sin * dv + (self.rates.0.abs() + self.rates.1.abs()) * dt;
        (Variation { excess, velocity: dv + dt + self.kappa * closing }, closing)
    }
}

impl LiftOffMap {
    /// ∂α′/∂α and ∂α′/∂M at `alpha`; nothing if the hopper is grounded.
    ///
    /// On the contact intervals ∂α′/∂α = (α/α′)(1 − 4μW). At α*_n both one-sided slopes are 1, with
    /// f′ = 1 − (4/3)λδ^{1/3} on the right and 1 + (40/3)λ|δ|^{1/3} on the left. Both derivatives
    /// are infinite where α′ falls to zero, and on one side of a grazing.
    ///
    /// # Errors
    /// As [`image`](Self::image).
    pub fn slopes(&self, alpha: f64) -> Result<Option<Slopes>, Error> {
        let (hop, landings) = self.path(alpha)?;
        if !hop.certain {
            return Err(Error::Undecided { alpha, sudden: hop.sudden });
        }
        let Some(next) = hop.next else { return Ok(None) };
        let ratio = self.mass_ratio();
        let (m, mu, kappa) = (ratio.value(), ratio.mu(), ratio.kappa());
        let whole = 1.0 + m;
        let kappa_slope = 1.0 / (whole * whole);
        let mut by_speed = Variation { excess: 0.0, velocity: 1.0 };
        let mut by_ratio = Variation { excess: 0.0, velocity: 0.0 };
        // Σ Γ ∂Γ/∂α, Σ Γ ∂Γ/∂M, Σ Γ².
        let (mut speed_sum, mut ratio_sum, mut square_sum) = (0.0, 0.0, 0.0);
        let mut start = TakeOff { excess: 0.0, velocity: alpha };
        for landing in landings {
            let gamma = landing.closing_speed;
            square_sum += gamma * gamma;
            if gamma == 0.0 {
                break; // a lossless landing changes nothing: both slopes stay
            }
            let tangent = Tangent::new(start, &landing, kappa);
            let (speed, speed_closing) = tangent.carry(by_speed);
            let (mut mass, mass_closing) = tangent.carry(by_ratio);
            mass.velocity += gamma * kappa_slope;
            speed_sum += gamma * speed_closing;
            ratio_sum += gamma * mass_closing;
            (by_speed, by_ratio) = (speed, mass);
            start = TakeOff { excess: landing.excess, velocity: landing.velocity };
        }
        let mu_slope = (1.0 - m) / whole / (whole * whole);
        Ok(Some(Slopes {
            by_speed: (alpha - mu * speed_sum) / next,
            by_mass_ratio: -(mu * ratio_sum + 0.5 * mu_slope * square_sum) / next,
        }))
    }
}
