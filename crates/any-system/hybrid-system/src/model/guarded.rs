//! Parts with a guard: its function, and the reset after its events.

use super::outcome::Outcome;
use super::part::ModelPart;
use crate::system::Reset;

/// A guard of one mode, with the reset after its events.
#[derive(Debug, Clone, Copy)]
pub struct Jump<M, S, G, R> {
    pub(super) mode: M,
    pub(super) surface: S,
    pub(super) guard: G,
    pub(super) reset: R,
}

impl<M, S, X, G, R, J> ModelPart<M, S, X> for Jump<M, S, G, R>
where
    M: Copy + Eq,
    S: Copy + Eq,
    G: Fn(&X) -> f64,
    R: Fn(&X) -> J,
    J: Outcome<M, X>,
{
    #[inline]
    fn value(&self, surface: S, state: &X) -> Option<f64> {
        (surface == self.surface).then(|| (self.guard)(state))
    }
    #[inline]
    fn reset(&self, mode: M, surface: S, before: &X) -> Option<Reset<M, X>> {
        (surface == self.surface && mode == self.mode).then(|| (self.reset)(before).reset())
    }
}

/// A guard of all modes, with the reset after its events.
#[derive(Debug, Clone, Copy)]
pub struct JumpEverywhere<S, G, R> {
    pub(super) surface: S,
    pub(super) guard: G,
    pub(super) reset: R,
}

impl<M, S, X, G, R, J> ModelPart<M, S, X> for JumpEverywhere<S, G, R>
where
    S: Copy + Eq,
    G: Fn(&X) -> f64,
    R: Fn(M, &X) -> J,
    J: Outcome<M, X>,
{
    #[inline]
    fn value(&self, surface: S, state: &X) -> Option<f64> {
        (surface == self.surface).then(|| (self.guard)(state))
    }
    #[inline]
    fn reset(&self, mode: M, surface: S, before: &X) -> Option<Reset<M, X>> {
        (surface == self.surface).then(|| (self.reset)(mode, before).reset())
    }
}

/// A guard of one mode whose events end the execution.
#[derive(Debug, Clone, Copy)]
pub struct Terminal<M, S, G> {
    pub(super) mode: M,
    pub(super) surface: S,
    pub(super) guard: G,
}

impl<M, S, X, G> ModelPart<M, S, X> for Terminal<M, S, G>
where
    M: Copy + Eq,
    S: Copy + Eq,
    G: Fn(&X) -> f64,
{
    #[inline]
    fn value(&self, surface: S, state: &X) -> Option<f64> {
        (surface == self.surface).then(|| (self.guard)(state))
    }
    #[inline]
    fn reset(&self, mode: M, surface: S, _: &X) -> Option<Reset<M, X>> {
        (surface == self.surface && mode == self.mode).then_some(Reset::Stop)
    }
}

/// A guard of all modes whose events change nothing.
#[derive(Debug, Clone, Copy)]
pub struct Watch<S, G> {
    pub(super) surface: S,
    pub(super) guard: G,
}

impl<M, S, X, G> ModelPart<M, S, X> for Watch<S, G>
where
    S: Copy + Eq,
    X: Clone,
    G: Fn(&X) -> f64,
{
    fn observes(&self, surface: S) -> Option<bool> {
        (surface == self.surface).then_some(true)
    }
    #[inline]
    fn value(&self, surface: S, state: &X) -> Option<f64> {
        (surface == self.surface).then(|| (self.guard)(state))
    }
    #[inline]
    fn reset(&self, mode: M, surface: S, before: &X) -> Option<Reset<M, X>> {
        (surface == self.surface).then(|| Reset::Jump { mode, state: before.clone() })
    }
}

/// Events at preset times, in one mode, or in all modes if `mode` is `None`.
#[derive(Debug, Clone, Copy)]
pub struct Clock<M, S, T, R> {
    pub(super) mode: Option<M>,
    pub(super) surface: S,
    pub(super) next: T,
    pub(super) reset: R,
}

impl<M: Copy + Eq, S: Copy + Eq, T, R> Clock<M, S, T, R> {
    fn ticks(&self, mode: M, surface: S) -> bool {
        surface == self.surface && self.mode.is_none_or(|own| own == mode)
    }
}

impl<M, S, X, T, R, J> ModelPart<M, S, X> for Clock<M, S, T, R>
where
    M: Copy + Eq,
    S: Copy + Eq,
    T: Fn(f64) -> Option<f64>,
    R: Fn(M, &X) -> J,
    J: Outcome<M, X>,
{
    fn next_time(&self, mode: M, surface: S, after: f64) -> Option<Option<f64>> {
        self.ticks(mode, surface).then(|| (self.next)(after))
    }
    fn reset(&self, mode: M, surface: S, before: &X) -> Option<Reset<M, X>> {
        self.ticks(mode, surface).then(|| (self.reset)(mode, before).reset())
    }
}
