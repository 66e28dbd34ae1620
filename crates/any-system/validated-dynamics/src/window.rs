//! The times of a step at which all states of a set cross a surface.

use crate::system::ValidatedGuard;
use crate::tube::Tube;
use crate::undecided::Reason;
use interval_arithmetic::Enclosure;

/// How often a step is halved where a guard may be zero. The crossing itself is found by Newton's method: halves only show where.
const HALVES: u32 = 10;

/// The most steps of Newton's method. Each one squares the width, so that a few reach rounding.
const NEWTON_STEPS: usize = 12;

/// A step is cut before a crossing that does not end in it, unless this much of it or less is before: then the set is too wide.
const LEAST_PROGRESS: f64 = 0.1;

/// What happens first on a step.
#[derive(Debug, Clone, Copy)]
pub(crate) enum First {
    /// No guard has a zero that counts.
    Nothing,
    /// All states cross a surface.
    Crossing(Crossing),
    /// States begin to cross here, and not all of them are beyond the surface when the step ends: a step must begin here.
    Cut(f64),
}

/// A crossing of one surface by all states, once each, with none of another surface before or meanwhile.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossing {
    pub(crate) guard: usize,
    /// The times at which the states cross.
    pub(crate) times: Enclosure,
    /// A time at which all of them are beyond, not to rounding alone.
    pub(crate) beyond: f64,
}

/// The guards of a mode along a step.
#[derive(Debug)]
pub(crate) struct Guards<'t, 's> {
    pub(crate) tube: &'t Tube<'s>,
    pub(crate) guards: &'t [ValidatedGuard],
    /// For each guard, true if it is 0 at the start of the step, at all states.
    pub(crate) on: &'t [bool],
}

impl Guards<'_, '_> {
    /// The first event of the step.
    pub(crate) fn first(&self) -> Result<First, Reason> {
        let open = |guard| self.first_open(guard, 0.0, self.tube.length, HALVES);
        let open: Vec<(usize, f64)> =
            (0..self.guards.len()).filter_map(|guard| Some((guard, open(guard)?))).collect();
        let Some(&(guard, from)) = open.iter().min_by(|a, b| a.1.total_cmp(&b.1)) else {
            return Ok(First::Nothing);
        };
        let surface = self.guards[guard].surface;
        let Some(to) = self.time_beyond(guard, from) else {
            let length = self.tube.length;
            let is_late = from > LEAST_PROGRESS * length;
            return match is_late {
                true => Ok(First::Cut(from)),
                false if self.rate(guard, from, length).sign().is_some() => {
                    Err(Reason::TooWide { surface })
                }
                false => Err(Reason::Grazing { surface }),
            };
        };
        if self.side_before(guard, from).is_none() {
            return Err(Reason::OnSurface { surface });
        }
        if !self.counts(guard, self.rate(guard, from, to)) {
            return Err(Reason::Grazing { surface });
        }
        let times = self.narrower(guard, Enclosure::new(from, to));
        self.are_others_clear(guard, times.high())?;
        Ok(First::Crossing(Crossing { guard, times, beyond: to }))
    }

    /// An error if another guard than this one may be crossed up to a time of the step.
    pub(crate) fn are_others_clear(&self, guard: usize, until: f64) -> Result<(), Reason> {
        for other in (0..self.guards.len()).filter(|other| *other != guard) {
            if self.first_open(other, 0.0, until, HALVES).is_some() {
                let [first, second] = [guard, other].map(|place| self.guards[place].surface);
                return Err(Reason::TwoSurfaces { first, second });
            }
        }
        Ok(())
    }

    fn rate(&self, guard: usize, from: f64, to: f64) -> Enclosure {
        self.tube.guard_rate_at(guard, Enclosure::new(from, to))
    }

    /// True if a crossing with these rates is an event, at every state.
    fn counts(&self, guard: usize, rates: Enclosure) -> bool {
        let side = rates.sign();
        side.is_some() && self.guards[guard].side_after().is_none_or(|after| side == Some(after))
    }

    /// The sign of a guard at a time, if it is that of the side from which crossings that count come.
    fn side_before(&self, guard: usize, time: f64) -> Option<f64> {
        let side = self.tube.guard_at(guard, Enclosure::from(time)).sign();
        side.filter(|side| self.guards[guard].side_after().is_none_or(|after| *side == -after))
    }

    /// True if no state crosses the surface in a direction that counts, at times of the interval beyond its start.
    fn is_clear(&self, guard: usize, from: f64, to: f64) -> bool {
        let times = Enclosure::new(from, to);
        if from == 0.0 && self.on[guard] {
            // It is 0 at the time 0 alone, and the flow does not lead beyond a surface that bounds it.
            let side = self.tube.guard(guard).over_time(times).sign();
            if side.is_some() && side != self.guards[guard].side_beyond() {
                return true;
            }
        }
        let goes_back = |after: f64| self.tube.guard_rate_at(guard, times).sign() == Some(-after);
        self.tube.guard_at(guard, times).sign().is_some()
            || self.guards[guard].side_after().is_some_and(goes_back)
    }

    /// A time before which no state crosses, and after which one may; `None` if none does up to `to`.
    fn first_open(&self, guard: usize, from: f64, to: f64, halves: u32) -> Option<f64> {
        if self.is_clear(guard, from, to) {
            return None;
        }
        let middle = from.midpoint(to);
        if halves == 0 || !(from < middle && middle < to) {
            return Some(from);
        }
        let first = self.first_open(guard, from, middle, halves - 1);
        first.or_else(|| self.first_open(guard, middle, to, halves - 1))
    }

    /// A time after `from` at which all states are on the other side than at `from`.
    fn time_beyond(&self, guard: usize, from: f64) -> Option<f64> {
        let after = self.guards[guard].side_after();
        let side = after.or_else(|| self.side_before(guard, from).map(|before| -before))?;
        let is_beyond =
            |time: f64| self.tube.guard_at(guard, Enclosure::from(time)).sign() == Some(side);
        let pieces =
            (0..=HALVES).rev().map(|halves| from + self.tube.length / f64::from(1 << halves));
        let inside = pieces.filter(|time| *time < self.tube.length);
        inside.chain([self.tube.length]).find(|time| is_beyond(*time))
    }

    /// Narrower times at which all states cross.
    fn narrower(&self, guard: usize, times: Enclosure) -> Enclosure {
        newton(
            times,
            |time| self.tube.guard_at(guard, time),
            |time| self.tube.guard_rate_at(guard, time),
        )
    }
}

/// Narrower times at which a function is zero, which is so at a time of the interval for each of its values, by Newton's method.
fn newton(
    mut times: Enclosure,
    value: impl Fn(Enclosure) -> Enclosure,
    rate: impl Fn(Enclosure) -> Enclosure,
) -> Enclosure {
    for _ in 0..NEWTON_STEPS {
        let rates = rate(times);
        if rates.sign().is_none() {
            break;
        }
        let middle = Enclosure::from(times.middle());
        let found = middle - value(middle) / rates;
        let Some(narrower) = found.intersection(&times) else { break };
        if narrower.width() >= times.width() {
            break;
        }
        times = narrower;
    }
    times
}

/// The time at which the solution from the centre crosses, in the times at which all do.
pub(crate) fn crossing_of_centre(tube: &Tube<'_>, guard: usize, times: Enclosure) -> Enclosure {
    let expansion = tube.guard_of_centre(guard);
    newton(times, |time| expansion.at(time), |time| expansion.rate(time))
}
