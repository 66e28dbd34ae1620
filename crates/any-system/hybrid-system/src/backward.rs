//! Executions backward in time, of any model that has a field.

use crate::crossing::{NextEvent, Search};
use crate::error::Error;
use crate::execution::Execution;
use crate::guard::{Direction, Guard, Role};
use crate::guard_table::GuardTable;
use crate::limits::{Limits, MOST_EVENTS};
use crate::model::smaller;
use crate::ode::{Tolerances, integrated_crossing, integrated_flow, integrated_states};
use crate::sliding::slope_along;
use crate::state::StateVector;
use crate::system::{HybridSystem, Reset};
use std::fmt::Debug;

/// A system backward in time: s = −t, with the field −f. [`Equations::reversed`](crate::Equations::reversed) does the same for
/// equations, as equations.
///
/// A jump is undone by its inverse, if [`inverse`](Self::inverse) gives it: in the mode to which the jump leads, where the guard
/// is zero at the state before it, and goes there in its direction. A start on this surface is such an event.
///
/// An event that leads out of a mode ends the run at its surface: no state comes from beyond it. Jumps that lead *into* a mode from
/// another one are known by their inverses alone. Without one the run goes on, as if the state had come by the flow. So a run
/// without jumps on its way needs no inverse.
///
/// - Where a state may have come by such a jump or by the flow alone, it has come by the jump: the past need not be unique.
/// - An observer ([`HybridSystem::observes`]) has its events at the same points: a guard that rises in t falls in s.
/// - A mode flows on one side of its contacts and switches, backward too: a start beyond is an error, and the run ends where it would
///   go beyond. At a crossing it ends where the event would have been.
/// - A state within the tolerances of a surface is on it.
/// - Jumps at one instant are undone in the reverse order of their guards. A jump that was an event at once, from a state beyond a
///   contact, is not undone.
/// - An inverse is compared with the jump: a state that the jump does not bring back is an error.
/// - Where the guard has no rate at the state before a jump, its direction is not decided: the run ends in
///   [`ConditionError::Undecided`](crate::ConditionError::Undecided).
/// - There is no rest after a Zeno limit, and no sliding: both have no unique past. A clock is an error, since its last tick is not
///   known.
/// - The field is integrated, also that of a flow in closed form ([`Model::field`](crate::Model::field)).
///
/// ```
/// use hybrid_system::{Backward, Model, State, Tolerances};
/// let ball = Model::integrated(|(), x: &State<2>| [x[1], -1.0]).falling(
///     (),
///     |x| x[0],
///     |x| ((), [x[0], -0.5 * x[1]]),
/// );
/// let end = ball.run((), [0.5, 0.0], 1.5).fate();
/// let back = Backward::new(&ball, Tolerances::both(1e-12))
///     .inverse(0, (), |x| ((), [x[0], -2.0 * x[1]].into()));
/// // From t = 1.5 back to 0: through the landing at 1, up to where it was dropped.
/// let first = back.run((), end.state, (1.5, 0.0)).fate();
/// assert!((first.state - State::from([0.5, 0.0])).norm() < 1e-8);
/// assert_eq!((first.events, first.time), (1, 0.0));
/// // Without the inverse it ends where it has come from the floor.
/// let alone = Backward::new(&ball, Tolerances::both(1e-12)).run((), end.state, (1.5, 0.0)).fate();
/// assert!((alone.time + 1.0).abs() < 1e-8);
/// # Ok::<(), hybrid_system::Error>(())
/// ```
pub struct Backward<'a, T: HybridSystem> {
    system: &'a T,
    tolerances: Tolerances,
    inverses: Vec<Inverse<'a, T>>,
    guards: GuardTable<T::Mode, BackwardSurface<T::Mode, T::Surface>>,
}

/// How near a jump leads back to the state from which its inverse comes, relative to each component: far above the rounding of both,
/// and far below what a wrong formula misses.
const RETURN: f64 = 1e-6;

/// The same for a component that is small beside others, relative to the largest one: it may be rounding of theirs.
const RETURN_OF_SMALL: f64 = 1e-10;

