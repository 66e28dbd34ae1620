//! Surfaces beyond which the state lies by rounding, since their last event.
//!
//! The state of an event lies on the surface within rounding, often a little beyond. The reset turns the guard round, and
//! the next arc brings it back to the side of the flow. But the next event may come before that:
//!
//! ```text
//!   ball 1 arrives at 2.2·10⁻¹⁶ and stops,
//!   ball 2 leaves 10⁻¹⁶ at velocity 1, and is stopped by ball 3 at 2·10⁻¹⁶: still behind ball 1
//! ```
//!
//! Then the guard is beyond its surface by no more than the error of that first event, and this is no new event.

use smallvec::SmallVec;

/// Surfaces that are kept without allocating.
const FEW: usize = 4;

/// The surfaces, each with the value that its guard had at its event.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Overshoots<S>(SmallVec<[(S, f64); FEW]>);

impl<S: Copy + PartialEq> Overshoots<S> {
    pub(crate) fn new() -> Self {
        Overshoots(SmallVec::new())
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// The event of a surface, whose guard has a value beyond it.
    pub(crate) fn push(&mut self, surface: S, value: f64) {
        self.0.retain(|known| known.0 != surface);
        self.0.push((surface, value));
    }

    /// Forgets the surfaces whose guards have come back at the end of an arc.
    pub(crate) fn keep_beyond(&mut self, value: impl Fn(S) -> f64) {
        self.0.retain(|known| known.1 * value(known.0) > 0.0);
    }

    /// How far beyond its surface a guard may lie without an event; 0 for a guard that has come back.
    pub(crate) fn error(&self, surface: S) -> f64 {
        self.0.iter().find(|known| known.0 == surface).map_or(0.0, |known| known.1.abs())
    }
}
