//! The vertical axis of a raster of shares.

/// The meaning of the vertical axis of a [`ShareRaster`](crate::ShareRaster).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Upwards {
    /// −log₁₀ |δ|: the point y is α*_n − 10^{−y}. α*_n is above.
    Depth,
    /// Ψ, in turns of the circle. α*_n is above.
    Phase,
    /// −log₁₀ of the distance from an edge p, on both sides: the lower half of the rows are the speeds p − 10^{−y},
    /// y upwards; the upper half are the speeds p + 10^{−y}, y downwards. So speeds increase upwards, and p is in
    /// the middle.
    BothSides,
    /// The lift-off speed α, as in a [`coverage_raster`](crate::coverage_raster).
    LiftOffSpeed,
    /// The speed, in half heights from the edge in the middle.
    Speed,
}