/// True if two states are one, as far as two formulas for it tell.
pub(crate) fn is_back<X: StateVector>(found: &X, state: &X) -> bool {
    let largest = state.largest();
    let is_near = |(a, b): (&f64, &f64)| {
        (a - b).abs() <= RETURN * a.abs().max(b.abs()) + RETURN_OF_SMALL * largest
    };
    found.dimension() == state.dimension()
        && found.components().iter().zip(state.components()).all(is_near)
}

/// The message of a jump and an inverse that do not lead back: from the first state to the second, and then to the third.
pub(crate) fn wrong_inverse<S: Debug, X: StateVector>(
    surface: Option<S>,
    time: f64,
    states: [&X; 3],
) -> String {
    let [from, to, back] = states.map(StateVector::components);
    let surface = surface.map_or(String::from("a limit"), |surface| format!("{surface:?}"));
    format!(
        "the jump of {surface} and its inverse do not fit at time {time}: from {from:?} to {to:?} and back to {back:?}; correct the \
         inverse, or the mode to which the jump leads"
    )
}

/// Mode and state before a jump, from the state after it.
type Undo<'a, M, X> = Box<dyn Fn(&X) -> (M, X) + Send + Sync + 'a>;

/// The inverse of a jump.
struct Inverse<'a, T: HybridSystem> {
    surface: T::Surface,
    /// The mode after the jump.
    after: T::Mode,
    undo: Undo<'a, T::Mode, T::State>,
}

/// A surface of [`Backward`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BackwardSurface<M, S> {
    /// A surface of the model, at the state itself.
    Model(S),
    /// A jump of the model is undone.
    Undone {
        /// The surface of the jump.
        surface: S,
        /// The mode to which it leads.
        after: M,
    },
}

impl<'a, T: HybridSystem> Backward<'a, T> {
    /// The system backward, integrated to these tolerances.
    pub fn new(system: &'a T, tolerances: Tolerances) -> Self {
        Backward { system, tolerances, inverses: Vec::new(), guards: GuardTable::new() }
    }

    /// Gives the inverse of the jumps of `surface` that lead to the mode `after`: the mode and the state before a jump, from the
    /// state after it.
    #[must_use]
    pub fn inverse(
        mut self,
        surface: T::Surface,
        after: T::Mode,
        undo: impl Fn(&T::State) -> (T::Mode, T::State) + Send + Sync + 'a,
    ) -> Self {
        self.inverses.push(Inverse { surface, after, undo: Box::new(undo) });
        Backward { guards: GuardTable::new(), ..self }
    }

