//! The trait that a model implements.

use crate::crossing::{GuardedFlow, NextEvent, QuasiPolynomial, Search, earliest_crossing};
use crate::error::Error;
use crate::guard::Guard;
use crate::sliding::Sliding;
use crate::state::StateVector;
use interval_arithmetic::Enclosure;
use std::fmt::Debug;

/// The result of an event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reset<M, X> {
    /// The execution continues in `mode` from `state`.
    Jump {
        /// The next mode.
        mode: M,
        /// The state after the jump, x⁺.
        state: X,
    },
    /// The execution continues in `mode` from a `state` that may have another number of components: a cell divides, a contact
    /// adds a coordinate, two bodies become one. What the guards were before the event says nothing about those after it: a
    /// guard that is zero at the new state has the side to which it leaves.
    Resize {
        /// The next mode.
        mode: M,
        /// The state after the event.
        state: X,
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
pub trait HybridSystem {
    /// The continuous state: [`State<N>`](crate::State), or `DVector<f64>` for a dimension that is chosen at run time.
    type State: StateVector;
    /// The discrete states.
    type Mode: Copy + Eq + Debug;
    /// The names of the switching surfaces.
    type Surface: Copy + Eq + Debug;

    /// φ(t; x₀), the state after `time` ≥ 0 in `mode`, regardless of guards. A component is NaN where the flow is not
    /// defined.
    fn flow(&self, mode: Self::Mode, start: &Self::State, time: f64) -> Self::State;

    /// φ(t; x₀) at each of these times, which are in one order from zero on. Pictures and comparisons with data
    /// need many states of one arc.
    ///
    /// Default: one call of [`flow`](Self::flow) for each time. An integrated mode returns `integrated_states(…)`
    /// (feature `ode`), which integrates once.
    ///
    /// # Errors
    /// None by default; the errors of the integration for an integrated mode.
    fn flow_at(
        &self,
        mode: Self::Mode,
        start: &Self::State,
        times: &[f64],
    ) -> Result<Vec<Self::State>, Error> {
        Ok(times.iter().map(|&time| self.flow(mode, start, time)).collect())
    }

    /// The guards of `mode`: only these surfaces are searched.
    ///
    /// Of guards that change their signs at the same double of the time, the one listed first is the event. Another
    /// one is an event at the same instant, after the first one, if the state after the first reset passes through
    /// its surface.
    fn guards(&self, mode: Self::Mode) -> &[Guard<Self::Surface>];

    /// The function g whose zero set is the surface.
    fn guard_value(&self, surface: Self::Surface, state: &Self::State) -> f64;

    /// Mode and state after the event, given the mode and state before it.
    fn reset(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        before: &Self::State,
    ) -> Reset<Self::Mode, Self::State>;

    /// The condition of an event of this surface, at the state before it. The event counts where the value is positive.
    /// Where it is negative the flow goes on as if there were no guard. Such a guard is a
    /// [`Role::Crossing`](crate::Role::Crossing): the mode flows on both sides.
    ///
    /// Default: `None`, and every event counts.
    fn condition(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        before: &Self::State,
    ) -> Option<f64> {
        let _ = (mode, surface, before);
        None
    }

    /// How far from zero a guard may be at a start that is on its surface, besides rounding: by the error of the start itself.
    ///
    /// Default: 0. The start is exact.
    fn start_error(&self, surface: Self::Surface, start: &Self::State) -> f64 {
        let _ = (surface, start);
        0.0
    }

    /// True for a surface whose events change nothing, as those of an observer. A run backward passes them.
    ///
    /// Default: false.
    fn observes(&self, surface: Self::Surface) -> bool {
        let _ = surface;
        false
    }

    /// Why the state after an event at this time is not finite, if the model knows more than that. Without a surface: the
    /// state after a Zeno limit.
    ///
    /// Default: `None`, and the execution names the state.
    fn reset_error(
        &self,
        mode: Self::Mode,
        surface: Option<Self::Surface>,
        before: &Self::State,
        time: f64,
    ) -> Option<Error> {
        let _ = (mode, surface, before, time);
        None
    }

    /// Mode and state after the Zeno limit of infinitely many events in `mode`. Example: after its bounces a ball is at
    /// rest. `limit` is the state at the limit.
    ///
    /// Default: `None`, and the execution ends at the limit.
    fn rest(&self, mode: Self::Mode, limit: &Self::State) -> Option<(Self::Mode, Self::State)> {
        let _ = (mode, limit);
        None
    }

    /// Mode and state on a surface at which the fields on both sides point: see [`Sliding`].
    ///
    /// Default: `None`, and the execution ends there.
    fn slide(
        &self,
        sliding: &Sliding<Self::Mode, Self::Surface, Self::State>,
    ) -> Option<(Self::Mode, Self::State)> {
        let _ = sliding;
        None
    }

    /// The surface along which the state slides in `mode`, as in those of [`Filippov`](crate::Filippov) (feature `ode`). Default: none.
    fn slides_on(&self, mode: Self::Mode) -> Option<Self::Surface> {
        let _ = mode;
        None
    }

    /// f(x) of ẋ = f(x) in `mode`. Integrated flows and derivatives through events need it, and so does the sliding
    /// field. If the field depends on time, time is a component of the state with ṫ = 1.
    ///
    /// Default: `None`.
    fn vector_field(&self, mode: Self::Mode, state: &Self::State) -> Option<Self::State> {
        let _ = (mode, state);
        None
    }

    /// Finds misuse of the model before its first arc, from the initial mode and state.
    ///
    /// Default: no check.
    ///
    /// # Errors
    /// The misuse, with its remedy.
    fn validate(&self, mode: Self::Mode, start: &Self::State) -> Result<(), Error> {
        let _ = (mode, start);
        Ok(())
    }

    /// A bound on the rounding error of [`guard_value`](Self::guard_value) by its own arithmetic, for an exact state.
    ///
    /// Default: `None`, and the error is measured.
    fn guard_error(&self, surface: Self::Surface, state: &Self::State) -> Option<f64> {
        let _ = (surface, state);
        None
    }

    /// The side to which a guard leaves its zero at the start of an arc, ±1, or 0 if it stays there: the model's own
    /// solution. It is asked only if the value of the guard is zero within its error.
    ///
    /// Default: `None`, and the side follows from the derivatives of the guard along the flow.
    fn leaving_side(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        start: &Self::State,
    ) -> Option<f64> {
        let _ = (mode, surface, start);
        None
    }

    /// For a guard with the role [`Role::Clock`](crate::Role::Clock): its first preset time strictly after the time
    /// `after`. Both are continuous times t, not times since the start of an arc.
    ///
    /// Default: `None`, no further time.
    fn next_time(&self, mode: Self::Mode, surface: Self::Surface, after: f64) -> Option<f64> {
        let _ = (mode, surface, after);
        None
    }

    /// The guard along the flow from `start`, g(φ(t; x₀)), as a quasi-polynomial in t: a sum of polynomials times
    /// exponentials, sines and cosines. Its crossings are then found with certainty.
    ///
    /// Default: `None`.
    fn guard_quasi_polynomial(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        start: &Self::State,
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
        start: &Self::State,
        order: u32,
        (from, to): (f64, f64),
    ) -> Option<Enclosure> {
        let _ = (mode, surface, start, order, from, to);
        None
    }

    /// The first event of an arc strictly after its `start`. The horizon of the `search` may be infinite for a
    /// model that solves its crossings.
    ///
    /// The start itself has been decided before: [`Search::leaving`] has the guards on whose surfaces it lies.
    /// Events at preset times are not searched here.
    ///
    /// At the end of an arc whose certainty is `Exact` the execution checks the other guards. A state beyond one of
    /// their surfaces is [`Error::MissedEvent`].
    ///
    /// Default: [`default_search`].
    ///
    /// # Errors
    /// Those of [`default_search`].
    fn first_crossing(
        &self,
        mode: Self::Mode,
        start: &Self::State,
        search: &Search<Self::Surface>,
    ) -> Result<NextEvent<Self::Surface, Self::State>, Error> {
        default_search(self, mode, start, search)
    }
}

/// A [`HybridSystem`] with states X, modes M and surfaces S: short to write where a function takes or returns a model.
///
/// ```
/// use hybrid_system::{Model, State, System};
/// fn falling_ball() -> impl System<State<2>, (), usize> {
///     Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
///         .falling((), |x| x[0], |x| ((), [0.0, -0.5 * x[1]]))
///         .sampled(0.01)
/// }
/// ```
pub trait System<X, M, S>: HybridSystem<State = X, Mode = M, Surface = S> {}

impl<T: HybridSystem> System<T::State, T::Mode, T::Surface> for T {}

/// The first crossing of a guard of `mode` along the flow of a system: what [`HybridSystem::first_crossing`] does
/// unless a model overrides it. An override can call this function for some modes.
///
/// Each guard is searched with the strongest information that the model gives. A guard with a
/// [quasi-polynomial](HybridSystem::guard_quasi_polynomial) or with [enclosures](HybridSystem::guard_enclosure) is
/// searched with certainty up to a finite horizon. Every other guard is sampled at the sampling interval, and a
/// change of sign is refined to full precision. Sampling misses two crossings of one guard between two samples, and
/// a touch without a change of sign; a zero at a sample counts once. If any guard was sampled, the result has
/// [`Certainty::Sampled`](crate::Certainty::Sampled).
///
/// If a budget of the search ends before its horizon, of intervals or of samples, the result is
/// [`NextEvent::Unfinished`] with the time up to which there is no event. This is no error: a search from there
/// goes on.
///
/// # Errors
/// * [`Error::Grazing`] for a touch of a guard whose [`Touch`](crate::Touch) is an error: the guard comes so close
///   to zero that rounding hides whether it crosses, and its sign is the same before and behind.
/// * [`Error::UndecidedStart`], [`Error::UndecidedSign`] if rounding or the samples hide to which side a guard
///   leaves its zero at the start.
/// * [`Error::NoSamplingInterval`] if a guard must be sampled and there is no interval;
///   [`Error::BadSamplingInterval`] for an interval that is not positive or vanishes beside the horizon, and for an
///   infinite horizon of a sampled guard.
/// * [`Error::BadLimit`] for a horizon that is negative or NaN, and for an infinite one of a guard under bounds.
/// * [`Error::NotFinite`] where a guard or a coefficient of its quasi-polynomial is infinite or NaN;
///   [`Error::BadEnclosure`] for an enclosure without an inside.
pub fn default_search<T: HybridSystem + ?Sized>(
    system: &T,
    mode: T::Mode,
    start: &T::State,
    search: &Search<T::Surface>,
) -> Result<NextEvent<T::Surface, T::State>, Error> {
    earliest_crossing(&FlowFrom { system, mode, start }, search)
}

/// The flow of a system in one mode from one start, in the form that the searches for crossings need.
pub(crate) struct FlowFrom<'a, T: HybridSystem + ?Sized> {
    pub(crate) system: &'a T,
    pub(crate) mode: T::Mode,
    pub(crate) start: &'a T::State,
}

