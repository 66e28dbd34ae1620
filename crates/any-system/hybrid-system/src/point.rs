//! The point that an execution has reached.

use crate::arrival::Arrival;
use crate::chain::Chain;
use crate::residues::Residues;
use crate::time_sum::TimeSum;
use crate::zeno::History;
use std::fmt::Debug;

/// Everything that decides how an execution goes on.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Point<M, S, X> {
    pub(crate) mode: M,
    pub(crate) state: X,
    pub(crate) time: TimeSum,
    /// Number of events so far, j.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::count::read_count"))]
    pub(crate) jump: usize,
    /// True as long as no arc has ended.
    pub(crate) initial: bool,
    /// True as long as the time is that of the start. Older files do not say so: their clocks have had their ticks.
    #[cfg_attr(feature = "serde", serde(default))]
    pub(crate) at_start: bool,
    pub(crate) history: History<S, X>,
    /// The events since time has passed for the last time.
    pub(crate) chain: Chain<M, S>,
    /// The last crossing, if no time has passed since.
    pub(crate) arrival: Option<Arrival<M, S, X>>,
    /// The values of guards at their events, as long as the state is on the same side.
    pub(crate) residues: Residues<S>,
}

impl<M: Copy + PartialEq + Debug, S: Copy + PartialEq + Debug, X> Point<M, S, X> {
    /// The time, as a double, has changed.
    pub(crate) fn time_changes(&mut self) {
        self.at_start = false;
        self.chain.clear();
    }
}