    /// The execution from a state back in time, from a time t to an earlier one, and through at most a million events. Its own time
    /// is −t.
    pub fn run(
        &self,
        mode: T::Mode,
        start: impl Into<T::State>,
        (from, to): (f64, f64),
    ) -> Execution<'_, Self> {
        Execution::new(self, mode, start.into(), Limits::new(-to, MOST_EVENTS)).starting_at(-from)
    }

    /// Mode and state before a jump.
    fn before(
        &self,
        surface: T::Surface,
        after: T::Mode,
        state: &T::State,
    ) -> Option<(T::Mode, T::State)> {
        let is_it =
            |inverse: &&Inverse<'_, T>| inverse.surface == surface && inverse.after == after;
        Some((self.inverses.iter().find(is_it)?.undo)(state))
    }

    /// An error for an inverse of a surface that is no guard where it leads.
    fn check_inverses(&self, mode: T::Mode, state: &T::State) -> Result<(), Error> {
        for inverse in self.inverses.iter().filter(|inverse| inverse.after == mode) {
            let (before, _) = (inverse.undo)(state);
            let surface = inverse.surface;
            let is_it = |guard: &&Guard<_>| guard.surface == surface && guard.role != Role::Clock;
            if !self.system.guards(before).iter().any(|guard| is_it(&guard)) {
                let reason = format!(
                    "the inverse of {surface:?} leads to mode {before:?}, where it is no guard with a function: correct the inverse"
                );
                return Err(Error::Model { reason });
            }
        }
        Ok(())
    }

    /// True if a jump leads from a mode and a state to another mode and state.
    fn brings_back(
        &self,
        (mode, surface, before): (T::Mode, T::Surface, &T::State),
        (after, state): (T::Mode, &T::State),
    ) -> bool {
        let (Reset::Jump { mode, state: found } | Reset::Resize { mode, state: found }) =
            self.system.reset(mode, surface, before)
        else {
            return false;
        };
        mode == after && is_back(&found, state)
    }

    /// The rate of a guard along the field of its mode, positive in its direction; `None` for one that counts both ways.
    fn rate_in_direction(
        &self,
        mode: T::Mode,
        surface: T::Surface,
        state: &T::State,
    ) -> Option<f64> {
        let mut guards = self.system.guards(mode).iter();
        let sign = match guards.find(|guard| guard.surface == surface)?.direction {
            Direction::Rising => 1.0,
            Direction::Falling => -1.0,
            Direction::Either => return None,
        };
        let field = self.system.vector_field(mode, state)?;
        let guard = |state: &T::State| self.system.guard_value(surface, state);
        Some(sign * slope_along(&guard, state, &field, 0.0).value)
    }

    /// The guards of a mode: first the jumps that lead to it, then its own surfaces.
    fn guards_of(&self, mode: T::Mode) -> Vec<Guard<BackwardSurface<T::Mode, T::Surface>>> {
        // Of jumps at one instant the last one is undone first.
        let place =
            |surface| self.system.guards(mode).iter().position(|own| own.surface == surface);
        let mut leading: Vec<_> =
            self.inverses.iter().rev().filter(|inverse| inverse.after == mode).collect();
        leading.sort_by_key(|inverse| std::cmp::Reverse(place(inverse.surface)));
        let jumps = leading.into_iter().map(|inverse| {
            let surface = BackwardSurface::Undone { surface: inverse.surface, after: mode };
            Guard { role: Role::Undone, ..Guard::either(surface) }
        });
        let own = self.system.guards(mode).iter().map(|guard| {
            let observes = self.system.observes(guard.surface);
            guard.backward(observes).named(BackwardSurface::Model(guard.surface))
        });
        jumps.chain(own).collect()
    }

    /// An error for two inverses that are not told apart.
    fn check_distinct(&self) -> Result<(), Error> {
        for (k, own) in self.inverses.iter().enumerate() {
            let same =
                |other: &Inverse<'_, T>| (other.surface, other.after) == (own.surface, own.after);
            if self.inverses[..k].iter().any(same) {
                let (surface, after) = (own.surface, own.after);
                let reason = format!(
                    "surface {surface:?} has two inverses of jumps to mode {after:?}: backward they are not told apart; \
                     give their guards surfaces of their own"
                );
                return Err(Error::Model { reason });
            }
        }
        Ok(())
    }

    /// An error for a clock.
    fn check_clocks(&self, mode: T::Mode) -> Result<(), Error> {
        match self.guards(mode).iter().find(|guard| guard.role == Role::Clock) {
            Some(Guard { surface: BackwardSurface::Model(clock), .. }) => {
                let reason = format!(
                    "the clock {clock:?} of mode {mode:?} has no last tick, at which a run backward would begin"
                );
                Err(Error::Model { reason })
            }
            _ => Ok(()),
        }
    }
}

