//! Equations backward in time.
//!
//! With s = −t the field is −f(−s, x). An event that leads from a mode m to m′ by x⁺ = R(x⁻) is, backward, one that leads from
//! m′ to m by R⁻¹, where the guard is zero at R⁻¹(x⁺).

use super::equations::{Equations, GuardEquations, Jump, ModeEquations};
use super::label::Label;
use crate::error::Error;
use crate::guard::{Direction, Role};
use equations::Formulas;

/// What the name of a surface has behind it where a run backward ends.
const ENDS: &str = " ends";

impl Equations {
    /// The same system backward: its time is s = −t, so that an execution from t₀ starts at −t₀, and its events are at −t. Each
    /// jump that changes the state needs its [`inverse`](Self::inverse).
    ///
    /// - An event of a jump happens in the mode to which the jump leads, where the guard is zero at the state before it, and goes there
    ///   in its direction. A start on this surface is such an event.
    /// - Where a state may have come by such a jump or by the flow alone, it has come by the jump: the past need not be unique.
    /// - An observer has its events at the same points: a guard that rises in t falls in s.
    /// - A mode flows on one side of its contacts and switches, backward too: a start beyond is an error, and the run ends where it would
    ///   go beyond. Where a jump leaves a mode this end has the surface `"NAME ends"`. At a [crossing](Self::crossing) the run ends where
    ///   the event would have been.
    /// - A state within 10⁻¹² of a surface is on it: the end of a run forward is known no better.
    /// - Jumps at one instant are undone in the reverse order of their guards; a tick at the instant of another jump is an error.
    /// - A tick at the start of a run backward is undone, and none at its end: forward it is the other way round.
    /// - The rest after a Zeno limit is left out. A periodic clock is an error, since its last tick is not known.
    ///
    /// ```
    /// use hybrid_system::{Equations, State};
    /// let ball = Equations::new(&["height", "speed"], &[])
    ///     .mode_text("flight", &["speed", "-1"])
    ///     .falling_text("floor", "height")
    ///     .resets_text(&["height", "-0.5*speed"])
    ///     .inverse_text(&["height", "-2*speed"]);
    /// let forward = ball.model::<State<2>>()?;
    /// let end = forward.start("flight", [0.5, 0.0], 1.5)?.fate();
    /// let back = ball.reversed()?.model::<State<2>>()?;
    /// // From t = 1.5 back to 0: through the landing at 1, up to where it was dropped.
    /// let first = back.start_at("flight", end.state, (-1.5, 0.0))?.fate();
    /// assert!((first.state - State::from([0.5, 0.0])).norm() < 1e-12);
    /// assert_eq!(first.events, 1);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`check`](Self::check); [`Error::BadEquations`] for a jump without an inverse, for a periodic clock, and for two jumps of
    /// one surface that lead to the same mode, as those of all modes do if they lead to one; [`Error::Formula`] for a guard with a kink,
    /// whose rate says in which direction it goes.
    pub fn reversed(&self) -> Result<Equations, Error> {
        self.check()?;
        let back = Formulas::of_vector(self.names.clone(), |t, x, _| {
            [-t].into_iter().chain(x.iter().copied()).collect()
        })?;
        let mut reversed = Equations::of_names(self.names.clone());
        reversed.backward = !self.backward;
        for mode in &self.modes {
            let field = mode.field.composed(&back)?.negative();
            let (guards, after_limit) = (Vec::new(), None);
            reversed.modes.push(ModeEquations { name: mode.name, field, guards, after_limit });
        }
        let guards = || {
            let of = |mode| move |guard| (mode, guard);
            // What the first reversal has added is not reversed again.
            let is_end = |guard: &&GuardEquations| {
                self.backward && guard.guard.surface.as_str().ends_with(ENDS)
            };
            let modes = self.modes.iter();
            modes.flat_map(move |mode| {
                let own = self.everywhere.iter().chain(&mode.guards);
                own.filter(move |guard| !is_end(guard)).map(of(mode))
            })
        };
        let changes = |guard: &GuardEquations| guard.jump.is_some() && !guard.observes();
        // First the jumps, in the modes to which they lead: they are its past. Of jumps at one instant the last one is undone first.
        let jumps: Vec<_> = guards().filter(|(_, guard)| changes(guard)).collect();
        for (mode, guard) in jumps.into_iter().rev() {
            reversed.add_reversed(&back, mode, guard)?;
        }
        // Then the observers and the stops, and the ends of the past where a jump leaves a mode.
        for (mode, guard) in guards() {
            match changes(guard) {
                true => reversed.add_end(&back, mode.name, guard)?,
                false => reversed.add_reversed(&back, mode, guard)?,
            }
        }
        Ok(reversed)
    }

