//! Does an execution reach a surface at which the fields on both sides point?

use super::sliding_point::Sliding;
use crate::error::Error;
use crate::system::HybridSystem;

/// An event at once, after another event at the same instant.
pub(crate) struct AtOnce<'a, M, S, X> {
    /// Mode, and surface of the event at once.
    pub(crate) mode: M,
    pub(crate) surface: S,
    /// The state, after the reset of the event before.
    pub(crate) state: &'a X,
    pub(crate) time: f64,
    /// Mode and surface of the event before.
    pub(crate) last: Option<(M, S)>,
    /// The state before the reset of the last crossing.
    pub(crate) before: Option<&'a X>,
}

/// The sliding point, if the last event and this event at once lead to each other and the fields on both sides point at
/// the surface.
pub(crate) fn sliding_point<T: HybridSystem>(
    _system: &T,
    _at: &AtOnce<T::Mode, T::Surface, T::State>,
) -> Result<Option<Sliding<T::Mode, T::Surface, T::State>>, Error> {
    Ok(None)
}
