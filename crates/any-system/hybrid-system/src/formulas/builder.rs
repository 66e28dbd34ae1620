//! How equations are written: modes, guards, and what events do.

use super::equations::{Equations, GuardEquations, Jump, ModeEquations, NO_MODE};
use super::label::Label;
use crate::error::Error;
use crate::guard::{Direction, Guard, Role, Touch};
use equations::{Expression, Formulas, Parameters, States};

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
            if self.wrong.is_some() {
                return self;
            }
            let function = Formulas::new(self.names.clone(), |t, x, p| [function(t, x, p)]);
            self.guard(surface, Direction::$direction, function)
        }

        /// The same, from text.
        #[must_use]
        pub fn $from_text(self, surface: &str, function: &str) -> Self {
            let function = Formulas::from_text(self.names.clone(), &[function]);
            self.guard(surface, Direction::$direction, function)
        }
    )*};
}

impl Equations {
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
        let field = Formulas::from_text(self.names.clone(), field);
        self.add_mode(name, field)
    }

    /// The same, from a closure that returns a vector: for a number of components that is known when it runs.
    #[must_use]
    pub fn mode_vector(
        self,
        name: &str,
        field: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> Vec<Expression<'g>>,
    ) -> Self {
        // A closure that is called with names that were refused would find no components.
        if self.wrong.is_some() {
            return self;
        }
        let field = Formulas::of_vector(self.names.clone(), field);
        self.add_mode(name, field)
    }

    fn add_mode(mut self, name: &str, field: Result<Formulas, equations::Error>) -> Self {
        // What follows belongs to names that were refused.
        if self.wrong.is_some() {
            return self;
        }
        match (Label::new(name), field) {
            (Err(error), _) => self.refused(error),
            (_, Err(error)) => self.refused(error),
            (Ok(name), _) if self.modes.iter().any(|mode| mode.name == name) => {
                self.refused(Error::BadEquations {
                    what: name.to_string(),
                    reason: "a mode has it already",
                })
            }
            (Ok(name), Ok(field)) => {
                self = self.functions(&field.names().functions);
                self.modes.push(ModeEquations { name, field, guards: vec![], after_limit: None });
                self
            }
        }
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
        if self.wrong.is_some() {
            return self;
        }
        let times = Formulas::new(self.names.clone(), |_, _, p| times(p));
        self.add_clock(surface, times)
    }

    /// The same, from texts: the first time and the period.
    #[must_use]
    pub fn clock_text(self, surface: &str, first: &str, period: &str) -> Self {
        let times = Formulas::from_text(self.names.clone(), &[first, period]);
        self.add_clock(surface, times)
    }

    /// Adds a clock: events at these times, which follow from the parameters and rise. A time that is not later than the start
    /// has no event.
    #[must_use]
    pub fn ticks(
        self,
        surface: &str,
        times: impl for<'g> Fn(&Parameters<'g>) -> Vec<Expression<'g>>,
    ) -> Self {
        if self.wrong.is_some() {
            return self;
        }
        let times = Formulas::of_vector(self.names.clone(), |_, _, p| times(p));
        self.add_ticks(surface, times)
    }

    /// The same, from texts.
    #[must_use]
    pub fn ticks_text(self, surface: &str, times: &[&str]) -> Self {
        let times = Formulas::from_text(self.names.clone(), times);
        self.add_ticks(surface, times)
    }

    fn add_ticks(self, surface: &str, times: Result<Formulas, equations::Error>) -> Self {
        self.add_clock(surface, times).with_last(|guard| guard.listed = true)
    }

    fn add_clock(self, surface: &str, times: Result<Formulas, equations::Error>) -> Self {
        self.guard(surface, Direction::Either, times).with_last(|guard| {
            guard.guard.role = Role::Clock;
        })
    }

    fn guard(
        mut self,
        surface: &str,
        direction: Direction,
        function: Result<Formulas, equations::Error>,
    ) -> Self {
        if self.wrong.is_some() {
            return self;
        }
        match (Label::new(surface), function) {
            (Err(error), _) => self.refused(error),
            (_, Err(error)) => self.refused(error),
            (Ok(surface), Ok(function)) => {
                // A switch, once its event does something.
                let guard = Guard { surface, direction, role: Role::Switch, touch: Touch::Error };
                self = self.functions(&function.names().functions);
                let jump = Some(Jump::default());
                let added =
                    GuardEquations { guard, function, listed: false, condition: None, jump };
                match self.modes.last_mut() {
                    Some(mode) => mode.guards.push(added),
                    None => self.everywhere.push(added),
                }
                self
            }
        }
    }

    fn last_guard(&mut self) -> Option<&mut GuardEquations> {
        match self.modes.last_mut() {
            Some(mode) => mode.guards.last_mut(),
            None => self.everywhere.last_mut(),
        }
    }

    /// Changes the guard that was added last.
    fn with_last(mut self, change: impl FnOnce(&mut GuardEquations)) -> Self {
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

    /// Changes what the event of the guard that was added last does.
    fn with_jump(self, change: impl FnOnce(&mut Jump)) -> Self {
        self.with_last(|guard| change(guard.jump.get_or_insert_default()))
    }

    /// The events of the last guard count only where h(t, x), at the state before the event, is positive. Where it is negative
    /// the flow goes on as if there were no guard. The guard becomes a [crossing](Self::crossing).
    ///
    /// An event at which the sign of h is lost in rounding is [`Error::UndecidedCondition`].
    ///
    /// ```
    /// use hybrid_system::{Equations, State};
    /// // A ball rolls off a table that ends at x = 1, and falls to the floor below.
    /// let ball = Equations::new(&["x", "y", "u", "v"], &[])
    ///     .mode_text("flight", &["u", "v", "0", "-1"])
    ///     .falling_text("table", "y")
    ///     .only_where_text("1 - x")
    ///     .resets_text(&["x", "y", "u", "-v"])
    ///     .falling_text("floor", "y + 1")
    ///     .resets_text(&["x", "y", "u", "-v"])
    ///     .model::<State<4>>()?;
    /// let mut surfaces = Vec::new();
    /// for arc in ball.start("flight", [0.0, 0.5, 0.3, 0.0], 9.0)? {
    ///     surfaces.extend(arc?.event().map(|event| event.surface));
    /// }
    /// assert_eq!(surfaces, ["table", "table", "floor"]);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    #[must_use]
    pub fn only_where(
        self,
        condition: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> Expression<'g>,
    ) -> Self {
        if self.wrong.is_some() {
            return self;
        }
        let condition = Formulas::new(self.names.clone(), |t, x, p| [condition(t, x, p)]);
        self.with_condition(condition)
    }

    /// The same, from text.
    #[must_use]
    pub fn only_where_text(self, condition: &str) -> Self {
        let condition = Formulas::from_text(self.names.clone(), &[condition]);
        self.with_condition(condition)
    }

    fn with_condition(self, condition: Result<Formulas, equations::Error>) -> Self {
        match condition {
            _ if self.wrong.is_some() => self,
            Ok(condition) => {
                let known = self.functions(&condition.names().functions);
                known.with_last(|guard| guard.condition = Some(condition)).crossing()
            }
            Err(error) => self.refused(error),
        }
    }

    /// The event of the last guard leads to this mode.
    #[must_use]
    pub fn to(self, mode: &str) -> Self {
        match Label::new(mode) {
            Ok(mode) => self.with_jump(|jump| jump.mode = Some(mode)),
            Err(error) => self.refused(error),
        }
    }

    /// The event of the last guard leads to this state.
    #[must_use]
    pub fn resets<const N: usize>(
        self,
        state: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> [Expression<'g>; N],
    ) -> Self {
        self.resets_vector(|t, x, p| state(t, x, p).into())
    }

    /// The same, from a closure that returns a vector: for a number of components that is known when it runs.
    #[must_use]
    pub fn resets_vector(
        self,
        state: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> Vec<Expression<'g>>,
    ) -> Self {
        if self.wrong.is_some() {
            return self;
        }
        let state = Formulas::of_vector(self.names.clone(), state);
        self.with_state(state)
    }

    /// The same, from texts.
    #[must_use]
    pub fn resets_text(self, state: &[&str]) -> Self {
        let state = Formulas::from_text(self.names.clone(), state);
        self.with_state(state)
    }

    fn with_state(self, state: Result<Formulas, equations::Error>) -> Self {
        match state {
            _ if self.wrong.is_some() => self,
            Ok(state) => {
                let known = self.functions(&state.names().functions);
                known.with_jump(|jump| jump.state = Some(state))
            }
            Err(error) => self.refused(error),
        }
    }

    /// The state before the event of the last guard, from the state after it: the inverse of its [`resets`](Self::resets), for
    /// [`reversed`](Self::reversed).
    #[must_use]
    pub fn inverse<const N: usize>(
        self,
        state: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> [Expression<'g>; N],
    ) -> Self {
        if self.wrong.is_some() {
            return self;
        }
        let state = Formulas::new(self.names.clone(), state);
        self.with_inverse(state)
    }

    /// The same, from texts.
    #[must_use]
    pub fn inverse_text(self, state: &[&str]) -> Self {
        let state = Formulas::from_text(self.names.clone(), state);
        self.with_inverse(state)
    }

    fn with_inverse(self, state: Result<Formulas, equations::Error>) -> Self {
        match state {
            _ if self.wrong.is_some() => self,
            Ok(state) => {
                let known = self.functions(&state.names().functions);
                known.with_jump(|jump| jump.inverse = Some(state))
            }
            Err(error) => self.refused(error),
        }
    }

    /// The event of the last guard ends the execution.
    #[must_use]
    pub fn stops(self) -> Self {
        self.with_jump(|_| ()).with_last(|guard| guard.jump = None)
    }

    /// The last guard is a contact that holds, such as a floor: see [`Role::Contact`].
    #[must_use]
    pub fn contact(self) -> Self {
        self.with_role(Role::Contact)
    }

    /// The last guard is crossed in flight alone: see [`Role::Crossing`].
    #[must_use]
    pub fn crossing(self) -> Self {
        self.with_role(Role::Crossing)
    }

    /// A clock stays one.
    fn with_role(self, role: Role) -> Self {
        self.with_last(|guard| {
            if guard.guard.role != Role::Clock {
                guard.guard.role = role;
            }
        })
    }

    /// What a touch of the last guard is.
    #[must_use]
    pub fn touch(self, touch: Touch) -> Self {
        self.with_last(|guard| guard.guard.touch = touch)
    }

    /// After infinitely many events of the last mode in finite time the execution goes on in this mode, at the limit.
    #[must_use]
    pub fn rests(self, mode: &str) -> Self {
        self.with_rest(mode, None)
    }

    /// The same, from another state than the limit, of which the closure makes it.
    #[must_use]
    pub fn rests_at<const N: usize>(
        self,
        mode: &str,
        state: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> [Expression<'g>; N],
    ) -> Self {
        if self.wrong.is_some() {
            return self;
        }
        match Formulas::new(self.names.clone(), state) {
            Ok(state) => self.functions(&state.names().functions).with_rest(mode, Some(state)),
            Err(error) => self.refused(error),
        }
    }

    fn with_rest(mut self, mode: &str, state: Option<Formulas>) -> Self {
        match (Label::new(mode), self.modes.last_mut()) {
            (Err(error), _) => self.refused(error),
            (Ok(mode), Some(last)) => {
                last.after_limit = Some(Jump { mode: Some(mode), state, inverse: None });
                self
            }
            (Ok(mode), None) => {
                self.refused(Error::BadEquations { what: mode.to_string(), reason: NO_MODE })
            }
        }
    }
}
