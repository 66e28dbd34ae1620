//! One guard for which the model gives bounds.

use super::bounded::Bounded;
use super::enclosure_search::EnclosedGuard;
use super::found::Found;
use super::guard_rounding::{is_far, range};
use super::guarded_flow::GuardedFlow;
use super::one_guard::OneGuard;
use super::quasi_polynomial_search::BoundedQuasiPolynomial;
use super::search_request::Search;
use super::zero_search::ZeroSearch;
use crate::error::Error;
use crate::guard::{Guard, Touch};
use crate::state::StateVector;
use interval_arithmetic::Enclosure;

/// The first event of one guard up to `until`, under the bounds that the model gives; `None` if the model gives none.
///
/// # Errors
/// [`Error::BadLimit`] if there are bounds and `until` is infinite: halving an infinite interval does not end.
pub(crate) fn event_under_bounds<F: GuardedFlow>(
    flow: &F,
    guard: Guard<F::Surface>,
    search: &Search<F::Surface>,
    until: f64,
) -> Result<Option<OneGuard>, Error> {
    let surface = guard.surface;
    let finite = || match until.is_finite() && until >= 0.0 {
        true => Ok(()),
        false => {
            Err(Error::BadLimit { what: "the horizon of a search under bounds", value: until })
        }
    };
    if let Some(function) = flow.quasi_polynomial(surface) {
        finite()?;
        let bounded = BoundedQuasiPolynomial::new(&function, until)?;
        if bounded.stays_away(until) {
            return Ok(Some(OneGuard::Quiet));
        }
        return first_event(flow, guard, search, &bounded, until).map(Some);
    }
    // The interval has length zero: the call only tests whether the model gives enclosures of this guard.
    if flow.enclosure(surface, 0, (0.0, 0.0)).is_none() {
        return Ok(None);
    }
    finite()?;
    let value = |time: f64| flow.guard_at(surface, time);
    let enclosure = |order, times| flow.enclosure(surface, order, times);
    first_event(flow, guard, search, &EnclosedGuard { value, enclosure }, until).map(Some)
}

/// A guard along a flow as its search sees it: its quasi-polynomial, if the model gives one, else its value.
pub(crate) fn as_searched<F: GuardedFlow>(flow: &F, surface: F::Surface, time: f64) -> f64 {
    match flow.quasi_polynomial(surface) {
        Some(function) => match BoundedQuasiPolynomial::new(&function, time) {
            Ok(bounded) => bounded.value(time),
            Err(_) => f64::NAN,
        },
        None => flow.guard_at(surface, time),
    }
}

/// The bounds at the start and the value of the guard there may differ by this part of the guard's size: a model
/// may compute both in different ways. A larger number would let more wrong bounds pass; a smaller one would refuse
/// models that lose digits.
const AGREEMENT: f64 = 1e-6;

/// An error if the bounds at the start do not contain the value of the guard. Wrong bounds elsewhere are not seen.
fn check_bounds_at_start<F: GuardedFlow>(
    flow: &F,
    surface: F::Surface,
    bounds: Enclosure,
) -> Result<(), Error> {
    let (low, high) = (bounds.low(), bounds.high());
    let (start, guard) = (flow.start(), |state: &F::State| flow.guard_value(surface, state));
    let value = guard(start);
    let outside = (low - value).max(value - high);
    if outside > AGREEMENT * value.abs()
        && outside > AGREEMENT * range(start, start.largest(), value, guard)
    {
        let surface = format!("{surface:?}");
        return Err(Error::WrongBounds { surface, value, low, high });
    }
    Ok(())
}

fn first_event<F: GuardedFlow>(
    flow: &F,
    guard: Guard<F::Surface>,
    search: &Search<F::Surface>,
    bounded: &impl Bounded,
    until: f64,
) -> Result<OneGuard, Error> {
    let Guard { surface, direction, touch, .. } = guard;
    let (at_start, start) = (bounded.at(0.0)?, flow.start());
    check_bounds_at_start(flow, surface, at_start)?;
    let leaving = search.side(surface);
    // The usual case, a guard far from its surface, needs no estimate of the rounding of the state.
    let far = || {
        let value = |state: &F::State| flow.guard_value(surface, state);
        let now = value(start);
        let stated = flow.guard_error(surface, start).unwrap_or(0.0);
        stated < now.abs() && is_far(start, start.largest(), now, value)
    };
    let error = match leaving.is_none() && at_start.sign().is_some() && far() {
        true => 0.0,
        false => flow.rounding_at(surface, start),
    };
    let (value, now) = (bounded.value(0.0), flow.guard_value(surface, start));
    let mut zeros = match search.side_before(surface) {
        // The bounds show the side: its two zeros beside a touch must not be taken for rounding of the start.
        Some(side) if at_start.sign() == Some(side) => ZeroSearch::on_side(direction, 0.0, side),
        Some(side) => {
            let error = error.max(at_start.magnitude());
            ZeroSearch::before_zero(direction, 0.0, side, error)
        }
        // Where the start rule has seen a side, it is the side, however wide the bounds: the zero is ahead.
        None if leaving.is_none()
            && at_start.widened(error).sign().is_none()
            && now.abs() > error =>
        {
            ZeroSearch::before_zero(direction, 0.0, now.signum(), at_start.magnitude())
        }
        None => ZeroSearch::new(direction, (0.0, value), at_start, error, leaving),
    };
    let mut budget = search.intervals;
    loop {
        let found = zeros.advance(bounded, until, until >= search.horizon, &mut budget)?;
        return Ok(match found {
            Found::Crossing { time, error, .. } => {
                OneGuard::Crossing { time, error, from: found.from() }
            }
            // The search goes on behind the touch.
            Found::Touch { .. } if touch == Touch::Ignore => continue,
            // An event is where the guard is clear again: the arc after it must not meet the same touch.
            Found::Touch { error, value, until, .. } if touch == Touch::Event => {
                OneGuard::Touch { time: until, error: 2.0 * error, value }
            }
            // The value of the source may lack a factor.
            Found::Touch { time, error, .. } => {
                OneGuard::Touch { time, error, value: flow.guard_at(surface, time) }
            }
            // Nothing follows up to the horizon.
            Found::Undecided { .. } if touch == Touch::Ignore => OneGuard::Quiet,
            Found::Undecided { time, .. } => {
                let value = flow.guard_at(surface, time);
                OneGuard::Touch { time, error: until - time, value }
            }
            Found::Nothing => OneGuard::Quiet,
            Found::BudgetEnded => OneGuard::BudgetEnded { time: zeros.time() },
        });
    }
}
