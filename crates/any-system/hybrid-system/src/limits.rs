//! Limits of an execution, and the reasons why it ends.

use crate::crossing::MOST_INTERVALS;

/// The limit on the number of events of a run that states none: far above what a user looks at event by event, and a run ends
/// within seconds. [`Execution::new`](crate::Execution::new) takes any other limit.
pub(crate) const MOST_EVENTS: usize = 1_000_000;

/// Limits of an execution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest continuous time t; may be infinite if the model solves its own crossings.
    pub time: f64,
    /// Largest number of events.
    pub events: usize,
    /// The interval at which guards without bounds are sampled.
    pub sampling_interval: Option<f64>,
    /// The most intervals that the search for one event tests under bounds.
    pub intervals: usize,
    /// The most steps of the integrated flow of one arc, and the most samples of one search. After them the arc
    /// ends with [`ArcEnd::Unfinished`](crate::ArcEnd::Unfinished), and the execution can go on. Two other limits
    /// hold as well: the steps of the tolerances of a flow, a million by default, and a billion samples of one
    /// search. It is also the most events of one arc that do not count, up to a million.
    pub steps: usize,
    /// True if a clock whose preset time is the start of the execution has its event there, after the events of other guards
    /// there. Default: false.
    pub ticks_at_start: bool,
    /// True if a clock whose preset time is the limit on time has its event there. Default: true. Without it the event is the
    /// first one of an execution that goes on.
    pub ticks_at_end: bool,
}

impl Limits {
    /// Limits for models whose guards need no samples.
    pub const fn new(time: f64, events: usize) -> Self {
        Limits {
            time,
            events,
            sampling_interval: None,
            intervals: MOST_INTERVALS,
            steps: usize::MAX,
            ticks_at_start: false,
            ticks_at_end: true,
        }
    }

    /// The same with a sampling interval for guards without bounds.
    pub const fn sampled(time: f64, events: usize, interval: f64) -> Self {
        let mut limits = Limits::new(time, events);
        limits.sampling_interval = Some(interval);
        limits
    }
}

/// Why an execution ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Stop {
    /// The limit on time was reached.
    TimeLimit,
    /// The limit on the number of events was reached.
    EventLimit,
    /// A reset ended the execution.
    Terminal,
    /// No event follows, and there is no limit on time.
    NoFurtherEvent,
    /// The events have a Zeno limit, and the model gives no mode after it.
    Zeno,
    /// The fields on both sides of a surface point at it, and the model gives no mode there.
    Sliding,
    /// A budget ended: of the search for the next event, or of events that do not count. The execution can go on.
    Unfinished,
    /// An error was returned.
    Failed,
}