impl<T: HybridSystem> HybridSystem for Backward<'_, T> {
    type State = T::State;
    type Mode = T::Mode;
    type Surface = BackwardSurface<T::Mode, T::Surface>;

    fn flow(&self, mode: T::Mode, start: &T::State, time: f64) -> T::State {
        integrated_flow(self, mode, start, time, self.tolerances)
    }

    fn flow_at(
        &self,
        mode: T::Mode,
        start: &T::State,
        times: &[f64],
    ) -> Result<Vec<T::State>, Error> {
        integrated_states(self, mode, start, times, self.tolerances)
    }

    fn guards(&self, mode: T::Mode) -> &[Guard<Self::Surface>] {
        self.guards.guards(mode, || self.guards_of(mode))
    }

    /// g at the state, or at the state before the jump.
    fn guard_value(&self, surface: Self::Surface, state: &T::State) -> f64 {
        match surface {
            BackwardSurface::Model(surface) => self.system.guard_value(surface, state),
            BackwardSurface::Undone { surface, after } => {
                let before = self.before(surface, after, state);
                before.map_or(f64::NAN, |(_, before)| self.system.guard_value(surface, &before))
            }
        }
    }

    /// By the tolerances: a start is often the end of a run forward, and known no better.
    fn start_error(&self, surface: Self::Surface, state: &T::State) -> f64 {
        let here = self.guard_value(surface, state);
        let mut error = 0.0;
        for axis in 0..state.dimension() {
            let mut beside = state.clone();
            let component = &mut beside.components_mut()[axis];
            *component += self.tolerances.of(axis, *component);
            error += (self.guard_value(surface, &beside) - here).abs();
        }
        error
    }

    fn observes(&self, surface: Self::Surface) -> bool {
        matches!(surface, BackwardSurface::Model(surface) if self.system.observes(surface))
    }

    fn reset(
        &self,
        mode: T::Mode,
        surface: Self::Surface,
        state: &T::State,
    ) -> Reset<T::Mode, T::State> {
        match surface {
            BackwardSurface::Undone { surface, after } => {
                let Some((mode, before)) = self.before(surface, after, state) else {
                    return Reset::Stop;
                };
                // Without a finite state the run ends in `reset_error`.
                let before = match self.brings_back((mode, surface, &before), (after, state)) {
                    true => before,
                    false => before.filled(|_| f64::NAN),
                };
                // The sides of the guards after the jump say nothing about those before it.
                Reset::Resize { mode, state: before }
            }
            BackwardSurface::Model(surface) => match self.system.observes(surface) {
                true => Reset::Jump { mode, state: state.clone() },
                false => Reset::Stop,
            },
        }
    }

    fn reset_error(
        &self,
        _: T::Mode,
        surface: Option<Self::Surface>,
        state: &T::State,
        time: f64,
    ) -> Option<Error> {
        let Some(BackwardSurface::Undone { surface, after }) = surface else { return None };
        let (mode, before) = self.before(surface, after, state)?;
        let found = match self.system.reset(mode, surface, &before) {
            Reset::Jump { state, .. } | Reset::Resize { state, .. } => state,
            Reset::Stop => before.filled(|_| f64::NAN),
        };
        let reason = wrong_inverse(Some(surface), time, [state, &before, &found]);
        Some(Error::Model { reason })
    }

    /// That of the event forward, at the state before it: it has its own condition, and the direction of its guard.
    fn condition(&self, mode: T::Mode, surface: Self::Surface, state: &T::State) -> Option<f64> {
        match surface {
            BackwardSurface::Model(surface) => self.system.condition(mode, surface, state),
            BackwardSurface::Undone { surface, after } => {
                let (mode, before) = self.before(surface, after, state)?;
                let own = self.system.condition(mode, surface, &before);
                let both = own.into_iter().chain(self.rate_in_direction(mode, surface, &before));
                both.reduce(smaller)
            }
        }
    }

    /// −f.
    fn vector_field(&self, mode: T::Mode, state: &T::State) -> Option<T::State> {
        let field = self.system.vector_field(mode, state)?;
        Some(field.filled(|axis| -field.components()[axis]))
    }

    fn validate(&self, mode: T::Mode, start: &T::State) -> Result<(), Error> {
        self.system.validate(mode, start)?;
        if self.system.vector_field(mode, start).is_none() {
            return Err(Error::NoVectorField { mode: format!("{mode:?}") });
        }
        self.check_distinct()
    }

    fn first_crossing(
        &self,
        mode: T::Mode,
        start: &T::State,
        search: &Search<Self::Surface>,
    ) -> Result<NextEvent<Self::Surface, T::State>, Error> {
        self.check_clocks(mode)?;
        self.check_inverses(mode, start)?;
        integrated_crossing(self, mode, start, search, self.tolerances)
    }
}
