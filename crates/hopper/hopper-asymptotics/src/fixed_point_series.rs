//! The fixed points α*_n for large n.
//!
//! Proof: docs/theory.md, Lemma 40 and Theorem 71.

use crate::error::Error;
use crate::expansion_value::ExpansionValue;

/// Bound on −q¹¹ times the neglected terms of [`fixed_point_series`], for all n ≥ 1 (docs/theory.md, Theorem 71).
/// The next coefficient is 16328/3465 ≈ 4.71. The proof gives 5.177; the rest of 5.2 covers the rounding of the
/// bound.
pub const FIXED_POINT_REMAINDER: f64 = 5.2;

/// Bound on the rounding error in ulps of q, for n < 2⁵² (docs/theory.md, Lemma 72): 1.36 units 2⁻⁵³ for π and the
/// product, 1 for the last difference, and 0.14 for the quotient that is subtracted.
const ULPS: f64 = 1.25;

/// As [`ULPS`], from n = 2⁵² on, where n and n + ½ are rounded as well, each with one unit 2⁻⁵³.
const ULPS_OF_LARGE_INDICES: f64 = 2.25;

/// From this index on, n + ½ is no `f64`.
const FIRST_ROUNDED_INDEX: u64 = 1 << 52;

/// α*_n = q − q⁻¹ − ⅔q⁻³ − (13/15)q⁻⁵ − (146/105)q⁻⁷ − (781/315)q⁻⁹ + O(q⁻¹¹), q = (n+½)π.
///
/// The neglected exponent is the exponent of q. [`passive_hopper::alpha_star`] gives the value itself, rounded from 100
/// bits; the series is for analysis.
///
/// # Errors
/// [`Error::Index`] for n = 0.
pub fn fixed_point_series(n: u64) -> Result<ExpansionValue, Error> {
    if n == 0 {
        return Err(Error::Index { n });
    }
    let q = (n as f64 + 0.5) * std::f64::consts::PI;
    let square = 1.0 / (q * q);
    let terms = [1.0, 2.0 / 3.0, 13.0 / 15.0, 146.0 / 105.0, 781.0 / 315.0];
    let sum = terms.iter().rev().fold(0.0, |sum, term| sum * square + term);
    let neglected = FIXED_POINT_REMAINDER * square * square * square * square * square / q;
    let ulps = if n < FIRST_ROUNDED_INDEX { ULPS } else { ULPS_OF_LARGE_INDICES };
    let error = neglected + ulps * f64::EPSILON * q;
    Ok(ExpansionValue { value: q - sum / q, error, neglected_exponent: -11.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use passive_hopper::FixedPointSpeed;

    /// |sum − α*_n|/error, with 100 bits of α*_n.
    fn ratio(n: u64) -> f64 {
        let (found, star) = (fixed_point_series(n).unwrap(), FixedPointSpeed::new(n));
        ((found.value - star.value()) - star.rest()).abs() / found.error
    }

    #[test]
    fn the_bound_holds_for_a_million_indices_and_is_nearly_met() {
        let largest = (1..1_000_000)
            .map(|n| (ratio(n), n))
            .fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a });
        assert!(largest.0 <= 1.0 && largest.0 > 0.9, "{largest:?}");
        // An error above one ulp of q.
        assert!(ratio(1306) > 1.0 / ULPS);
    }

    #[test]
    fn the_bound_holds_where_the_index_is_rounded() {
        for n in [
            1 << 51,
            (1 << 52) - 1,
            1 << 52,
            (1 << 52) + 1,
            (1 << 53) + 1,
            (1 << 60) + 511,
            u64::MAX,
        ] {
            assert!(ratio(n) <= 1.0, "{n}: {}", ratio(n));
        }
    }
}
