//! The steps of a Runge–Kutta pair, for states of any kind.

use super::inverse_root::inverse_root;
use super::rows::{Rows, add_pairs, add_rows};
use super::schemes::{ALL_STAGES, Scheme, scheme_for};
use super::tolerances::Tolerances;
use super::vector::Vector;
use crate::error::Error;

// The step-size controller: h_new = h · clamp(SAFETY · error^(−1/order), SMALLEST_FACTOR, LARGEST_FACTOR), with the
// error in units of the tolerance. Its constants are the usual ones (Hairer, Nørsett, Wanner, II.4). They trade
// rejected steps for shorter steps and never affect whether a step meets its tolerance.

/// Safety factor of the step-size controller. Steps of exactly the predicted size would often be rejected.
const SAFETY: f64 = 0.9;

/// A step is at least this fraction of the step before. One very large error may come from outside the range where the
/// prediction holds, and should not stop the integration.
const SMALLEST_FACTOR: f64 = 0.2;

/// A step is at most this multiple of the step before. An error may be small by chance.
const LARGEST_FACTOR: f64 = 10.0;

/// Smallest step, relative to the last accepted one. Shorter steps mean that the field is not smooth there or that the
/// solution is leaving for infinity; the integration ends with [`Error::Integration`].
const SMALLEST_STEP: f64 = 1e-14;

/// Trials of one step. Each rejection shortens the step, usually by far. After a hundred rejections in a row the
/// integration ends with [`Error::Integration`].
const MOST_TRIALS: usize = 100;

/// A trial whose error exceeds the tolerance by this factor makes the next steps cautious. The controller aims at
/// less than half of the tolerance. With 3 van der Pol's oscillator takes up to 7 % more evaluations, and the worst
/// errors at kinks stay the same; with 1.5 the pendulum takes up to 17 % more.
const ROUGH: f64 = 10.0;

/// The reason of the error of an integration that has used its budget.
pub(super) const NO_STEPS_LEFT: &str = "no steps are left";

// The vectors that every step needs, as rows.

/// The state at the end of the last step.
pub(super) const STATE: usize = 0;
/// The field there.
pub(super) const SLOPE: usize = 1;
/// The state at the start of the last step.
pub(super) const BEFORE: usize = 2;
/// The state after the step that is tried, and the field there.
pub(super) const AFTER: usize = 3;
pub(super) const SLOPE_AFTER: usize = 4;
/// The estimated error of the step that is tried.
const ERROR: usize = 5;

/// Steps of the scheme.
///
/// Invariant: row `SLOPE` is the field at (`time`, row `STATE`), and after a step `slopes` and `stages` belong to the
/// step from (`from`, row `BEFORE`) to `time`, until [`directly_at`](Self::directly_at) overwrites them.
pub(super) struct Steps<F, V> {
    pub(super) field: F,
    pub(super) tolerances: Tolerances,
    pub(super) scheme: &'static Scheme,
    /// True if the field does not depend on time: where it is zero the state stays for ever.
    pub(super) autonomous: bool,
    /// Start and end of the last step.
    pub(super) from: f64,
    pub(super) time: f64,
    /// The argument of the field.
    pub(super) argument: V,
    pub(super) vectors: Rows<6>,
    /// The states at the stages of the last step.
    pub(super) stages: Rows<ALL_STAGES>,
    /// The field at the start of the last step, then the differences from it at the other stages.
    pub(super) slopes: Rows<ALL_STAGES>,
    /// True if the stages of the interpolant have been computed too. Most steps never need these stages.
    pub(super) dense: bool,
    /// The field is never evaluated beyond this time. It is below the start for an integration backward in time.
    pub(super) end: f64,
    /// Size of the last step, with its sign; 0 before the first.
    pub(super) last: f64,
    /// Planned length of the next step; `None` before the first.
    pub(super) next: Option<f64>,
    /// A bound on the length of the first step.
    pub(super) longest_first: f64,
    /// A kink of the field lies perhaps before this time: steps that start earlier, in the direction of the
    /// integration, estimate their errors by [`Scheme::kinks`] as well.
    pub(super) kink_until: f64,
    /// The last rejected trial ended here: steps that start earlier must meet a tolerance that is smaller by
    /// [`Scheme::kink_ratio`].
    pub(super) strict_until: f64,
    /// Number of trials, rejected ones included.
    pub(super) taken: usize,
}

