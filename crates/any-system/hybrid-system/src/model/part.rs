//! The parts of a model besides its motion: each answers for its own surface, and the pair of two parts asks the first
//! one first.

use crate::crossing::QuasiPolynomial;
use crate::error::Error;
use crate::sliding::Sliding;
use crate::system::Reset;
use interval_arithmetic::Enclosure;

/// The smaller one; NaN if one is NaN, which decides nothing.
pub(crate) fn smaller(first: f64, second: f64) -> f64 {
    if first < second || first.is_nan() { first } else { second }
}

/// Writes the methods of a part: by default each is `None`, and a pair asks its first part first.
macro_rules! methods {
    ($($(#[$about:meta])* fn $name:ident($($argument:ident: $kind:ty),*) -> $answer:ty;)*) => {
        /// A part of a [`Model`](crate::Model). Each method answers for the surfaces of the part, and with `None` for
        /// all others.
        pub trait ModelPart<M, S, X> {
            $($(#[$about])*
            #[inline]
            fn $name(&self, $($argument: $kind),*) -> Option<$answer> {
                let _ = ($($argument,)*);
                None
            })*
            /// Where an event counts: at the states at which this is positive. Of several conditions all must hold.
            #[inline]
            fn condition(&self, mode: M, surface: S, before: &X) -> Option<f64> {
                let _ = (mode, surface, before);
                None
            }
            /// A value of a guard function of this surface, if it differs from `value`. Two NaN count as equal: the
            /// search reports them.
            fn other_value(&self, surface: S, state: &X, value: f64) -> Option<f64> {
                let own = self.value(surface, state);
                own.filter(|own| *own != value && !(own.is_nan() && value.is_nan()))
            }
        }

        impl<M, S, X, A, B> ModelPart<M, S, X> for (A, B)
        where
            M: Copy,
            S: Copy,
            A: ModelPart<M, S, X>,
            B: ModelPart<M, S, X>,
        {
            $(#[inline]
            fn $name(&self, $($argument: $kind),*) -> Option<$answer> {
                self.0.$name($($argument),*).or_else(|| self.1.$name($($argument),*))
            })*
            #[inline]
            fn condition(&self, mode: M, surface: S, before: &X) -> Option<f64> {
                let [first, second] =
                    [self.0.condition(mode, surface, before), self.1.condition(mode, surface, before)];
                match (first, second) {
                    (Some(first), Some(second)) => Some(smaller(first, second)),
                    (one, other) => one.or(other),
                }
            }
            fn other_value(&self, surface: S, state: &X, value: f64) -> Option<f64> {
                let first = self.0.other_value(surface, state, value);
                first.or_else(|| self.1.other_value(surface, state, value))
            }
        }
    };
}

methods! {
    /// g(x).
    fn value(surface: S, state: &X) -> f64;
    /// A bound on the rounding of a guard's own arithmetic.
    fn guard_error(surface: S, state: &X) -> f64;
    /// The gradient of a guard, if the part has a formula for it.
    fn gradient(surface: S, state: &X) -> X;
    /// ∂x⁺/∂x⁻ₖ of a reset, if the part has a formula for it.
    fn reset_column(mode: M, surface: S, before: &X, column: usize) -> X;
    /// A surface that has bounds in this part, and is not among the `known` ones.
    fn unknown_surface(known: &dyn Fn(S) -> bool) -> S;
    /// Mode and state after an event.
    fn reset(mode: M, surface: S, before: &X) -> Reset<M, X>;
    /// The error of a guard by that of the start.
    fn start_error(surface: S, start: &X) -> f64;
    /// True for an observer.
    fn observes(surface: S) -> bool;
    /// Why the state after an event, or a Zeno limit, is not finite.
    fn reset_error(mode: M, surface: Option<S>, before: &X, time: f64) -> Error;
    /// The next preset time. The outer `None` means that the surface belongs to another part.
    fn next_time(mode: M, surface: S, after: f64) -> Option<f64>;
    /// The guard along the flow.
    fn quasi_polynomial(mode: M, surface: S, start: &X) -> QuasiPolynomial;
    /// Bounds on the guard along the flow.
    fn enclosure(mode: M, surface: S, start: &X, order: u32, times: (f64, f64)) -> Enclosure;
    /// f(x) of a flow in closed form.
    fn field(mode: M, state: &X) -> X;
    /// Mode and state after a Zeno limit.
    fn rest(mode: M, limit: &X) -> (M, X);
    /// Mode and state on a surface at which both fields point.
    fn slide(sliding: &Sliding<M, S, X>) -> (M, X);
}

/// A model without parts.
impl<M, S, X> ModelPart<M, S, X> for () {}
