//! The part with the condition of a guard.

use super::model::Model;
use super::part::ModelPart;
use crate::guard::Role;
use std::fmt::Debug;

/// The condition of a guard.
#[derive(Debug, Clone, Copy)]
pub struct Condition<S, H> {
    pub(super) surface: S,
    pub(super) condition: H,
}

impl<M, S, X, H> ModelPart<M, S, X> for Condition<S, H>
where
    S: Copy + Eq,
    H: Fn(&X) -> f64,
{
    fn unknown_surface(&self, known: &dyn Fn(S) -> bool) -> Option<S> {
        (!known(self.surface)).then_some(self.surface)
    }
    #[inline]
    fn condition(&self, _: M, surface: S, before: &X) -> Option<f64> {
        (surface == self.surface).then(|| (self.condition)(before))
    }
}

// Each part of a model has a type of its own.
#[allow(clippy::type_complexity)]
impl<M, S, X, F, P> Model<M, S, X, F, P>
where
    M: Copy + Eq,
    S: Copy + Eq + Debug,
{
    /// Lets the events of this surface count only where h(x), at the state before the event, is positive. Where it is
    /// negative the flow goes on as if there were no guard. The guard becomes a [crossing](crate::Guard::crossing). The condition
    /// holds in all modes that have this surface. Of several conditions all must hold.
    ///
    /// An event at which the sign of h is lost in rounding is [`ConditionError::Undecided`](crate::ConditionError::Undecided). So is one
    /// at which h has no value. A guard that is declared a contact or a switch later is an error.
    ///
    #[cfg_attr(feature = "ode", doc = "```")]
    #[cfg_attr(not(feature = "ode"), doc = "```ignore")]
    /// use hybrid_system::{Model, State};
    /// // A ball rolls off a table that ends at x = 1, and falls to the floor below.
    /// let ball = Model::integrated(|(), x: &State<4>| [x[2], x[3], 0.0, -1.0])
    ///     .falling((), |x| x[1], |x| ((), [x[0], x[1], x[2], -x[3]]))
    ///     .only_where(0, |x| 1.0 - x[0])
    ///     .falling((), |x| x[1] + 1.0, |x| ((), [x[0], x[1], x[2], -x[3]]));
    /// let surfaces: Vec<usize> = ball
    ///     .run((), [0.0, 0.5, 0.3, 0.0], 9.0)
    ///     .filter_map(|arc| arc.ok()?.event().map(|event| event.surface))
    ///     .collect();
    /// assert_eq!(surfaces, [0, 0, 1]);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    pub fn only_where<H>(
        mut self,
        surface: S,
        condition: H,
    ) -> Model<M, S, X, F, (Condition<S, H>, P)>
    where
        H: Fn(&X) -> f64,
    {
        self.guards.declare(None, surface, Role::Crossing);
        self.with(Condition { surface, condition })
    }
}
