//! Derivatives ∂α′/∂α and ∂α′/∂M of the map, from the derivatives of its flights.
//!
//! Differentiating α′² = α² − μ Σ Γ² gives
//!
//! ```text
//!   α′ dα′ = α dα − μ Σ Γ dΓ − ½ dμ Σ Γ²
//!   dκ/dM = 1/(1 + M)²        dμ/dM = (1 − M)/(1 + M)³
//! ```
//!
//! [`FlightDerivative`] maps (dx, dV) at the start of each flight to its end, and gives dΓ. It holds κ fixed; the
//! change of κ adds Γ dκ to dV at each landing.

use crate::error::Error;
use crate::landing::flight_derivative::{FlightDerivative, Variation};
use crate::landing::flight_ends::TakeOff;
use crate::map::lift_off_map::LiftOffMap;

/// The derivatives of one hop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slopes {
    /// ∂α′/∂α.
    pub by_speed: f64,
    /// ∂α′/∂M.
    pub by_mass_ratio: f64,
}

impl Slopes {
    /// The unit of the error of `next` = α′: the effect on α′ of half an ulp in each of α, M, α′ and α², added up.
    ///
    /// It is ε (α′ + |∂α′/∂α| α + |∂α′/∂M| M + α²/α′) with ε = 2⁻⁵³, but for a very small α′. An error h = εα² of
    /// α² moves α′ by √(α′² + h) − α′, which is below h/(2α′) and below √h. Near α′ = 0 only the second bound is
    /// finite, so that the last term is at most √h/ε. The error of [`LiftOffMap`] is at most 4 (1 + sudden
    /// lift-offs) of these units.
    pub fn error_unit(&self, alpha: f64, mass_ratio: f64, next: f64) -> f64 {
        // √(ε/2) α in units of ε/2 is α √(2/ε); ε is the spacing of numbers at 1 here.
        let most = (2.0 / f64::EPSILON).sqrt();
        // α (α/α′) does not overflow where α² does.
        let sum = next
            + self.by_speed.abs() * alpha
            + self.by_mass_ratio.abs() * mass_ratio
            + alpha * (alpha / next).min(most);
        0.5 * f64::EPSILON * sum
    }
}

impl LiftOffMap {
    /// ∂α′/∂α and ∂α′/∂M at `alpha`; `None` if the hopper is grounded.
    ///
    /// On the contact intervals ∂α′/∂α = (α/α′)(1 − 4μW) (docs/theory.md, Lemma 26). At α*_n both one-sided derivatives
    /// by α are 1, with f′ = 1 − (4/3)λδ^{1/3} on the right and 1 + (40/3)λ|δ|^{1/3} on the left. Both derivatives are
    /// infinite where α′ falls to zero, and on one side of a grazing.
    ///
    /// # Errors
    /// The errors of [`image`](Self::image).
    pub fn slopes(&self, alpha: f64) -> Result<Option<Slopes>, Error> {
        let (hop, landings) = self.path(alpha)?;
        let Some(next) = hop.next else { return Ok(None) };
        let ratio = self.mass_ratio();
        let (m, mu, kappa) = (ratio.value(), ratio.mu(), ratio.kappa());
        let whole = 1.0 + m;
        let kappa_slope = 1.0 / (whole * whole);
        // The state on the ground as a function of α, and as a function of M.
        let mut by_speed = Variation { excess: 0.0, velocity: 1.0 };
        let mut by_ratio = Variation { excess: 0.0, velocity: 0.0 };
        // Σ Γ ∂Γ/∂α, Σ Γ ∂Γ/∂M, Σ Γ².
        let (mut speed_sum, mut ratio_sum, mut square_sum) = (0.0, 0.0, 0.0);
        let mut start = TakeOff { excess: 0.0, velocity: alpha };
        for landing in landings {
            let gamma = landing.closing_speed;
            square_sum += gamma * gamma;
            if gamma == 0.0 {
                // A lossless landing: dτ has a factor 1/Γ, which would give NaN. Its Γ dΓ is zero.
                break;
            }
            let flight = FlightDerivative::new(start, &landing, kappa);
            let (speed, speed_closing) = flight.carry(by_speed);
            let (mut mass, mass_closing) = flight.carry(by_ratio);
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
