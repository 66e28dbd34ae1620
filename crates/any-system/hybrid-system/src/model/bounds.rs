//! Parts with bounds on a guard along the flow, so that its crossings are found with certainty.

use super::part::ModelPart;
use crate::crossing::QuasiPolynomial;
use interval_arithmetic::Enclosure;

/// A guard along the flow as a quasi-polynomial.
#[derive(Debug, Clone, Copy)]
pub struct Signal<S, F> {
    pub(super) surface: S,
    pub(super) signal: F,
}

impl<M, S, X, F> ModelPart<M, S, X> for Signal<S, F>
where
    S: Copy + Eq,
    F: Fn(M, &X) -> Option<QuasiPolynomial>,
{
    fn unknown_surface(&self, known: &dyn Fn(S) -> bool) -> Option<S> {
        (!known(self.surface)).then_some(self.surface)
    }
    #[inline]
    fn quasi_polynomial(&self, mode: M, surface: S, start: &X) -> Option<QuasiPolynomial> {
        if surface == self.surface { (self.signal)(mode, start) } else { None }
    }
}

/// Enclosures of a guard and its derivatives along the flow.
#[derive(Debug, Clone, Copy)]
pub struct GuardEnclosure<S, F> {
    pub(super) surface: S,
    pub(super) enclosure: F,
}

impl<M, S, X, F> ModelPart<M, S, X> for GuardEnclosure<S, F>
where
    S: Copy + Eq,
    F: Fn(M, &X, u32, (f64, f64)) -> Option<Enclosure>,
{
    fn unknown_surface(&self, known: &dyn Fn(S) -> bool) -> Option<S> {
        (!known(self.surface)).then_some(self.surface)
    }
    #[inline]
    fn enclosure(
        &self,
        mode: M,
        surface: S,
        start: &X,
        order: u32,
        times: (f64, f64),
    ) -> Option<Enclosure> {
        if surface == self.surface { (self.enclosure)(mode, start, order, times) } else { None }
    }
}
