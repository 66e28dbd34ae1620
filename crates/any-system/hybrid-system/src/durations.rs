//! The durations of the last arcs: do they have a sum although there is no end of them?
//!
//! Two records are kept: the last few durations, for series that fall fast, and marks at which the durations have
//! fallen to a half since the mark before, for series that fall slowly. An arc of no duration is not recorded: several
//! events at one instant are one event here.

mod remainder;

pub(crate) use remainder::Remainder;

use crate::time_sum::TimeSum;

/// Longest period that is looked for, in events: two guards that are crossed alternately give period 2, and 4 leaves
/// room for twice as many. A Zeno limit of a longer period is not recognised, and the execution ends at its limit on
/// events. A larger number costs a longer record, and more tests of every short arc.
pub(crate) const LONGEST_PERIOD: usize = 4;

/// Number of durations in the record, a power of two: enough for six periods of four events, and for a few events that
/// are dropped because of their errors.
const KEPT: usize = 32;

/// Number of marks in the record: eight durations that fall to a half each, a factor of 128 in all. A larger number
/// would ask for longer series before a power law is recognised.
const MARKS: usize = 8;

/// Rounding of a duration and of the state after it, relative, in ulps: each of the two is rounded once or twice.
const ROUNDING_ULPS: f64 = 4.0;

/// A duration below this many times its error is lost. A number near 1 would come too late: the durations may then no
/// longer fall at all. A larger number stops earlier than rounding demands.
const LOST: f64 = 4.0;

/// An event at which durations have fallen to a half since the mark before.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Mark {
    pub(crate) time: TimeSum,
    /// The last four durations, the newest first.
    pub(crate) durations: [f64; LONGEST_PERIOD],
    /// Bound on the error of each of their sums.
    pub(crate) error: f64,
    /// The sum of all four.
    pub(crate) sum: f64,
    /// The sum of the errors of all events up to here.
    pub(crate) total: f64,
}

/// The record.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Durations {
    /// A ring of durations.
    pub(crate) durations: [f64; KEPT],
    /// Their errors.
    pub(crate) errors: [f64; KEPT],
    /// The sums of the errors of all events up to theirs.
    pub(crate) totals: [f64; KEPT],
    /// Number of durations pushed since the record is empty.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::count::read_count"))]
    pub(crate) count: usize,
    /// A ring of marks.
    pub(crate) marks: [Mark; MARKS],
    /// Number of marks since durations have grown for the last time.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::count::read_count"))]
    pub(crate) marked: usize,
    /// True if the newest event is a mark.
    pub(crate) fresh: bool,
    /// The sum of four durations at the first mark.
    pub(crate) largest: f64,
    /// Time of the newest event.
    pub(crate) now: TimeSum,
    /// The sum of all durations of the execution, and of their errors as they act on the durations behind them.
    pub(crate) elapsed: f64,
    pub(crate) error: f64,
}

impl Durations {
    pub(crate) const fn new() -> Self {
        let mark = Mark {
            time: TimeSum::new(0.0),
            durations: [0.0; LONGEST_PERIOD],
            error: 0.0,
            sum: 0.0,
            total: 0.0,
        };
        Durations {
            durations: [0.0; KEPT],
            errors: [0.0; KEPT],
            totals: [0.0; KEPT],
            count: 0,
            marks: [mark; MARKS],
            marked: 0,
            fresh: false,
            largest: 0.0,
            now: TimeSum::new(0.0),
            elapsed: 0.0,
            error: 0.0,
        }
    }

    /// The next arc: its duration with the error, above zero, and the time of the event at its end.
    pub(crate) fn push(&mut self, duration: f64, error: f64, now: TimeSum) {
        let (before, stated) = (self.duration(0), self.stated_error(0));
        if duration > LOST * stated {
            // A flight from rest is half of a bounce.
            let whole = if self.count == 1 { 2.0 } else { 1.0 };
            self.error += stated * beyond_factor(whole * before / duration);
        }
        let place = self.count % KEPT;
        (self.durations[place], self.errors[place]) = (duration, error);
        self.count += 1;
        self.now = now;
        self.elapsed += duration;
        self.error += error;
        self.totals[place] = self.error;
        let last: [f64; LONGEST_PERIOD] = std::array::from_fn(|back| self.duration(back));
        let sum = last[0] + last[1] + (last[2] + last[3]);
        let before = self.marks[(self.marked + MARKS - 1) % MARKS].sum;
        let grows = self.marked == 0 || sum > before;
        self.fresh = grows || sum <= 0.5 * before;
        if grows {
            (self.marked, self.largest) = (0, sum);
        }
        if self.fresh {
            let error = (0..LONGEST_PERIOD).map(|back| self.duration_error(back)).sum();
            self.marks[self.marked % MARKS] =
                Mark { time: now, durations: last, error, sum, total: self.error };
            self.marked += 1;
        }
    }

    /// Forgets all arcs but the sums of time and errors.
    pub(crate) fn clear(&mut self) {
        (self.count, self.marked, self.fresh) = (0, 0, false);
    }

    /// The duration `back` arcs before the newest; 0 before the record begins.
    pub(crate) fn duration(&self, back: usize) -> f64 {
        self.before(&self.durations, back)
    }

    /// The error of that duration, as stated by the search.
    fn stated_error(&self, back: usize) -> f64 {
        self.before(&self.errors, back)
    }

    /// The sum of all errors up to `back` events before the newest.
    fn total(&self, back: usize) -> f64 {
        self.before(&self.totals, back)
    }

    /// The number of a ring `back` arcs before the newest; 0 before the record begins.
    fn before(&self, ring: &[f64; KEPT], back: usize) -> f64 {
        if back < self.count { ring[(self.count - 1 - back) % KEPT] } else { 0.0 }
    }

    /// The error of that duration, with its rounding.
    fn duration_error(&self, back: usize) -> f64 {
        self.stated_error(back) + ROUNDING_ULPS * f64::EPSILON * self.duration(back)
    }

    /// What the durations behind the newest one add up to, if they fall by a factor from each to the next as the last
    /// four from the four one earlier; 0 if they do not fall.
    pub(crate) fn expected(&self) -> f64 {
        let sum = |from: usize| -> f64 {
            (from..from + LONGEST_PERIOD).map(|back| self.duration(back)).sum()
        };
        let factor = sum(0) / sum(1);
        if !(factor < 1.0) {
            return 0.0;
        }
        // The one behind the newest is that of a period before, or shorter.
        let (mut next, mut power) = (0.0f64, factor);
        for back in 0..LONGEST_PERIOD {
            next = next.max(self.duration(back) * power);
            power *= factor;
        }
        next / (1.0 - factor)
    }

    /// True if the newest duration may be wrong by a large part of itself. Further durations are rounding errors then.
    pub(crate) fn is_lost(&self) -> bool {
        self.count > 0 && self.duration(0) < LOST * self.stated_error(0)
    }
}

/// How far an error δ of an event moves the limit, in units of δ, beyond the factor 1 + 2q/(1 − q) of a series that
/// falls by q at each event, if the durations fall by 1/q there.
///
/// At the event a ball is left at a height of δ times its speed, and 1/q times slower: all in all its limit moves by
/// (1 + 1/q) δ. That is more if q is below ½.
fn beyond_factor(fall: f64) -> f64 {
    if fall > 2.0 { fall - 2.0 / (fall - 1.0) } else { 0.0 }
}
