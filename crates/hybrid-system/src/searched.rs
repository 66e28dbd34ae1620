//! A system whose crossings are searched for, although it could solve them.

use crate::guard::Guard;
use crate::state::State;
use crate::system::{HybridSystem, Reset};

/// A system with its flows, guards and resets only.
///
/// Crossings that the system solves itself, quasi-polynomials and enclosures of its guards, and rest after infinitely many
/// events are hidden: an execution samples the guards. A test that compares it with the system itself checks the
/// hidden parts against a search that knows none of their theory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Searched<T>(pub T);

impl<T, const N: usize> HybridSystem<N> for Searched<T>
where
    T: HybridSystem<N>,
{
    type Mode = T::Mode;
    type Surface = T::Surface;

    fn flow(&self, mode: T::Mode, start: &State<N>, time: f64) -> State<N> {
        self.0.flow(mode, start, time)
    }

    fn guards(&self, mode: T::Mode) -> &[Guard<T::Surface>] {
        self.0.guards(mode)
    }

    fn guard_value(&self, surface: T::Surface, state: &State<N>) -> f64 {
        self.0.guard_value(surface, state)
    }

    fn reset(&self, mode: T::Mode, surface: T::Surface, before: &State<N>) -> Reset<T::Mode, N> {
        self.0.reset(mode, surface, before)
    }
}
