//! The model, and the methods that give it its parts.

use super::bounds::{GuardEnclosure, Signal};
use super::continued::{Field, Rest, Slide};
use super::guard_lists::GuardLists;
use super::guarded::{Clock, Jump, JumpEverywhere, Terminal, Watch};
#[cfg(feature = "ode")]
use super::integrated::Integrated;
use super::motion::{ClosedForm, Motion};
use super::outcome::Outcome;
use super::part::ModelPart;
use crate::crossing::QuasiPolynomial;
use crate::execution::Execution;
use crate::guard::Guard;
use crate::limits::Limits;
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
/// | [`rising`](Self::rising), [`falling`](Self::falling), [`either`](Self::either) | a guard of one mode, with a number |
/// | [`contact`](Self::contact), [`crossing`](Self::crossing) | what a state beyond the surface of the last guard means |
/// | [`guard`](Self::guard), [`guard_everywhere`](Self::guard_everywhere) | a guard with a name, of one mode or of all |
/// | [`terminal`](Self::terminal), [`observer`](Self::observer) | a guard that ends the execution, or only watches |
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
pub struct Model<M, S, X, F, P = ()> {
    pub(crate) motion: F,
    pub(crate) parts: P,
    pub(super) guards: GuardLists<M, S>,
    sampling_interval: Option<f64>,
    state: PhantomData<fn() -> X>,
}

/// The limit on the number of events of [`Model::run`]: far above what a user looks at event by event, and a run ends
/// within seconds. [`Execution::new`] takes any other limit.
const MOST_EVENTS: usize = 1_000_000;

impl<M: Copy + Eq, S: Copy + Eq + Debug, X, F> Model<M, S, X, F> {
    fn new(motion: F) -> Self {
        let guards = GuardLists::new();
        Model { motion, parts: (), guards, sampling_interval: None, state: PhantomData }
    }
}

