//! How much later does an event happen if the start of an orbit changes?
//!
//! | event | δτ |
//! |---|---|
//! | a crossing | −∇g·δx/(∇g·f) |
//! | a preset time | 0 |
//! | at once, beyond its surface | that of the event before |
//! | at once, on its surface | the same, if the reset maps the surface before into this one: both δτ then agree. Else nearby orbits reach the surfaces in either order, and there is no derivative |
//! | a touch | none: nearby orbits miss the surface. An event that changes nothing needs none |

use crate::arc::{Arc, Event};
use crate::crossing::{EventKind, stated_or_measured};
use crate::error::Error;
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::RowSVector;

/// Two delays agree within this part of their size. Derivatives by differences have about ten digits. A larger
/// number would take two surfaces at a small angle for one.
const AGREEMENT: f64 = 1e-6;

/// A crossing after this part of the present time is at the same instant as the event before: some roundings of the
/// time.
const SAME_INSTANT: f64 = 4.0 * f64::EPSILON;

/// The derivative of the time of an event.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Delay<const C: usize> {
    pub(crate) delay: RowSVector<f64, C>,
    /// The rounding of the time of the event.
    pub(crate) time_rounding: f64,
}

/// ∂τ of the event that ends an arc; `None` for a touch, or a second event at one instant, that changes nothing.
/// `by_guard` gives it for a crossing. `before` is that of the event before.
///
/// # Errors
/// [`Error::GrazingSensitivity`] for a touch, [`Error::CornerSensitivity`] for two surfaces at one instant,
/// [`Error::NoSensitivity`] for an arc without an event, and the errors of `by_guard`.
pub(crate) fn delay_of_event<T, const N: usize, const C: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, State<N>>,
    by_guard: impl Fn() -> Result<RowSVector<f64, C>, Error>,
    before: Option<&Delay<C>>,
) -> Result<Option<RowSVector<f64, C>>, Error>
where
    T: HybridSystem<State = State<N>>,
{
    let event = arc.event().ok_or(Error::NoSensitivity { time: arc.time })?;
    let at_once = event.kind == EventKind::AtStart
        || event.kind == EventKind::Crossing && arc.duration <= SAME_INSTANT * event.time.abs();
    // Where such an event changes nothing, its time does not matter.
    let changes = event.after != Some((arc.mode, event.before));
    match (event.kind, before) {
        (EventKind::Clock, _) => Ok(Some(RowSVector::zeros())),
        (EventKind::Touch, _) if changes => {
            Err(Error::GrazingSensitivity { time: event.time, rate: 0.0 })
        }
        (EventKind::Touch, _) => Ok(None),
        (_, Some(before)) if at_once && changes => {
            let own = by_guard();
            if let Ok(own) = &own
                && (own - before.delay).amax() <= AGREEMENT * (own.amax() + before.delay.amax())
            {
                return Ok(Some(*own));
            }
            if event.kind == EventKind::AtStart
                && is_beyond(system, arc.mode, event, before.time_rounding)
            {
                return Ok(Some(before.delay));
            }
            let surface = format!("{:?}", event.surface);
            Err(Error::CornerSensitivity { time: event.time, surface })
        }
        (_, Some(_)) if at_once => Ok(None),
        _ => by_guard().map(Some),
    }
}

/// True if the state is beyond the surface by more than rounding, and more than the error of the time of the event
/// before can explain.
fn is_beyond<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    event: &Event<T::Mode, T::Surface, State<N>>,
    time_rounding: f64,
) -> bool
where
    T: HybridSystem<State = State<N>>,
{
    let value = |state: &State<N>| system.guard_value(event.surface, state);
    let moved = system
        .vector_field(mode, &event.before)
        .map_or(0.0, |field| value(&(event.before + field * time_rounding)) - value(&event.before));
    // The error counts for both events, in both directions.
    let stated = system.guard_error(event.surface, &event.before);
    let error = stated_or_measured(stated, &event.before, &value) + 4.0 * moved.abs();
    value(&event.before).abs() > error
}
