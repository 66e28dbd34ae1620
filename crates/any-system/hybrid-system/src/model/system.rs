//! A model written with closures is a hybrid system.

use super::model::Model;
use super::motion::Motion;
use super::part::ModelPart;
use crate::crossing::{NextEvent, QuasiPolynomial, Search, spread};
use crate::error::Error;
use crate::guard::Guard;
use crate::sliding::Sliding;
use crate::state::StateVector;
use crate::system::{HybridSystem, Reset};
use interval_arithmetic::Enclosure;
use std::fmt::Debug;

impl<M, S, X, F, P, C> HybridSystem for Model<M, S, X, F, P, C>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    X: StateVector,
    F: Motion<M, X>,
    P: ModelPart<M, S, X>,
{
    type State = X;
    type Mode = M;
    type Surface = S;

    #[inline]
    fn flow(&self, mode: M, start: &X, time: f64) -> X {
        self.motion.flow(self, mode, start, time)
    }

    #[inline]
    fn guards(&self, mode: M) -> &[Guard<S>] {
        self.guards.of(mode)
    }

    /// g(x); NaN for a surface that the model does not have.
    #[inline]
    fn guard_value(&self, surface: S, state: &X) -> f64 {
        self.parts.value(surface, state).unwrap_or(f64::NAN)
    }

    fn guard_error(&self, surface: S, state: &X) -> Option<f64> {
        self.parts.guard_error(surface, state)
    }

    /// Mode and state after the event. [`Reset::Stop`] for a surface that is no guard of the mode.
    #[inline]
    fn reset(&self, mode: M, surface: S, before: &X) -> Reset<M, X> {
        self.parts.reset(mode, surface, before).unwrap_or(Reset::Stop)
    }

    #[inline]
    fn condition(&self, mode: M, surface: S, before: &X) -> Option<f64> {
        self.parts.condition(mode, surface, before)
    }

    fn start_error(&self, surface: S, start: &X) -> f64 {
        self.parts.start_error(surface, start).unwrap_or(0.0)
    }

    fn observes(&self, surface: S) -> bool {
        self.parts.observes(surface).unwrap_or(false)
    }

    fn reset_error(&self, mode: M, surface: Option<S>, before: &X, time: f64) -> Option<Error> {
        self.parts.reset_error(mode, surface, before, time)
    }

    fn rest(&self, mode: M, limit: &X) -> Option<(M, X)> {
        self.parts.rest(mode, limit)
    }

    fn slide(&self, sliding: &Sliding<M, S, X>) -> Option<(M, X)> {
        self.parts.slide(sliding)
    }

    #[inline]
    fn vector_field(&self, mode: M, state: &X) -> Option<X> {
        self.motion.field(mode, state).or_else(|| self.parts.field(mode, state))
    }

    fn next_time(&self, mode: M, surface: S, after: f64) -> Option<f64> {
        self.parts.next_time(mode, surface, after).flatten()
    }

    #[inline]
    fn guard_quasi_polynomial(&self, mode: M, surface: S, start: &X) -> Option<QuasiPolynomial> {
        self.parts.quasi_polynomial(mode, surface, start)
    }

    #[inline]
    fn guard_enclosure(
        &self,
        mode: M,
        surface: S,
        start: &X,
        order: u32,
        times: (f64, f64),
    ) -> Option<Enclosure> {
        self.parts.enclosure(mode, surface, start, order, times)
    }

    fn flow_at(&self, mode: M, start: &X, times: &[f64]) -> Result<Vec<X>, Error> {
        self.motion.states(self, mode, start, times)
    }

    /// Finds surfaces that are used twice, clocks without times, and bounds on a guard that the model does not have.
    ///
    /// Guard functions are compared at the initial state and beside it: at a start on both surfaces all of them are
    /// zero.
    ///
    /// # Errors
    /// [`Error::SurfaceTwice`], [`Error::ClockWithoutTimes`], [`Error::NoSuchGuard`] and [`Error::TwoGuardFunctions`].
    fn validate(&self, mode: M, start: &X) -> Result<(), Error> {
        self.motion.validate(mode, start)?;
        self.guards.check()?;
        let known = |surface| self.guards.contains(surface);
        if let Some(surface) = self.parts.unknown_surface(&known) {
            let (part, surface) = ("a signal or an enclosure", format!("{surface:?}"));
            return Err(Error::NoSuchGuard { part, surface });
        }
        for &surface in self.guards.repeated() {
            for state in [start.clone(), beside(start)] {
                let first = self.guard_value(surface, &state);
                if let Some(second) = self.parts.other_value(surface, &state, first) {
                    let surface = format!("{surface:?}");
                    return Err(Error::TwoGuardFunctions { surface, first, second });
                }
            }
        }
        Ok(())
    }

    fn first_crossing(
        &self,
        mode: M,
        start: &X,
        search: &Search<S>,
    ) -> Result<NextEvent<S, X>, Error> {
        self.motion.first_crossing(self, mode, start, search)
    }
}

/// A component is moved by about this part of its size, each by another one. A larger number could leave the region
/// in which the guards are defined; a smaller one would lose digits of the difference.
const BESIDE: f64 = 1.0 / 64.0;

/// A state beside `state`.
fn beside<X: StateVector>(state: &X) -> X {
    state.filled(|axis| {
        let component = state.components()[axis];
        component + BESIDE * (1.0 + component.abs()) * spread(axis)
    })
}
