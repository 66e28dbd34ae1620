//! The length Δ_n of the trap for large λ.
//!
//! Proof: docs/theory.md, Lemma 40 and Theorem 70.

use crate::error::Error;
use crate::expansion_value::ExpansionValue;
use crate::right_expansion::RightExpansion;
use passive_hopper::MassRatio;

/// The smallest λ for which [`trap_length_series`] has a value.
///
/// The series is in 1/λ. For smaller λ its terms no longer fall, and the bound on the error is not proved.
pub const SMALLEST_LAMBDA: f64 = 3.0;

/// Bound on |c₃ + c₄/λ + …| in the factor 1 + c₁/λ + c₂/λ² + c₃/λ³ + … of Δ, for all n ≥ 1 and all M with λ ≥
/// [`SMALLEST_LAMBDA`] (docs/theory.md, Theorem 70). The proof gives 6.155; the rest of 6.2 covers the rounding of the
/// bound.
pub const TRAP_LENGTH_REMAINDER: f64 = 6.2;

/// Bound on the rounding error in ulps of λ⁻³ (docs/theory.md, Lemma 72): 43 units 2⁻⁵³ of λ⁻³ times the largest
/// factor, 1.2, and 32 for the factor, of which most is the error of λ.
const LENGTH_ULPS: f64 = 44.0;

/// Δ_n = λ⁻³ [1 − 3ℓ₅/λ + (9ℓ₅² − 3ℓ₆)/λ²] + O(λ⁻⁶), the length of the trap [α*_n, α*_n + Δ_n].
///
/// Δ solves δ′ = 0. With v = δ^{1/3} and the [`RightExpansion`] this is λv (1 + ℓ₅v + ℓ₆v² + …) = 1, solved in powers
/// of 1/λ. The neglected exponent is the exponent of λ. The leading term is 2(1+α*²)⁴/(81 μ³ α*¹¹).
///
/// # Errors
/// [`Error::Index`] for n = 0; [`Error::OutsideRange`] with λ if λ is under [`SMALLEST_LAMBDA`].
pub fn trap_length_series(n: u64, mass_ratio: MassRatio) -> Result<ExpansionValue, Error> {
    let right = RightExpansion::new(n, mass_ratio)?;
    let lambda = right.lambda;
    if !(lambda >= SMALLEST_LAMBDA) {
        let (left, right) = (SMALLEST_LAMBDA, f64::INFINITY);
        return Err(Error::OutsideRange { value: lambda, left, right });
    }
    let [l5, l6, ..] = right.coefficients;
    let leading = 1.0 / (lambda * lambda * lambda);
    let series = 1.0 - 3.0 * l5 / lambda + (9.0 * l5 * l5 - 3.0 * l6) / (lambda * lambda);
    let error = leading * (TRAP_LENGTH_REMAINDER * leading + LENGTH_ULPS * f64::EPSILON);
    Ok(ExpansionValue { value: leading * series, error, neglected_exponent: -6.0 })
}
