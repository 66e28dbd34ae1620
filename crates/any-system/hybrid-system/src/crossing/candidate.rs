//! A candidate for the earliest event of a mode.

/// A candidate for the earliest event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    /// Time of the event.
    pub(crate) time: f64,
    /// Bound on the error of the time.
    pub(crate) error: f64,
    /// Index of the guard in the list of the mode.
    pub(crate) index: usize,
    /// The value of the guard, if this is a touch.
    pub(crate) touch: Option<f64>,
    /// The side from which the guard comes, if it is crossed.
    pub(crate) from: Option<f64>,
}

impl Candidate {
    /// True if this event comes before the other one: at an earlier double, or at the same one if the model lists
    /// its guard first. The errors of the two times do not count: both are on one computed trajectory.
    pub(crate) fn is_sooner_than(&self, other: &Candidate) -> bool {
        self.time < other.time || self.time == other.time && self.index < other.index
    }
}
