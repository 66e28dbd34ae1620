//! Bounds on a number, which hold under stated conditions.

/// An interval that contains a number, under the conditions that its source states.
///
/// The ends are computed in `f64` and rounded to nearest, not outwards: they are right to some ulps.
///
/// For an interval that contains the number with 95 % probability see
/// [`ConfidenceInterval`](crate::ConfidenceInterval).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The number is not smaller than this.
    pub lower: f64,
    /// The number is not larger than this.
    pub upper: f64,
}

impl Bounds {
    /// Whether `number` lies within the bounds.
    pub fn covers(&self, number: f64) -> bool {
        self.lower <= number && number <= self.upper
    }

    /// The mean of both bounds: no other number has a smaller largest error.
    pub fn middle(&self) -> f64 {
        0.5 * (self.lower + self.upper)
    }

    /// Half the distance of the bounds: the largest error of [`middle`](Self::middle).
    pub fn half_width(&self) -> f64 {
        0.5 * (self.upper - self.lower)
    }
}
