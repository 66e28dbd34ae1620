//! The model, and the methods that give it its parts.

use super::bounds::{GuardEnclosure, Signal};
use super::continued::Slide;
use super::guard_lists::GuardLists;
#[cfg(feature = "ode")]
use super::integrated::Integrated;
use super::motion::{ClosedForm, Motion};
use super::part::ModelPart;
use crate::crossing::QuasiPolynomial;
use crate::execution::Execution;
#[cfg(feature = "ode")]
use crate::guard::Guard;
use crate::limits::{Limits, MOST_EVENTS};
#[cfg(feature = "ode")]
use crate::ode::Tolerances;
use crate::sliding::Sliding;
use crate::state::StateVector;
use interval_arithmetic::Enclosure;
use std::fmt::Debug;
use std::marker::PhantomData;

/// A hybrid system that is written with closures.
///
/// A thermostat. A room warms towards 30° and cools towards 10°. The heater is switched off above 21°, and on below
/// 19°:
///
#[cfg_attr(feature = "ode", doc = "```")]
#[cfg_attr(not(feature = "ode"), doc = "```ignore")]
/// use hybrid_system::*;
///
/// #[derive(Debug, Clone, Copy, PartialEq, Eq)]
/// enum Heater {
///     On,
///     Off,
/// }
///
/// fn main() -> Result<(), Error> {
///     let room = Model::integrated(|heater, x: &State<1>| match heater {
///         Heater::On => [30.0 - x[0]],
///         Heater::Off => [10.0 - x[0]],
///     })
///     .rising(Heater::On, |x| x[0] - 21.0, |x| (Heater::Off, *x))
///     .falling(Heater::Off, |x| x[0] - 19.0, |x| (Heater::On, *x));
///     for arc in room.run(Heater::On, [15.0], 2.0) {
///         println!("{:?}", arc?.event());
///     }
///     Ok(())
/// }
/// ```
///
/// The first closure states the type of the state: [`State<N>`](crate::State), or `DVector<f64>`. A closure may return
/// everything that can be converted into the state, for example an array. Parameters are captured by the closures.
///
/// A surface has a name, a value of any type `S: Copy + Eq + Debug`. [`rising`](Self::rising),
/// [`falling`](Self::falling) and [`either`](Self::either) number the surfaces: 0, 1, 2, … in the order in which they are
/// added. [`guard`](Self::guard) takes a [`Guard`] with a name, for example of an enum, and with its role and its touch.
/// A name is compared at every evaluation of a guard. With numbers or an enum a thermostat takes 1 % more instructions than
/// by the trait, and the section of a pendulum as well; with texts the thermostat takes 20 % more. The bench `front_end`
/// has the models.
///
/// | method | part of the model |
/// |---|---|
/// | [`closed_form`](Self::closed_form), `integrated` | the motion |
/// | [`closed_form_in_time`](Self::closed_form_in_time), `integrated_in_time` | a motion that depends on the time: guards, conditions, resets and rests take `\|t, x\|` |
/// | [`rising`](Self::rising), [`falling`](Self::falling), [`either`](Self::either) | a guard of one mode, with a number |
/// | [`contact`](Self::contact), [`crossing`](Self::crossing) | what a state beyond the surface of the last guard means |
/// | [`guard`](Self::guard), [`guard_everywhere`](Self::guard_everywhere) | a guard with a name, of one mode or of all |
/// | [`terminal`](Self::terminal), [`observer`](Self::observer) | a guard that ends the execution, or only watches |
/// | [`only_where`](Self::only_where) | a condition: an event counts only in some states |
/// | [`clock`](Self::clock), [`clock_everywhere`](Self::clock_everywhere) | events at preset times |
/// | [`signal`](Self::signal), [`enclosure`](Self::enclosure) | bounds on a guard: its crossings are certain |
/// | [`field`](Self::field) | the field of a flow in closed form, for sliding points and derivatives |
/// | [`rest`](Self::rest), [`slide`](Self::slide) | what follows a Zeno limit or a sliding point |
/// | [`sampled`](Self::sampled), `tolerance`, `tolerances` | how the guards are sampled and the field is integrated |
///
/// A model is a [`HybridSystem`](crate::HybridSystem): everything that works for a model by the trait works for it. With a
/// [`State<N>`](crate::State) it is [`Differentiable`](crate::Differentiable) too; derivatives of its closures are
/// difference quotients with about ten digits. Its type contains the types of its closures. A function returns it as
/// `impl System<…, …, …>`.
///
/// # Errors
/// An execution of a model in which one mode has two guards with the same surface begins with
/// [`Error::SurfaceTwice`](crate::Error::SurfaceTwice). Guards of different modes may have the same surface if their
/// functions are the same. They are compared at the initial state and beside it, and a difference is
/// [`Error::TwoGuardFunctions`](crate::Error::TwoGuardFunctions). A signal or an enclosure of a surface that no guard has is
/// [`Error::NoSuchGuard`](crate::Error::NoSuchGuard), and a [`Guard::clock`] with a function is
/// [`Error::ClockWithoutTimes`](crate::Error::ClockWithoutTimes). A mode without guards is allowed: its arcs end at the limit on time.
#[derive(Debug, Clone)]
#[must_use]
pub struct Model<M, S, X, F, P = (), C = Autonomous> {
    pub(crate) motion: F,
    pub(crate) parts: P,
    pub(super) guards: GuardLists<M, S>,
    sampling_interval: Option<f64>,
    types: PhantomData<fn() -> (X, C)>,
}

/// How the closures of a [`Model`] are called: without the time, which they do not depend on.
#[derive(Debug, Clone, Copy)]
pub enum Autonomous {}

