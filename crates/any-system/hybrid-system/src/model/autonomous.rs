//! The parts of a model that does not depend on the time.

use super::continued::{Field, Rest};
use super::guarded::{Clock, Jump, JumpEverywhere, Terminal, Watch};
use super::model::Model;
use super::motion::{ClosedForm, Motion};
use super::outcome::Outcome;
use super::part::ModelPart;
use crate::execution::Execution;
use crate::guard::Guard;
use crate::state::StateVector;
use std::fmt::Debug;

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

    /// Gives the mode and the state after a Zeno limit, from the mode before it and the state at the limit.
    pub fn rest<B, Y>(self, rest: B) -> Model<M, S, X, F, (Rest<B>, P)>
    where
        B: Fn(M, &X) -> Option<(M, Y)>,
        Y: Into<X>,
    {
        self.with(Rest(rest))
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
        self.execution(mode, start.into(), time)
    }
}
