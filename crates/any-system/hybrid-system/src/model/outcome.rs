//! What the closure of a reset may return.

use crate::system::Reset;

/// What the closure of a reset may return: the next mode and state, or a [`Reset`].
pub trait Outcome<M, X> {
    /// The reset.
    fn reset(self) -> Reset<M, X>;
}

impl<M, X, Y: Into<X>> Outcome<M, X> for (M, Y) {
    #[inline]
    fn reset(self) -> Reset<M, X> {
        Reset::Jump { mode: self.0, state: self.1.into() }
    }
}

impl<M, X> Outcome<M, X> for Reset<M, X> {
    #[inline]
    fn reset(self) -> Reset<M, X> {
        self
    }
}
