//! Why the fate of an orbit is not known.

/// Why a fate is not known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UndecidedReason {
    /// The budget of steps was used up.
    Budget,
    /// The computed image equals the point, outside any trap: the true step is shorter than the spacing of `f64`.
    Precision {
        /// The point that the computed orbit repeats.
        at: f64,
    },
    /// The map could not be evaluated, or the point is not finite.
    Map {
        /// The point.
        at: f64,
    },
}
