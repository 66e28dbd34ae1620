//! How accurately a flow is integrated.

use crate::error::Error;

/// How accurately a flow is integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Error of a step relative to the state, for each component.
    pub relative: f64,
    /// Error of a step where a component is near zero, in the units of the state.
    pub absolute: f64,
    /// Most steps of one integration, rejected ones included.
    pub steps: usize,
}

/// Most steps by default. It limits the time that an integration takes, not its accuracy; a field that needs more steps
/// is probably stiff. The integration then ends with [`Error::Integration`].
const MOST_STEPS: usize = 100_000;

impl Tolerances {
    /// The same relative and absolute tolerance, and 100 000 steps.
    pub const fn both(tolerance: f64) -> Self {
        Tolerances { relative: tolerance, absolute: tolerance, steps: MOST_STEPS }
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        match [self.relative, self.absolute].into_iter().find(|t| !(*t > 0.0 && t.is_finite())) {
            Some(value) => Err(Error::BadTolerance { value }),
            None => Ok(()),
        }
    }
}
