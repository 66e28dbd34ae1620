//! To which side does a guard leave its zero at the start of an arc?
//!
//! The first derivative along the flow that is not zero decides: statements (4) and (5) of
//! [mathematics](crate::mathematics). It comes from the strongest information that the model gives:
//!
//! | the model gives | the side comes from |
//! |---|---|
//! | its own decision | [`HybridSystem::leaving_side`](crate::HybridSystem::leaving_side) |
//! | a quasi-polynomial | its derivatives at the start |
//! | enclosures | the first derivative whose enclosure excludes zero |
//! | a vector field | the rate ∇g·f, if rounding does not hide it |
//! | a flow only, or a hidden rate | the guard at times that double from a very short one on |

use super::certainty::Certainty;
use super::enclosure_search::EnclosedGuard;
use super::guard_rate::guard_rate;
use super::guard_rounding::rounding_of_state;
use super::guarded_flow::GuardedFlow;
use crate::error::Error;
use crate::guard::Direction;
use crate::looked::Looked;
use crate::state::StateVector;

/// The first of the times after the start at which a guard is evaluated if the model gives no derivatives, relative
/// to the longest one, or to the last arc or the sampling interval if that is shorter. Each further time is twice
/// as long. 2⁻³⁹ is 2·10⁻¹², near the rounding of a guard that moves at a rate of 1. The last arc counts because
/// the bounces of a ball become shorter and shorter: a look behind the end of the next bounce would show the wrong
/// side.
const SHORTEST_LOOK: f64 = 1.0 / 549_755_813_888.0;

/// The longest of these times: one unit of time, because the scale of the model is not known.
pub(crate) const LONGEST_LOOK: f64 = 1.0;

/// A guard has left its surface when its value is this many times its error. A margin of a factor 4 over the error
/// at the time 0: the error of the later value, and that of the flow in between, are not known here. A smaller
/// number may take rounding for a side; a larger one looks later, when the guard may have come back.
const LEFT_SURFACE: f64 = 4.0;

/// The growth of a guard between two looks, from a value that rounding hides: 2⁸ for a zero of order eight. A guard
/// that grows faster has stayed at zero for a while. A smaller number would take zeros of high order for that.
const LARGEST_GROWTH: f64 = 256.0;

/// A contact that jumps at its surface turns back over it within so many times the shortest look. A larger number
/// would take a later crossing for that; a smaller one would miss a slow return.
const MOST_LOOKS_BACK: f64 = 1024.0;

/// Further looks at a guard that leaves its zero with a hidden rate, each twice as late: up to 1024 times the first one
/// that is clear. With fewer of them noise of a step could be taken for a return; more of them would cost evaluations.
const LOOKS_BEHIND: u32 = 10;

/// A look behind so much of the last arc may be behind the next bounce. A larger number would miss the return of a
/// bounce whose speed is a small part of the one before; a smaller one would refuse a slow departure.
const NEXT_BOUNCE: f64 = 1.0 / 1024.0;

/// A guard that leaves straight has half of its value at half of the time. One that has bounced has less than a quarter
/// there, or another sign.
const STRAIGHT: f64 = 3.0;

/// The rounding of a guard along the flow as its values show it: of its own components, and the third difference of its
/// values at the quarters of a time. A guard that has just left its zero is nearly a parabola.
fn shown_error<F: GuardedFlow>(
    flow: &F,
    surface: F::Surface,
    (time, value, state): (f64, f64, &F::State),
) -> f64 {
    let [first, second, third] = [0.25, 0.5, 0.75].map(|part| flow.guard_at(surface, part * time));
    let scatter = (value - 3.0 * third + 3.0 * second - first).abs();
    let start = flow.start().components();
    let size = state.filled(|axis| state.components()[axis].abs().max(start[axis].abs()));
    scatter + rounding_of_state(state, &size, &|state| flow.guard_value(surface, state))
}

