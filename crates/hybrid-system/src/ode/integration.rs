//! Solutions of ẋ = f(t, x), step by step, each step with a polynomial inside.

use super::chebyshev::NODES;
use super::scheme::{ALL_STAGES, Scheme, inverse_root};
use super::step::Step;
use super::{first_step, vector::Vector};
use crate::{Error, State};

/// How exactly a flow is integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Error of a step relative to the state, component by component.
    pub relative: f64,
    /// Error of a step where the state is near zero, in units of the state.
    pub absolute: f64,
    /// Steps that one integration may take.
    pub steps: usize,
}

impl Tolerances {
    /// The same relative and absolute tolerance, and 100 000 steps.
    pub const fn both(tolerance: f64) -> Self {
        Tolerances { relative: tolerance, absolute: tolerance, steps: 100_000 }
    }

    fn check(&self) -> Result<(), Error> {
        match [self.relative, self.absolute].into_iter().find(|t| !(*t > 0.0 && t.is_finite())) {
            Some(value) => Err(Error::BadTolerance { value }),
            None => Ok(()),
        }
    }
}

/// The part of the new size that a step is given.
const SAFETY: f64 = 0.9;

/// A step is at least this part of the one before.
const SMALLER: f64 = 0.2;

/// And at most this multiple.
const LARGER: f64 = 10.0;

/// Steps in a row that may be rejected.
const REJECTED: usize = 100;

/// A solution of ẋ = f(t, x), followed step by step.
///
/// Verner's pair of orders 9 and 8, or 8 and 7 for tolerances from 2e-11 on. The tolerance bounds the estimated error of each step; errors of steps add up
/// and are carried on by the flow. The arithmetic is the same on every machine, as far as the field's is.
/// Nothing is allocated.
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
    /// The polynomial of the last step, once it has been asked for.
    inside: Option<Step<N>>,
}

impl<F: Fn(f64, &State<N>) -> State<N>, const N: usize> Integration<F, N> {
    /// From `start` at time zero.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless both tolerances are positive and finite,
    /// [`Error::StateNotFinite`] for a start or a first derivative that is not finite.
    pub fn new(field: F, start: &State<N>, tolerances: Tolerances) -> Result<Self, Error> {
        Ok(Integration { inner: Steps::new(field, start, tolerances)?, inside: None })
    }

    /// With a first step no longer than this.
    pub(super) fn starting_with(mut self, longest: f64) -> Self {
        self.inner.next = self.inner.next.min(longest);
        self
    }

    /// The times that the last step leads from and to; both zero before the first.
    pub fn interval(&self) -> (f64, f64) {
        (self.inner.from, self.inner.time)
    }

    /// The state at the end of the last step.
    pub fn state(&self) -> State<N> {
        self.inner.state
    }

    /// Takes a step within the tolerances.
    ///
    /// # Errors
    /// [`Error::Integration`] if the tolerances cannot be met, or no steps are left;
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

    /// States all over the last step, to the shape of the orbit: those of its stages, and of the cubic between its
    /// ends, eight to the step.
    pub(super) fn samples(&self) -> impl Iterator<Item = State<N>> {
        let Steps { before, state, slopes, slope, last, stages, scheme, .. } = &self.inner;
        let cubic = (0..=8).map(move |k| {
            let s = 0.125 * f64::from(k);
            let (r, part) = (1.0 - s, s * (1.0 - s) * last);
            before * (r * r * (1.0 + 2.0 * s))
                + state * (s * s * (1.0 + 2.0 * r))
                + (slopes[0] * r - slope * s) * part
        });
        stages[1..scheme.stages].iter().copied().chain(cubic)
    }

    /// As [`Steps::directly_at`].
    pub(super) fn directly_at(&mut self, time: f64) -> Result<State<N>, Error> {
        self.inner.directly_at(time)
    }
}

/// Steps of the scheme, for states of any kind.
pub(super) struct Steps<F, V> {
    field: F,
    tolerances: Tolerances,
    scheme: &'static Scheme,
    /// Time and state before the last step.
    from: f64,
    before: V,
    /// Time, state and its derivative now.
    pub(super) time: f64,
    state: V,
    slope: V,
    /// The states at the stages of the last step, and the field there.
    stages: [V; ALL_STAGES],
    slopes: [V; ALL_STAGES],
    /// Whether those of the interpolant are among them.
    dense: bool,
    /// Size of the last step, and of the next.
    last: f64,
    next: f64,
    taken: usize,
}