impl<T: HybridSystem + ?Sized> GuardedFlow for FlowFrom<'_, T> {
    type State = T::State;
    type Surface = T::Surface;

    fn start(&self) -> &T::State {
        self.start
    }

    fn state(&self, time: f64) -> T::State {
        self.system.flow(self.mode, self.start, time)
    }

    fn guards(&self) -> &[Guard<T::Surface>] {
        self.system.guards(self.mode)
    }

    fn guard_value(&self, surface: T::Surface, state: &T::State) -> f64 {
        self.system.guard_value(surface, state)
    }

    fn guard_error(&self, surface: T::Surface, state: &T::State) -> Option<f64> {
        self.system.guard_error(surface, state)
    }

    fn vector_field(&self, state: &T::State) -> Option<T::State> {
        self.system.vector_field(self.mode, state)
    }

    fn leaving_side(&self, surface: T::Surface) -> Option<f64> {
        self.system.leaving_side(self.mode, surface, self.start)
    }

    fn quasi_polynomial(&self, surface: T::Surface) -> Option<QuasiPolynomial> {
        self.system.guard_quasi_polynomial(self.mode, surface, self.start)
    }

    fn enclosure(&self, surface: T::Surface, order: u32, times: (f64, f64)) -> Option<Enclosure> {
        self.system.guard_enclosure(self.mode, surface, self.start, order, times)
    }
}
