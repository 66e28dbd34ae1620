//! The first crossing of zero by one function of time.

/// The result of a search under bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FirstCrossing {
    /// The function changes sign at this time, in the given direction, and not before.
    ///
    /// The function may be hidden by rounding around this time: at a zero of third order, or where the rounding of
    /// a large phase hides the steepest part of a sine. Then its signs before and behind the hidden interval are
    /// opposite.
    At {
        /// Time of the crossing.
        time: f64,
        /// True if the function goes from negative to positive.
        rising: bool,
    },
    /// The function comes within rounding of zero and goes back. Rounding hides whether it touches zero, crosses
    /// twice, or stays away. It does not cross before.
    Touch {
        /// Time at which the function is closest to zero.
        time: f64,
        /// Value of the function at that time, the smallest computed one.
        value: f64,
    },
    /// The function comes within rounding of zero and stays there up to the horizon. It does not cross before.
    Undecided {
        /// Time at which the function is closest to zero.
        time: f64,
        /// Value of the function at that time, the smallest computed one.
        value: f64,
    },
    /// The function does not cross zero up to the horizon.
    Never,
}
