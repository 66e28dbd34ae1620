//! How certain it is that no event was missed.

/// How certain it is that no event comes before a time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Certainty {
    /// The model solved for the crossing itself.
    Exact,
    /// The guards were searched under bounds: no earlier crossing can exist.
    Certain,
    /// The guards were searched along an integrated flow.
    ///
    /// A step is skipped if the guard stays far from zero at the stages and at eighths of the step. On every other step
    /// the guard is replaced by polynomials, and none of their zeros is missed. The flow itself is accurate to its
    /// tolerances.
    Interpolated,
    /// A guard was sampled: two crossings between neighbouring samples are missed.
    Sampled {
        /// Time between two samples.
        interval: f64,
    },
}