/// Which estimates of the error a trial uses besides the usual one.
#[derive(Clone, Copy)]
struct Caution {
    /// The usual one, times [`Scheme::kink_ratio`].
    strict: bool,
    /// The one by [`Scheme::kinks`].
    kink: bool,
}

/// Why a trial of a step gave no error estimate.
pub(super) enum Failed {
    /// The field or the state is infinite or NaN at a stage: a shorter step may stay inside the domain of the field.
    NotFinite,
    /// The field has another number of components than the state.
    Length(usize),
}

impl<F: Fn(f64, &V) -> V, V: Vector> Steps<F, V> {
    pub(super) fn new(
        field: F,
        time: f64,
        start: &V,
        tolerances: Tolerances,
    ) -> Result<Self, Error> {
        let length = start.length();
        tolerances.check(start.states())?;
        let mut steps = Steps {
            field,
            tolerances,
            scheme: scheme_for(tolerances.relative),
            autonomous: false,
            from: time,
            time,
            argument: start.clone(),
            vectors: Rows::new(length),
            stages: Rows::new(length),
            slopes: Rows::new(length),
            dense: false,
            end: f64::INFINITY,
            last: 0.0,
            next: None,
            longest_first: f64::INFINITY,
            kink_until: time,
            strict_until: time,
            taken: 0,
        };
        if !time.is_finite() {
            return Err(Error::BadLimit { what: "the start of an integration", value: time });
        }
        let slope = (steps.field)(time, start);
        if slope.length() != length {
            return Err(wrong_length(length, slope.length()));
        }
        for axis in 0..length {
            steps.vectors.row_mut(STATE, length)[axis] = start.component(axis);
            steps.vectors.row_mut(BEFORE, length)[axis] = start.component(axis);
            steps.vectors.row_mut(SLOPE, length)[axis] = slope.component(axis);
        }
        for row in [STATE, SLOPE] {
            let row = steps.vectors.row(row, length);
            if !finite(row) {
                return Err(Error::StateNotFinite { time, jumps: 0, state: row.to_vec() });
            }
        }
        Ok(steps)
    }

    /// The number of components. The compiler knows it if the dimension is known when the program is compiled.
    pub(super) fn n(&self) -> usize {
        self.argument.length()
    }

    /// Tells the last time. It may lie before the start: the integration runs backward then.
    pub(super) fn until(&mut self, end: f64) -> Result<(), Error> {
        if end.is_nan() {
            return Err(Error::BadLimit { what: "the end of an integration", value: end });
        }
        self.end = end;
        Ok(())
    }

    pub(super) fn autonomous(&mut self) {
        self.autonomous = true;
    }

    pub(super) fn starting_with(&mut self, longest: f64) {
        self.longest_first = longest;
    }

