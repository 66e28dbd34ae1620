//! Infinitely many events in finite time (Zeno): recognised by their durations, with the limit.

use crate::State;

/// The limit of infinitely many events.
///
/// The durations of the last arcs shrink by the same factor, to a hundredth of it, over five periods, and
/// what is left of them is under 10⁻¹² of the time so far. Where rounding hides the next event two periods, a tenth and
/// 10⁻⁵ suffice.
/// The limits are those of the geometric series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZenoLimit<const N: usize> {
    /// When it is: the sum of all durations.
    pub time: f64,
    /// Bound on the error of `time`, given that the factor stays between those seen and that each event was
    /// right to an ulp.
    pub time_error: f64,
    /// The state there, extrapolated.
    pub state: State<N>,
    /// How far the state still moved over the last period, divided by 1 − factor.
    pub state_error: f64,
    /// The factor by which durations shrink in a period.
    pub ratio: f64,
    /// Number of events in a period.
    pub period: usize,
}

/// Periods that must agree.
const PERIODS: usize = 5;

/// And where rounding hides the next event, which may be soon.
const PERIODS_WHEN_HIDDEN: usize = 2;

/// Longest period looked for.
const LONGEST: usize = 4;

/// What may be left, relative to the time so far.
const LEFT: f64 = 1e-12;

/// What may be left where rounding hides the next event: the surfaces need not be at zero.
const LEFT_WHEN_HIDDEN: f64 = 1e-5;

/// How far the factors of the periods may be apart, relative to them; where rounding hides, too.
const APART: f64 = 0.01;
const APART_WHEN_HIDDEN: f64 = 0.1;

/// Arcs that are kept: those of the longest period, so often as they must agree, and once more.
const KEPT: usize = (PERIODS + 1) * LONGEST;

/// The last arcs: how long each was, and the state after it; the newest last.
#[derive(Debug, Clone)]
pub(crate) struct History<const N: usize> {
    durations: [f64; KEPT],
    states: [State<N>; KEPT],
    arcs: usize,
}

impl<const N: usize> History<N> {
    pub(crate) fn new() -> Self {
        History { durations: [0.0; KEPT], states: [State::zeros(); KEPT], arcs: 0 }
    }

    pub(crate) fn push(&mut self, duration: f64, after: State<N>) {
        self.durations.rotate_left(1);
        self.states.rotate_left(1);
        (self.durations[KEPT - 1], self.states[KEPT - 1]) = (duration, after);
        self.arcs = (self.arcs + 1).min(KEPT);
    }

    pub(crate) fn clear(&mut self) {
        self.arcs = 0;
    }

    /// The limit, if the events accumulate; `time` is that of the last of so many.
    pub(crate) fn accumulation(
        &self,
        time: f64,
        events: usize,
        hidden: bool,
    ) -> Option<ZenoLimit<N>> {
        // The common case first: the last arc is no small part of all.
        if self.arcs == 0 || !(self.durations[KEPT - 1] < 1e-3 * time) {
            return None;
        }
        let mut limit = (1..=LONGEST).find_map(|period| self.with_period(period, time, hidden))?;
        // Every event may have rounded the time and the state by an ulp.
        limit.time_error += 2.0 * f64::EPSILON * time * (1 + events) as f64;
        Some(limit)
    }

    fn with_period(&self, period: usize, time: f64, hidden: bool) -> Option<ZenoLimit<N>> {
        let (periods, left, apart) = if hidden {
            (PERIODS_WHEN_HIDDEN, LEFT_WHEN_HIDDEN, APART_WHEN_HIDDEN)
        } else {
            (PERIODS, LEFT, APART)
        };
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
        if !(highest < 1.0 && lowest > 0.0 && highest - lowest <= apart * highest) {
            return None;
        }
        let (ratio, sum) = (ratio_of(periods - 1), sum_of(periods));
        let rest = |ratio: f64| sum * ratio / (1.0 - ratio);
        if !(rest(highest) <= left * time) {
            return None;
        }
        let now = self.states[KEPT - 1];
        let step = now - self.states[KEPT - 1 - period];
        Some(ZenoLimit {
            time: time + rest(ratio),
            time_error: rest(highest) - rest(lowest),
            state: now + step * (ratio / (1.0 - ratio)),
            state_error: step.amax() / (1.0 - ratio),
            ratio,
            period,
        })
    }
}
