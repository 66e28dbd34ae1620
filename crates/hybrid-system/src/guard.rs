//! Guards: the surfaces that a mode searches, and the side from which a crossing counts.

/// The side from which a crossing counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Both ways.
    Either,
}

impl Direction {
    /// True if a change of sign from `before` to `after`, both non-zero, counts.
    pub fn admits(self, before: f64, after: f64) -> bool {
        match self {
            Direction::Rising => before < 0.0 && after > 0.0,
            Direction::Falling => before > 0.0 && after < 0.0,
            Direction::Either => (before < 0.0) != (after < 0.0),
        }
    }

    /// True if `value` is on a side to which a crossing that counts leads.
    pub(crate) fn leads_to(self, value: f64) -> bool {
        match self {
            Direction::Rising => value > 0.0,
            Direction::Falling => value < 0.0,
            Direction::Either => value != 0.0,
        }
    }
}

/// A switching surface and the direction in which crossing it is an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Guard<S> {
    /// The model's name of the surface {x : g(x) = 0}.
    pub surface: S,
    /// The direction in which a crossing is an event.
    pub direction: Direction,
}

impl<S> Guard<S> {
    /// An event when g goes from negative to positive.
    pub const fn rising(surface: S) -> Self {
        Guard { surface, direction: Direction::Rising }
    }
    /// An event when g goes from positive to negative.
    pub const fn falling(surface: S) -> Self {
        Guard { surface, direction: Direction::Falling }
    }
    /// An event at every change of sign.
    pub const fn either(surface: S) -> Self {
        Guard { surface, direction: Direction::Either }
    }
}
