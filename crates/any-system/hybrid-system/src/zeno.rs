//! Infinitely many events in finite time (Zeno): recognised by the durations of the last arcs, with their limit.
//!
//! Statement (8) of [mathematics](crate::mathematics): the durations are treated as a geometric series, possibly with a
//! period of several events, or as a power law.

use crate::durations::{Durations, LONGEST_PERIOD, Remainder};
use crate::state::StateVector;
use crate::time_sum::TimeSum;
use smallvec::SmallVec;

/// The limit of infinitely many events in finite time.
///
/// An execution recognises the limit by the durations of its last arcs, in two cases.
///
/// * **A geometric series**, possibly with a period of up to four events. Over six periods the lengths of the
///   periods must fall in proportion to the time that remains, within one per cent; the sum of all further
///   durations must be below 10⁻¹² of the time so far. If rounding hides the next event, or the errors of the
///   events are a quarter of the durations, three periods, ten per cent and 10⁻⁵ suffice; with durations below
///   their errors six periods and one per cent.
/// * **A power law** k^(−p) of the number k of events, p > 1.14: the restitution tends to 1 as the speed tends to 0.
///   Predictions of the limit from durations that halve must converge. The remainder must be below 10⁻¹² of the time so
///   far, or, for p < 3.5, below 10⁻⁵ with an error below 10⁻¹⁰.
///
/// Finitely many durations never prove a limit. Durations that fall like 1/k or slower have none, and those that
/// fall only a little faster, such as 1/(k ln² k), cannot be told from them: the execution goes on to its limits
/// then.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ZenoLimit<X> {
    /// Time of the limit: the sum of all durations.
    pub time: f64,
    /// Bound on the error of `time`, under two conditions. The series goes on as it was: the slope of the lengths
    /// of the periods changes by no more than it has changed over the fitted periods, or predictions from a power
    /// law go on to converge. And the errors of the single events, which the bound contains, act on later durations
    /// as in a bounce: an error δ of an event after the duration T changes the later durations by 2δ/T of their
    /// size, and moves the limit by (1 + 1/q) δ or more if they fall by the factor q there.
    #[cfg_attr(feature = "serde", serde(with = "crate::infinite"))]
    pub time_error: f64,
    /// Time from the start of the arc to the limit, with all its digits. The arc starts at the last event, or at a
    /// limit on time at which the execution had stopped since.
    pub remainder: f64,
    /// The state at the limit, extrapolated.
    pub state: X,
    /// The change of the state over the last period, divided by 1 − `ratio`: an estimate of the error of `state`.
    #[cfg_attr(feature = "serde", serde(with = "crate::infinite"))]
    pub state_error: f64,
    /// The factor by which the time to the limit shrinks in one period. Durations shrink by the same factor if they
    /// are a geometric series.
    pub ratio: f64,
    /// Number of events in one period.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::count::read_count"))]
    pub period: usize,
}

impl<X> ZenoLimit<X> {
    /// The same limit with its state in another type.
    pub(crate) fn with_state<Y>(&self, convert: impl Fn(&X) -> Y) -> ZenoLimit<Y> {
        let ZenoLimit { time, time_error, remainder, state_error, ratio, period, .. } = *self;
        ZenoLimit {
            time,
            time_error,
            remainder,
            state: convert(&self.state),
            state_error,
            ratio,
            period,
        }
    }
}

/// Surfaces that are kept without allocating.
const FEW: usize = 4;

/// A surface that has had two events within so many periods is one of those whose events lead to the limit: one event
/// in a period, and room for the error of its length. An observer of something else may have had one event.
const PERIODS: usize = 3;

/// Rounding of the times that are compared.
const TIME_ULPS: f64 = 4.0;

/// The largest factor by which the time to a limit shrinks in one period, for the error of the state. At a factor
/// nearer to 1 the estimate has no digits.
const LARGEST_RATIO: f64 = 1.0 - 1e-9;

/// States that are kept: those of two of the longest periods.
const STATES: usize = 2 * LONGEST_PERIOD + 1;

/// The last events of a surface.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct LastEvents<S> {
    surface: S,
    last: f64,
    before: Option<f64>,
}

/// The durations of the last arcs, the last states after events, and the last event of each surface.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct History<S, X> {
    pub(crate) durations: Durations,
    /// The times of the last events of each surface.
    pub(crate) events: SmallVec<[LastEvents<S>; FEW]>,
    /// A ring of states: those after the last events.
    pub(crate) states: [Option<X>; STATES],
    /// Place of the newest state.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "read_place"))]
    pub(crate) newest: usize,
    /// Time since the newest event: the execution has stopped at limits on time since then.
    pub(crate) since_event: f64,
}

/// Reads a place in the ring of states.
#[cfg(feature = "serde")]
fn read_place<'de, D: serde::Deserializer<'de>>(reader: D) -> Result<usize, D::Error> {
    let place = crate::count::read_count(reader)?;
    if place < STATES {
        return Ok(place);
    }
    Err(serde::de::Error::custom(format!(
        "a checkpoint with place {place} of its states is damaged"
    )))
}

impl<S: Copy + PartialEq, X: StateVector> History<S, X> {
    pub(crate) fn new() -> Self {
        History {
            durations: Durations::new(),
            events: SmallVec::new(),
            states: [const { None }; STATES],
            newest: 0,
            since_event: 0.0,
        }
    }

