//! Infinitely many events in finite time (Zeno): recognised by their durations, with the limit.

use crate::State;
use std::collections::VecDeque;

/// The limit of infinitely many events.
///
/// The durations of the last arcs shrink by the same factor, to a hundredth of it, over five periods, and
/// what is left of them is under 10⁻¹² of the time so far. The limits are those of the geometric series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accumulation<const N: usize> {
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

/// Longest period looked for.
const LONGEST: usize = 4;

/// What may be left, relative to the time so far.
const LEFT: f64 = 1e-12;

/// The last arcs: how long each was, and the state after it.
#[derive(Debug, Clone)]
pub(crate) struct History<const N: usize> {
    arcs: VecDeque<(f64, State<N>)>,
}

impl<const N: usize> History<N> {
    pub(crate) fn new() -> Self {
        History { arcs: VecDeque::new() }
    }

    pub(crate) fn push(&mut self, duration: f64, after: State<N>) {
        if self.arcs.len() == (PERIODS + 1) * LONGEST {
            self.arcs.pop_front();
        }
        self.arcs.push_back((duration, after));
    }

    pub(crate) fn clear(&mut self) {
        self.arcs.clear();
    }

    /// The limit, if the events accumulate; `time` is that of the last of so many.
    pub(crate) fn accumulation(&self, time: f64, events: usize) -> Option<Accumulation<N>> {
        // The common case first: the last arc is no small part of all.
        let &(last, _) = self.arcs.back()?;
        if !(last < 1e-3 * time) {
            return None;
        }
        let mut limit = (1..=LONGEST).find_map(|period| self.with_period(period, time))?;
        // Every event may have rounded the time and the state by an ulp.
        limit.time_error += 2.0 * f64::EPSILON * time * (1 + events) as f64;
        Some(limit)
    }

    fn with_period(&self, period: usize, time: f64) -> Option<Accumulation<N>> {
        let newest = self.arcs.len();
        let start = newest.checked_sub((PERIODS + 1) * period)?;
        let sums: Vec<f64> = (0..=PERIODS)
            .map(|k| {
                let from = start + k * period;
                self.arcs.range(from..from + period).map(|(duration, _)| duration).sum()
            })
            .collect();
        let ratios: Vec<f64> = sums.windows(2).map(|pair| pair[1] / pair[0]).collect();
        let lowest = ratios.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = ratios.iter().copied().fold(0.0, f64::max);
        if !(highest < 1.0 && lowest > 0.0 && highest - lowest <= 0.01 * highest) {
            return None;
        }
        let (ratio, sum) = (ratios[PERIODS - 1], sums[PERIODS]);
        let rest = |ratio: f64| sum * ratio / (1.0 - ratio);
        if !(rest(highest) <= LEFT * time) {
            return None;
        }
        let (now, before) = (self.arcs[newest - 1].1, self.arcs[newest - 1 - period].1);
        let step = now - before;
        Some(Accumulation {
            time: time + rest(ratio),
            time_error: rest(highest) - rest(lowest),
            state: now + step * (ratio / (1.0 - ratio)),
            state_error: step.amax() / (1.0 - ratio),
            ratio,
            period,
        })
    }
}
