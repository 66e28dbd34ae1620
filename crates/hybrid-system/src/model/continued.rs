//! Parts that say how an execution continues where no event leads on: after a Zeno limit, and at a sliding point.

use super::part::Part;
use crate::sliding::Sliding;

/// Mode and state after a Zeno limit.
#[derive(Debug, Clone, Copy)]
pub struct Rest<F>(pub(super) F);

impl<M, S, X, Y, F> Part<M, S, X> for Rest<F>
where
    Y: Into<X>,
    F: Fn(M, &X) -> Option<(M, Y)>,
{
    fn rest(&self, mode: M, limit: &X) -> Option<(M, X)> {
        (self.0)(mode, limit).map(|(mode, state)| (mode, state.into()))
    }
}

/// Mode and state on a surface at which the fields on both sides point.
#[derive(Debug, Clone, Copy)]
pub struct Slide<F>(pub(super) F);

impl<M, S, X, Y, F> Part<M, S, X> for Slide<F>
where
    Y: Into<X>,
    F: Fn(&Sliding<M, S, X>) -> Option<(M, Y)>,
{
    fn slide(&self, sliding: &Sliding<M, S, X>) -> Option<(M, X)> {
        (self.0)(sliding).map(|(mode, state)| (mode, state.into()))
    }
}
