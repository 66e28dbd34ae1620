//! The trait that a model implements.

use crate::crossing::{Crossing, Enclosure, GuardedFlow, QuasiPolynomial, earliest_crossing};
use crate::error::Error;
use crate::guard::Guard;
use crate::state::State;
use std::fmt::Debug;

/// The result of an event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reset<M, const N: usize> {
    /// The execution continues in `mode` from `state`.
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
/// In mode m the state follows x(t) = φ_m(t; x₀). When a guard of the mode is crossed, a reset gives the next mode and
/// state. Four methods are required; parameters are fields of the implementing type. A model that can solve for its own
/// crossings overrides [`first_crossing`](Self::first_crossing), and states in the result how certain it is. In a mode
/// without closed form, `integrated_flow` and `integrated_crossing` (feature `ode`) provide both methods.
pub trait HybridSystem<const N: usize> {
    /// The discrete states.
    type Mode: Copy + Eq + Debug;
    /// The names of the switching surfaces.
    type Surface: Copy + Eq + Debug;

    /// φ(t; x₀), the state after `time` ≥ 0 in `mode`, regardless of guards. A component is NaN where the flow is not
    /// defined.
    fn flow(&self, mode: Self::Mode, start: &State<N>, time: f64) -> State<N>;

    /// The guards of `mode`: only these surfaces are searched.
    ///
    /// Of guards that are crossed at the same instant, within a few ulps, the one listed first is the event. Another
    /// guard is an event at the same instant, after the first one, if the state after the first reset passes through
    /// its surface.
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

    /// Mode and state after the Zeno limit of infinitely many events in `mode`. Example: after its bounces a ball is at
    /// rest. `limit` is the state at the limit.
    ///
    /// Default: `None`, and the execution ends at the limit.
    fn rest(&self, mode: Self::Mode, limit: &State<N>) -> Option<(Self::Mode, State<N>)> {
        let _ = (mode, limit);
        None
    }

    /// The guard along the flow from `start`, g(φ(t; x₀)), as a quasi-polynomial in t: a sum of polynomials times sines
    /// and cosines. Its crossings are then found with certainty.
    ///
    /// Default: `None`.
    fn guard_quasi_polynomial(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        start: &State<N>,
    ) -> Option<QuasiPolynomial> {
        let _ = (mode, surface, start);
        None
    }

    /// An interval that contains dᵏ/dtᵏ g(φ(t; x₀)), k = `order`, at all times in [`from`, `to`], including rounding
    /// errors. Order 0 is the guard itself.
    ///
    /// Bounds of orders 0 and 1 for every interval are enough to find crossings with certainty. Order 2 makes the
    /// search faster. A start at which the derivatives below order k are zero needs the orders up to k.
    ///
    /// Default: `None`.
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

    /// The first crossing of a guard of `mode` strictly after `start`, no later than `horizon`. The horizon may be
    /// infinite for a model that solves its crossings.
    ///
    /// Default: each guard is searched with the strongest information that the model gives. A guard with a
    /// [quasi-polynomial](Self::guard_quasi_polynomial) or with [enclosures](Self::guard_enclosure) is searched with
    /// certainty up to a finite horizon. Every other guard is sampled at `sampling_interval`, and a change of sign is
    /// refined to full precision. Sampling misses two crossings of one guard between two samples, and a touch without a
    /// change of sign; a zero at a sample counts once. If any guard was sampled, the result has
    /// [`Certainty::Sampled`](crate::Certainty::Sampled).
    ///
    /// # Errors
    /// [`Error::Grazing`] if a guard under bounds comes so close to zero that rounding hides whether it crosses,
    /// and the errors of [`QuasiPolynomial::first_crossing`]; [`Error::NoSamplingInterval`] if a guard must be
    /// sampled and there is no interval; [`Error::UndecidedStart`] if a sampled guard is zero at the start and
    /// beyond its surface at the first sample.
    fn first_crossing(
        &self,
        mode: Self::Mode,
        start: &State<N>,
        horizon: f64,
        sampling_interval: Option<f64>,
    ) -> Result<Option<Crossing<Self::Surface, N>>, Error> {
        earliest_crossing(&FlowFrom { system: self, mode, start }, horizon, sampling_interval)
    }
}

/// The flow of a system in one mode from one start, in the form that the searches for crossings need.
struct FlowFrom<'a, T: HybridSystem<N> + ?Sized, const N: usize> {
    system: &'a T,
    mode: T::Mode,
    start: &'a State<N>,
}

impl<T: HybridSystem<N> + ?Sized, const N: usize> GuardedFlow<N> for FlowFrom<'_, T, N> {
    type Surface = T::Surface;

    fn start(&self) -> &State<N> {
        self.start
    }

    fn state(&self, time: f64) -> State<N> {
        self.system.flow(self.mode, self.start, time)
    }

    fn guards(&self) -> &[Guard<T::Surface>] {
        self.system.guards(self.mode)
    }

    fn guard_value(&self, surface: T::Surface, state: &State<N>) -> f64 {
        self.system.guard_value(surface, state)
    }

    fn quasi_polynomial(&self, surface: T::Surface) -> Option<QuasiPolynomial> {
        self.system.guard_quasi_polynomial(self.mode, surface, self.start)
    }

    fn enclosure(&self, surface: T::Surface, order: u32, times: (f64, f64)) -> Option<Enclosure> {
        self.system.guard_enclosure(self.mode, surface, self.start, order, times)
    }
}

/// f of ẋ = f(x) in each mode.
///
/// If the field depends on time, time is a component of the state with ṫ = 1.
pub trait VectorField<const N: usize>: HybridSystem<N> {
    /// f(x) in `mode`.
    fn vector_field(&self, mode: Self::Mode, state: &State<N>) -> State<N>;
}
