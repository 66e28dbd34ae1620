//! The first crossing of zero by one function of time.

/// The result of a search under bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FirstCrossing {
    /// The function crosses zero at this time, in the given direction, and not before.
    At {
        /// Time of the crossing.
        time: f64,
        /// True if the function goes from negative to positive.
        rising: bool,
    },
    /// The function comes so close to zero, and so slowly, that rounding hides whether it touches zero, crosses once
    /// or twice, or stays away. It does not cross before.
    Grazing {
        /// Time at which the function is closest to zero.
        time: f64,
        /// Value of the function at that time, the smallest computed one.
        value: f64,
    },
    /// The function does not cross zero up to the horizon.
    Never,
}
