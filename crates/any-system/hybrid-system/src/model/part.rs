//! The parts of a model besides its motion: each answers for its own surface, and the pair of two parts asks the first
//! one first.

use crate::crossing::QuasiPolynomial;
use crate::sliding::Sliding;
use crate::system::Reset;
use interval_arithmetic::Enclosure;

/// A part of a [`Model`](crate::Model). Each method answers for the surfaces of the part, and with `None` for all
/// others.
pub trait ModelPart<M, S, X> {
    /// g(x).
    #[inline]
    fn value(&self, surface: S, state: &X) -> Option<f64> {
        let _ = (surface, state);
        None
    }
    /// A value of a guard function of this surface, if it differs from `value`.
    fn other_value(&self, surface: S, state: &X, value: f64) -> Option<f64> {
        let _ = (surface, state, value);
        None
    }
    /// A surface that has bounds in this part, and is not among the `known` ones.
    fn unknown_surface(&self, known: &dyn Fn(S) -> bool) -> Option<S> {
        let _ = known;
        None
    }
    /// Mode and state after an event.
    #[inline]
    fn reset(&self, mode: M, surface: S, before: &X) -> Option<Reset<M, X>> {
        let _ = (mode, surface, before);
        None
    }
    /// The next preset time. The outer `None` means that the surface belongs to another part.
    #[inline]
    fn next_time(&self, mode: M, surface: S, after: f64) -> Option<Option<f64>> {
        let _ = (mode, surface, after);
        None
    }
    /// The guard along the flow.
    #[inline]
    fn quasi_polynomial(&self, mode: M, surface: S, start: &X) -> Option<QuasiPolynomial> {
        let _ = (mode, surface, start);
        None
    }
    /// Bounds on the guard along the flow.
    #[inline]
    fn enclosure(
        &self,
        mode: M,
        surface: S,
        start: &X,
        order: u32,
        times: (f64, f64),
    ) -> Option<Enclosure> {
        let _ = (mode, surface, start, order, times);
        None
    }
    /// f(x) of a flow in closed form.
    #[inline]
    fn field(&self, mode: M, state: &X) -> Option<X> {
        let _ = (mode, state);
        None
    }
    /// Mode and state after a Zeno limit.
    fn rest(&self, mode: M, limit: &X) -> Option<(M, X)> {
        let _ = (mode, limit);
        None
    }
    /// Mode and state on a surface at which both fields point.
    fn slide(&self, sliding: &Sliding<M, S, X>) -> Option<(M, X)> {
        let _ = sliding;
        None
    }
}

/// A model without parts.
impl<M, S, X> ModelPart<M, S, X> for () {}

impl<M: Copy, S: Copy, X, A: ModelPart<M, S, X>, B: ModelPart<M, S, X>> ModelPart<M, S, X>
    for (A, B)
{
    #[inline]
    fn value(&self, surface: S, state: &X) -> Option<f64> {
        self.0.value(surface, state).or_else(|| self.1.value(surface, state))
    }
    fn other_value(&self, surface: S, state: &X, value: f64) -> Option<f64> {
        let first = self.0.other_value(surface, state, value);
        first.or_else(|| self.1.other_value(surface, state, value))
    }
    fn unknown_surface(&self, known: &dyn Fn(S) -> bool) -> Option<S> {
        self.0.unknown_surface(known).or_else(|| self.1.unknown_surface(known))
    }
    #[inline]
    fn reset(&self, mode: M, surface: S, before: &X) -> Option<Reset<M, X>> {
        self.0.reset(mode, surface, before).or_else(|| self.1.reset(mode, surface, before))
    }
    #[inline]
    fn next_time(&self, mode: M, surface: S, after: f64) -> Option<Option<f64>> {
        self.0.next_time(mode, surface, after).or_else(|| self.1.next_time(mode, surface, after))
    }
    #[inline]
    fn quasi_polynomial(&self, mode: M, surface: S, start: &X) -> Option<QuasiPolynomial> {
        let first = self.0.quasi_polynomial(mode, surface, start);
        first.or_else(|| self.1.quasi_polynomial(mode, surface, start))
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
        let first = self.0.enclosure(mode, surface, start, order, times);
        first.or_else(|| self.1.enclosure(mode, surface, start, order, times))
    }
    #[inline]
    fn field(&self, mode: M, state: &X) -> Option<X> {
        self.0.field(mode, state).or_else(|| self.1.field(mode, state))
    }
    fn rest(&self, mode: M, limit: &X) -> Option<(M, X)> {
        self.0.rest(mode, limit).or_else(|| self.1.rest(mode, limit))
    }
    fn slide(&self, sliding: &Sliding<M, S, X>) -> Option<(M, X)> {
        self.0.slide(sliding).or_else(|| self.1.slide(sliding))
    }
}
