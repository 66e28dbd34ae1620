//! A value of an expansion, with its error.

/// A value of a truncated expansion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpansionValue {
    /// The truncated sum.
    pub value: f64,
    /// Bound on the distance from the exact value: the neglected terms, and the rounding of the sum and of its
    /// coefficients (docs/theory.md, Theorems 67 to 71 and Lemma 72).
    pub error: f64,
    /// Exponent of the first neglected term, in the variable of the expansion.
    pub neglected_exponent: f64,
}

/// Bound on the errors of a product whose factors or result are subnormal: four times 2⁻¹⁰⁷⁴, the spacing of the
/// subnormal numbers.
///
/// An operation with a subnormal result has an error of up to half this spacing, which no bound relative to the result
/// covers. The bounds here are themselves such products. Each value and its bound have at most seven such operations,
/// and the factors after them are at most 1.2, together less than four spacings (docs/theory.md, Lemma 72). Where
/// nothing underflows, this term is far below an ulp of the bound.
pub(crate) const UNDERFLOW: f64 = f64::from_bits(4);
