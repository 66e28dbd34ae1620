//! Solutions of ẋ = f(t, x), step by step, with a polynomial for the state inside each step.

use super::chebyshev::NODES;
use super::first_step::first_step;
use super::inverse_root::inverse_root;
use super::schemes::{ALL_STAGES, Scheme, scheme_for};
use super::step::Step;
use super::tolerances::Tolerances;
use super::vector::Vector;
use crate::error::Error;
use crate::state::State;

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

/// A solution of ẋ = f(t, x), followed step by step.
/// The scheme is Verner's pair of orders 9 and 8, or of orders 8 and 7 for relative tolerances from 2e-11 on. The
/// tolerance bounds the estimated error of each step. The flow propagates these errors, and they add up. If the field
/// gives the same results on every machine, so does the integration. It allocates no memory.
///
/// ```
/// use hybrid_system::{Integration, Tolerances};
/// use nalgebra::Vector2;
///
/// let pendulum = |_: f64, x: &Vector2<f64>| Vector2::new(x[1], -x[0]);
/// let mut swing = Integration::new(pendulum, &Vector2::new(1.0, 0.0), Tolerances::both(1e-12))?;
/// while swing.interval().1 < std::f64::consts::PI {
///     swing.step()?;
/// }
/// let half = swing.at(std::f64::consts::PI)?;
/// assert!((half - Vector2::new(-1.0, 0.0)).norm() < 1e-11);
/// # Ok::<(), hybrid_system::Error>(())
/// ```
pub struct Integration<F, const N: usize> {
    inner: Steps<F, State<N>>,
    /// The polynomial of the last step; `None` until [`at`](Self::at) needs it.
    inside: Option<Step<N>>,
}

impl<F: Fn(f64, &State<N>) -> State<N>, const N: usize> Integration<F, N> {
    /// Starts from `start` at time zero.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless both tolerances are positive and finite,
    /// [`Error::StateNotFinite`] for a start or a first derivative that is not finite.
    pub fn new(field: F, start: &State<N>, tolerances: Tolerances) -> Result<Self, Error> {
        Ok(Integration { inner: Steps::new(field, start, tolerances)?, inside: None })
    }

    /// As `self`, with a first step no longer than `longest`.
    pub(super) fn starting_with(mut self, longest: f64) -> Self {
        self.inner.next = self.inner.next.min(longest);
        self
    }

    /// Start and end of the last step; both zero before the first step.
    pub fn interval(&self) -> (f64, f64) {
        (self.inner.from, self.inner.time)
    }

    /// The state at the end of the last step.
    pub fn state(&self) -> State<N> {
        self.inner.state
    }

    /// Takes one step within the tolerances.
    ///
    /// # Errors
    /// [`Error::Integration`] if no step meets the tolerances, or no steps are left;
    /// [`Error::StateNotFinite`] if the state is no longer finite.
    pub fn step(&mut self) -> Result<(), Error> {
        self.inside = None;
        self.inner.step()
    }

    /// The state at a time in the last step, by its interpolant.
    ///
    /// # Errors
    /// [`Error::Integration`] for a time outside the [`interval`](Self::interval).
    pub fn at(&mut self, time: f64) -> Result<State<N>, Error> {
        let (from, to) = self.interval();
        if !(time >= from && time <= to) {
            return Err(Error::Integration { reason: "outside the last step", time });
        }
        if from == to {
            return Ok(self.inner.state);
        }
        Ok(self.inside.get_or_insert_with(|| self.inner.inside()).state(time))
    }

    /// The polynomial of the last step.
    pub(super) fn last_step(&mut self) -> Step<N> {
        self.inner.inside()
    }

    /// States along the last step that need no evaluation of the field: the states of the stages, and nine states of
    /// the cubic through both ends with their slopes, an eighth of the step apart.
    ///
    /// These states show the shape of the orbit, not its digits: the stages are of low order, and the error of the
    /// cubic is of order h⁴. They are used to test that a guard stays far from zero.
    pub(super) fn samples(&self) -> impl Iterator<Item = State<N>> {
        let Steps { before, state, slopes, slope, last, stages, scheme, .. } = &self.inner;
        let cubic = (0..=8).map(move |k| {
            // The cubic Hermite interpolant at s ∈ [0, 1], r = 1 − s.
            let s = 0.125 * f64::from(k);
            let (r, part) = (1.0 - s, s * (1.0 - s) * last);
            before * (r * r * (1.0 + 2.0 * s))
                + state * (s * s * (1.0 + 2.0 * r))
                + (slopes[0] * r - slope * s) * part
        });
        stages[1..scheme.stages].iter().copied().chain(cubic)
    }

