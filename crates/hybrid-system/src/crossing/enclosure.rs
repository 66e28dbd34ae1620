//! Intervals that hold a value for certain.

/// An interval that holds a number, or all values of a function, for certain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Enclosure {
    /// Lower bound.
    pub low: f64,
    /// Upper bound.
    pub high: f64,
}

impl Enclosure {
    /// [low, high].
    pub const fn new(low: f64, high: f64) -> Self {
        Enclosure { low, high }
    }

    /// A value with an error of at most `error`.
    pub const fn around(value: f64, error: f64) -> Self {
        Enclosure { low: value - error, high: value + error }
    }

    /// The common sign of all values, ±1; `None` if the interval holds zero.
    pub fn sign(&self) -> Option<f64> {
        if self.low > 0.0 {
            Some(1.0)
        } else if self.high < 0.0 {
            Some(-1.0)
        } else {
            None
        }
    }

    /// The largest absolute value.
    pub(crate) fn magnitude(&self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// The interval with both ends moved outwards.
    pub(crate) fn widened(&self, by: f64) -> Self {
        Enclosure { low: self.low - by, high: self.high + by }
    }

    /// The interval of the differences from `level`.
    pub(crate) fn above(&self, level: f64) -> Self {
        Enclosure { low: self.low - level, high: self.high - level }
    }
}
