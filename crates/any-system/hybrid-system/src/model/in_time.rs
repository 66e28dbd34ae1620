//! The parts of a model whose closures take the time: `|t, x|` in the place of `|x|`.
//!
//! The time is the last component of the state, so that derivatives, errors and closed forms know it. The library adds it to
//! rates, resets and starts.

use super::condition::Condition;
use super::continued::Rest;
use super::guarded::{Clock, Jump, JumpEverywhere, Terminal, Watch};
#[cfg(feature = "ode")]
use super::integrated::Integrated;
use super::model::Model;
use super::motion::{ClosedForm, Motion};
use super::part::ModelPart;
use super::untimed::{OutcomeInTime, Untimed, time_of};
use crate::execution::Execution;
use crate::guard::{Guard, Role};
use crate::state::StateVector;
use std::fmt::Debug;

/// How the closures of a [`Model`] are called: with the time before the state.
#[derive(Debug, Clone, Copy)]
pub enum InTime {}

/// A closure of the time and the state as one of the state.
fn of_state<X: StateVector, V>(closure: impl Fn(f64, &X) -> V) -> impl Fn(&X) -> V {
    move |state| closure(time_of(state), state)
}

// The types contain those of the closures.
#[allow(clippy::type_complexity)]
#[cfg(feature = "ode")]
impl<M: Copy + Eq, S: Copy + Eq + Debug, X: StateVector> Model<M, S, X, (), (), InTime> {
    /// A model whose flow is the solution of ẋ = f(t, x): f from the mode, the time and the state. (feature `ode`)
    ///
    /// The state has the time t as its last component. The closures of guards, conditions and resets take the time too:
    /// `|t, x|` instead of `|x|`. Rates, states after a reset and starts are given without it.
    ///
    /// ```
    /// use hybrid_system::{Model, State};
    /// // A bead on a vertical wire above a table that shakes.
    /// let table = |t: f64| 0.1 * pxfm::f_sin(9.0 * t);
    /// let speed = |t: f64| 0.9 * pxfm::f_cos(9.0 * t);
    /// let bead = Model::integrated_in_time(|(), _, x: &State<3>| [x[1], -1.0])
    ///     .falling((), move |t, x| x[0] - table(t), move |t, x| ((), [x[0], 2.0 * speed(t) - x[1]]))
    ///     .only_where(0, move |t, x| speed(t) - x[1]);
    /// let landing = bead.run((), [1.0, 0.0], 9.0).next().expect("an arc")?;
    /// let event = landing.event().expect("it lands");
    /// assert_eq!(event.before[2], event.time);
    /// assert!((event.before[0] - table(event.time)).abs() < 1e-10);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    pub fn integrated_in_time<Y: Untimed<X>>(
        field: impl Fn(M, f64, &X) -> Y,
    ) -> Model<M, S, X, Integrated<impl Fn(M, &X) -> X>, (), InTime> {
        Model::new(Integrated::new(move |mode, state: &X| {
            field(mode, time_of(state), state).with_time(Some(state.dimension()), 1.0)
        }))
    }
}

#[allow(clippy::type_complexity)]
impl<M: Copy + Eq, S: Copy + Eq + Debug, X: StateVector> Model<M, S, X, (), (), InTime> {
    /// A model whose flow has a closed form that depends on the time at its start: x(t₀ + τ) from the mode, t₀, x(t₀) and τ ≥ 0. As
    /// for `integrated_in_time` the state has the time as its last component, and closures take it.
    pub fn closed_form_in_time<Y: Untimed<X>>(
        flow: impl Fn(M, f64, &X, f64) -> Y,
    ) -> Model<M, S, X, ClosedForm<impl Fn(M, &X, f64) -> X>, (), InTime> {
        Model::new(ClosedForm(move |mode, start: &X, duration: f64| {
            let time = time_of(start);
            flow(mode, time, start, duration).with_time(Some(start.dimension()), time + duration)
        }))
    }
}