    /// The state at a time in the last step, computed by [`Steps::directly_at`].
    pub(super) fn directly_at(&mut self, time: f64) -> Result<State<N>, Error> {
        self.inner.directly_at(time)
    }
}

/// Steps of the scheme, for states of any kind.
///
/// Invariant: `slope` is the field at (`time`, `state`), and after a step `slopes` and `stages` belong to the step from
/// (`from`, `before`) of size `last`, until [`directly_at`](Self::directly_at) overwrites them.
pub(super) struct Steps<F, V> {
    field: F,
    tolerances: Tolerances,
    scheme: &'static Scheme,
    /// Time and state at the start of the last step.
    from: f64,
    before: V,
    /// Time, state and its derivative at the end of the last step.
    pub(super) time: f64,
    state: V,
    slope: V,
    /// The states at the stages of the last step.
    stages: [V; ALL_STAGES],
    /// The field at the start of the last step, then the differences from it at the other stages.
    slopes: [V; ALL_STAGES],
    /// True if the stages of the interpolant have been computed too. Most steps never need these stages.
    dense: bool,
    /// Size of the last step, and planned size of the next.
    last: f64,
    next: f64,
    /// Number of trials, rejected ones included.
    taken: usize,
}

impl<F: Fn(f64, &V) -> V, V: Vector> Steps<F, V> {
    pub(super) fn new(field: F, start: &V, tolerances: Tolerances) -> Result<Self, Error> {
        tolerances.check()?;
        start.check_finite(0.0)?;
        let slope = field(0.0, start);
        slope.check_finite(0.0)?;
        let scheme = scheme_for(tolerances.relative);
        let next = first_step(&field, start, &slope, tolerances, scheme.order);
        Ok(Steps {
            field,
            tolerances,
            scheme,
            from: 0.0,
            before: *start,
            time: 0.0,
            state: *start,
            slope,
            stages: [V::zero(); ALL_STAGES],
            slopes: [V::zero(); ALL_STAGES],
            dense: false,
            last: 0.0,
            next,
            taken: 0,
        })
    }

    pub(super) fn step(&mut self) -> Result<(), Error> {
        let failed = |reason, time| Err(Error::Integration { reason, time });
        let mut largest_factor = LARGEST_FACTOR;
        for _ in 0..MOST_TRIALS {
            let size = self.next;
            if size < SMALLEST_STEP * self.last || self.time + size <= self.time {
                return failed("the step size has become too small", self.time);
            }
            if self.taken >= self.tolerances.steps {
                return failed("no steps are left", self.time);
            }
            self.taken += 1;
            self.slopes[0] = self.slope;
            let (state, error) = self.trial(size);
            let norm = error.in_tolerances(&self.state, &state, &self.tolerances);
            // The norm is not finite if a stage lies outside the domain of the field: a shorter step may stay inside.
            let predicted = SAFETY * inverse_root(norm, self.scheme.order);
            let factor = if norm.is_finite() {
                predicted.clamp(SMALLEST_FACTOR, largest_factor)
            } else {
                SMALLEST_FACTOR
            };
            self.next = size * factor;
            if norm <= 1.0 {
                self.dense = false;
                (self.from, self.before) = (self.time, self.state);
                (self.time, self.state, self.last) = (self.time + size, state, size);
                self.slope = (self.field)(self.time, &self.state);
                return self.state.check_finite(self.time);
            }
            // After a rejection the next trial must not be longer.
            largest_factor = 1.0;
        }
        failed("a hundred steps in a row were rejected", self.time)
    }

    /// The state after a step of this size from now, and an estimate of its error.
    fn trial(&mut self, size: f64) -> (V, V) {
        for stage in 1..self.scheme.stages {
            self.stage(stage, self.time, self.state, size);
        }
        let (mut after, mut error) = (self.state, V::zero());
        for (slope, (b, e)) in
            self.slopes.iter().zip(self.scheme.weights.iter().zip(self.scheme.errors))
        {
            after.add(size * b, slope);
            error.add(size * e, slope);
        }
        (after, error)
    }

    /// Computes one stage of a step of this size from `from` at `time`. Its slope is kept as the difference from the
    /// slope at the start (see `schemes`).
    fn stage(&mut self, stage: usize, time: f64, from: V, size: f64) {
        let at = V::combination(&from, size, self.scheme.rows[stage], &self.slopes);
        self.stages[stage] = at;
        self.slopes[stage] = (self.field)(time + size * self.scheme.times[stage], &at);
        let first = self.slopes[0];
        self.slopes[stage].add(-1.0, &first);
    }

