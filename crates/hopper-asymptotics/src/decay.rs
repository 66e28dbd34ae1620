//! The algebraic approach to a fixed point from the right.

use crate::error::Error;
use crate::expansion_value::ExpansionValue;
use crate::right_expansion::{RIGHT_RANGE, RightExpansion};
use passive_hopper::MassRatio;

/// The law of the approach: δ_k^{−1/3} = λk/3 + (β/α* + 2λ/3) ln k + C + o(1) after k hops.
///
/// With u = δ^{−1/3} the expansion of the right side reads u′ = u + r + a₁/u + a₂/u² + …, r = λ/3. The function
///
/// ```text
///   K(u) = [u − L ln u + e/u]/r
///   L = a₁/r = ℓ₅ + 2λ/3      a₂/r = ℓ₆ + 4λℓ₅/3 + 14λ²/27      e = a₂/r − L² + rL/2
/// ```
///
/// grows by 1 + O(u⁻³) in a hop. The number of hops between two offsets is therefore the difference of their K, to
/// O(δ₀^{2/3}) with the start's offset δ₀.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decay {
    /// r = λ/3, by which u grows in a hop.
    pub rate: f64,
    /// L = β/α* + 2λ/3, the coefficient of the logarithm.
    pub logarithm: f64,
    /// e, the coefficient of 1/u.
    pub inverse: f64,
}

/// Bound on r/((1+λ)³ δ₀^{2/3}) times the neglected terms of a difference of K. The largest measured value for n =
/// 1…1000, M = 10⁻⁴…10³ is 0.08. Outside that range the error may be larger than stated.
const NEGLECTED: f64 = 0.1;

/// The smallest λ. The number of hops is about 3u/λ, and u reaches 10¹⁰⁸ for the smallest positive δ, so that the
/// number is at most 10²⁵⁹ here. For λ under 10⁻²⁰⁰ it could exceed the range of `f64`.
const SMALLEST_LAMBDA: f64 = 1e-150;

/// Most Newton steps of [`Decay::offset_after`]. K is nearly linear, so that a few steps suffice. The limit only
/// guarantees that the loop ends.
const NEWTON_STEPS: usize = 60;

/// Larger than ln(u₁/u₀) for any two positive `f64`: u lies between 1 and 10¹⁰⁸, and ln 10¹⁰⁸ = 249.
const LARGEST_LOGARITHM: f64 = 700.0;

impl Decay {
    /// Exponent of the start's offset δ₀ in the first neglected term of a number of hops.
    pub const NEGLECTED_EXPONENT: f64 = 2.0 / 3.0;

    /// The law at α*_n.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0; [`Error::OutsideRange`] with λ if λ is under 10⁻¹⁵⁰, where numbers of hops could
    /// overflow.
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        let right = RightExpansion::new(n, mass_ratio)?;
        let (lambda, [l5, l6, ..]) = (right.lambda, right.coefficients);
        if !(lambda >= SMALLEST_LAMBDA) {
            let (left, right) = (SMALLEST_LAMBDA, f64::INFINITY);
            return Err(Error::OutsideRange { value: lambda, left, right });
        }
        let rate = lambda / 3.0;
        let logarithm = l5 + 2.0 * rate;
        // a₂/r in terms of r: 4λ/3 = 4r and 14λ²/27 = (14/3) r².
        let second = l6 + 4.0 * rate * l5 + 14.0 / 3.0 * rate * rate;
        let inverse = second - logarithm * logarithm + 0.5 * rate * logarithm;
        Ok(Decay { rate, logarithm, inverse })
    }

    /// The largest offset for which the law has values: 0.1, or 10⁻³ λ⁻³ if that is less.
    ///
    /// 10⁻³ λ⁻³ is about a thousandth of the length of the trap. The error was measured up to it.
    pub fn range(&self) -> f64 {
        let lambda = 3.0 * self.rate;
        RIGHT_RANGE.min(1e-3 / (lambda * lambda * lambda))
    }

    /// The number of hops from offset `start` to offset `end`, as a real number. Rounded up, it is the number of hops
    /// after which the orbit is at or below `end`.
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
        // Newton's method on r (K(u) − K(u₀)) = r · hops. The slope of r K is near 1 throughout the range, so that the
        // leading term is a good start. u never decreases, so that no step may fall below u₀.
        let mut u = u0 + self.rate * hops;
        for _ in 0..NEWTON_STEPS {
            let sum = (u - u0) - self.logarithm * pxfm::f_log(u / u0)
                + self.inverse * (1.0 / u - 1.0 / u0);
            let slope = 1.0 - self.logarithm / u - self.inverse / (u * u);
            let step = (sum - self.rate * hops) / slope;
            u = (u - step).max(u0);
            // Two ulps are the rounding of u. A NaN also ends the loop.
            if !(step.abs() > 2.0 * f64::EPSILON * u) {
                break;
            }
        }
        let value = 1.0 / (u * u * u);
        // An error in hops is an error in δ: one hop takes λδ^{4/3} = 3 r δ/u. Eight ulps cover the rounding of u³.
        let hops = self.with_error(hops, start, u);
        let error = (hops.error * 3.0 * self.rate / u + 8.0 * f64::EPSILON) * value;
        Ok(ExpansionValue { value, error, neglected_exponent: Self::NEGLECTED_EXPONENT })
    }

    /// C of the law for the orbit from `start`.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] unless 0 < `start` ≤ [`range`](Self::range).
    pub fn constant(&self, start: f64) -> Result<ExpansionValue, Error> {
        self.check(start)?;
        let u0 = 1.0 / pxfm::f_cbrt(start);
        // For large k the law gives u = r k + L ln(r k) + r K(u₀), where r K(u₀) = u₀ − L ln u₀ + e/u₀. Comparison with
        // r k + L ln k + C gives C = r K(u₀) + L ln r.
        let value = u0 - self.logarithm * pxfm::f_log(u0 / self.rate) + self.inverse / u0;
        let hops = self.with_error(value / self.rate, start, u0);
        Ok(ExpansionValue { value, error: self.rate * hops.error, ..hops })
    }

    /// Returns an error for a start outside the range.
    fn check(&self, start: f64) -> Result<(), Error> {
        let right = self.range();
        if start > 0.0 && start <= right {
            return Ok(());
        }
        Err(Error::OutsideRange { value: start, left: 0.0, right })
    }

    /// A number of hops with its error: the terms neglected from `start` on, and the roundings of K for u up to
    /// `largest_u`.
    fn with_error(&self, value: f64, start: f64, largest_u: f64) -> ExpansionValue {
        let root = pxfm::f_cbrt(start);
        let size = 1.0 + 3.0 * self.rate;
        let neglected = NEGLECTED * size * size * size * root * root / self.rate;
        // Sixteen ulps of the largest terms, u and L ln u, cover the roots, the logarithm and the sums.
        let largest = largest_u + self.logarithm.abs() * LARGEST_LOGARITHM;
        let rounding = 16.0 * f64::EPSILON * largest / self.rate;
        ExpansionValue {
            value,
            error: neglected + rounding,
            neglected_exponent: Self::NEGLECTED_EXPONENT,
        }
    }
}
