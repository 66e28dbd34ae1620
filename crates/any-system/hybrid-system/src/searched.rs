//! A system whose crossings are found by sampling, although it could solve for them.

use crate::error::Error;
use crate::guard::Guard;
use crate::system::{HybridSystem, Reset};

/// A system with its flows, guards, clocks and resets only.
///
/// This type hides the system's own solutions for crossings, the quasi-polynomials and enclosures of its guards, and
/// its rest after infinitely many events: an execution samples the guards. A test that compares it with the system
/// itself checks the hidden parts against a search that uses none of their theory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Searched<T>(pub T);

impl<T: HybridSystem> HybridSystem for Searched<T> {
    type State = T::State;
    type Mode = T::Mode;
    type Surface = T::Surface;

    fn flow(&self, mode: T::Mode, start: &T::State, time: f64) -> T::State {
        self.0.flow(mode, start, time)
    }

    fn guards(&self, mode: T::Mode) -> &[Guard<T::Surface>] {
        self.0.guards(mode)
    }

    fn guard_value(&self, surface: T::Surface, state: &T::State) -> f64 {
        self.0.guard_value(surface, state)
    }

    fn reset(
        &self,
        mode: T::Mode,
        surface: T::Surface,
        before: &T::State,
    ) -> Reset<T::Mode, T::State> {
        self.0.reset(mode, surface, before)
    }

    fn condition(&self, mode: T::Mode, surface: T::Surface, before: &T::State) -> Option<f64> {
        self.0.condition(mode, surface, before)
    }

    fn observes(&self, surface: T::Surface) -> bool {
        self.0.observes(surface)
    }

    fn reset_error(
        &self,
        mode: T::Mode,
        surface: Option<T::Surface>,
        before: &T::State,
        time: f64,
    ) -> Option<Error> {
        self.0.reset_error(mode, surface, before, time)
    }

    fn next_time(&self, mode: T::Mode, surface: T::Surface, after: f64) -> Option<f64> {
        self.0.next_time(mode, surface, after)
    }

    fn validate(&self, mode: T::Mode, start: &T::State) -> Result<(), Error> {
        self.0.validate(mode, start)
    }
}