    /// Adds the guard backward: to the mode to which its jump leads.
    fn add_reversed(
        &mut self,
        back: &Formulas,
        mode: &ModeEquations,
        guard: &GuardEquations,
    ) -> Result<(), Error> {
        let jump = guard.jump.as_ref();
        let inverse = match jump.map(|jump| (&jump.state, &jump.inverse)) {
            Some((Some(_), None)) => {
                return guard.bad("a jump backward needs the inverse of its state: give it");
            }
            Some((Some(_), Some(inverse))) => Some(inverse.composed(back)?),
            _ => None,
        };
        let inner = match &inverse {
            // The time is the same before the jump.
            Some(inverse) => Formulas::new(self.names.clone(), |t, _, _| [-t])?.and(inverse)?,
            None => back.clone(),
        };
        let changes = jump.filter(|jump| **jump != Jump::default());
        let to = changes.and_then(|jump| jump.mode).unwrap_or(mode.name);
        let mut guard = match changes {
            Some(_) if guard.guard.role != Role::Clock => guard.undone_at(&inner, &mode.field)?,
            _ => guard.crossed_at(&inner)?,
        };
        if let Some(jump) = changes {
            let forward = jump.state.as_ref().map(|state| state.composed(back)).transpose()?;
            let mode = (to != mode.name).then_some(mode.name);
            guard.jump = Some(Jump { mode, state: inverse, inverse: forward });
        }
        match self.push_guard(to, guard.clone()) {
            true => Ok(()),
            false => guard.bad(
                "two guards of this name are in one mode backward: give them names of their own",
            ),
        }
    }

    /// Adds the end of the past at an event that leads out of a mode, under a name of its own: the surface of the jump backward is another
    /// one.
    fn add_end(
        &mut self,
        back: &Formulas,
        mode: Label,
        guard: &GuardEquations,
    ) -> Result<(), Error> {
        if guard.guard.role == Role::Clock {
            return Ok(());
        }
        let mut guard = guard.crossed_at(back)?;
        guard.jump = None;
        let name = format!("{}{ENDS}", guard.guard.surface);
        guard.guard.surface = Label::new(&name)?;
        match self.push_guard(mode, guard.clone()) {
            true => Ok(()),
            false => guard.bad("its name is that of the end of another guard backward"),
        }
    }

    /// Adds a guard, and returns true, if its mode has none of its surface.
    fn push_guard(&mut self, mode: Label, guard: GuardEquations) -> bool {
        let Some(known) = self.modes.iter_mut().find(|known| known.name == mode) else {
            return false;
        };
        let is_new = known.guards.iter().all(|own| own.guard.surface != guard.guard.surface);
        if is_new {
            known.guards.push(guard);
        }
        is_new
    }
}

impl GuardEquations {
    /// The guard backward, as a crossing of the surface where it is zero at another time and state. A clock has its times backward.
    fn crossed_at(&self, inner: &Formulas) -> Result<GuardEquations, Error> {
        let mut guard = self.clone();
        guard.guard = self.guard.backward(self.observes());
        if self.guard.role == Role::Clock {
            guard.function = self.times_backward()?;
        } else {
            guard.function = self.function.composed(inner)?;
        }
        let condition = self.condition.as_ref();
        guard.condition = condition.map(|condition| condition.composed(inner)).transpose()?;
        Ok(guard)
    }

    /// The guard at the state before its jump, along the field before it. It counts where it goes in its direction there.
    fn undone_at(&self, inner: &Formulas, field: &Formulas) -> Result<GuardEquations, Error> {
        let mut guard = self.crossed_at(inner)?;
        let rate = || self.function.rate(field)?.composed(inner);
        let direction = match self.guard.direction {
            Direction::Rising => Some(rate()?),
            Direction::Falling => Some(rate()?.negative()),
            Direction::Either => None,
        };
        guard.condition = match (guard.condition, direction) {
            (Some(condition), Some(direction)) => Some(condition.minimum(&direction)?),
            (condition, direction) => condition.or(direction),
        };
        guard.guard.direction = Direction::Either;
        guard.guard.role = Role::Undone;
        Ok(guard)
    }

    /// The times of a list, from the last one on.
    fn times_backward(&self) -> Result<Formulas, Error> {
        if !self.listed {
            return self.bad("a periodic clock has no last tick, at which it would begin backward");
        }
        Ok(self.function.negative().turned_round())
    }
}
