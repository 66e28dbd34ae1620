//! A function of time with bounds: what the search for zeros asks of its sources.

use super::zero_test::ZeroTest;
use crate::error::Error;
use interval_arithmetic::Enclosure;

/// How a function leaves a zero at the left end of a stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Leave {
    /// It has this sign, ±1, after the zero and up to this time, and no further zero until then.
    To {
        /// The time.
        time: f64,
        /// The sign.
        side: f64,
    },
    /// It stays zero on the whole stretch, within rounding.
    Stays,
    /// Rounding hides to which side it leaves.
    Hidden,
}

/// A function of time g that can be evaluated, with bounds on its values over intervals of time.
///
/// Sources are quasi-polynomials, the enclosures of a model, and the polynomials through values along one step of an
/// integrated flow. [`ZeroSearch`](super::zero_search::ZeroSearch) finds the zeros of all of them.
pub(crate) trait Bounded {
    /// g(t), as computed.
    fn value(&self, time: f64) -> f64;

    /// An interval that holds g(t): the computed value with its rounding error.
    fn at(&self, time: f64) -> Result<Enclosure, Error>;

    /// What the bounds show about zeros of g − `level` on [left, right].
    fn test(&self, left: f64, right: f64, level: f64) -> Result<ZeroTest, Error>;

    /// How g leaves its zero at `from`, up to `until` at most. The value at `from` counts as zero, with this `error`.
    fn leave(&self, from: f64, until: f64, error: f64) -> Result<Leave, Error>;

    /// A bound on the distance between `time`, at which g was found to be zero, and the zero of g that lies in
    /// [left, right]. The function is monotone there.
    fn root_error(&self, time: f64, left: f64, right: f64) -> Result<f64, Error>;
}