impl<F: Fn(f64, &V) -> V, V: Vector> Steps<F, V> {
    pub(super) fn new(field: F, start: &V, tolerances: Tolerances) -> Result<Self, Error> {
        tolerances.check()?;
        start.finite(0.0)?;
        let slope = field(0.0, start);
        slope.finite(0.0)?;
        let scheme = Scheme::within(tolerances.relative);
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
        let mut most = LARGER;
        for _ in 0..REJECTED {
            let size = self.next;
            if size < 1e-14 * self.last || self.time + size <= self.time {
                return failed("the step size has become too small", self.time);
            }
            if self.taken >= self.tolerances.steps {
                return failed("no steps are left", self.time);
            }
            self.taken += 1;
            self.slopes[0] = self.slope;
            let (state, error) = self.trial(size);
            let norm = error.relative_to(&self.state, &state, &self.tolerances);
            // A trial state outside the field's domain asks for a smaller step, too.
            let wish = SAFETY * inverse_root(norm, self.scheme.order);
            let scale = if norm.is_finite() { wish.clamp(SMALLER, most) } else { SMALLER };
            self.next = size * scale;
            if norm <= 1.0 {
                self.dense = false;
                (self.from, self.before) = (self.time, self.state);
                (self.time, self.state, self.last) = (self.time + size, state, size);
                self.slope = (self.field)(self.time, &self.state);
                return self.state.finite(self.time);
            }
            most = 1.0;
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
            self.slopes.iter().zip(self.scheme.weights.iter().zip(&self.scheme.errors))
        {
            after.add(size * b, slope);
            error.add(size * e, slope);
        }
        (after, error)
    }

    /// One stage of a step from a state.
    fn stage(&mut self, stage: usize, time: f64, from: V, size: f64) {
        let at = V::combination(&from, size, &self.scheme.rows[stage], &self.slopes);
        self.stages[stage] = at;
        self.slopes[stage] = (self.field)(time + size * self.scheme.times[stage], &at);
    }

    /// The state at a time in the last step, by a step of its own that ends there: without the rounding of
    /// the interpolant, whose coefficients are large. Its stages take the place of those of the last step.
    pub(super) fn directly_at(&mut self, time: f64) -> Result<V, Error> {
        let size = time - self.from;
        let mut state = self.before;
        for stage in 1..self.scheme.stages {
            self.stage(stage, self.from, self.before, size);
        }
        for (slope, b) in self.slopes.iter().zip(&self.scheme.weights) {
            state.add(size * b, slope);
        }
        state.finite(time).map(|()| state)
    }
}

impl<F: Fn(f64, &State<N>) -> State<N>, const N: usize> Steps<F, State<N>> {
    /// The polynomial of the last step.
    fn inside(&mut self) -> Step<N> {
        if !self.dense {
            for stage in self.scheme.stages..ALL_STAGES {
                self.stage(stage, self.from, self.before, self.last);
            }
            self.dense = true;
        }
        let mut moves = [[0.0; NODES]; N];
        for (slope, weights) in self.slopes.iter().zip(&self.scheme.nodes) {
            for (axis, moves) in moves.iter_mut().enumerate() {
                for (sum, weight) in moves.iter_mut().zip(weights) {
                    *sum += weight * slope[axis];
                }
            }
        }
        let node =
            |j: usize| State::from_fn(|axis, _| self.before[axis] + self.last * moves[axis][j]);
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

    /// The interpolant is as good as the steps: errors everywhere within a step follow the tolerance.
    #[test]
    #[allow(clippy::disallowed_methods)] // the tolerance is far above a misrounding
    fn the_error_follows_the_tolerance_inside_the_steps_too() {
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
    fn what_cannot_be_integrated_is_an_error() {
        let start = Vector2::new(1.0, 0.0);
        let tolerances = Tolerances::both(1e-9);
        let bad = Integration::new(pendulum, &start, Tolerances::both(0.0));
        assert_eq!(bad.err(), Some(Error::BadTolerance { value: 0.0 }));
        let nowhere = |_: f64, _: &Vector2<f64>| Vector2::new(f64::NAN, 0.0);
        let bad = Integration::new(nowhere, &start, tolerances).err();
        assert!(matches!(bad, Some(Error::StateNotFinite { .. })));
        // x' = x² leaves for infinity at t = 1.
        let blow_up = |_: f64, x: &Vector2<f64>| Vector2::new(x[0] * x[0], 0.0);
        let mut run = Integration::new(blow_up, &start, tolerances).unwrap();
        let error = (0..100_000).find_map(|_| run.step().err()).unwrap();
        assert!(matches!(error, Error::Integration { .. } | Error::StateNotFinite { .. }));
        assert!(run.interval().1 < 1.0 + 1e-7);
        // A field with a jump in time that is not finite beyond it.
        let wall =
            |t: f64, _: &Vector2<f64>| Vector2::new(if t > 1.0 { f64::NAN } else { 1.0 }, 0.0);
        let mut run = Integration::new(wall, &start, tolerances).unwrap();
        assert!((0..100_000).find_map(|_| run.step().err()).is_some());
    }

    #[test]
    fn steps_are_bounded() {
        let tolerances = Tolerances { steps: 10, ..Tolerances::both(1e-12) };
        let mut run = Integration::new(pendulum, &Vector2::new(1.0, 0.0), tolerances).unwrap();
        let error = (0..100).find_map(|_| run.step().err()).unwrap();
        assert!(matches!(error, Error::Integration { reason: "no steps are left", .. }));
    }
}
