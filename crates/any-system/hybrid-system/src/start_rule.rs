//! What happens at the start of an arc on a surface or beyond it?
//!
//! The start is the initial state of an execution, or the state after a jump. For each guard:
//!
//! | value of the guard at the start | contact | switch | crossing |
//! |---|---|---|---|
//! | zero within its error, leaves to the side of the event, after a jump that moves the state | an event at once | an error | no event |
//! | the same, after a change of the mode alone, or at the initial state | an event at once | an event at once | no event |
//! | zero within its error, leaves to the side of the flow, or stays zero | no event | no event | no event |
//! | zero within its error, the side is hidden by rounding | an error | an error | an error |
//! | beyond the surface, after a jump | an event at once | an error | no event |
//! | beyond the surface, at the initial state | an error | an error | no event |
//! | on the side of the flow | no event | no event | no event |
//!
//! A surface at which jumps are undone is a crossing. A start on it is an event at once: at the initial state, and after the event of
//! another surface.
//!
//! A switch whose surface both fields point at is no error: the state slides.
//!
//! After a touch the guard goes back to the side of the flow, although its rate at the time of the touch may still lead
//! to the surface.
//!
//! A guard that the flow has brought next to its surface, and whose zero is still ahead by the signs of the computed
//! trajectory, is on its side, however small its value.
//!
//! Where the same flow goes on, after a stop or an event that changes neither the mode nor the state, nothing is
//! looked for: a guard has the side of its sign, and an observer that was crossed the side to which it passed. What
//! a contact that jumps at its surface does after its reset is told by the motion: a path beside the flow, from the
//! side of the flow, comes beyond the surface, or the flow turns back.
//!
//! For guards of all roles: if the flow has reached the surface at the same instant as the surface of the last
//! event, and the reset of that event lets the state pass through, that is an event. No crossing is lost between
//! two resets.

use crate::arrival::Arrival;
use crate::crossing::{
    Certainty, Departure, GuardedFlow, LONGEST_LOOK, Leaving, LeavingGuards, StartsAs, departure,
    is_far,
};
use crate::error::Error;
use crate::guard::{Direction, Guard, Role};
use crate::residues::Residues;
use crate::sliding::is_unchanged;
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem};

/// How an arc starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ArcStart<S> {
    /// With an event at once.
    Event {
        surface: S,
        certainty: Certainty,
        /// The rounding of its time and its error: those of the arrival, if the flow has reached its surface, too.
        errors: (f64, f64),
        undeclared: Option<Undeclared>,
    },
    /// The mode flows.
    Flows,
}

/// An event at once of a guard that says neither that it is a contact nor that it is a crossing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Undeclared {
    /// The value of the guard, and its rounding.
    pub(crate) value: f64,
    pub(crate) rounding: f64,
    /// The value is rounding, and the flow leads beyond the surface.
    pub(crate) on_surface: bool,
}

