//! The algebraic approach to a fixed point from the right.
//!
//! Proof: docs/theory.md, Theorem 37 and Theorem 69.

use crate::error::Error;
use crate::expansion_value::{ExpansionValue, UNDERFLOW};
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

/// Bound on dδ of an error of K, relative to its first order where the slope of rK is 1 (docs/theory.md, Theorem
/// 69): the slope is at least 0.69, and the error of K changes u by at most 5 %.
const OFFSET_FACTOR: f64 = 2.0;

/// The smallest λ. The number of hops is about 3u/λ, and u reaches 10¹⁰⁸ for the smallest positive δ, so that the
/// number is at most 10²⁵⁹ here. For λ under 10⁻²⁰⁰ it could exceed the range of `f64`.
const SMALLEST_LAMBDA: f64 = 1e-150;

/// Most Newton steps of [`Decay::offset_after`]. K is nearly linear, so that a few suffice; the limit only makes sure
/// that the loop ends. It exceeds the 53 bits of a number: even a search that gained one bit a step would end before
/// it.
const NEWTON_STEPS: usize = 60;

/// Larger than ln(u₁/u₀) for any two positive `f64`, and than ln(u₀/r): u₀ lies between 1 and 10¹⁰⁸, u₁ between 1
/// and the largest `f64`, r above 10⁻¹⁵¹, and ln 1.8·10³⁰⁸ = 709.8.
const LARGEST_LOGARITHM: f64 = 710.0;

/// Bound on the rounding error of rK in ulps of u + 710 |L| (docs/theory.md, Lemma 72): 27 units 2⁻⁵³ of u, of
/// which 14 are the error of r, and 18 of |L| ln.
const SUM_ULPS: f64 = 16.0;

/// Bound on the rounding error of 1/u³ in ulps of it (docs/theory.md, Lemma 72): 6 for the last Newton step, which
/// is at most two ulps of u, 1.5 for the rounding of u and 1.5 for the three divisions, rounded up.
const OFFSET_ULPS: f64 = 10.0;

impl Decay {
    /// Exponent of the start's offset δ₀ in the first neglected term of a number of hops.
    pub const NEGLECTED_EXPONENT: f64 = 2.0 / 3.0;

    /// The coefficients of the bound for one hop, |K(u′) − K(u) − 1| ≤ (0.55 + 0.3 λ³) u⁻³, for all n ≥ 1 and all M
    /// (docs/theory.md, Theorem 69).
    pub const ONE_HOP: [f64; 2] = [0.55, 0.3];

    /// Bound on r δ₀^{−2/3} Σ u_j⁻³ over an orbit from δ₀ (docs/theory.md, Theorem 69).
    ///
    /// So the neglected terms of a number of hops are at most `ORBIT` (0.55 + 0.3 λ³) δ₀^{2/3}/r. The proof gives
    /// 0.603; the rest of 0.61 covers the rounding of this product.
    pub const ORBIT: f64 = 0.61;

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
    /// 10⁻³ λ⁻³ is about a thousandth of the length of the trap. The error is proved up to it (docs/theory.md,
    /// Theorem 69).
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
    /// [`Error::OutsideRange`] unless 0 < `start` ≤ [`range`](Self::range), `hops` is not negative, and u = λ
    /// `hops`/3 is finite.
    pub fn offset_after(&self, start: f64, hops: f64) -> Result<ExpansionValue, Error> {
        self.check(start)?;
        let u0 = 1.0 / pxfm::f_cbrt(start);
        // From an infinite u the search would return u₀.
        if !(hops >= 0.0 && (u0 + self.rate * hops).is_finite()) {
            let right = f64::MAX / self.rate.max(1.0);
            return Err(Error::OutsideRange { value: hops, left: 0.0, right });
        }
        // Newton's method on r (K(u) − K(u₀)) = r · hops. The slope of r K by u is near 1 throughout the range
        // (docs/theory.md, Theorem 69), so that the leading term is a good start. The slope is positive and `hops`
        // is not negative: the root is not below u₀, and no step may fall below it.
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
        // u³ can exceed the largest number where δ is subnormal; the quotients cannot.
        let value = 1.0 / u / u / u;
        // An error in hops is an error in δ: one hop takes λδ^{4/3} = 3 r δ/u.
        let hops = self.with_error(hops, start, u);
        let relative = OFFSET_FACTOR * hops.error * 3.0 * self.rate / u;
        let error = (relative + OFFSET_ULPS * f64::EPSILON) * value + UNDERFLOW;
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
        let lambda = 3.0 * self.rate;
        let one_hop = Self::ONE_HOP[0] + Self::ONE_HOP[1] * lambda * lambda * lambda;
        let neglected = Self::ORBIT * one_hop * root * root / self.rate;
        let largest = largest_u + self.logarithm.abs() * LARGEST_LOGARITHM;
        let rounding = SUM_ULPS * f64::EPSILON * largest / self.rate;
        ExpansionValue {
            value,
            error: neglected + rounding,
            neglected_exponent: Self::NEGLECTED_EXPONENT,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// After so many hops δ is about (3/(λk))³, here a subnormal number; u³ would overflow.
    #[test]
    fn offsets_below_the_normal_numbers_have_values() {
        let law = Decay::new(1, MassRatio::ONE).unwrap();
        for (hops, exponent) in [(1e106, 318), (3e106, 320), (1e107, 321)] {
            let found = law.offset_after(1e-6, hops).unwrap();
            let exact = (1.0 / (law.rate * hops * 10f64.powi(-107))).powi(3); // δ 10³²¹
            let value = found.value * 1e300 * 1e21;
            assert!(
                (value - exact).abs() <= found.error * 1e300 * 1e21,
                "{exponent} {value} {exact}"
            );
            assert!(found.value > 0.0 && found.value < f64::MIN_POSITIVE);
        }
        // Far below the smallest number.
        let found = law.offset_after(1e-6, 1e200).unwrap();
        assert!(found.value == 0.0 && found.error > 0.0);
    }

    /// The offset cannot be the start again.
    #[test]
    fn numbers_of_hops_with_an_infinite_u_are_errors() {
        let law = Decay::new(1 << 40, MassRatio::ONE).unwrap();
        let start = law.range();
        assert!(matches!(law.offset_after(start, 1e308), Err(Error::OutsideRange { .. })));
        let found = law.offset_after(start, 1e290).unwrap();
        assert!(found.value < start && found.error < start, "{found:?}");
    }

    /// A start that is a subnormal number.
    #[test]
    fn subnormal_offsets_are_accepted() {
        let law = Decay::new(1, MassRatio::ONE).unwrap();
        let start = f64::from_bits(1000);
        let found = law.offset_after(start, 0.0).unwrap();
        assert!((found.value - start).abs() <= found.error && found.error < 0.01 * start);
        assert!(law.hops(start, f64::from_bits(1)).unwrap().value > 1e100);
    }
}
