//! Has a model that solves for its own crossings passed through a surface?
//!
//! The searches of this crate find a change of sign by themselves. A model that overrides
//! [`first_crossing`](crate::HybridSystem::first_crossing) may forget a guard. At the end of an arc the state must
//! not be beyond a surface, unless the model has returned the crossing of that surface.

use crate::arrival::{Arrival, DurationOfArc};
use crate::crossing::{GuardedFlow, LeavingGuards};
use crate::error::Error;
use crate::residues::Residues;
use crate::system::{FlowFrom, HybridSystem};

/// The error of a time that the model gives without one, in ulps: that of
/// [`Crossing::exact`](crate::Crossing::exact).
const TIME_ULPS: f64 = 2.0;

/// An error if the state at the end of an arc is clearly beyond the surface of a switch, other than the one that is
/// `crossed` there, and other than by the `residues` of earlier events. The arc has this duration, with this error.
///
/// # Errors
/// [`Error::MissedEvent`].
pub(crate) fn check_missed<T: HybridSystem>(
    arc: &FlowFrom<T>,
    residues: &Residues<T::Surface>,
    crossed: Option<T::Surface>,
    end: &T::State,
    (duration, time_rounding): (f64, f64),
) -> Result<(), Error> {
    for guard in arc.guards() {
        let surface = guard.surface;
        if !guard.role.bounds_flow() || Some(surface) == crossed {
            continue;
        }
        let value = arc.guard_value(surface, end);
        if !guard.direction.is_beyond(value) {
            continue;
        }
        // Two surfaces may be reached at the same instant, within the error of the time.
        let time_rounding = time_rounding.max(TIME_ULPS * f64::EPSILON * duration);
        let arrival = {
            let time_error = time_rounding;
            let length = DurationOfArc {
                duration,
                since_event: 0.0,
                time_rounding,
                time_error,
                solved: true,
                from: None,
            };
            Arrival::new(arc, None, end, (length, LeavingGuards::new()))
        };
        let next = FlowFrom { system: arc.system, mode: arc.mode, start: end };
        let rounding = arc.rounding_at(surface, end);
        let by_time = arrival.error_after(&next, surface);
        let error = rounding + by_time.max(residues.error(surface));
        if value.abs() > error {
            return Err(Error::MissedEvent {
                mode: format!("{:?}", arc.mode),
                surface: format!("{surface:?}"),
                duration,
                value,
                error,
            });
        }
    }
    Ok(())
}
