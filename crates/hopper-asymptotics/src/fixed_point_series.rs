//! The fixed points α*_n for large n.

use crate::error::Error;
use crate::expansion_value::ExpansionValue;

/// α*_n = q − q⁻¹ − ⅔q⁻³ − (13/15)q⁻⁵ − (146/105)q⁻⁷ − (781/315)q⁻⁹ + O(q⁻¹¹), q = (n+½)π.
///
/// The neglected exponent is the exponent of q. [`passive_hopper::alpha_star`] gives the value itself, rounded from 100
/// bits; the series is for analysis.
///
/// # Errors
/// [`Error::Index`] for n = 0.
pub fn fixed_point_series(n: u64) -> Result<ExpansionValue, Error> {
    /// Bound on −q¹¹ times the neglected terms. The next coefficient is 16328/3465 ≈ 4.71, and all have the same
    /// sign. At n = 1, where q⁻² = 0.045, the terms after it add about a tenth.
    const NEGLECTED: f64 = 6.0;
    if n == 0 {
        return Err(Error::Index { n });
    }
    let q = (n as f64 + 0.5) * std::f64::consts::PI;
    let square = 1.0 / (q * q);
    let terms = [1.0, 2.0 / 3.0, 13.0 / 15.0, 146.0 / 105.0, 781.0 / 315.0];
    let sum = terms.iter().rev().fold(0.0, |sum, term| sum * square + term);
    let neglected = NEGLECTED * square * square * square * square * square / q;
    // One ulp of q covers the roundings of π, of q and of the last difference.
    let error = neglected + f64::EPSILON * q;
    Ok(ExpansionValue { value: q - sum / q, error, neglected_exponent: -11.0 })
}
