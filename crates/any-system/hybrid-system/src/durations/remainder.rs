//! The sum of all further durations, predicted from the record.

use super::{Durations, KEPT, LONGEST_PERIOD, MARKS, ROUNDING_ULPS, beyond_factor};
use crate::series_fit::{Fit, Period, geometric, power_law};

/// Periods that are compared in the usual case. Five slopes between them within one per cent are unlikely by chance.
const USUAL_PERIODS: usize = 6;

/// Events between the ends of periods that are compared, for periods of 1 to 4 events. Factors near 1 need a longer
/// stride, for the lengths to fall enough. No period has a longer one than period 1, so that a multiple of the period
/// is not found before it.
const STRIDES: [&[usize]; LONGEST_PERIOD] = [&[1, 6], &[2, 6], &[3], &[4]];

/// Durations that are compared with those a period before: two of the longest periods.
const COMPARED: usize = 2 * LONGEST_PERIOD;

/// Largest difference between the falls of single durations and the fall that the limit demands, relative. An
/// alternation by more than this is a longer period.
const PERIOD_SPREAD: f64 = 0.1;

/// Periods that are compared if rounding hides the next event. The execution cannot continue in any other way then.
const FEWEST_PERIODS: usize = 3;

/// Largest difference of the slopes, relative to the largest, in the usual case; see [`USUAL_PERIODS`]. A surface that
/// moves or curves changes the slope in proportion to the duration, which is below 10⁻¹² of the time so far.
const USUAL_SPREAD: f64 = 0.01;

/// The same if rounding hides the next event. The last durations have rounding errors then, so that slopes differ more.
const HIDDEN_SPREAD: f64 = 0.1;

/// Largest remainder, relative to the time so far, in the usual case. It is the error of an execution that stops there.
/// It is far below every tolerance of a model, and above the rounding of the time, 10⁻¹⁶.
const USUAL_REMAINDER: f64 = 1e-12;

/// Largest remainder, relative to the time so far, if rounding hides the next event, or for a slow power law. A guard
/// at a surface of size 1 hides a bounce of duration T if its height, of order T², is below 10⁻¹⁶. The remainder may
/// therefore be about 10⁻⁷, and larger for large coordinates. Under a power law k⁻² the remainder is 10⁻⁵ after 10⁵
/// events; 10⁻¹² would need 10¹².
const LARGEST_REMAINDER: f64 = 1e-5;

/// Least order μ of a slow power law: durations fall like k^(−μ/(μ−1)), here k^−3.5 and slower. A faster series reaches
/// the usual remainder within some 10⁵ events.
const SLOW_ORDER: f64 = 1.4;

/// Largest order μ that is recognised, for durations that fall like k^−1.14. Durations 1/k, which have no limit, are
/// the case μ = ∞. A larger number would come closer to them.
const LARGEST_ORDER: f64 = 8.0;

/// Largest error of the limit of a slow power law, relative to the time so far. The execution goes on until then.
const SLOW_ERROR: f64 = 1e-10;

/// In the usual case durations must have fallen by this factor since they fell for the first time. A few short
/// arcs that happen to shrink, such as those between nearly simultaneous events, are not a series that has fallen for
/// long.
const LEAST_FALL: f64 = 1e3;

/// The longest last arc, relative to the time so far, that may be followed by a Zeno limit. It only delays the
/// recognition of a limit whose factor is below 10⁻⁹.
const LONGEST_LAST_ARC: f64 = 1e-3;

/// The most events that are dropped at the end of the record if rounding hides the next event. A bounce of velocity v
/// on a surface of size 1 has a relative error of 10⁻¹⁶/v², so that with a restitution of ½ each dropped event reduces
/// the error by a factor of 4. For restitutions near 1 the marks are used.
const MOST_DROPPED: usize = 8;

/// The sum of all further durations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Remainder {
    /// Time from the last event to the limit.
    pub(crate) time: f64,
    /// Bound on the error of the limit.
    pub(crate) error: f64,
    /// Events in one period.
    pub(crate) period: usize,
    /// The length of the last period.
    pub(crate) length: f64,
    /// The order μ of the law: 1 for a geometric series.
    pub(crate) order: f64,
}