/// The start of an arc: an event at once, or a flow. `leaving` becomes the list of the guards on whose surfaces it
/// starts.
///
/// `had_its_event` tells of a surface whether it had an event at this instant. `arrival` is the crossing before the arc, at the same instant, and `residues` are the values of guards at events
/// from which the state has not gone away yet. `initial` is true at the start of an execution. The search goes up
/// to a horizon, with samples at an interval, if there is one.
///
/// # Errors
/// [`Error::StartsBeyond`], [`Error::NotFinite`] for a guard without a value, and errors if rounding hides to which
/// side a guard leaves its surface.
pub(crate) fn start_of_arc<T: HybridSystem>(
    flow: &FlowFrom<T>,
    arrival: Option<&Arrival<T::Mode, T::Surface, T::State>>,
    residues: &Residues<T::Surface>,
    initial: bool,
    (horizon, interval): (f64, Option<f64>),
    had_its_event: &dyn Fn(T::Surface) -> bool,
    leaving: &mut LeavingGuards<T::Surface>,
) -> Result<ArcStart<T::Surface>, Error> {
    leaving.clear();
    let continued = arrival.filter(|arrival| arrival.continues(flow));
    let size = flow.start.largest().max(arrival.map_or(0.0, Arrival::size));
    for guard in flow.guards().iter().filter(|guard| guard.role != Role::Clock) {
        let Guard { surface, direction, role, .. } = *guard;
        let value = |state: &T::State| flow.guard_value(surface, state);
        let now = value(flow.start);
        if !now.is_finite() {
            return Err(Error::NotFinite { at: 0.0, value: now });
        }
        let reached = arrival.and_then(|arrival| arrival.came_from(surface));
        let switch = role.bounds_flow();
        // The usual case: far from the surface, on a side where the mode flows.
        let beyond = switch && direction.is_beyond(now);
        // The crossed surface itself may be farther than that, by the error of the time of the crossing.
        let crossed = arrival.is_some_and(|arrival| arrival.surface() == Some(surface));
        let far = || is_far(flow.start, size, now, value);
        let residue = residues.error(surface);
        if !beyond && reached.is_none() && !crossed && residue == 0.0 && far() {
            continue;
        }
        // The same flow goes on: the sign of the computed trajectory is the side, and nothing has to be looked for.
        if let Some(arrival) = continued
            && reached.is_none()
            && !arrival.has_touched(flow, surface)
        {
            // A guard that counts both ways passes through its surface, whatever its role.
            let passes = !switch || direction == Direction::Either;
            let passed = arrival.passed_to(surface).filter(|_| passes);
            if passed.is_none()
                && let Some(still) = arrival.still_leaves(flow, surface, now)
            {
                leaving.push(still);
                continue;
            }
            let at_rest = now != 0.0 && residue == 0.0 && !beyond && !crossed;
            if let Some(side) = passed.or(at_rest.then_some(now.signum())) {
                let ahead = now * side > 0.0;
                leaving.push(Leaving { ahead, ..Leaving::to(surface, side) });
                continue;
            }
        }
        let rounding = flow.rounding_at(surface, flow.start);
        // An exact zero, to which a reset has moved the state, has no error by time. A guard that the flow has
        // moved to its other side has crossed it.
        let crossed_by_flow = reached.is_some_and(|from| from * now < 0.0);
        let by_time = arrival
            .filter(|_| now != 0.0 && !crossed_by_flow)
            .map_or(0.0, |arrival| arrival.error_after(flow, surface));
        // Without an arrival the error of the state is that of a start.
        let by_start = match arrival {
            None => flow.system.start_error(surface, flow.start),
            Some(_) => 0.0,
        };
        let error = rounding + by_time.max(residue) + by_start;
        let on_surface = now.abs() <= error;
        // A state on it has come by the jump: the initial one, or one to which another jump has been undone. The start is
        // known to be on the surface as far as its errors tell.
        if on_surface && role == Role::Undone && arrival.is_none() && !had_its_event(surface) {
            let (certainty, errors) = (Certainty::Certain, (0.0, 0.0));
            return Ok(ArcStart::Event { surface, certainty, errors, undeclared: None });
        }
        let touched = arrival.is_some_and(|arrival| arrival.has_touched(flow, surface));
        if on_surface && touched && switch && direction != Direction::Either {
            let side = if direction == Direction::Rising { -1.0 } else { 1.0 };
            leaving.push(Leaving::to(surface, side));
            continue;
        }
        // It has had its event at the last limit on time.
        if on_surface
            && !switch
            && let Some(side) = residues.passes_later(surface)
        {
            leaving.push(Leaving::to(surface, side));
            continue;
        }
        // Its event is still to come, however near: the signs of the computed trajectory decide.
        let is_ahead = |arrival: &Arrival<_, _, _>| {
            direction.admits(now, -now) && arrival.is_ahead(flow, surface, (now, rounding))
        };
        if on_surface && residue == 0.0 && reached.is_none() && arrival.is_some_and(is_ahead) {
            leaving.push(Leaving::before_zero(surface, now.signum()));
            continue;
        }
        // A guard that jumps at its surface has a value beyond it that does not tell how far: the motion tells.
        let leads_beyond = (on_surface && crossed && beyond && now.abs() > rounding)
            .then(|| arrival?.leads_beyond(flow, surface, horizon.min(LONGEST_LOOK)))
            .flatten();
        if leads_beyond == Some(false) {
            leaving.push(Leaving::to(surface, -now.signum()));
            continue;
        }
        let (side, certainty, hidden) = if leads_beyond == Some(true) {
            (now.signum(), Certainty::Sampled { interval: horizon.min(LONGEST_LOOK) }, 0.0)
        } else if on_surface {
            // Both are short on the time scale of the model.
            let interval = interval.filter(|interval| *interval > 0.0).unwrap_or(f64::INFINITY);
            let short = arrival.map_or(f64::INFINITY, Arrival::duration).min(interval);
            // A stop or another event may have divided the flight.
            let starts_as = match arrival {
                Some(last) if switch => StartsAs::Bounced { direction, flight: last.flight() },
                _ if switch => StartsAs::Bound,
                _ => StartsAs::Crossing,
            };
            match departure(flow, surface, (error, rounding), (horizon, short), starts_as)? {
                Departure::To { side, certainty, hidden } => (side, certainty, hidden),
                Departure::Stays => {
                    // On the side of the flow its value is the distance to the next event. Elsewhere it counts as zero.
                    if now == 0.0 || beyond {
                        leaving.push(Leaving::to(surface, 0.0));
                    }
                    continue;
                }
            }
        } else {
            (now.signum(), Certainty::Certain, 0.0)
        };
        let passes = reached.is_some_and(|from| direction.admits(from, side));
        if passes || switch && direction.is_beyond(side) {
            if initial && !on_surface {
                return Err(Error::StartsBeyond {
                    mode: format!("{:?}", flow.mode),
                    surface: format!("{surface:?}"),
                    value: now,
                    rounding: error,
                });
            }
            // A surface that the flow has reached is crossed. A jump through it, or beyond it, may mean two things.
            // A reset that only changes the mode is no jump on the surface: the flow has brought the state there.
            let moved = || {
                let before = arrival.and_then(Arrival::before);
                before.is_some_and(|before| !is_unchanged(before, flow.start))
            };
            let jumped = !initial && !passes && (!on_surface || moved());
            let undeclared = (jumped && role == Role::Switch).then_some(Undeclared {
                value: now,
                rounding: error,
                on_surface,
            });
            let errors = arrival.filter(|_| passes).map_or((0.0, 0.0), Arrival::errors);
            return Ok(ArcStart::Event { surface, certainty, errors, undeclared });
        }
        if on_surface {
            leaving.push(Leaving { hidden, ..Leaving::to(surface, side) });
        }
    }
    Ok(ArcStart::Flows)
}
