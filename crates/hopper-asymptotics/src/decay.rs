//! The algebraic approach to a fixed point from the right.

use crate::{Error, ExpansionValue, RIGHT_RANGE, RightExpansion};
use passive_hopper::MassRatio;

/// δ_k^{−1/3} = λk/3 + (β/α* + 2λ/3) ln k + C + o(1).
///
/// With u = δ^{−1/3} the right side's expansion reads u′ = u + r + a₁/u + a₂/u² + …, r = λ/3, and
///
/// ```text
///   K(u) = [u − L ln u + e/u]/r     grows by one in a hop, but for O(u⁻³):
///   L = a₁/r = ℓ₅ + 2λ/3      a₂/r = ℓ₆ + 4λℓ₅/3 + 14λ²/27      e = a₂/r − L² + rL/2
/// ```
///
/// So the number of hops between two offsets is the difference of their K, to O(δ₀^{2/3}).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decay {
    /// λ/3, by which u grows in a hop.
    pub rate: f64,
    /// L = β/α* + 2λ/3, the coefficient of the logarithm.
    pub logarithm: f64,
    /// e.
    pub inverse: f64,
}

/// The neglected terms of K come to at most 0.08 (1+λ)³ δ₀^{2/3}/r, for n = 1…1000, M = 10⁻⁴…10³.
const NEGLECTED: f64 = 0.1;

impl Decay {
    /// Exponent of the start's offset in the first neglected term of a number of hops.
    pub const NEGLECTED_EXPONENT: f64 = 2.0 / 3.0;

    /// The law at α*_n.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0; [`Error::OutsideRange`] with λ, if it is under 10⁻¹⁵⁰: numbers of hops
    /// overflow.
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        const SMALLEST: f64 = 1e-150;
        let right = RightExpansion::new(n, mass_ratio)?;
        let (lambda, [l5, l6, ..]) = (right.lambda, right.l);
        if !(lambda >= SMALLEST) {
            let (left, right) = (SMALLEST, f64::INFINITY);
            return Err(Error::OutsideRange { value: lambda, left, right });
        }
        let rate = lambda / 3.0;
        let logarithm = l5 + 2.0 * rate;
        let second = l6 + 4.0 * rate * l5 + 14.0 / 3.0 * rate * rate;
        let inverse = second - logarithm * logarithm + 0.5 * rate * logarithm;
        Ok(Decay { rate, logarithm, inverse })
    }

    /// The largest offset for which the law answers: 0.1, or 10⁻³ λ⁻³ if that is less.
    pub fn range(&self) -> f64 {
        let lambda = 3.0 * self.rate;
        RIGHT_RANGE.min(1e-3 / (lambda * lambda * lambda))
    }

    /// The number of hops from offset `start` to offset `end`, as a real number: an orbit is under `end`
    /// after the next whole one.
    ///
    /// ```
    /// use hopper_asymptotics::Decay;
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let law = Decay::new(1, MassRatio::ONE)?;
    /// let map = LiftOffMap::new(MassRatio::ONE);
    /// let mut delta = 1e-5;
    /// for _ in 0..1000 {
    ///     delta = map.hop_near_fixed_point(1, delta)?.next.expect("in the trap");
    /// }
    /// let hops = law.hops(1e-5, delta)?;
    /// assert!((hops.value - 1000.0).abs() <= hops.error && hops.error < 0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutsideRange`] unless 0 < `end` ≤ `start` ≤ [`range`](Self::range).
    pub fn hops(&self, start: f64, end: f64) -> Result<ExpansionValue, Error> {
        self.check(start)?;
        if !(end > 0.0 && end <= start) {
            return Err(Error::OutsideRange { value: end, left: 0.0, right: start });
        }
        let (u0, u1) = (1.0 / pxfm::f_cbrt(start), 1.0 / pxfm::f_cbrt(end));
        let sum = (u1 - u0) - self.logarithm * pxfm::f_log(u1 / u0)
            + self.inverse * (1.0 / u1 - 1.0 / u0);
        Ok(self.with_error(sum / self.rate, start, u1))
    }

    /// The offset after `hops` hops from `start`.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] unless 0 < `start` ≤ [`range`](Self::range) and `hops` is finite and not
    /// negative.
    pub fn offset_after(&self, start: f64, hops: f64) -> Result<ExpansionValue, Error> {
        self.check(start)?;
        if !(hops >= 0.0 && hops.is_finite()) {
            return Err(Error::OutsideRange { value: hops, left: 0.0, right: f64::INFINITY });
        }
        let u0 = 1.0 / pxfm::f_cbrt(start);
        // Newton's method on K(u) − K(u₀) = hops; K′ is about 1/r throughout the range.
        let mut u = u0 + self.rate * hops;
        for _ in 0..60 {
            let sum = (u - u0) - self.logarithm * pxfm::f_log(u / u0)
                + self.inverse * (1.0 / u - 1.0 / u0);
            let slope = 1.0 - self.logarithm / u - self.inverse / (u * u);
            let step = (sum - self.rate * hops) / slope;
            u = (u - step).max(u0);
            if !(step.abs() > 2.0 * f64::EPSILON * u) {
                break;
            }
        }
        let value = 1.0 / (u * u * u);
        // One hop takes λδ^{4/3} = 3 r δ/u.
        let hops = self.with_error(hops, start, u);
        let error = (hops.error * 3.0 * self.rate / u + 8.0 * f64::EPSILON) * value;
        Ok(ExpansionValue { value, error, neglected_exponent: Self::NEGLECTED_EXPONENT })
    }

    /// C of the law, for the orbit from `start`.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] unless 0 < `start` ≤ [`range`](Self::range).
    pub fn constant(&self, start: f64) -> Result<ExpansionValue, Error> {
        self.check(start)?;
        let u0 = 1.0 / pxfm::f_cbrt(start);
        let value = u0 - self.logarithm * pxfm::f_log(u0 / self.rate) + self.inverse / u0;
        let hops = self.with_error(value / self.rate, start, u0);
        Ok(ExpansionValue { value, error: self.rate * hops.error, ..hops })
    }

    fn check(&self, start: f64) -> Result<(), Error> {
        let right = self.range();
        if start > 0.0 && start <= right {
            return Ok(());
        }
        Err(Error::OutsideRange { value: start, left: 0.0, right })
    }

    /// A number of hops, with what the law neglects from `start` on and the roundings of u.
    fn with_error(&self, value: f64, start: f64, largest: f64) -> ExpansionValue {
        let root = pxfm::f_cbrt(start);
        let size = 1.0 + 3.0 * self.rate;
        let neglected = NEGLECTED * size * size * size * root * root / self.rate;
        let rounding = 16.0 * f64::EPSILON * (largest + self.logarithm.abs() * 700.0) / self.rate;
        ExpansionValue {
            value,
            error: neglected + rounding,
            neglected_exponent: Self::NEGLECTED_EXPONENT,
        }
    }
}
