//! An interval of mass ratios.

use crate::error::Error;
use interval_arithmetic::Enclosure;
use passive_hopper::MassRatio;

/// All mass ratios of an interval, with the parameters of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strip {
    /// M.
    pub mass_ratios: Enclosure,
    /// κ = M/(1+M).
    pub(crate) kappa: Enclosure,
    /// μ = κ(1−κ) ≤ ¼.
    pub(crate) mu: Enclosure,
    /// A κ of the strip.
    pub(crate) middle: Enclosure,
}

/// κ of one mass ratio.
fn kappa_of(mass_ratio: f64) -> Enclosure {
    let m = Enclosure::new(mass_ratio, mass_ratio);
    m / (Enclosure::ONE + m)
}

/// κ(1−κ), which rises up to κ = ½ and falls beyond it.
fn mu_of(kappa: Enclosure) -> Enclosure {
    let at = |k: f64| Enclosure::new(k, k) * (Enclosure::ONE - Enclosure::new(k, k));
    let ends = at(kappa.low).hull(&at(kappa.high));
    if kappa.contains(0.5) { ends.hull(&Enclosure::new(0.25, 0.25)) } else { ends }
}

impl Strip {
    /// All mass ratios from `low` to `high`.
    ///
    /// # Errors
    /// [`Error::MassRatios`] unless both are positive and finite, and `low` is not above `high`.
    pub fn between(low: f64, high: f64) -> Result<Self, Error> {
        let valid = |m: f64| MassRatio::new(m).is_ok();
        if !(valid(low) && valid(high) && low <= high) {
            return Err(Error::MassRatios { low, high });
        }
        let kappa = kappa_of(low).hull(&kappa_of(high));
        let centre = kappa.middle();
        Ok(Strip {
            mass_ratios: Enclosure::new(low, high),
            kappa,
            mu: mu_of(kappa),
            middle: Enclosure::new(centre, centre),
        })
    }

    /// One mass ratio.
    ///
    /// # Errors
    /// [`Error::MassRatios`] unless it is positive and finite.
    pub fn at(mass_ratio: f64) -> Result<Self, Error> {
        Strip::between(mass_ratio, mass_ratio)
    }

    /// The mass parameter in the middle of the strip, as a strip of its own.
    pub(crate) fn centre(&self) -> Self {
        Strip { kappa: self.middle, mu: mu_of(self.middle), ..*self }
    }
}