    /// The state at a time in the last step, by a separate step that ends there.
    ///
    /// The coefficients of the interpolant are large and cancel. This separate step loses no digits. Its stages
    /// overwrite the stages of the last step.
    pub(super) fn directly_at(&mut self, time: f64) -> Result<V, Error> {
        let size = time - self.from;
        let mut state = self.before;
        for stage in 1..self.scheme.stages {
            self.stage(stage, self.from, self.before, size);
        }
        for (slope, b) in self.slopes.iter().zip(self.scheme.weights) {
            state.add(size * b, slope);
        }
        state.check_finite(time).map(|()| state)
    }
}

impl<F: Fn(f64, &State<N>) -> State<N>, const N: usize> Steps<F, State<N>> {
    /// The polynomial of the last step: at node j the state is before + h Σᵢ bᵢ(sⱼ) kᵢ.
    fn inside(&mut self) -> Step<N> {
        if !self.dense {
            for stage in self.scheme.stages..ALL_STAGES {
                self.stage(stage, self.from, self.before, self.last);
            }
            self.dense = true;
        }
        let mut changes = [[0.0; NODES]; N];
        for (slope, weights) in self.slopes.iter().zip(&self.scheme.nodes) {
            for (axis, changes) in changes.iter_mut().enumerate() {
                for (sum, weight) in changes.iter_mut().zip(weights) {
                    *sum += weight * slope[axis];
                }
            }
        }
        let node =
            |j: usize| State::from_fn(|axis, _| self.before[axis] + self.last * changes[axis][j]);
        Step::new(self.from, self.time, std::array::from_fn(node))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    fn pendulum(_: f64, x: &Vector2<f64>) -> Vector2<f64> {
        Vector2::new(x[1], -x[0])
    }

    /// The interpolant is as accurate as the steps: errors everywhere inside a step are proportional to the tolerance.
    #[test]
    #[allow(clippy::disallowed_methods)] // std's sine is off by an ulp on some machines, far below the tolerance
    fn errors_inside_steps_follow_the_tolerance() {
        for exponent in 3..=12 {
            let tolerance = 10f64.powi(-exponent);
            let start = Vector2::new(1.0, 0.0);
            let mut swing =
                Integration::new(pendulum, &start, Tolerances::both(tolerance)).unwrap();
            let mut worst: f64 = 0.0;
            while swing.interval().1 < 20.0 {
                swing.step().unwrap();
                let (from, to) = swing.interval();
                for k in 0..=10 {
                    let time = (from + (to - from) * f64::from(k) / 10.0).min(to);
                    let exact = Vector2::new(time.cos(), -time.sin());
                    worst = worst.max((swing.at(time).unwrap() - exact).norm());
                }
            }
            assert!(worst < 30.0 * tolerance, "{tolerance:e}: {worst:e}");
        }
    }

    #[test]
    fn a_field_that_is_not_finite_is_an_error() {
        let start = Vector2::new(1.0, 0.0);
        let tolerances = Tolerances::both(1e-9);
        let bad = Integration::new(pendulum, &start, Tolerances::both(0.0));
        assert_eq!(bad.err(), Some(Error::BadTolerance { value: 0.0 }));
        let not_a_number = |_: f64, _: &Vector2<f64>| Vector2::new(f64::NAN, 0.0);
        let bad = Integration::new(not_a_number, &start, tolerances).err();
        assert!(matches!(bad, Some(Error::StateNotFinite { .. })));
        // The solution of x′ = x² goes to infinity at t = 1.
        let blow_up = |_: f64, x: &Vector2<f64>| Vector2::new(x[0] * x[0], 0.0);
        let mut run = Integration::new(blow_up, &start, tolerances).unwrap();
        let error = (0..100_000).find_map(|_| run.step().err()).unwrap();
        assert!(matches!(error, Error::Integration { .. } | Error::StateNotFinite { .. }));
        assert!(run.interval().1 < 1.0 + 1e-7);
        // A field that is not finite after t = 1.
        let wall =
            |t: f64, _: &Vector2<f64>| Vector2::new(if t > 1.0 { f64::NAN } else { 1.0 }, 0.0);
        let mut run = Integration::new(wall, &start, tolerances).unwrap();
        assert!((0..100_000).find_map(|_| run.step().err()).is_some());
    }

    #[test]
    fn the_number_of_steps_is_limited() {
        let tolerances = Tolerances { steps: 10, ..Tolerances::both(1e-12) };
        let mut run = Integration::new(pendulum, &Vector2::new(1.0, 0.0), tolerances).unwrap();
        let error = (0..100).find_map(|_| run.step().err()).unwrap();
        assert!(matches!(error, Error::Integration { reason: "no steps are left", .. }));
    }
}