    /// Time has passed without an event.
    pub(crate) fn pass(&mut self, duration: f64) {
        self.since_event += duration;
    }

    /// An event: the duration of the last arc with its error, the time of the event, and the state after it.
    ///
    /// An event without time before it only replaces the newest state. Its duration of zero is not part of a series.
    pub(crate) fn push(&mut self, duration: f64, error: f64, now: TimeSum, after: X) {
        let duration = duration + std::mem::take(&mut self.since_event);
        if duration > 0.0 {
            self.durations.push(duration, error, now);
            self.newest = (self.newest + 1) % self.states.len();
        }
        self.states[self.newest] = Some(after);
    }

    /// An event of this surface.
    pub(crate) fn event(&mut self, surface: S, time: f64) {
        match self.events.iter_mut().find(|events| events.surface == surface) {
            Some(events) => (events.last, events.before) = (time, Some(events.last)),
            None => self.events.push(LastEvents { surface, last: time, before: None }),
        }
    }

    /// Whether the events of this surface are among those that lead to a limit of this period.
    pub(crate) fn leads_to_limit(&self, period: usize, surface: S) -> bool {
        self.leading(period).any(|leading| leading == surface)
    }

    fn leading(&self, period: usize) -> impl Iterator<Item = S> {
        let now = self.durations.now.value();
        let length = self.length(0..PERIODS * period);
        let since = now - length - TIME_ULPS * f64::EPSILON * now.abs();
        let leads = move |events: &&LastEvents<S>| events.before.is_some_and(|time| time >= since);
        self.events.iter().filter(leads).map(|events| events.surface)
    }

    /// The sum of some of the last durations.
    fn length(&self, back: std::ops::Range<usize>) -> f64 {
        back.map(|back| self.durations.duration(back)).sum()
    }

    /// An estimate of the error of each component of the state at a limit: its steps over the last two periods should
    /// be in the ratio of the periods. Without a state so early it is the last step.
    pub(crate) fn error_of_state(&self, limit: &ZenoLimit<X>) -> Option<X> {
        let period = limit.period;
        let now = self.state(0)?;
        let mut error = now.clone();
        error.add_scaled(-1.0, self.state(period)?);
        if let Some(before) = self.state(2 * period) {
            let ratio = self.length(0..period) / self.length(period..2 * period);
            error.add_scaled(-ratio, self.state(period)?);
            error.add_scaled(ratio, before);
        }
        // 1 − ratio is the last period as a part of the time to the limit at its begin.
        let steps = 1.0 / (1.0 - limit.ratio.clamp(0.0, LARGEST_RATIO));
        Some(error.filled(|axis| steps * error.components()[axis].abs()))
    }

    /// The state so many events before the newest.
    fn state(&self, back: usize) -> Option<&X> {
        self.states[(self.newest + STATES - back) % STATES].as_ref()
    }

    /// Its states.
    #[cfg(feature = "serde")]
    pub(crate) fn states(&self) -> impl Iterator<Item = &X> {
        self.states.iter().flatten()
    }

    pub(crate) fn clear(&mut self) {
        self.durations.clear();
        self.events.clear();
        self.states = [const { None }; STATES];
        self.since_event = 0.0;
    }

    /// The Zeno limit of the last arcs; `None` if their durations are not recognised as a convergent series.
    ///
    /// `next_event_hidden` is true if rounding hides the next event. The search may also go on to find events
    /// although their times are lost in their errors: that is the same case. `at` is the present state.
    pub(crate) fn zeno_limit(&self, next_event_hidden: bool, at: &X) -> Option<ZenoLimit<X>> {
        let remainder = if next_event_hidden || self.durations.is_lost() {
            self.durations.remainder_if_hidden()
        } else {
            self.durations.remainder()
        };
        let remainder = remainder?;
        // The times of clocks are known: they have no limit, whatever their series so far.
        self.leading(remainder.period).next()?;
        self.limit(remainder, at)
    }

    #[cold]
    fn limit(&self, remainder: Remainder, at: &X) -> Option<ZenoLimit<X>> {
        let Remainder { time, error, period, length, order } = remainder;
        // A limit before the present is now, within its error. Farther back it is refuted: the flow has gone on.
        let end = time.max(self.since_event);
        let overrun = end - time;
        if overrun > error {
            return None;
        }
        let now = self.state(0)?;
        let mut step = now.clone();
        step.add_scaled(-1.0, self.state(period)?);
        // A speed is proportional to the duration, D = c (t∞ − t)^μ. Over one period D changes by −D′ times the
        // period, and it vanishes if it changes by D = −D′ (t∞ − t)/μ: a multiple (t∞ − t)/(μ · period) of the
        // step.
        let mut state = now.clone();
        match overrun > 0.0 {
            true => state.clone_from(at),
            false => state.add_scaled(time / (order * length), &step),
        }
        let rounding = 0.5 * f64::EPSILON * self.durations.now.value().abs();
        Some(ZenoLimit {
            time: self.durations.now.plus(end).value(),
            time_error: error + overrun + rounding,
            remainder: end - self.since_event,
            state,
            state_error: step.largest() * (1.0 + time / length),
            // 1 − ratio = length/(length + time).
            ratio: time / (length + time),
            period,
        })
    }
}
