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

/// The events since time has passed for the last time, the last crossing included: modes and surfaces.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Chain<M, S> {
    pub(crate) events: SmallVec<[(M, S); FEW]>,
}

impl<M: Copy + PartialEq + Debug, S: Copy + PartialEq + Debug> Chain<M, S> {
    pub(crate) fn new() -> Self {
        Chain { events: SmallVec::new() }
    }

    pub(crate) fn clear(&mut self) {
        self.events.clear();
    }

    pub(crate) fn push(&mut self, mode: M, surface: S) {
        self.events.push((mode, surface));
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
        if self.events.len() <= MOST_TIMELESS {
            return Ok(());
        }
        Err(Error::TimelessChain { time, events: self.events.len(), cycle: self.cycle() })
    }

    /// The shortest cycle that the last events repeat, or the last few events if there is none.
    fn cycle(&self) -> String {
        let events = &self.events;
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
