//! The ratios actual error / bound of one bound on one class of inputs.

/// A bound on one class of inputs, compared with the actual errors.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Measured {
    /// The bounded quantity, as in "excess after a later flight".
    pub(crate) bound: &'static str,
    /// The statement of docs/theory.md that derives the bound.
    pub(crate) statement: &'static str,
    /// The class of inputs.
    pub(crate) class: &'static str,
    /// Number of comparisons.
    pub(crate) count: u64,
    /// Median of actual error / bound.
    pub(crate) median: f64,
    /// Largest actual error / bound.
    pub(crate) largest: f64,
    /// The input with the largest ratio, in a form that can be copied into a test.
    pub(crate) at: String,
}