impl Durations {
    /// The sum of all further durations in the usual case; `None` if they are not recognised as a convergent series.
    pub(crate) fn remainder(&self) -> Option<Remainder> {
        // This test makes the record cheap for an execution whose durations do not fall.
        let sum = self.duration(0) + self.duration(1) + (self.duration(2) + self.duration(3));
        if !(LEAST_FALL * sum <= self.largest) {
            return None;
        }
        (1..=LONGEST_PERIOD).find_map(|period| {
            // The remainder of a geometric series is D²/(D_before − D). This test saves the fits.
            let sum = |from: usize| -> f64 {
                (from..from + period).map(|back| self.duration(back)).sum()
            };
            let (last, before) = (sum(0), sum(period));
            let near = last * last <= 2.0 * USUAL_REMAINDER * self.elapsed * (before - last);
            let strides = if near { STRIDES[period - 1] } else { &[] };
            let mut fast = strides.iter().filter_map(|&stride| {
                let periods = self.recent(period, stride, 0, USUAL_PERIODS)?;
                let fit = geometric(&periods, USUAL_SPREAD)?;
                self.accepted(fit, &periods, period, self.error, USUAL_REMAINDER)
            });
            fast.next().or_else(|| self.slow(period)).filter(|found| self.is_period(found))
        })
    }

    /// The same from marks, at a new mark.
    fn slow(&self, period: usize) -> Option<Remainder> {
        if !self.fresh || self.marked < MARKS {
            return None;
        }
        let periods = self.marked_periods(period, 0, MARKS)?;
        let newest = &periods[MARKS - USUAL_PERIODS..];
        if let Some(fit) = geometric(newest, USUAL_SPREAD) {
            return self.accepted(fit, newest, period, self.error, USUAL_REMAINDER);
        }
        // The remainder of a power law is larger than that of the straight line through the last two lengths. This
        // test saves the fit while the remainder is large.
        let [.., before, last] = periods.as_slice() else { return None };
        let line = last.length * (last.end - before.end) / (before.length - last.length);
        if !(line <= LARGEST_REMAINDER * self.elapsed) {
            return None;
        }
        let fit = power_law(newest).filter(|fit| fit.order <= LARGEST_ORDER)?;
        if fit.order >= SLOW_ORDER && fit.error <= SLOW_ERROR * self.elapsed {
            return self.accepted(fit, newest, period, self.error, LARGEST_REMAINDER);
        }
        self.accepted(fit, newest, period, self.error, USUAL_REMAINDER)
    }

    /// The sum of all further durations if rounding hides the next event.
    ///
    /// The last durations have large errors then. The limit is predicted from several earlier events, and the
    /// prediction with the smallest bound is taken.
    pub(crate) fn remainder_if_hidden(&self) -> Option<Remainder> {
        if self.count == 0 || !(self.duration(0) < LONGEST_LAST_ARC * self.elapsed) {
            return None;
        }
        (1..=LONGEST_PERIOD).find_map(|period| {
            let recent = (0..=MOST_DROPPED).filter_map(|dropped| {
                (FEWEST_PERIODS..=USUAL_PERIODS).find_map(|number| {
                    let periods = self.recent(period, period, dropped, number)?;
                    let fit = geometric(&periods, hidden_spread(&periods)?)?;
                    self.accepted(fit, &periods, period, self.total(dropped), LARGEST_REMAINDER)
                })
            });
            let marked = (0..MARKS - FEWEST_PERIODS).filter_map(|dropped| {
                let number = MARKS.min(self.marked).checked_sub(dropped)?.min(USUAL_PERIODS);
                let periods = self.marked_periods(period, dropped, number)?;
                let fit = geometric(&periods, hidden_spread(&periods)?)
                    .or_else(|| power_law(&periods).filter(|fit| fit.order <= LARGEST_ORDER))?;
                let total = self.marks[(self.marked - 1 - dropped) % MARKS].total;
                self.accepted(fit, &periods, period, total, LARGEST_REMAINDER)
            });
            recent.chain(marked).min_by(|a, b| a.error.total_cmp(&b.error))
        })
    }