/// How a guard leaves its zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Departure {
    /// To this side, ±1.
    To {
        side: f64,
        certainty: Certainty,
        /// How long rounding hides that it does.
        hidden: f64,
    },
    /// It stays at zero.
    Stays,
}

/// What a guard is at the start of a flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum StartsAs {
    /// A crossing: both sides are allowed.
    Crossing,
    /// A contact or a switch: it bounds the flow.
    Bound,
    /// A bound that has just had its event, after a flight of this duration. At the first look that is clear of
    /// rounding it may be beyond its surface again, behind a bounce that is hidden.
    Bounced { direction: Direction, flight: f64 },
}

/// How the guard of `surface` leaves its zero at the start of a flow. Its value there is zero with this `error`.
/// The part `rounding` of the error differs from state to state. The rest, by the error of the time of a crossing,
/// is the same for states next to each other, and hides no rate. `short` is the duration of the arc before or the
/// sampling interval, or infinite.
///
/// # Errors
/// [`Error::UndecidedSign`], [`Error::UndecidedStart`] for a guard that stays at zero for a while, and
/// [`Error::NotFinite`].
pub(crate) fn departure<F: GuardedFlow>(
    flow: &F,
    surface: F::Surface,
    (error, rounding): (f64, f64),
    (horizon, short): (f64, f64),
    starts_as: StartsAs,
) -> Result<Departure, Error> {
    let to = |side: f64, certainty| Departure::To { side: side.signum(), certainty, hidden: 0.0 };
    if let Some(side) = flow.leaving_side(surface) {
        return Ok(if side == 0.0 { Departure::Stays } else { to(side, Certainty::Exact) });
    }
    let longest = horizon.min(LONGEST_LOOK);
    if let Some(function) = flow.quasi_polynomial(surface) {
        let side = function.side_after_zero(longest, error)?;
        return Ok(side.map_or(Departure::Stays, |side| to(side, Certainty::Certain)));
    }
    if flow.enclosure(surface, 0, (0.0, 0.0)).is_some() {
        let enclosure = |order, times| flow.enclosure(surface, order, times);
        // An event at the limit on time: no interval is left, and the rate alone decides.
        if longest == 0.0 {
            let rate = enclosure(1, (0.0, 0.0));
            let side =
                rate.and_then(|rate| (rate.low() > 0.0 || rate.high() < 0.0).then_some(rate.low()));
            return Ok(side.map_or(Departure::Stays, |side| to(side, Certainty::Certain)));
        }
        let guard = EnclosedGuard { value: |time| flow.guard_at(surface, time), enclosure };
        return Ok(to(guard.side_after_zero(longest, error)?, Certainty::Certain));
    }
    let start = flow.start();
    let mut looked = Looked::ByFlow;
    if let Some(field) = flow.vector_field(start) {
        looked = Looked::OnSteps;
        if field.largest() == 0.0 {
            return Ok(Departure::Stays);
        }
        let value = |state: &F::State| flow.guard_value(surface, state);
        if let Some(rate) = guard_rate(start, &field, rounding, &value) {
            return Ok(to(rate, Certainty::Interpolated));
        }
    }
    by_looks(flow, surface, Looks { error, rounding, horizon, short, looked, starts_as })
}

/// A guard that is looked at along the flow.
struct Looks {
    error: f64,
    rounding: f64,
    horizon: f64,
    short: f64,
    looked: Looked,
    starts_as: StartsAs,
}

