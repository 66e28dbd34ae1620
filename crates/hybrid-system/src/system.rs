//! The trait that a model implements.

use crate::crossing::{certain_crossing, sampled_crossing};
use crate::{Crossing, Error, Guard, Signal};
use nalgebra::SVector;
use std::fmt::Debug;

/// A point of the continuous state space.
pub type State<const N: usize> = SVector<f64, N>;

/// What happens at an event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reset<M, const N: usize> {
    /// The execution goes on in `mode` from `state`.
    Jump {
        /// The next mode.
        mode: M,
        /// The state after the jump, x⁺.
        state: State<N>,
    },
    /// The execution ends here.
    Stop,
}

/// A hybrid dynamical system with closed-form flows.
///
/// In mode m the state follows x(t) = φ_m(t; x₀); when a guard of the mode is crossed, a reset
/// gives the next mode and state. Four methods are asked for; parameters live in the implementing
/// type. A model that can solve its own crossings overrides [`first_crossing`](Self::first_crossing)
/// and says in the result how sure it is.
pub trait HybridSystem<const N: usize> {
    /// The discrete states.
    type Mode: Copy + Eq + Debug;
    /// The names of the switching surfaces.
    type Surface: Copy + Eq + Debug;

    /// The state after `time` ≥ 0 in `mode`, φ(t; x₀), with no regard to guards.
    fn flow(&self, mode: Self::Mode, start: &State<N>, time: f64) -> State<N>;

    /// The guards watched in `mode`. Of events at the same instant, the guard listed first wins.
    fn guards(&self, mode: Self::Mode) -> &[Guard<Self::Surface>];

    /// The function g whose zero set is the surface.
    fn guard_value(&self, surface: Self::Surface, state: &State<N>) -> f64;

    /// Mode and state after the event, given the mode and state before it.
    fn reset(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        before: &State<N>,
    ) -> Reset<Self::Mode, N>;

    /// Mode and state that infinitely many events in `mode`, accumulating at `limit`, lead to: a ball that has
    /// bounced for ever rests.
    ///
    /// Provided: none; the execution ends at the limit.
    fn rest(&self, mode: Self::Mode, limit: &State<N>) -> Option<(Self::Mode, State<N>)> {
        let _ = (mode, limit);
        None
    }

    /// The guard along the flow from `start`, g(φ(t; x₀)) as a function of t, where it is a sum of
    /// polynomials times sines and cosines: then its crossings are found with certainty.
    ///
    /// Provided: none.
    fn guard_signal(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        start: &State<N>,
    ) -> Option<Signal> {
        let _ = (mode, surface, start);
        None
    }

    /// The first crossing of a guard of `mode` strictly after `start`, no later than `horizon`
    /// (which may be infinite for a model that solves its crossings).
    ///
    /// Provided: if the model gives all guards of the mode as [signals](Self::guard_signal), the first
    /// crossing is found with certainty up to a finite horizon. Otherwise every guard is sampled at
    /// `sampling_interval` and a change of sign is refined to full precision. Two crossings of one guard inside one interval are not seen; the result says
    /// [`Certainty::Sampled`](crate::Certainty::Sampled). A zero on a sample counts once, and a
    /// touch without change of sign not at all.
    ///
    /// # Errors
    /// [`Error::Grazing`] if a signal comes so close that rounding hides whether it crosses, and the
    /// errors of [`Signal::first_crossing`]; [`Error::NoSamplingInterval`] if it is needed and absent; [`Error::UndecidedStart`] if a
    /// guard starts at zero and is beyond its surface at the first sample.
    fn first_crossing(
        &self,
        mode: Self::Mode,
        start: &State<N>,
        horizon: f64,
        sampling_interval: Option<f64>,
    ) -> Result<Option<Crossing<Self::Surface, N>>, Error> {
        if let Some(crossing) = certain_crossing(self, mode, start, horizon) {
            return crossing;
        }
        sampled_crossing(self, mode, start, horizon, sampling_interval)
    }
}
