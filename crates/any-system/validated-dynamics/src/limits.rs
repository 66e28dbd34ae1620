//! How far runs go.

/// How far a run goes before it is called undecided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// The most steps. Ten thousand take seconds in three dimensions.
    pub steps: usize,
    /// The most events.
    pub events: usize,
    /// The latest time since the start.
    pub time: f64,
    /// The largest width of a component: wider sets are undecided at once, before they need many short steps.
    pub width: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { steps: 10_000, events: 1000, time: f64::INFINITY, width: f64::INFINITY }
    }
}
