//! The rate ġ of a guard along the flow of a mode, from the best source that the model gives.

use super::directional::{Estimate, slope_along};
use crate::crossing::{QuasiPolynomial, guard_rounding, stated_or_measured};
use crate::system::HybridSystem;

/// The first two derivatives of a guard along a flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GuardRates {
    /// ġ.
    pub(crate) first: Estimate,
    /// g̈; `None` if the model does not give it.
    pub(crate) second: Option<Estimate>,
}

impl GuardRates {
    /// The side to which the guard leaves a zero, ±1: the sign of the first derivative that is not zero within its
    /// error. `None` if both are hidden.
    pub(crate) fn side(&self) -> Option<f64> {
        if self.first.is_hidden() {
            return self.second.and_then(Estimate::sign);
        }
        self.first.sign()
    }
}

/// The rates of the guard of `surface` along the flow of `mode` at `state`, with errors that contain the rounding
/// of the state. `None` if the model gives neither a quasi-polynomial nor enclosures nor a field.
///
/// | the model gives | ġ | error |
/// |---|---|---|
/// | a quasi-polynomial | its derivative | measured: the change under the rounding of the state |
/// | enclosures of order 1 | the middle of the interval | half its width |
/// | a field | the difference of order eight along the field | the distance from order six, and rounding |
pub(crate) fn guard_rates<T: HybridSystem>(
    system: &T,
    mode: T::Mode,
    surface: T::Surface,
    state: &T::State,
) -> Option<GuardRates> {
    by_quasi_polynomial(system, mode, surface, state)
        .or_else(|| by_enclosure(system, mode, surface, state))
        .or_else(|| by_field(system, mode, surface, state))
}

fn by_quasi_polynomial<T: HybridSystem>(
    system: &T,
    mode: T::Mode,
    surface: T::Surface,
    state: &T::State,
) -> Option<GuardRates> {
    let derivative = |state: &T::State| {
        let guard = system.guard_quasi_polynomial(mode, surface, state);
        guard.map(|guard: QuasiPolynomial| guard.derivative())
    };
    let first = derivative(state)?;
    let value = |state: &T::State| derivative(state).map_or(f64::NAN, |first| first.value(0.0));
    let bend = |state: &T::State| {
        derivative(state).map_or(f64::NAN, |first| first.derivative().value(0.0))
    };
    let estimate = |value: f64, error: f64| Estimate {
        value,
        error: error + 2.0 * f64::EPSILON * value.abs(),
    };
    Some(GuardRates {
        first: estimate(first.value(0.0), guard_rounding(state, state, &value)),
        second: Some(estimate(first.derivative().value(0.0), guard_rounding(state, state, &bend))),
    })
}

fn by_enclosure<T: HybridSystem>(
    system: &T,
    mode: T::Mode,
    surface: T::Surface,
    state: &T::State,
) -> Option<GuardRates> {
    let derivative = |order| {
        let interval = system.guard_enclosure(mode, surface, state, order, (0.0, 0.0))?;
        let middle = interval.low() + 0.5 * (interval.high() - interval.low());
        Some(Estimate { value: middle, error: 0.5 * (interval.high() - interval.low()) })
    };
    Some(GuardRates { first: derivative(1)?, second: derivative(2) })
}

fn by_field<T: HybridSystem>(
    system: &T,
    mode: T::Mode,
    surface: T::Surface,
    state: &T::State,
) -> Option<GuardRates> {
    let field = system.vector_field(mode, state)?;
    let guard = |state: &T::State| system.guard_value(surface, state);
    let rounding = stated_or_measured(system.guard_error(surface, state), state, &guard);
    // L_f g(x) = ∇g·f, at any state.
    let rate = |state: &T::State| {
        let field = system.vector_field(mode, state);
        field.map_or(f64::NAN, |field| slope_along(&guard, state, &field, rounding).value)
    };
    let mut first = slope_along(&guard, state, &field, rounding);
    first.error += guard_rounding(state, state, &rate);
    // g̈ = L_f L_f g. The differences of the rate have the errors of the rate.
    let second = slope_along(&rate, state, &field, first.error);
    Some(GuardRates { first, second: Some(second) })
}
