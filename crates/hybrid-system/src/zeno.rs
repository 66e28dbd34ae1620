//! Infinitely many events in finite time (Zeno): recognised by the durations of the last arcs, with their limit.
//!
//! Statement (8) of [mathematics](crate::mathematics): the durations are treated as a geometric series, possibly with a
//! period of several events.

use crate::state::StateVector;

/// The limit of infinitely many events in finite time.
///
/// An execution recognises the limit by the durations of its last arcs. Over five periods the durations must shrink by
/// the same factor, to one per cent of the factor, and the sum of all further durations must be below 10⁻¹² of the time
/// so far. If rounding hides the next event, two periods, ten per cent and 10⁻⁵ suffice. The limit is the limit of the
/// geometric series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZenoLimit<X> {
    /// Time of the limit: the sum of all durations.
    pub time: f64,
    /// Bound on the error of `time`. It holds if all further factors lie between the smallest and the largest of the
    /// known factors, and each event was accurate to an ulp.
    pub time_error: f64,
    /// The state at the limit, extrapolated.
    pub state: X,
    /// The change of the state over the last period, divided by 1 − factor: an estimate of the error of `state`.
    pub state_error: f64,
    /// The factor by which durations shrink in one period.
    pub ratio: f64,
    /// Number of events in one period.
    pub period: usize,
}

/// How closely durations must follow a geometric series.
struct Criterion {
    /// Number of factors that must agree.
    periods: usize,
    /// Largest difference between two factors, relative to the larger one.
    spread: f64,
    /// Largest sum of all further durations, relative to the time so far.
    remainder: f64,
}

/// The usual case. The remainder is the error of stopping early. It is far below every tolerance of the model, and far
/// above the rounding of the time, 10⁻¹⁶. Five factors within one per cent are unlikely by chance.
const USUAL: Criterion = Criterion { periods: 5, spread: 0.01, remainder: 1e-12 };

/// If rounding hides the next event, the execution cannot continue in any other way. The last durations have rounding
/// errors then, so that the factors differ more. A guard at a surface of size 1 hides a bounce of duration t if its
/// height, of order t², is below 10⁻¹⁶. The remainder may therefore be as large as about 10⁻⁷, and larger for large
/// coordinates.
const NEXT_EVENT_HIDDEN: Criterion = Criterion { periods: 2, spread: 0.1, remainder: 1e-5 };

/// Longest period that is looked for, in events: two guards that are crossed alternately give period 2, and 4 leaves
/// room for twice as many. A Zeno limit of a longer period is not recognised, and the execution ends at its limit on
/// events. A larger number costs a longer history, and more tests of every short arc.
const LONGEST_PERIOD: usize = 4;

/// Number of stored arcs: one period more than the factors that must agree, because a factor compares two periods.
const KEPT: usize = (USUAL.periods + 1) * LONGEST_PERIOD;

/// The longest last arc, relative to the time so far, that may be followed by a Zeno limit. With this test the usual
/// arc costs little. It only delays the recognition of a limit whose factor is below 10⁻⁹.
const LONGEST_LAST_ARC: f64 = 1e-3;

/// The last arcs: their durations, and the states after them, the newest last.
#[derive(Debug, Clone)]
pub(crate) struct History<X> {
    durations: [f64; KEPT],
    states: [Option<X>; KEPT],
    /// Number of arcs so far, up to `KEPT`.
    arcs: usize,
}

impl<X: StateVector> History<X> {
    pub(crate) fn new() -> Self {
        History { durations: [0.0; KEPT], states: [const { None }; KEPT], arcs: 0 }
    }

    pub(crate) fn push(&mut self, duration: f64, after: X) {
        self.durations.rotate_left(1);
        self.states.rotate_left(1);
        (self.durations[KEPT - 1], self.states[KEPT - 1]) = (duration, Some(after));
        self.arcs = (self.arcs + 1).min(KEPT);
    }

    pub(crate) fn clear(&mut self) {
        self.arcs = 0;
    }

    /// The Zeno limit of the last arcs; `None` if their durations form no geometric series.
    ///
    /// `time` is the time of the last event, `events` the number of all events so far. `next_event_hidden` is true if
    /// the search for the next event failed because of rounding.
    pub(crate) fn zeno_limit(
        &self,
        time: f64,
        events: usize,
        next_event_hidden: bool,
    ) -> Option<ZenoLimit<X>> {
        if self.arcs == 0 || !(self.durations[KEPT - 1] < LONGEST_LAST_ARC * time) {
            return None;
        }
        let criterion = if next_event_hidden { &NEXT_EVENT_HIDDEN } else { &USUAL };
        let mut limit = (1..=LONGEST_PERIOD)
            .find_map(|period| self.limit_with_period(period, time, criterion))?;
        // Every event may round the time by an ulp, and the state by an ulp, which changes the next duration.
        limit.time_error += 2.0 * f64::EPSILON * time * (1 + events) as f64;
        Some(limit)
    }

    fn limit_with_period(
        &self,
        period: usize,
        time: f64,
        criterion: &Criterion,
    ) -> Option<ZenoLimit<X>> {
        let periods = criterion.periods;
        let needed = (periods + 1) * period;
        if self.arcs < needed {
            return None;
        }
        let start = KEPT - needed;
        let sum_of =
            |k: usize| -> f64 { self.durations[start + k * period..][..period].iter().sum() };
        let ratio_of = |k: usize| sum_of(k + 1) / sum_of(k);
        let lowest = (0..periods).map(ratio_of).fold(f64::INFINITY, f64::min);
        let highest = (0..periods).map(ratio_of).fold(0.0, f64::max);
        if !(highest < 1.0 && lowest > 0.0 && highest - lowest <= criterion.spread * highest) {
            return None;
        }
        let (ratio, sum) = (ratio_of(periods - 1), sum_of(periods));
        // T q + T q² + … = T q/(1 − q), T the last period.
        let remainder = |ratio: f64| sum * ratio / (1.0 - ratio);
        if !(remainder(highest) <= criterion.remainder * time) {
            return None;
        }
        let now = self.states[KEPT - 1].as_ref()?;
        let mut step = now.clone();
        step.add_scaled(-1.0, self.states[KEPT - 1 - period].as_ref()?);
        let mut state = now.clone();
        state.add_scaled(ratio / (1.0 - ratio), &step);
        Some(ZenoLimit {
            time: time + remainder(ratio),
            time_error: remainder(highest) - remainder(lowest),
            state,
            state_error: step.largest() / (1.0 - ratio),
            ratio,
            period,
        })
    }
}
