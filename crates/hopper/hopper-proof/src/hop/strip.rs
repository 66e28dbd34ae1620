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
    let m = Enclosure::from(mass_ratio);
    m / (Enclosure::ONE + m)
}

/// κ(1−κ), which rises up to κ = ½ and falls beyond it.
fn mu_of(kappa: Enclosure) -> Enclosure {
    let at = |k: f64| Enclosure::from(k) * (Enclosure::ONE - Enclosure::from(k));
    let ends = at(kappa.low()).hull(&at(kappa.high()));
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
        Ok(Strip::of_kappa(kappa, Enclosure::new(low, high)))
    }

    /// One mass ratio.
    ///
    /// # Errors
    /// [`Error::MassRatios`] unless it is positive and finite.
    pub fn at(mass_ratio: f64) -> Result<Self, Error> {
        Strip::between(mass_ratio, mass_ratio)
    }

    /// All mass ratios from 0 to `high`, with the limit of the motion at 0.
    pub(crate) fn up_to(high: f64) -> Result<Self, Error> {
        let strip = Strip::at(high)?;
        Ok(Strip::of_kappa(Enclosure::new(0.0, strip.kappa.high()), Enclosure::new(0.0, high)))
    }

    fn of_kappa(kappa: Enclosure, mass_ratios: Enclosure) -> Self {
        let centre = kappa.middle();
        Strip { mass_ratios, kappa, mu: mu_of(kappa), middle: Enclosure::from(centre) }
    }

    /// The length in κ.
    pub(crate) fn kappa_width(&self) -> f64 {
        self.kappa.width()
    }

    /// Two halves in κ. The mass ratios of both are those of the whole.
    pub(crate) fn halves(&self) -> [Self; 2] {
        let (low, high) = (self.kappa.low(), self.kappa.high());
        let middle = self.middle.low();
        [(low, middle), (middle, high)]
            .map(|(low, high)| Strip::of_kappa(Enclosure::new(low, high), self.mass_ratios))
    }

    /// The mass parameter in the middle of the strip, as a strip of its own.
    pub(crate) fn centre(&self) -> Self {
        Strip { kappa: self.middle, mu: mu_of(self.middle), ..*self }
    }
}