    pub(super) fn step(&mut self) -> Result<(), Error> {
        let failed = |reason, time| Err(Error::Integration { reason, time });
        if self.ended() {
            return failed("its end has been reached", self.time);
        }
        let direction = if self.end > self.time { 1.0 } else { -1.0 };
        if self.at_rest() {
            return self.rest();
        }
        let mut next = match self.next {
            Some(next) => next,
            None => self.length_of_first_step(direction),
        };
        let mut largest_factor = LARGEST_FACTOR;
        let mut outside = false;
        for _ in 0..MOST_TRIALS {
            let longest = (self.end - self.time).abs();
            let length = next.min(self.tolerances.longest_step);
            let (size, to) = if length < longest {
                (direction * length, self.time + direction * length)
            } else {
                (self.end - self.time, self.end)
            };
            if !to.is_finite() {
                return failed("the time has become infinite", self.time);
            }
            // The last step may be as short as it has to be.
            let short = size.abs() < SMALLEST_STEP * self.last.abs() && to != self.end;
            if outside && (short || to == self.time) {
                return Err(self.wall());
            }
            if short || to == self.time {
                return failed("the step size has become too small", self.time);
            }
            if self.left() == 0 {
                return failed(NO_STEPS_LEFT, self.time);
            }
            self.taken += 1;
            let caution = Caution {
                strict: direction * (self.strict_until - self.time) > 0.0,
                kink: direction * (self.kink_until - self.time) > 0.0,
            };
            let (usual, norm) = match self.trial(size, to, caution) {
                Ok(norms) => norms,
                Err(Failed::NotFinite) => (f64::NAN, f64::NAN),
                Err(Failed::Length(found)) => {
                    return Err(wrong_length(self.n(), found));
                }
            };
            outside |= !norm.is_finite();
            // At a kink the error is of second order.
            let order = if caution.kink && norm > 1.0 { 2 } else { self.scheme.order };
            let predicted = SAFETY * inverse_root(norm, order);
            let factor = if norm.is_finite() {
                predicted.clamp(SMALLEST_FACTOR, largest_factor)
            } else {
                SMALLEST_FACTOR
            };
            next = size.abs() * factor;
            if norm <= 1.0 {
                self.next = Some(next);
                self.accept(size, to);
                return Ok(());
            }
            // Where a field is smooth, an error is seldom this large, and it falls so fast with the step that a second
            // rejection in a row is unusual. A kink lies in the shortest such trial.
            let again = usual > 1.0 && largest_factor == 1.0;
            let shorter = |until, known| if known { no_later(until, to, direction) } else { to };
            if again || usual > ROUGH {
                self.strict_until = shorter(self.strict_until, caution.strict);
            }
            if again {
                self.kink_until = shorter(self.kink_until, caution.kink);
            }
            // After a rejection the next trial must not be longer.
            largest_factor = 1.0;
        }
        if outside {
            return Err(self.wall());
        }
        failed("a hundred steps in a row were rejected", self.time)
    }

    /// The integration comes no further: the field is not finite just after the last state.
    fn wall(&self) -> Error {
        let state = self.vectors.row(STATE, self.n()).to_vec();
        Error::FieldNotFinite { time: self.time, state }
    }

    /// Tries a step of this size from now to `to`. Its result is the norm of the estimated error in units of the
    /// tolerances, the largest component: of the usual estimate, and of the one that decides. At most 1 means that
    /// the rows `AFTER` and `SLOPE_AFTER` are the next state.
    fn trial(&mut self, size: f64, to: f64, caution: Caution) -> Result<(f64, f64), Failed> {
        let n = self.n();
        self.slopes.row_mut(0, n).copy_from_slice(self.vectors.row(SLOPE, n));
        for stage in 1..self.scheme.stages {
            self.stage(stage, (self.time, STATE), size, to)?;
        }
        self.combine(STATE, size);
        let slopes = self.slopes.all(n);
        add_rows(self.vectors.row_mut(ERROR, n), None, (size, self.scheme.errors), slopes);
        let row = |k| self.vectors.row(k, n);
        let (before, after, errors) = (row(STATE), row(AFTER), row(ERROR));
        let (mut usual, mut worst): (f64, f64) = (0.0, 0.0);
        for axis in 0..n {
            let (a, b) = (before[axis].abs(), after[axis].abs());
            let allowed = self.tolerances.of(axis, if a > b { a } else { b });
            let error = (errors[axis] / allowed).abs();
            // `f64::max` would drop NaN, and the step would be accepted.
            usual = if error > usual || error.is_nan() { error } else { usual };
            if usual.is_nan() {
                return Ok((usual, usual));
            }
            if caution.kink {
                let terms = self.scheme.kinks.iter().zip(slopes.chunks_exact(n));
                let sum = terms.fold(0.0, |sum, (weight, row)| sum + size * weight * row[axis]);
                worst = worst.max((sum / allowed).abs());
            }
        }
        worst = worst.max(if caution.strict { usual * self.scheme.kink_ratio } else { usual });
        if worst <= 1.0 && !self.scheme.first_same_as_last {
            let after = self.vectors.row(AFTER, n);
            self.argument.set_components(after);
            let slope = (self.field)(to, &self.argument);
            check_length(&slope, n)?;
            let slope_after = self.vectors.row_mut(SLOPE_AFTER, n);
            (0..n).for_each(|axis| slope_after[axis] = slope.component(axis));
        }
        let is_finite = worst > 1.0
            || finite(self.vectors.row(AFTER, n)) && finite(self.vectors.row(SLOPE_AFTER, n));
        if is_finite { Ok((usual, worst)) } else { Err(Failed::NotFinite) }
    }

