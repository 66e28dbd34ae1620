//! Solutions of ẋ = f(t, x), step by step, with a polynomial for the state inside each step.

use super::step::Step;
use super::stepping::Stepping;
use super::steps::Steps;
use super::tolerances::Tolerances;
use crate::error::Error;
use crate::state::StateVector;

/// A solution of ẋ = f(t, x), followed step by step. The scheme is Verner's pair of orders 9 and 8, of orders 8 and
/// 7, or of orders 6 and 5, by the relative tolerance. The tolerance bounds the estimated error of each step. The
/// flow propagates these errors, and they add up. If the field gives the same results on every machine, so does the
/// integration. For states of up to eight components it allocates no memory, for longer ones only at the start.
///
/// A step that meets a field which is infinite or NaN is shortened. So the field need not be defined behind the event
/// that ends an arc.
///
/// ```
/// use hybrid_system::{Integration, Tolerances};
/// use nalgebra::Vector2;
///
/// let pendulum = |_: f64, x: &Vector2<f64>| Vector2::new(x[1], -x[0]);
/// let start = Vector2::new(1.0, 0.0);
/// let end = std::f64::consts::PI;
/// let mut swing = Integration::new(pendulum, &start, Tolerances::both(1e-12))?.until(end)?;
/// while !swing.ended() {
///     swing.step()?;
/// }
/// assert!((swing.state() - Vector2::new(-1.0, 0.0)).norm() < 1e-11);
/// # Ok::<(), hybrid_system::Error>(())
/// ```
pub struct Integration<F, V> {
    inner: Steps<F, V>,
    /// The polynomial of the last step; `None` until [`at`](Self::at) needs it.
    inside: Option<Step<V>>,
}

impl<F: Fn(f64, &V) -> V, V: StateVector> Integration<F, V> {
    /// Starts from `start` at time zero.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless all tolerances are positive and finite; [`Error::BadLimit`] for a longest step
    /// that is not positive; [`Error::Dimension`] for a field or for tolerances of another length than the state;
    /// [`Error::StateNotFinite`] for a start or a first derivative that is not finite.
    pub fn new(field: F, start: &V, tolerances: Tolerances) -> Result<Self, Error> {
        Self::starting_at(0.0, field, start, tolerances)
    }

    /// Starts from `start` at this time.
    ///
    /// # Errors
    /// As [`new`](Self::new), and [`Error::BadLimit`] for a time that is not finite.
    pub fn starting_at(
        time: f64,
        field: F,
        start: &V,
        tolerances: Tolerances,
    ) -> Result<Self, Error> {
        Ok(Integration { inner: Steps::new(field, time, start, tolerances)?, inside: None })
    }

    /// As `self`, with an end. The last step ends exactly there, and the field is never evaluated beyond it. An end
    /// before the start, −∞ included, makes the integration run backward in time. Without a call the end is +∞.
    ///
    /// # Errors
    /// [`Error::BadLimit`] for an end that is NaN.
    pub fn until(mut self, end: f64) -> Result<Self, Error> {
        self.inner.until(end)?;
        Ok(self)
    }

    /// As `self`, for a field that does not depend on time. Where such a field is exactly zero, the state stays for
    /// ever: one step leads to the end then.
    #[must_use]
    pub fn autonomous(mut self) -> Self {
        self.inner.autonomous();
        self
    }

    /// As `self`, with a first step no longer than `longest`.
    pub(super) fn starting_with(mut self, longest: f64) -> Self {
        self.inner.starting_with(longest);
        self
    }

    /// Start and end of the last step; both are the start of the integration before the first step. Backward in time
    /// the first is the larger one.
    pub fn interval(&self) -> (f64, f64) {
        (self.inner.from, self.inner.time)
    }

    /// The state at the end of the last step.
    pub fn state(&self) -> V {
        self.inner.state()
    }

    /// True if the end has been reached.
    pub fn ended(&self) -> bool {
        self.inner.ended()
    }

    /// True if the field is [autonomous](Self::autonomous) and zero at the end of the last step: the state stays for
    /// ever.
    pub fn at_rest(&self) -> bool {
        self.inner.at_rest()
    }

    /// Steps that are left in the budget of the tolerances. Rejected ones have been counted as well.
    pub fn steps_left(&self) -> usize {
        self.inner.left()
    }

    /// Takes one step within the tolerances.
    ///
    /// # Errors
    /// [`Error::Integration`] if no step meets the tolerances, no steps are left, the end has been reached, or the
    /// state stays for ever and there is no end. [`Error::FieldNotFinite`] if the field is infinite or NaN just
    /// after the last state, however short the step.
    pub fn step(&mut self) -> Result<(), Error> {
        self.inside = None;
        self.inner.step()
    }

    /// The state at a time in the last step, by its interpolant.
    ///
    /// # Errors
    /// [`Error::Integration`] for a time outside the [`interval`](Self::interval); [`Error::FieldNotFinite`] if the
    /// field is not finite at a stage of the interpolant.
    pub fn at(&mut self, time: f64) -> Result<V, Error> {
        let (from, to) = self.interval();
        if !(time >= from.min(to) && time <= from.max(to)) {
            return Err(Error::Integration { reason: "outside the last step", time });
        }
        if time == to {
            return Ok(self.inner.state());
        }
        if self.inside.is_none() {
            self.inside = Some(self.last_step()?);
        }
        // It is there now.
        self.inside.as_ref().map_or_else(|| Ok(self.inner.state()), |inside| Ok(inside.state(time)))
    }

    /// The polynomial of the last step.
    pub(super) fn last_step(&mut self) -> Result<Step<V>, Error> {
        let (degree, before, changes) = self.inner.inside()?;
        Ok(Step::new(self.interval(), degree, before, changes))
    }
}

impl<F: Fn(f64, &V) -> V, V: StateVector> Stepping<V> for Integration<F, V> {
    fn step(&mut self) -> Result<(), Error> {
        self.step()
    }

    fn interval(&self) -> (f64, f64) {
        self.interval()
    }

    fn state(&self) -> V {
        self.state()
    }

    fn slope(&self) -> V {
        self.inner.slope()
    }

    fn enlarge(&self, sizes: &mut V) {
        self.inner.enlarge(sizes);
    }

    fn ended(&self) -> bool {
        self.ended()
    }

    fn at_rest(&self) -> bool {
        self.at_rest()
    }

    fn steps_left(&self) -> usize {
        self.steps_left()
    }

    /// States that need no evaluation of the field: the states of the stages, and nine states of the cubic through both
    /// ends with their slopes, an eighth of the step apart.
    ///
    /// They show the shape of the orbit, not its digits: the stages are of low order, and the error of the cubic is of
    /// order h⁴.
    fn samples(&self) -> impl Iterator<Item = V> {
        self.inner.samples()
    }

    fn last_step(&mut self) -> Result<Step<V>, Error> {
        self.last_step()
    }

    /// By a separate step that ends there. The interpolant, whose coefficients are large and cancel, loses more digits.
    fn directly_at(&mut self, time: f64) -> Option<Result<V, Error>> {
        Some(self.inner.directly_at(time))
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
