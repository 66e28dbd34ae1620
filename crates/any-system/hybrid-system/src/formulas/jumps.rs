//! How equations say what events do: jumps, conditions, roles, rests.

use super::equations::{Equations, Jump, NO_MODE};
use super::label::Label;
use crate::error::Error;
use crate::guard::{Role, Touch};
use equations::{Expression, Formulas, Names, Parameters, States};

impl Equations {
    /// Changes what the event of the guard that was added last does.
    fn with_jump(self, change: impl FnOnce(&mut Jump)) -> Self {
        self.with_last(|guard| change(guard.jump.get_or_insert_default()))
    }

    /// The events of the last guard count only where h(t, x), at the state before the event, is positive. Where it is negative
    /// the flow goes on as if there were no guard. The guard becomes a [crossing](Self::crossing).
    ///
    /// An event at which the sign of h is lost in rounding is [`ConditionError::Undecided`](crate::ConditionError::Undecided). So is one
    /// at which h has no value. A guard that is declared a contact or a switch later is an error. Of several conditions all must hold.
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
        self.with_condition(|names| Formulas::new(names, |t, x, p| [condition(t, x, p)]))
    }

    /// The same, from text.
    #[must_use]
    pub fn only_where_text(self, condition: &str) -> Self {
        self.with_condition(|names| Formulas::from_text(names, &[condition]))
    }

    fn with_condition(
        self,
        condition: impl FnOnce(Names) -> Result<Formulas, equations::Error>,
    ) -> Self {
        self.take(condition, |known, condition| {
            let mut wrong = None;
            let known = known.with_last(|guard| {
                // All conditions must hold.
                let all = match &guard.condition {
                    Some(own) => own.minimum(&condition),
                    None => Ok(condition),
                };
                match all {
                    Ok(all) => guard.condition = Some(all),
                    Err(error) => wrong = Some(error),
                }
            });
            match wrong {
                Some(error) => known.refused(error),
                None => known.crossing(),
            }
        })
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
        self.with_state(|names| Formulas::of_vector(names, state))
    }

    /// The same, from texts.
    #[must_use]
    pub fn resets_text(self, state: &[&str]) -> Self {
        self.with_state(|names| Formulas::from_text(names, state))
    }

    fn with_state(self, state: impl FnOnce(Names) -> Result<Formulas, equations::Error>) -> Self {
        self.take(state, |known, state| known.with_jump(|jump| jump.state = Some(state)))
    }

    /// The state before the event of the last guard, from the state after it: the inverse of its [`resets`](Self::resets), for
    /// [`reversed`](Self::reversed). At each event it is compared with `resets`: an error if they do not fit.
    #[must_use]
    pub fn inverse<const N: usize>(
        self,
        state: impl for<'g> Fn(Expression<'g>, &States<'g>, &Parameters<'g>) -> [Expression<'g>; N],
    ) -> Self {
        self.with_inverse(|names| Formulas::new(names, state))
    }

    /// The same, from texts.
    #[must_use]
    pub fn inverse_text(self, state: &[&str]) -> Self {
        self.with_inverse(|names| Formulas::from_text(names, state))
    }

    fn with_inverse(self, state: impl FnOnce(Names) -> Result<Formulas, equations::Error>) -> Self {
        self.take(state, |known, state| known.with_jump(|jump| jump.inverse = Some(state)))
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
        self.take(
            |names| Formulas::new(names, state),
            |known, state| known.with_rest(mode, Some(state)),
        )
    }

    /// The same, from texts.
    #[must_use]
    pub fn rests_at_text(self, mode: &str, state: &[&str]) -> Self {
        self.take(
            |names| Formulas::from_text(names, state),
            |known, state| known.with_rest(mode, Some(state)),
        )
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