    /// Row `AFTER`: the state after a step of this size from row `from`, whose stages have been computed.
    pub(super) fn combine(&mut self, from: usize, size: f64) {
        let n = self.n();
        if self.scheme.first_same_as_last {
            let last = self.stages.row(self.scheme.stages - 1, n);
            self.vectors.row_mut(AFTER, n).copy_from_slice(last);
            return;
        }
        let (first, second) = self.vectors.all_mut(n).split_at_mut(AFTER * n);
        let from = &first[from * n..(from + 1) * n];
        add_rows(&mut second[..n], Some(from), (size, self.scheme.weights), self.slopes.all(n));
    }

    /// Computes one stage of a step of this size from `time` and the row `from`, no later than `to`. Its slope is kept
    /// as the difference from the slope at the start (see `schemes`).
    pub(super) fn stage(
        &mut self,
        stage: usize,
        (time, from): (f64, usize),
        size: f64,
        to: f64,
    ) -> Result<(), Failed> {
        let n = self.n();
        let slopes = self.slopes.all_mut(n);
        let from = self.vectors.row(from, n);
        let at = self.stages.row_mut(stage, n);
        let mut put = |axis, value| {
            at[axis] = value;
            self.argument.set_component(axis, value);
        };
        add_pairs(&mut put, from, (size, self.scheme.rows[stage]), slopes);
        let time = no_later(time + size * self.scheme.times[stage], to, size);
        let slope = (self.field)(time, &self.argument);
        check_length(&slope, n)?;
        let mut is_finite = true;
        for axis in 0..n {
            let component = slope.component(axis);
            is_finite &= component.is_finite();
            slopes[stage * n + axis] = component - slopes[axis];
        }
        if self.scheme.first_same_as_last && stage + 1 == self.scheme.stages {
            let slope_after = self.vectors.row_mut(SLOPE_AFTER, n);
            (0..n).for_each(|axis| slope_after[axis] = slope.component(axis));
        }
        if is_finite { Ok(()) } else { Err(Failed::NotFinite) }
    }

    /// The trial becomes the last step.
    pub(super) fn accept(&mut self, size: f64, to: f64) {
        let n = self.n();
        let all = self.vectors.all_mut(n);
        all.copy_within(STATE * n..(STATE + 1) * n, BEFORE * n);
        all.copy_within(AFTER * n..(AFTER + 1) * n, STATE * n);
        all.copy_within(SLOPE_AFTER * n..(SLOPE_AFTER + 1) * n, SLOPE * n);
        self.dense = false;
        (self.from, self.time, self.last) = (self.time, to, size);
    }
}

/// `time`, or `last` if `time` is later in the direction of the integration.
pub(super) fn no_later(time: f64, last: f64, direction: f64) -> f64 {
    if (time - last) * direction > 0.0 { last } else { time }
}

pub(super) fn finite(components: &[f64]) -> bool {
    components.iter().all(|component| component.is_finite())
}

fn check_length<V: Vector>(slope: &V, length: usize) -> Result<(), Failed> {
    if slope.length() == length { Ok(()) } else { Err(Failed::Length(slope.length())) }
}

fn wrong_length(expected: usize, found: usize) -> Error {
    Error::Dimension { what: "the vector field", expected, found }
}
