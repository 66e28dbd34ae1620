//! A value of an expansion, with its error.

/// A value of a truncated expansion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpansionValue {
    /// The truncated sum.
    pub value: f64,
    /// Bound on the distance from the exact value: the neglected terms and the rounding of the sum. The
    /// coefficient of the neglected terms was measured against the exact map; it is not proved.
    pub error: f64,
    /// Exponent of the first neglected term, in the variable of the expansion.
    pub neglected_exponent: f64,
}
