//! What a state beyond the surface of a guard means, in one word behind the guard.

use super::model::Model;
use crate::guard::Role;
use std::fmt::Debug;

impl<M, S, X, F, P, C> Model<M, S, X, F, P, C>
where
    M: Copy + Eq,
    S: Copy + Eq + Debug,
{
    /// Declares the guard that was added last a contact that holds, such as a floor: the mode flows on one side of
    /// it, and a jump to a state beyond it is an event at once.
    ///
    /// Without this word, and without [`crossing`](Self::crossing), such a jump is the error
    /// [`LandsBeyond`](crate::Error::LandsBeyond).
    pub fn contact(mut self) -> Self {
        self.guards.declare_last(Role::Contact);
        self
    }

    /// Declares the guard that was added last a crossing: an event only where the flow crosses its surface, such as the
    /// touchdown of a leg that takes off below the height of its touchdown. The mode flows on both sides.
    pub fn crossing(mut self) -> Self {
        self.guards.declare_last(Role::Crossing);
        self
    }
}