#[cfg(feature = "ode")]
impl<M: Copy + Eq, S: Copy + Eq + Debug, X, F, P> Model<M, S, X, F, P> {
    /// A model with this motion, whose one part has these guards: of a mode, or of all modes.
    pub(crate) fn of_equations(motion: F, parts: P, watched: Vec<(Option<M>, Guard<S>)>) -> Self {
        let mut guards = GuardLists::new();
        watched.into_iter().for_each(|(mode, guard)| guards.add(mode, guard));
        Model { motion, parts, guards, sampling_interval: None, state: PhantomData }
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
    /// If f depends on time, time is a component of the state with ṫ = 1.
    pub fn integrated(field: F) -> Self {
        Model::new(Integrated::new(field))
    }
}

#[cfg(feature = "ode")]
impl<M, S, X, F, P> Model<M, S, X, Integrated<F>, P> {
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

/// The three directions of a guard whose surface is the number of guards that were added before.
macro_rules! numbered_guards {
    ($($(#[$about:meta])* $direction:ident;)*) => {$(
        $(#[$about])*
        ///
        /// The reset gives the next mode and state. The surface is the number of guards that were added before.
        pub fn $direction<G, R, J>(
            self,
            mode: M,
            guard: G,
            reset: R,
        ) -> Model<M, usize, X, F, (Jump<M, usize, G, R>, P)>
        where
            G: Fn(&X) -> f64,
            R: Fn(&X) -> J,
            J: Outcome<M, X>,
        {
            let surface = self.guards.next_index();
            self.guard(mode, Guard::$direction(surface), guard, reset)
        }
    )*};
}

// Each part of a model has a type of its own.
#[allow(clippy::type_complexity)]
impl<M, X, F, P> Model<M, usize, X, F, P>
where
    M: Copy + Eq,
{
    numbered_guards! {
        /// Adds a guard of `mode`: an event when g(x) goes from negative to positive.
        rising;
        /// Adds a guard of `mode`: an event when g(x) goes from positive to negative.
        falling;
        /// Adds a guard of `mode`: an event at every change of sign of g(x).
        either;
    }
}

// Each part of a model has a type of its own.
#[allow(clippy::type_complexity)]
impl<M, S, X, F, P> Model<M, S, X, F, P>
where
    M: Copy + Eq,
    S: Copy + Eq + Debug,
{
    pub(super) fn with<A>(self, part: A) -> Model<M, S, X, F, (A, P)> {
        Model {
            motion: self.motion,
            parts: (part, self.parts),
            guards: self.guards,
            sampling_interval: self.sampling_interval,
            state: PhantomData,
        }
    }

    /// Adds a guard of `mode`: its surface, direction, role and touch, its function g(x), and the reset after its events.
    ///
    /// The reset returns the next mode and state, or a [`Reset`](crate::Reset).
    pub fn guard<G, R, J>(
        mut self,
        mode: M,
        watched: Guard<S>,
        guard: G,
        reset: R,
    ) -> Model<M, S, X, F, (Jump<M, S, G, R>, P)>
    where
        G: Fn(&X) -> f64,
        R: Fn(&X) -> J,
        J: Outcome<M, X>,
    {
        self.guards.add_watched(Some(mode), watched);
        self.with(Jump { mode, surface: watched.surface, guard, reset })
    }

    /// Adds a guard of all modes. The reset takes the mode before the event, and the state.
    pub fn guard_everywhere<G, R, J>(
        mut self,
        watched: Guard<S>,
        guard: G,
        reset: R,
    ) -> Model<M, S, X, F, (JumpEverywhere<S, G, R>, P)>
    where
        G: Fn(&X) -> f64,
        R: Fn(M, &X) -> J,
        J: Outcome<M, X>,
    {
        self.guards.add_watched(None, watched);
        self.with(JumpEverywhere { surface: watched.surface, guard, reset })
    }

    /// Adds a guard of `mode` whose events end the execution.
    pub fn terminal<G>(
        mut self,
        mode: M,
        watched: Guard<S>,
        guard: G,
    ) -> Model<M, S, X, F, (Terminal<M, S, G>, P)>
    where
        G: Fn(&X) -> f64,
    {
        self.guards.add_watched(Some(mode), watched);
        self.with(Terminal { mode, surface: watched.surface, guard })
    }

    /// Adds an observer of all modes: mode and state stay as they are at its events.
    pub fn observer<G>(mut self, watched: Guard<S>, guard: G) -> Model<M, S, X, F, (Watch<S, G>, P)>
    where
        G: Fn(&X) -> f64,
    {
        self.guards.add_observer(watched);
        self.with(Watch { surface: watched.surface, guard })
    }

    /// Adds events of `mode` at preset times. `next` gives the first preset time strictly after a time, both continuous
    /// times t, or `None` after the last one. The reset takes the mode and the state.
    pub fn clock<T, R, J>(
        mut self,
        mode: M,
        surface: S,
        next: T,
        reset: R,
    ) -> Model<M, S, X, F, (Clock<M, S, T, R>, P)>
    where
        T: Fn(f64) -> Option<f64>,
        R: Fn(M, &X) -> J,
        J: Outcome<M, X>,
    {
        self.guards.add(Some(mode), Guard::clock(surface));
        self.with(Clock { mode: Some(mode), surface, next, reset })
    }

    /// The same in all modes.
    pub fn clock_everywhere<T, R, J>(
        mut self,
        surface: S,
        next: T,
        reset: R,
    ) -> Model<M, S, X, F, (Clock<M, S, T, R>, P)>
    where
        T: Fn(f64) -> Option<f64>,
        R: Fn(M, &X) -> J,
        J: Outcome<M, X>,
    {
        self.guards.add(None, Guard::clock(surface));
        self.with(Clock { mode: None, surface, next, reset })
    }

    /// Gives the guard of this surface along the flow from a start, g(φ(t; x₀)), as a quasi-polynomial in t, or `None`
    /// where it is none. Its crossings are then found with certainty.
    pub fn signal<Q>(self, surface: S, signal: Q) -> Model<M, S, X, F, (Signal<S, Q>, P)>
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
    ) -> Model<M, S, X, F, (GuardEnclosure<S, B>, P)>
    where
        B: Fn(M, &X, u32, (f64, f64)) -> Option<Enclosure>,
    {
        self.with(GuardEnclosure { surface, enclosure })
    }

    /// Gives the mode and the state after a Zeno limit, from the mode before it and the state at the limit.
    pub fn rest<B, Y>(self, rest: B) -> Model<M, S, X, F, (Rest<B>, P)>
    where
        B: Fn(M, &X) -> Option<(M, Y)>,
        Y: Into<X>,
    {
        self.with(Rest(rest))
    }

    /// Gives the mode and the state on a surface at which the fields on both sides point.
    pub fn slide<B, Y>(self, slide: B) -> Model<M, S, X, F, (Slide<B>, P)>
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

// Each part of a model has a type of its own.
#[allow(clippy::type_complexity)]
impl<M, S, X, G, P> Model<M, S, X, ClosedForm<G>, P>
where
    M: Copy + Eq,
    S: Copy + Eq + Debug,
{
    /// Gives f(x) of ẋ = f(x) for a flow in closed form. Sliding points and derivatives through events need it.
    pub fn field<B, Y>(self, field: B) -> Model<M, S, X, ClosedForm<G>, (Field<B>, P)>
    where
        B: Fn(M, &X) -> Y,
        Y: Into<X>,
    {
        self.with(Field(field))
    }
}

impl<M, S, X, F, P> Model<M, S, X, F, P>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    X: StateVector,
    F: Motion<M, X>,
    P: ModelPart<M, S, X>,
{
    /// The execution from `start` in `mode`, up to the time `time` and at most a million events: an iterator over its arcs.
    ///
    /// [`Execution::new`] takes the other limits.
    pub fn run(&self, mode: M, start: impl Into<X>, time: f64) -> Execution<'_, Self> {
        let mut limits = Limits::new(time, MOST_EVENTS);
        limits.sampling_interval = self.sampling_interval;
        Execution::new(self, mode, start.into(), limits)
    }
}
