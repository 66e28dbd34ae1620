//! The result of a test for zeros on one interval of time.

/// What bounds show about the zeros of a function on one interval.
///
/// The tests themselves are statements (2) and (3) of [mathematics](crate::mathematics).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ZeroTest {
    /// The function has no zero on the interval.
    NoZero {
        /// Its sign there, ±1.
        sign: f64,
    },
    /// The function is monotone on the interval: it has a zero if and only if its sign changes.
    Monotone {
        /// A number with the sign of the derivative.
        slope: f64,
    },
    /// The function is within a few rounding errors of zero on the whole interval: shorter intervals would show no
    /// more.
    Hidden,
    /// The bounds are too wide for any result: the interval must be halved.
    Undecided,
}