    /// True if each of the last eight durations is in the ratio to the one a period before that the limit demands.
    /// Durations that alternate look like a series of period 1 at every second event.
    fn is_period(&self, found: &Remainder) -> bool {
        // 1 − q of the durations is μ times that of the remainder.
        let fall = found.order * found.length / (found.length + found.time);
        (0..COMPARED.min(self.count - found.period)).all(|back| {
            let before = self.duration(back + found.period);
            let fell = 1.0 - self.duration(back) / before;
            let noise =
                (self.duration_error(back) + self.duration_error(back + found.period)) / before;
            (fell - fall).abs() <= PERIOD_SPREAD * fall + noise
        })
    }

    /// `number` periods, the oldest first, that end `stride` events apart, after dropping the newest events.
    fn recent(
        &self,
        period: usize,
        stride: usize,
        dropped: usize,
        number: usize,
    ) -> Option<Periods> {
        if dropped + (number - 1) * stride + period > self.count.min(KEPT) {
            return None;
        }
        let sum = |from: usize, to: usize| (from..to).map(|back| self.duration(back)).sum::<f64>();
        let mut periods = Periods::new();
        let mut end = -sum(0, dropped);
        for index in 0..number {
            let first = dropped + index * stride;
            let error = (first..first + period).map(|back| self.duration_error(back)).sum();
            let length = sum(first, first + period);
            periods.push(Period { end, length, error });
            end -= sum(first, first + stride);
        }
        periods.reverse();
        Some(periods)
    }

    /// The periods at `number` marks, the oldest first, after dropping the newest marks.
    fn marked_periods(&self, period: usize, dropped: usize, number: usize) -> Option<Periods> {
        if number < FEWEST_PERIODS || dropped + number > self.marked.min(MARKS) {
            return None;
        }
        let mut periods = Periods::new();
        for back in dropped..dropped + number {
            let mark = &self.marks[(self.marked - 1 - back) % MARKS];
            let length: f64 = mark.durations[..period].iter().sum();
            if !(length > 0.0) {
                return None;
            }
            periods.push(Period { end: mark.time.since(self.now), length, error: mark.error });
        }
        periods.reverse();
        Some(periods)
    }

    /// The remainder after the newest event from a fit, if it is not above `largest` of the time so far. `total` is the
    /// sum of the errors of the events up to the end of the fit: later events do not change the limit that is
    /// predicted.
    fn accepted(
        &self,
        fit: Fit,
        periods: &[Period],
        period: usize,
        total: f64,
        largest: f64,
    ) -> Option<Remainder> {
        let last = periods.last()?;
        // An error δ of an event changes its time by δ and the next speeds by the acceleration times δ. For a bounce
        // this changes all further durations by 2δ/T of their size, T the duration before it.
        let mean = last.length / period as f64;
        let amplification = 1.0 + 2.0 * fit.remainder / (fit.order * mean);
        // The errors of the events may be larger than stated. An error δ shows in the slope as δ/T of its size, or
        // more.
        let shown = fit.scatter * mean;
        // The error of the last event acts on the next duration, which is not in the record.
        let next = last.error * beyond_factor((last.length + fit.remainder) / fit.remainder);
        let accumulated = total + next + ROUNDING_ULPS * f64::EPSILON * self.elapsed + shown;
        let time = last.end + fit.remainder;
        // The limit is not earlier than the newest event.
        let error = fit.error + (-time).max(0.0);
        let accepted = time + error <= largest * self.elapsed || {
            // Errors of the events do not shrink with further events.
            largest >= LARGEST_REMAINDER && time <= largest * self.elapsed
        };
        let length = (0..period).map(|back| self.duration(back)).sum();
        accepted.then_some(Remainder {
            time: time.max(0.0),
            error: error + amplification * accumulated,
            period,
            length,
            order: fit.order,
        })
    }
}

/// The largest spread of the slopes of these periods if rounding hides the next event; `None` if they do not suffice.
///
/// Lengths below their errors may be noise, and three of them often fall in proportion by chance. As many as usual must
/// agree.
fn hidden_spread(periods: &[Period]) -> Option<f64> {
    if periods.iter().all(|period| period.error < period.length) {
        return Some(HIDDEN_SPREAD);
    }
    (periods.len() >= USUAL_PERIODS).then_some(USUAL_SPREAD)
}

/// A list of periods.
type Periods = smallvec::SmallVec<[Period; MARKS]>;