impl<M: Copy + Eq, S: Copy + Eq + Debug, X, F, C> Model<M, S, X, F, (), C> {
    pub(super) fn new(motion: F) -> Self {
        let guards = GuardLists::new();
        Model { motion, parts: (), guards, sampling_interval: None, types: PhantomData }
    }
}

#[cfg(feature = "ode")]
impl<M: Copy + Eq, S: Copy + Eq + Debug, X, F, P> Model<M, S, X, F, P> {
    /// A model with this motion, whose one part has these guards: of a mode, or of all modes.
    pub(crate) fn of_equations(motion: F, parts: P, watched: Vec<(Option<M>, Guard<S>)>) -> Self {
        let mut guards = GuardLists::new();
        watched.into_iter().for_each(|(mode, guard)| guards.add(mode, guard));
        Model { motion, parts, guards, sampling_interval: None, types: PhantomData }
    }

    /// True if guards and samples are those of the other model.
    #[cfg(feature = "serde")]
    pub(crate) fn has_declarations_of(&self, other: &Self) -> bool {
        self.guards == other.guards && self.sampling_interval == other.sampling_interval
    }
}

impl<M: Copy + Eq, S: Copy + Eq + Debug, X, Y, F> Model<M, S, X, ClosedForm<F>>
where
    F: Fn(M, &X, f64) -> Y,
    Y: Into<X>,
{
    /// A model whose flow has a closed form: φ(t; x₀) from the mode, the start x₀ and the time t ≥ 0.
    ///
    /// Its guards need bounds ([`signal`](Self::signal), [`enclosure`](Self::enclosure)) or samples
    /// ([`sampled`](Self::sampled)).
    pub fn closed_form(flow: F) -> Self {
        Model::new(ClosedForm(flow))
    }
}

#[cfg(feature = "ode")]
impl<M: Copy + Eq, S: Copy + Eq + Debug, X, Y, F> Model<M, S, X, Integrated<F>>
where
    F: Fn(M, &X) -> Y,
    Y: Into<X>,
{
    /// A model whose flow is the solution of ẋ = f(x): f(x) from the mode and the state x. (feature `ode`)
    ///
    /// If f depends on the time: [`integrated_in_time`](Self::integrated_in_time).
    pub fn integrated(field: F) -> Self {
        Model::new(Integrated::new(field))
    }
}

#[cfg(feature = "ode")]
impl<M, S, X, F, P, C> Model<M, S, X, Integrated<F>, P, C> {
    /// The same model, integrated with this relative and absolute tolerance. Default: 1e-10. (feature `ode`)
    pub fn tolerance(self, tolerance: f64) -> Self {
        self.tolerances(Tolerances::both(tolerance))
    }

    /// The same model, integrated with these tolerances. (feature `ode`)
    pub fn tolerances(mut self, tolerances: Tolerances) -> Self {
        self.motion.tolerances = tolerances;
        self
    }
}

// Each part of a model has a type of its own.
#[allow(clippy::type_complexity)]
impl<M, S, X, F, P, C> Model<M, S, X, F, P, C>
where
    M: Copy + Eq,
    S: Copy + Eq + Debug,
{
    pub(super) fn with<A>(self, part: A) -> Model<M, S, X, F, (A, P), C> {
        Model {
            motion: self.motion,
            parts: (part, self.parts),
            guards: self.guards,
            sampling_interval: self.sampling_interval,
            types: PhantomData,
        }
    }

    /// Gives the guard of this surface along the flow from a start, g(φ(t; x₀)), as a quasi-polynomial in t, or `None`
    /// where it is none. Its crossings are then found with certainty.
    pub fn signal<Q>(self, surface: S, signal: Q) -> Model<M, S, X, F, (Signal<S, Q>, P), C>
    where
        Q: Fn(M, &X) -> Option<QuasiPolynomial>,
    {
        self.with(Signal { surface, signal })
    }

    /// Gives enclosures of the guard of this surface: an interval that contains dᵏ/dtᵏ g(φ(t; x₀)) over an interval of
    /// time. The closure takes the mode, the start x₀, the order k and both ends of the interval of time.
    pub fn enclosure<B>(
        self,
        surface: S,
        enclosure: B,
    ) -> Model<M, S, X, F, (GuardEnclosure<S, B>, P), C>
    where
        B: Fn(M, &X, u32, (f64, f64)) -> Option<Enclosure>,
    {
        self.with(GuardEnclosure { surface, enclosure })
    }

    /// Gives the mode and the state on a surface at which the fields on both sides point.
    pub fn slide<B, Y>(self, slide: B) -> Model<M, S, X, F, (Slide<B>, P), C>
    where
        B: Fn(&Sliding<M, S, X>) -> Option<(M, Y)>,
        Y: Into<X>,
    {
        self.with(Slide(slide))
    }

    /// The same model with this interval at which [`run`](Self::run) samples guards without bounds.
    pub fn sampled(mut self, interval: f64) -> Self {
        self.sampling_interval = Some(interval);
        self
    }
}

impl<M, S, X, F, P, C> Model<M, S, X, F, P, C>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    X: StateVector,
    F: Motion<M, X>,
    P: ModelPart<M, S, X>,
{
    /// The execution from `start`, which has the time if the model has.
    pub(super) fn execution(&self, mode: M, start: X, time: f64) -> Execution<'_, Self> {
        let mut limits = Limits::new(time, MOST_EVENTS);
        limits.sampling_interval = self.sampling_interval;
        Execution::new(self, mode, start, limits)
    }
}
