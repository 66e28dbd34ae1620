//! Events in a row between which no time passes.

use crate::error::Error;
use smallvec::SmallVec;
use std::fmt::Debug;

/// Most events in a row without time passing. Where several guards are crossed together, there is about one for each
/// guard; many more mean that the resets lead back to each other. The execution then ends with
/// [`Error::TimelessChain`]. The number is far above the guards of a model, and a thousand resets take no noticeable
/// time. A model with more surfaces in one point would be refused.
const MOST_TIMELESS: usize = 1000;

/// Events that are kept without allocating.
const FEW: usize = 4;

/// The events since the time, as a double, has changed for the last time, the last crossing included: modes and
/// surfaces.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Chain<M, S> {
    pub(crate) events: SmallVec<[(M, S); FEW]>,
    /// How many of them, the newest, took no time at all, or only the error of their times. The others moved the
    /// time by less than the rounding of a double, as the last bounces of a ball late in time do.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::count::read_count"))]
    pub(crate) timeless: usize,
}

impl<M: Copy + PartialEq + Debug, S: Copy + PartialEq + Debug> Chain<M, S> {
    pub(crate) fn new() -> Self {
        Chain { events: SmallVec::new(), timeless: 0 }
    }

    pub(crate) fn clear(&mut self) {
        self.events.clear();
        self.timeless = 0;
    }

    /// Keeps the events of some surfaces.
    pub(crate) fn keep(&mut self, is_kept: impl Fn(S) -> bool) {
        self.events.retain(|event| is_kept(event.1));
        self.timeless = 0;
    }

    /// Time has passed, but less than the rounding of a double.
    pub(crate) fn moves_on(&mut self) {
        self.timeless = 0;
    }

    pub(crate) fn push(&mut self, mode: M, surface: S) {
        self.events.push((mode, surface));
        self.timeless += 1;
    }

    /// The last event.
    pub(crate) fn last(&self) -> Option<(M, S)> {
        self.events.last().copied()
    }

    /// True if an event of this surface is among them.
    pub(crate) fn contains(&self, surface: S) -> bool {
        self.events.iter().any(|event| event.1 == surface)
    }

    /// An error for a chain that is too long.
    pub(crate) fn check(&self, time: f64) -> Result<(), Error> {
        if self.timeless <= MOST_TIMELESS {
            return Ok(());
        }
        Err(Error::TimelessChain { time, events: self.timeless, cycle: self.cycle() })
    }

    /// The shortest cycle that the last events repeat, or the last few events if there is none.
    fn cycle(&self) -> String {
        let events = &self.events[self.events.len() - self.timeless.min(self.events.len())..];
        let half = events.len() / 2;
        let repeats = |period: &usize| {
            let (last, before) = (&events[events.len() - period..], events.len() - 2 * period);
            &events[before..before + period] == last
        };
        let period = (1..=half).find(repeats).unwrap_or(FEW.min(events.len()));
        let last = &events[events.len() - period..];
        let arrows: Vec<String> =
            last.iter().map(|(mode, surface)| format!("{mode:?} ─{surface:?}→ ")).collect();
        let back = last.first().map_or(String::new(), |(mode, _)| format!("{mode:?}"));
        arrows.concat() + &back
    }
}
