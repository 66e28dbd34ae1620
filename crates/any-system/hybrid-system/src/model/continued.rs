//! Parts that say how an execution continues where no event leads on: after a Zeno limit, and at a sliding point.
//! The field of a flow in closed form, which a sliding point needs.

use super::part::ModelPart;
use crate::sliding::Sliding;

/// The field of a flow in closed form.
#[derive(Debug, Clone, Copy)]
pub struct Field<F>(pub(super) F);

impl<M, S, X, Y, F> ModelPart<M, S, X> for Field<F>
where
    Y: Into<X>,
    F: Fn(M, &X) -> Y,
{
    #[inline]
    fn field(&self, mode: M, state: &X) -> Option<X> {
        Some((self.0)(mode, state).into())
    }
}

/// Mode and state after a Zeno limit.
#[derive(Debug, Clone, Copy)]
pub struct Rest<F>(pub(super) F);

impl<M, S, X, Y, F> ModelPart<M, S, X> for Rest<F>
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

impl<M, S, X, Y, F> ModelPart<M, S, X> for Slide<F>
where
    Y: Into<X>,
    F: Fn(&Sliding<M, S, X>) -> Option<(M, Y)>,
{
    fn slide(&self, sliding: &Sliding<M, S, X>) -> Option<(M, X)> {
        (self.0)(sliding).map(|(mode, state)| (mode, state.into()))
    }
}
