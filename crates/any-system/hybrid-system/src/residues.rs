//! Values of guards at their events, as long as the state has not come to the side where the event leads.
//!
//! The state of an event lies on the surface within an error: a little beyond it, or a little before. The next arc
//! leads away from there: back, if the reset has turned the motion round, or through the surface of an observer.
//! But the next event, or a limit on time, may come earlier:
//!
//! ```text
//!   ball 1 arrives at 2.2·10⁻¹⁶ and stops,
//!   ball 2 leaves 10⁻¹⁶ at velocity 1, and is stopped by ball 3 at 2·10⁻¹⁶: still behind ball 1
//! ```
//!
//! Then the guard is zero within the error of that first event, and this is no new event.

use crate::guard::{Direction, Guard};
use smallvec::SmallVec;

/// Surfaces that are kept without allocating.
const FEW: usize = 4;

/// The surfaces, each with the value that its guard had at its event.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Residues<S>(SmallVec<[Residue<S>; FEW]>);

/// A guard at its event.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Residue<S> {
    surface: S,
    value: f64,
    /// True if the event was at a limit on time, within rounding of the surface: the guard has had its event, and
    /// passes through its zero later.
    passes_later: bool,
}

impl<S: Copy + PartialEq> Residues<S> {
    pub(crate) fn new() -> Self {
        Residues(SmallVec::new())
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// The guard has this value at its event, to which it came from this side.
    pub(crate) fn push(&mut self, guard: &Guard<S>, value: f64, from: f64) {
        let passes_later = from * value > 0.0;
        let is_left_behind = match guard.direction {
            // The flow goes on at the side from which it came.
            Direction::Either if guard.role.bounds_flow() => value != 0.0,
            direction if guard.role.bounds_flow() => direction.is_beyond(value),
            _ => passes_later,
        };
        if is_left_behind {
            self.0.push(Residue { surface: guard.surface, value, passes_later });
        }
    }

    /// Forgets the surfaces whose guards have changed sign or have gone away, with the values and their rounding at
    /// the end of an arc, and some values `inside` it. The event at the end is one of the surface `now`, if any.
    pub(crate) fn keep(
        &mut self,
        now: Option<S>,
        value: impl Fn(S) -> f64,
        rounding: impl Fn(S) -> f64,
        inside: impl Fn(S) -> [f64; 3],
    ) {
        self.0.retain(|&mut Residue { surface, value: before, passes_later }| {
            let value = value(surface);
            let is_behind = before * value > 0.0 || value == 0.0 && passes_later;
            let is_near =
                value.abs() <= before.abs() || value.abs() <= before.abs() + rounding(surface);
            // It may have gone far away, and come back.
            let is_away = |inside: &f64| {
                before * inside < 0.0 || inside.abs() > 2.0 * before.abs() + rounding(surface)
            };
            Some(surface) != now && is_behind && is_near && !inside(surface).iter().any(is_away)
        });
    }

    /// The reset has moved this guard away.
    pub(crate) fn forget(&mut self, surface: S) {
        self.0.retain(|residue| residue.surface != surface);
    }

    /// The distance from zero within which a guard has had its event; 0 for a guard that is not among them.
    pub(crate) fn error(&self, surface: S) -> f64 {
        self.of(surface).map_or(0.0, |known| known.value.abs())
    }

    /// The side to which the guard of this surface passes, if it has had its event, and has not passed through its
    /// zero yet.
    pub(crate) fn passes_later(&self, surface: S) -> Option<f64> {
        self.of(surface).filter(|known| known.passes_later).map(|known| -known.value.signum())
    }

    fn of(&self, surface: S) -> Option<&Residue<S>> {
        self.0.iter().find(|known| known.surface == surface)
    }
}