/// The side on which the guard is at the first look that is clear of rounding. The looks do not depend on the horizon,
/// which may be some ulps ahead: the flow goes on behind it, if it is defined there.
fn by_looks<F: GuardedFlow>(
    flow: &F,
    surface: F::Surface,
    looks: Looks,
) -> Result<Departure, Error> {
    let Looks { error, rounding, horizon, short, looked, starts_as } = looks;
    let start = flow.start();
    let shortest = SHORTEST_LOOK * LONGEST_LOOK.min(short);
    // An arc of subnormal duration gives no time to begin with.
    let shortest = if shortest > 0.0 { shortest } else { SHORTEST_LOOK * LONGEST_LOOK };
    let (mut time, mut first) = (shortest, true);
    let at_start = flow.guard_value(surface, start);
    while horizon > 0.0 && time <= LONGEST_LOOK {
        let state = flow.state(time);
        let value = flow.guard_value(surface, &state);
        if !value.is_finite() && time <= horizon {
            return Err(Error::NotFinite { at: time, value });
        }
        if !value.is_finite() {
            break;
        }
        let later_error = rounding_at_look(flow, surface, (time, value, &state), error);
        let to = || {
            let side = value.signum();
            // The steps of an integrated flow are longer than the looks, and their noise is larger.
            let hidden = match looked {
                Looked::OnSteps => leaves_until(flow, surface, (time, value)),
                _ => 0.5 * time,
            };
            Ok(Departure::To { side, certainty: Certainty::Sampled { interval: time }, hidden })
        };
        // The value at the start may be the height of a jump there, over which the reset of a contact turns back.
        let jumps = value * at_start < 0.0 && value.abs() > LEFT_SURFACE * (rounding + later_error);
        if jumps && starts_as != StartsAs::Crossing && time <= MOST_LOOKS_BACK * shortest {
            return to();
        }
        let hidden = LEFT_SURFACE * (error + later_error);
        if value.abs() > hidden {
            // A guard that was zero up to here does not leave at the start. When it leaves is not known.
            let stayed = !first && value.abs() > LARGEST_GROWTH * hidden;
            if stayed && time > horizon {
                break;
            }
            if stayed || may_have_bounced(flow, surface, (time, value), starts_as) {
                let surface = format!("{surface:?}");
                return Err(Error::UndecidedStart { surface, interval: time, looked });
            }
            return to();
        }
        // A look so short that the state has not moved tells nothing.
        (time, first) = (2.0 * time, first && state == *start);
    }
    Ok(Departure::Stays)
}

/// Half of the last one of some looks, each twice as late as the one before, up to which a guard leaves with a growing
/// rate. Its way back begins behind that look.
fn leaves_until<F: GuardedFlow>(flow: &F, surface: F::Surface, (first, value): (f64, f64)) -> f64 {
    let (mut time, mut value) = (first, value);
    for _ in 0..LOOKS_BEHIND {
        let later = flow.guard_at(surface, 2.0 * time);
        if !(later / value >= 2.0) {
            break;
        }
        (time, value) = (2.0 * time, later);
    }
    0.5 * time
}

/// The rounding of a guard at a look: its flow adds numbers as large as the largest component, and rounds by as much in
/// each. A large component may have no part in the guard: then its values show no rounding of that size.
fn rounding_at_look<F: GuardedFlow>(
    flow: &F,
    surface: F::Surface,
    (time, value, state): (f64, f64, &F::State),
    error: f64,
) -> f64 {
    let largest = state.largest().max(flow.start().largest());
    let size = state.filled(|_| largest);
    let rounding = rounding_of_state(state, &size, &|state| flow.guard_value(surface, state));
    match value.abs() > LEFT_SURFACE * (error + rounding) {
        true => rounding,
        false => rounding.min(shown_error(flow, surface, (time, value, state))),
    }
}

/// Whether a guard that is beyond its surface at a look may have had a bounce before, which rounding hides.
fn may_have_bounced<F: GuardedFlow>(
    flow: &F,
    surface: F::Surface,
    (time, value): (f64, f64),
    starts_as: StartsAs,
) -> bool {
    let StartsAs::Bounced { direction, flight } = starts_as else { return false };
    // The value at the start is zero within its error.
    let start = flow.guard_value(surface, flow.start());
    let ratio = || (value - start) / (flow.guard_at(surface, 0.5 * time) - start);
    direction.is_beyond(value) && time > NEXT_BOUNCE * flight && !(0.0..STRAIGHT).contains(&ratio())
}