/// The three directions of a guard whose surface is the number of guards that were added before.
macro_rules! numbered_guards {
    ($($(#[$about:meta])* $direction:ident;)*) => {$(
        $(#[$about])*
        ///
        /// The reset gives the next mode and state. The surface is the number of guards that were added before.
        pub fn $direction<J: OutcomeInTime<M, X>>(
            self,
            mode: M,
            guard: impl Fn(f64, &X) -> f64,
            reset: impl Fn(f64, &X) -> J,
        ) -> Model<M, usize, X, F, (impl ModelPart<M, usize, X>, P), InTime> {
            let surface = self.guards.next_index();
            self.guard(mode, Guard::$direction(surface), guard, reset)
        }
    )*};
}

impl<M: Copy + Eq, X: StateVector, F, P> Model<M, usize, X, F, P, InTime> {
    numbered_guards! {
        /// Adds a guard of `mode`: an event when g(t, x) goes from negative to positive.
        rising;
        /// Adds a guard of `mode`: an event when g(t, x) goes from positive to negative.
        falling;
        /// Adds a guard of `mode`: an event at every change of sign of g(t, x).
        either;
    }
}

impl<M, S, X, F, P> Model<M, S, X, F, P, InTime>
where
    M: Copy + Eq,
    S: Copy + Eq + Debug,
    X: StateVector,
{
    /// Adds a guard of `mode`: its surface, direction, role and touch, its function g(t, x), and the reset after its events.
    ///
    /// The reset returns the next mode and state, or a [`Reset`](crate::Reset). The state is given without the time.
    pub fn guard<J: OutcomeInTime<M, X>>(
        mut self,
        mode: M,
        watched: Guard<S>,
        guard: impl Fn(f64, &X) -> f64,
        reset: impl Fn(f64, &X) -> J,
    ) -> Model<M, S, X, F, (impl ModelPart<M, S, X>, P), InTime> {
        self.guards.add_watched(Some(mode), watched);
        let guard = of_state(guard);
        let reset = move |before: &X| reset(time_of(before), before).reset_at(before);
        self.with(Jump { mode, surface: watched.surface, guard, reset })
    }

    /// Adds a guard of all modes. The reset takes the mode before the event, the time and the state.
    pub fn guard_everywhere<J: OutcomeInTime<M, X>>(
        mut self,
        watched: Guard<S>,
        guard: impl Fn(f64, &X) -> f64,
        reset: impl Fn(M, f64, &X) -> J,
    ) -> Model<M, S, X, F, (impl ModelPart<M, S, X>, P), InTime> {
        self.guards.add_watched(None, watched);
        let guard = of_state(guard);
        let reset = move |mode, before: &X| reset(mode, time_of(before), before).reset_at(before);
        self.with(JumpEverywhere { surface: watched.surface, guard, reset })
    }

    /// Adds a guard of `mode` whose events end the execution.
    pub fn terminal(
        mut self,
        mode: M,
        watched: Guard<S>,
        guard: impl Fn(f64, &X) -> f64,
    ) -> Model<M, S, X, F, (impl ModelPart<M, S, X>, P), InTime> {
        self.guards.add_watched(Some(mode), watched);
        self.with(Terminal { mode, surface: watched.surface, guard: of_state(guard) })
    }

    /// Adds an observer of all modes: mode and state stay as they are at its events.
    pub fn observer(
        mut self,
        watched: Guard<S>,
        guard: impl Fn(f64, &X) -> f64,
    ) -> Model<M, S, X, F, (impl ModelPart<M, S, X>, P), InTime> {
        self.guards.add_observer(watched);
        self.with(Watch { surface: watched.surface, guard: of_state(guard) })
    }

    /// Lets the events of this surface count only where h(t, x), at the state before the event, is positive: a scuff only at
    /// mid-stance, a guard only after a time.
    ///
    /// As [`Model::only_where`] of a model without the time.
    pub fn only_where(
        mut self,
        surface: S,
        condition: impl Fn(f64, &X) -> f64,
    ) -> Model<M, S, X, F, (impl ModelPart<M, S, X>, P), InTime> {
        self.guards.declare(None, surface, Role::Crossing);
        self.with(Condition { surface, condition: of_state(condition) })
    }

    /// Adds events of `mode` at preset times. `next` gives the first preset time strictly after a time, or `None` after the last
    /// one. The reset takes the mode, the time of the tick, and the state.
    pub fn clock<J: OutcomeInTime<M, X>>(
        mut self,
        mode: M,
        surface: S,
        next: impl Fn(f64) -> Option<f64>,
        reset: impl Fn(M, f64, &X) -> J,
    ) -> Model<M, S, X, F, (impl ModelPart<M, S, X>, P), InTime> {
        self.guards.add(Some(mode), Guard::clock(surface));
        let reset = move |mode, before: &X| reset(mode, time_of(before), before).reset_at(before);
        self.with(Clock { mode: Some(mode), surface, next, reset })
    }

    /// The same in all modes.
    pub fn clock_everywhere<J: OutcomeInTime<M, X>>(
        mut self,
        surface: S,
        next: impl Fn(f64) -> Option<f64>,
        reset: impl Fn(M, f64, &X) -> J,
    ) -> Model<M, S, X, F, (impl ModelPart<M, S, X>, P), InTime> {
        self.guards.add(None, Guard::clock(surface));
        let reset = move |mode, before: &X| reset(mode, time_of(before), before).reset_at(before);
        self.with(Clock { mode: None, surface, next, reset })
    }

    /// Gives the mode and the state after a Zeno limit, from the mode before it, the time of the limit, and the state there.
    pub fn rest<Y: Untimed<X>>(
        self,
        rest: impl Fn(M, f64, &X) -> Option<(M, Y)>,
    ) -> Model<M, S, X, F, (impl ModelPart<M, S, X>, P), InTime> {
        self.with(Rest(move |mode, limit: &X| {
            let (time, dimension) = (time_of(limit), Some(limit.dimension()));
            rest(mode, time, limit).map(|(mode, state)| (mode, state.with_time(dimension, time)))
        }))
    }
}

impl<M, S, X, F, P> Model<M, S, X, F, P, InTime>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    X: StateVector,
    F: Motion<M, X>,
    P: ModelPart<M, S, X>,
{
    /// The execution from `start` in `mode`, from the time 0 up to the time `time` and at most a million events: an iterator over its
    /// arcs. The start has no time.
    pub fn run(&self, mode: M, start: impl Untimed<X>, time: f64) -> Execution<'_, Self> {
        self.run_at(mode, start, (0.0, time))
    }

    /// The same from a time on, up to another one.
    pub fn run_at(
        &self,
        mode: M,
        start: impl Untimed<X>,
        (from, to): (f64, f64),
    ) -> Execution<'_, Self> {
        self.execution(mode, start.with_time(None, from), to).starting_at(from)
    }
}
