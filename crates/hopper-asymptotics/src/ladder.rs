//! The ladder of fixed points for large n.

use crate::{Error, ExpansionValue, RightExpansion};
use passive_hopper::MassRatio;

/// α*_n = q − q⁻¹ − ⅔q⁻³ − (13/15)q⁻⁵ − (146/105)q⁻⁷ − (781/315)q⁻⁹ + O(q⁻¹¹), q = (n+½)π.
///
/// The exponent given is that of q. For the value itself take [`passive_hopper::alpha_star`], which is right to 100 bits.
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
    // The next coefficient is 16328/3465; all have the same sign.
    let neglected = 6.0 * square * square * square * square * square / q;
    let error = neglected + f64::EPSILON * q;
    Ok(ExpansionValue { value: q - sum / q, error, neglected_exponent: -11.0 })
}

/// Smallest λ for which [`trap_length_series`] answers.
pub const SMALLEST_LAMBDA: f64 = 3.0;

/// |c₃| and what follows in 1 + c₁/λ + c₂/λ² + c₃/λ³ + …, for λ from the smallest on.
const NEGLECTED: f64 = 6.0;

/// Δ_n = λ⁻³ [1 − 3ℓ₅/λ + (9ℓ₅² − 3ℓ₆)/λ²] + O(λ⁻⁶), the interval of attraction.
///
/// The exponent given is that of λ. The leading term is 2(1+α*²)⁴/(81 μ³ α*¹¹). From δ′ = 0: v = δ^{1/3} solves
/// λv (1 + ℓ₅v + ℓ₆v² + …) = 1.
///
/// # Errors
/// [`Error::Index`] for n = 0; [`Error::OutsideRange`] with λ, if it is under [`SMALLEST_LAMBDA`].
pub fn trap_length_series(n: u64, mass_ratio: MassRatio) -> Result<ExpansionValue, Error> {
    let right = RightExpansion::new(n, mass_ratio)?;
    let lambda = right.lambda;
    if !(lambda >= SMALLEST_LAMBDA) {
        let (left, right) = (SMALLEST_LAMBDA, f64::INFINITY);
        return Err(Error::OutsideRange { value: lambda, left, right });
    }
    let [l5, l6, ..] = right.l;
    let leading = 1.0 / (lambda * lambda * lambda);
    let series = 1.0 - 3.0 * l5 / lambda + (9.0 * l5 * l5 - 3.0 * l6) / (lambda * lambda);
    let error = leading * (NEGLECTED * leading + 16.0 * f64::EPSILON);
    Ok(ExpansionValue { value: leading * series, error, neglected_exponent: -6.0 })
}
