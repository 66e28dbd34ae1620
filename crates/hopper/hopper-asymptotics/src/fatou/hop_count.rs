//! A number of hops, counted continuously, in `f64`.

/// A value of Ψ as one `f64`, for points that are not too near.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HopCount {
    /// The number of hops, not an integer as a rule.
    pub hops: f64,
    /// Bound on its error.
    pub error: f64,
}
