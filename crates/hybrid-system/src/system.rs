//! The trait that a model implements.

use crate::crossing::earliest_crossing;
use crate::{Crossing, Enclosure, Error, Guard, QuasiPolynomial};
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

/// A hybrid dynamical system.
///
/// In mode m the state follows x(t) = φ_m(t; x₀); when a guard of the mode is crossed, a reset
/// gives the next mode and state. Four methods are asked for; parameters live in the implementing
/// type. A model that can solve its own crossings overrides [`first_crossing`](Self::first_crossing)
/// and says in the result how sure it is. In a mode without closed form both are one call each:
/// `integrated_flow` and `integrated_crossing` (feature `ode`).
pub trait HybridSystem<const N: usize> {
    /// The discrete states.
    type Mode: Copy + Eq + Debug;
    /// The names of the switching surfaces.
    type Surface: Copy + Eq + Debug;

    /// The state after `time` ≥ 0 in `mode`, φ(t; x₀), with no regard to guards; not a number where it has none.
    fn flow(&self, mode: Self::Mode, start: &State<N>, time: f64) -> State<N>;

    /// The guards watched in `mode`. Of events at the same instant, within an ulp, the guard listed first comes
    /// first; the others follow at once if the state it leads to goes on through their surfaces.
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
    fn guard_quasi_polynomial(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        start: &State<N>,
    ) -> Option<QuasiPolynomial> {
        let _ = (mode, surface, start);
        None
    }

    /// An interval that holds the derivative of this order of the guard along the flow from `start`,
    /// dᵏ/dtᵏ g(φ(t; x₀)), at all times in [`from`, `to`], roundings included; order 0 is the guard itself.
    ///
    /// With bounds of order 0 and 1 for any interval, crossings are found with certainty; order 2 makes
    /// that faster, and a start on the surface to order k needs orders up to k.
    ///
    /// Provided: none.
    fn guard_enclosure(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        start: &State<N>,
        order: u32,
        (from, to): (f64, f64),
    ) -> Option<Enclosure> {
        let _ = (mode, surface, start, order, from, to);
        None
    }

    /// The first crossing of a guard of `mode` strictly after `start`, no later than `horizon`
    /// (which may be infinite for a model that solves its crossings).
    ///
    /// Provided: each guard by the best means that the model gives. A [signal](Self::guard_quasi_polynomial) or
    /// [enclosures](Self::guard_enclosure) are searched with certainty up to a finite horizon. Any other
    /// guard is sampled at `sampling_interval` and a change of sign is refined to full precision: two
    /// crossings of one guard inside one interval are not seen, a zero on a sample counts once, and a
    /// touch without change of sign not at all. If any guard was sampled, the result says
    /// [`Certainty::Sampled`](crate::Certainty::Sampled).
    ///
    /// # Errors
    /// [`Error::Grazing`] if a signal or enclosure comes so close that rounding hides whether it crosses, and
    /// the errors of [`QuasiPolynomial::first_crossing`]; [`Error::NoSamplingInterval`] if it is needed and absent;
    /// [`Error::UndecidedStart`] if a sampled guard starts at zero and is beyond its surface at the first
    /// sample.
    fn first_crossing(
        &self,
        mode: Self::Mode,
        start: &State<N>,
        horizon: f64,
        sampling_interval: Option<f64>,
    ) -> Result<Option<Crossing<Self::Surface, N>>, Error> {
        earliest_crossing(self, mode, start, horizon, sampling_interval)
    }
}

/// f of ẋ = f(x), mode by mode.
///
/// A field that depends on time carries time as a component of the state, ṫ = 1.
pub trait VectorField<const N: usize>: HybridSystem<N> {
    /// f in `mode`.
    fn vector_field(&self, mode: Self::Mode, state: &State<N>) -> State<N>;
}
