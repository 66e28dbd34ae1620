//! How equations are written: modes, guards and clocks.

use super::equations::{Equations, GuardEquations, Jump, ModeEquations};
use super::label::Label;
use crate::error::Error;
use crate::guard::{Direction, Guard, Role, Touch};
use equations::{Expression, Formulas, Names, Parameters, States};

const NO_GUARD: &str = "what an event does stands behind its guard, and no guard has been declared";

/// Gives the three directions of guards, from a closure and from text.
macro_rules! guards {
    ($($(#[$about:meta])* $name:ident $from_text:ident $direction:ident;)*) => {$(
        $(#[$about])*
        #[must_use]
        pub fn $name(
            self,
            surface: &str,
            function: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> Expression<'g>,
        ) -> Self {
            self.guard(surface, Direction::$direction, |names| {
                Formulas::new(names, |t, x, p| [function(t, x, p)])
            })
        }

        /// The same, from text.
        #[must_use]
        pub fn $from_text(self, surface: &str, function: &str) -> Self {
            self.guard(surface, Direction::$direction, |names| {
                Formulas::from_text(names, &[function])
            })
        }
    )*};
}

impl Equations {
    /// Takes formulas with the names of these equations, unless something was wrong before: a closure that is called with
    /// names that were refused would find no components.
    pub(super) fn take(
        self,
        make: impl FnOnce(Names) -> Result<Formulas, equations::Error>,
        put: impl FnOnce(Self, Formulas) -> Self,
    ) -> Self {
        if self.wrong.is_some() {
            return self;
        }
        match make(self.names.clone()) {
            Ok(formulas) => {
                let known = self.functions(&formulas.names().functions);
                put(known, formulas)
            }
            Err(error) => self.refused(error),
        }
    }

    pub(super) fn refused(mut self, error: impl Into<Error>) -> Self {
        self.wrong.get_or_insert(error.into());
        self
    }

    /// Adds a mode with its field: the rate of each component.
    #[must_use]
    pub fn mode<const N: usize>(
        self,
        name: &str,
        field: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> [Expression<'g>; N],
    ) -> Self {
        self.mode_vector(name, |t, x, p| field(t, x, p).into())
    }

    /// The same, from texts.
    #[must_use]
    pub fn mode_text(self, name: &str, field: &[&str]) -> Self {
        self.add_mode(name, |names| Formulas::from_text(names, field))
    }

    /// The same, from a closure that returns a vector: for a number of components that is known when it runs.
    #[must_use]
    pub fn mode_vector(
        self,
        name: &str,
        field: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> Vec<Expression<'g>>,
    ) -> Self {
        self.add_mode(name, |names| Formulas::of_vector(names, field))
    }

    fn add_mode(
        self,
        name: &str,
        field: impl FnOnce(Names) -> Result<Formulas, equations::Error>,
    ) -> Self {
        self.take(field, |mut known, field| match Label::new(name) {
            Err(error) => known.refused(error),
            Ok(name) if known.modes.iter().any(|mode| mode.name == name) => {
                known.refused(Error::BadEquations {
                    what: name.to_string(),
                    reason: "a mode has it already",
                })
            }
            Ok(name) => {
                known.modes.push(ModeEquations { name, field, guards: vec![], after_limit: None });
                known
            }
        })
    }

    guards! {
        /// Adds a guard: an event when g(t, x) goes from negative to positive.
        rising rising_text Rising;
        /// Adds a guard: an event when g(t, x) goes from positive to negative.
        falling falling_text Falling;
        /// Adds a guard: an event at every change of sign of g(t, x).
        either either_text Either;
    }

    /// Adds a clock: events at a first time and after each period, which follow from the parameters. A time that is not
    /// later than the start has no event.
    ///
    /// ```
    /// use hybrid_system::{Equations, State};
    /// // A sampled controller: every half second the force is set anew.
    /// let cart = Equations::new(&["place", "speed", "force"], &[("gain", "1")])
    ///     .mode("rolls", |_, x, _| [x[1], x[2], x[2].number(0.0)])
    ///     .clock("sample", |p| [p.number(0.5), p.number(0.5)])
    ///     .resets(|_, x, p| [x[0], x[1], -p["gain"] * (x[0] + x[1])])
    ///     .model::<State<3>>()?;
    /// let mut times = Vec::new();
    /// for arc in cart.start("rolls", [1.0, 0.0, 0.0], 2.1)? {
    ///     times.extend(arc?.event().map(|event| event.time));
    /// }
    /// assert_eq!(times, [0.5, 1.0, 1.5, 2.0]);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    #[must_use]
    pub fn clock(
        self,
        surface: &str,
        times: impl for<'g> Fn(&Parameters<'g>) -> [Expression<'g>; 2],
    ) -> Self {
        self.add_clock(surface, |names| Formulas::new(names, |_, _, p| times(p)))
    }

    /// The same, from texts: the first time and the period.
    #[must_use]
    pub fn clock_text(self, surface: &str, first: &str, period: &str) -> Self {
        self.add_clock(surface, |names| Formulas::from_text(names, &[first, period]))
    }

    /// Adds a clock: events at these times, which follow from the parameters. They must be finite and rise strictly, or
    /// [`model`](Self::model) is [`Error::BadClock`]. Times before the start have no event, and one at the start has an event
    /// with [`Limits::ticks_at_start`](crate::Limits::ticks_at_start).
    #[must_use]
    pub fn ticks(
        self,
        surface: &str,
        times: impl for<'g> Fn(&Parameters<'g>) -> Vec<Expression<'g>>,
    ) -> Self {
        self.add_clock(surface, |names| Formulas::of_vector(names, |_, _, p| times(p)))
            .with_last(|guard| guard.listed = true)
    }

    /// The same, from texts.
    #[must_use]
    pub fn ticks_text(self, surface: &str, times: &[&str]) -> Self {
        self.add_clock(surface, |names| Formulas::from_text(names, times))
            .with_last(|guard| guard.listed = true)
    }

    fn add_clock(
        self,
        surface: &str,
        times: impl FnOnce(Names) -> Result<Formulas, equations::Error>,
    ) -> Self {
        self.guard(surface, Direction::Either, times).with_last(|guard| {
            guard.guard.role = Role::Clock;
        })
    }

    fn guard(
        self,
        surface: &str,
        direction: Direction,
        function: impl FnOnce(Names) -> Result<Formulas, equations::Error>,
    ) -> Self {
        self.take(function, |mut known, function| match Label::new(surface) {
            Err(error) => known.refused(error),
            Ok(surface) => {
                // A switch, once its event does something.
                let guard = Guard { surface, direction, role: Role::Switch, touch: Touch::Error };
                let jump = Some(Jump::default());
                let added =
                    GuardEquations { guard, function, listed: false, condition: None, jump };
                match known.modes.last_mut() {
                    Some(mode) => mode.guards.push(added),
                    None => known.everywhere.push(added),
                }
                known
            }
        })
    }

    fn last_guard(&mut self) -> Option<&mut GuardEquations> {
        match self.modes.last_mut() {
            Some(mode) => mode.guards.last_mut(),
            None => self.everywhere.last_mut(),
        }
    }

    /// Changes the guard that was added last.
    pub(super) fn with_last(mut self, change: impl FnOnce(&mut GuardEquations)) -> Self {
        if self.wrong.is_some() {
            return self;
        }
        match self.last_guard() {
            Some(guard) => {
                change(guard);
                self
            }
            None => {
                self.refused(Error::BadEquations { what: "equations".to_owned(), reason: NO_GUARD })
            }
        }
    }
}
