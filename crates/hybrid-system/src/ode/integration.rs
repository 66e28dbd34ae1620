//! Solutions of ẋ = f(t, x), step by step, each step with a polynomial inside.
//!
//! The only folder that uses `differential-equations`: Verner's 9(8) pair with its interpolant of order 8.

use super::first_step;
use crate::{Error, State};
use differential_equations::error::Error as Failure;
use differential_equations::interpolate::Interpolation;
use differential_equations::methods::{Adaptive, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};

type Method<const N: usize> = ExplicitRungeKutta<Ordinary, Adaptive, f64, [f64; N], 9, 16, 21>;

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

    pub(super) fn check(&self) -> Result<(), Error> {
        match [self.relative, self.absolute].into_iter().find(|t| !(*t > 0.0 && t.is_finite())) {
            Some(value) => Err(Error::BadTolerance { value }),
            None => Ok(()),
        }
    }
}

/// A solution of ẋ = f(t, x), followed step by step.
///
/// The tolerance bounds the estimated error of each step; errors of steps add up and are carried on
/// by the flow. The step sizes depend on the system's `powf`, so the last bits may differ between
/// machines: use a closed-form flow where there is one.
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
    field: Field<F>,
    method: Method<N>,
}

/// A vector field in the integrator's form.
struct Field<F>(F);

impl<F: Fn(f64, &State<N>) -> State<N>, const N: usize> ODE<f64, [f64; N]> for Field<F> {
    fn diff(&self, time: f64, state: &[f64; N], derivative: &mut [f64; N]) {
        *derivative = (self.0)(time, &State::from(*state)).into();
    }
}

impl<F: Fn(f64, &State<N>) -> State<N>, const N: usize> Integration<F, N> {
    /// From `start` at time zero.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless both tolerances are positive and finite,
    /// [`Error::StateNotFinite`] for a start or a first derivative that is not finite.
    pub fn new(field: F, start: &State<N>, tolerances: Tolerances) -> Result<Self, Error> {
        let Tolerances { relative, absolute, steps } = tolerances;
        tolerances.check()?;
        finite(start, 0.0)?;
        finite(&field(0.0, start), 0.0)?;
        let first = first_step(&field, start, tolerances);
        let mut method =
            Method::rkv988e().rtol(relative).atol(absolute).max_steps(steps).h0(first);
        let field = Field(field);
        method.init(&field, 0.0, f64::MAX, &(*start).into()).map_err(|failure| named(&failure))?;
        Ok(Integration { field, method })
    }

    /// The times that the last step leads from and to; both zero before the first.
    pub fn interval(&self) -> (f64, f64) {
        (self.method.t_prev(), self.method.t())
    }

    /// The state at the end of the last step.
    pub fn state(&self) -> State<N> {
        State::from(*self.method.y())
    }

    /// Takes a step within the tolerances.
    ///
    /// # Errors
    /// [`Error::Integration`] if the tolerances cannot be met, or no steps are left;
    /// [`Error::StateNotFinite`] if the state is no longer finite.
    pub fn step(&mut self) -> Result<(), Error> {
        let before = self.method.t();
        // The method returns after rejected steps too.
        while self.method.t() == before {
            self.method.step(&self.field).map_err(|failure| named(&failure))?;
        }
        finite(&self.state(), self.method.t())
    }

    /// The state at a time in the last step, by a step of its own that ends there: without the rounding of
    /// the interpolant, whose coefficients are large.
    pub(super) fn directly_at(&self, time: f64) -> Result<State<N>, Error> {
        let from = self.method.t_prev();
        let mut method = Method::rkv988e().rtol(f64::MAX).atol(f64::MAX).h0(time - from);
        let failed = |failure| named(&failure);
        method.init(&self.field, from, f64::MAX, self.method.y_prev()).map_err(failed)?;
        method.step(&self.field).map_err(failed)?;
        let state = State::from(*method.y());
        finite(&state, time).map(|()| state)
    }

    /// The state at a time in the last step, by its interpolant.
    ///
    /// # Errors
    /// [`Error::Integration`] for a time outside the [`interval`](Self::interval).
    pub fn at(&mut self, time: f64) -> Result<State<N>, Error> {
        self.method.interpolate(time).map(State::from).map_err(|failure| named(&failure))
    }
}

pub(super) fn finite<const N: usize>(state: &State<N>, time: f64) -> Result<(), Error> {
    if state.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    Err(Error::StateNotFinite { time, jumps: 0, state: state.iter().copied().collect() })
}

/// The integrator's failure in our words.
pub(super) fn named<Y: differential_equations::traits::State<f64>>(failure: &Failure<f64, Y>) -> Error {
    let (reason, time) = match failure {
        Failure::MaxSteps { t, .. } => ("no steps are left", *t),
        Failure::StepSize { t, .. } => ("the step size has become too small", *t),
        Failure::Stiffness { t, .. } => ("a hundred steps in a row were rejected", *t),
        Failure::OutOfBounds { t_interp, .. } => ("outside the last step", *t_interp),
        _ => ("the integrator cannot start", 0.0),
    };
    Error::Integration { reason, time }
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
        assert!(run.interval().1 < 1.0 + 1e-9);
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
