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
use crate::landing::flight_ends::TakeOff;
use crate::landing::flight_jacobian::{FlightJacobian, Variation};
use crate::map::lift_off_map::LiftOffMap;

/// The derivatives of one hop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slopes {
    /// ∂α′/∂α.
    pub by_speed: f64,
    /// ∂α′/∂M.
    pub by_mass_ratio: f64,
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
            let jacobian = FlightJacobian::new(start, &landing, kappa);
            let (speed, speed_closing) = jacobian.apply(by_speed);
            let (mut mass, mass_closing) = jacobian.apply(by_ratio);
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
