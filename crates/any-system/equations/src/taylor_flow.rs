//! Motions by Taylor's method.
//!
//! À. Jorba, M. Zou, *A software package for the numerical integration of ODEs by means of high-order Taylor methods*,
//! Experimental Mathematics 14 (2005).

use crate::error::Error;
use crate::series::{Coefficients, Series};

/// The most steps of one call. A motion of a million steps takes seconds to minutes; one that needs more comes next to a
/// pole or is stiff.
const MOST_STEPS: usize = 1_000_000;

/// How often a step is halved, until it is some 10⁻¹⁸ of its first length: next to the end of a field's domain.
const MOST_HALVINGS: usize = 60;

/// How much larger than the tolerance times the order the error of a rate may be, times the step. A smaller number
/// shortens steps of fields that spread errors fast; a larger one sees less.
const RATE_ERROR: f64 = 1000.0;

/// The motion ẋ = f(t, x; p), by its Taylor series, step by step.
///
/// The order follows from the relative tolerance, and each step from the last two coefficients, so that the terms that
/// are left out are below the tolerance. A tolerance holds for one step; errors add up along the motion as it spreads
/// them. Stiff fields need as many steps as explicit methods do.
#[derive(Debug, Clone, Copy)]
pub struct TaylorFlow<'s> {
    series: &'s Series,
    order: usize,
    /// The relative tolerance.
    tolerance: f64,
    /// The size below which the tolerance of a state is absolute.
    least_size: f64,
    /// The longest step, of time.
    pub longest_step: f64,
}

/// A step of a motion: the polynomials that are the motion on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The time at which it begins.
    pub time: f64,
    /// The time at which it ends.
    pub end: f64,
    /// The coefficients of state and watched formulas, in powers of the time since the beginning.
    pub coefficients: Coefficients<f64>,
}

impl Step {
    /// The state at a time of the step.
    pub fn state(&self, time: f64) -> Vec<f64> {
        self.coefficients.state.iter().map(|series| horner(series, time - self.time)).collect()
    }

    /// The watched formulas at a time of the step.
    pub fn watched(&self, time: f64) -> Vec<f64> {
        self.coefficients.watched.iter().map(|series| horner(series, time - self.time)).collect()
    }
}

fn horner(series: &[f64], x: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

/// The largest size among the coefficients of one order.
fn largest(coefficients: &Coefficients<f64>, order: usize) -> f64 {
    coefficients.state.iter().fold(0.0, |largest, series| series[order].abs().max(largest))
}

impl<'s> TaylorFlow<'s> {
    /// The motion of a series' field with these tolerances of the state: an error of `relative` times its largest
    /// component, or of `absolute` if this is more.
    ///
    /// ```
    /// use equations::{Formulas, Names, Series, TaylorFlow};
    /// let names = Names::new(&["angle", "speed"], &[])?;
    /// let field = Formulas::new(names, |_, x, _| [x[1], -x[0].sin()])?;
    /// let series = Series::new(&field, None)?;
    /// let flow = TaylorFlow::new(&series, 1e-15, 1e-15)?;
    /// // From rest at 1 rad, after the period 4 K(sin ½).
    /// let state = flow.state_at(0.0, &[1.0, 0.0], 6.699_975_664_370_453)?;
    /// assert!((state[0] - 1.0).abs() < 1e-14 && state[1].abs() < 1e-13);
    /// # Ok::<(), equations::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Tolerance`] unless 10⁻¹⁷ ≤ `relative` ≤ 0.1 and 0 ≤ `absolute` < ∞.
    pub fn new(series: &'s Series, relative: f64, absolute: f64) -> Result<Self, Error> {
        let sensible = (1e-17..=0.1).contains(&relative) && (0.0..f64::MAX).contains(&absolute);
        if !sensible {
            return Err(Error::Tolerance { relative, absolute });
        }
        // A step reaches to e⁻² of the radius of convergence: the term of order p is e^(−2p) of the state there.
        let order = (1.0 - 0.5 * pxfm::f_log(relative)).ceil() as usize;
        let least_size = absolute / relative;
        let (order, tolerance, longest_step) = (order.max(2), relative, f64::INFINITY);
        Ok(TaylorFlow { series, order, tolerance, least_size, longest_step })
    }

    /// The order of the polynomials.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The step from a state towards `end`, which may be earlier: it ends there at the latest.
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::NoValue`] if the field or its series has no value at the state; [`Error::Time`] for
    /// a time that is not finite.
    pub fn step(&self, time: f64, state: &[f64], end: f64) -> Result<Step, Error> {
        let coefficients = self.series.coefficients(time, state, self.order)?;
        self.step_with(time, coefficients, end)
    }

    fn step_with(
        &self,
        time: f64,
        coefficients: Coefficients<f64>,
        end: f64,
    ) -> Result<Step, Error> {
        if !(time.is_finite() && end.is_finite()) {
            return Err(Error::Time { time, end });
        }
        let size = largest(&coefficients, 0).max(self.least_size);
        let radius = [self.order - 1, self.order].map(|order| {
            interval_arithmetic::pow(size / largest(&coefficients, order), 1.0 / order as f64)
        });
        // e⁻² of the smaller estimate, and a factor that covers the terms that follow (Jorba and Zou, Section 3.2).
        let safe = pxfm::f_exp(-2.0 - 0.7 / (self.order - 1) as f64);
        // 0/0: the state and all its rates are zero. It stays.
        let length =
            radius.into_iter().filter(|radius| !radius.is_nan()).fold(f64::INFINITY, f64::min);
        let length = (safe * length).min(self.longest_step);
        let end = match end >= time {
            true => (time + length).min(end),
            false => (time - length).max(end),
        };
        Ok(Step { time, end, coefficients })
    }

    /// The steps up to `end`, which `see` receives one after the other; the state there. It goes on while `see` returns
    /// true.
    ///
    /// A step after which the field has no value, as beyond the end of its domain, is repeated with half its length.
    ///
    /// # Errors
    /// As [`step`](Self::step); [`Error::Stuck`] if a step does not move the time, as next to a pole, or after a million
    /// steps.
    pub fn follow(
        &self,
        time: f64,
        state: &[f64],
        end: f64,
        mut see: impl FnMut(&Step) -> bool,
    ) -> Result<Vec<f64>, Error> {
        let (mut state, mut time) = (state.to_vec(), time);
        let mut coefficients = self.series.coefficients(time, &state, self.order)?;
        for _ in 0..MOST_STEPS {
            let mut step = self.step_with(time, coefficients, end)?;
            if step.end == time {
                return if time == end { Ok(state) } else { Err(Error::Stuck { time, end }) };
            }
            (state, coefficients) = self.accepted(&mut step)?;
            time = step.end;
            if !see(&step) || time == end {
                return Ok(state);
            }
        }
        Err(Error::Stuck { time, end })
    }

    /// Shortens a step until the field has a series at its end that goes on as the step ends; the state there, and its
    /// series.
    fn accepted(&self, step: &mut Step) -> Result<(Vec<f64>, Coefficients<f64>), Error> {
        let stuck = Error::Stuck { time: step.time, end: step.end };
        let mut refused = stuck.clone();
        for _ in 0..MOST_HALVINGS {
            let state = step.state(step.end);
            match self.series.coefficients(step.end, &state, self.order) {
                Ok(next) if self.goes_on(step, &next) => return Ok((state, next)),
                Ok(_) => refused = stuck.clone(),
                Err(error) => refused = error,
            }
            step.end = step.time + 0.5 * (step.end - step.time);
            if step.end == step.time {
                break;
            }
        }
        Err(refused)
    }

    /// The rate at the end of a step is that of its polynomial. Where it is not, the field is not the one of the series:
    /// (1 + t/2)² is the motion of ẋ = √x for t > −2 alone.
    fn goes_on(&self, step: &Step, next: &Coefficients<f64>) -> bool {
        let length = step.end - step.time;
        let size = largest(&step.coefficients, 0).max(largest(next, 0)).max(self.least_size);
        // The rate of the terms that are left out is some `order` times as large as they are, and the field spreads an
        // error of the state by some factor in a step. A field of another branch is off by all of its rate.
        let most = RATE_ERROR * self.order as f64 * (self.tolerance * size).max(f64::MIN_POSITIVE);
        step.coefficients.state.iter().zip(&next.state).all(|(series, next)| {
            let rate =
                (1..series.len()).rev().fold(0.0, |sum, k| sum * length + k as f64 * series[k]);
            !((rate - next[1]).abs() * length.abs()
                > most + RATE_ERROR * f64::EPSILON * (rate * length).abs())
        })
    }

    /// The state at a later or an earlier time.
    ///
    /// # Errors
    /// As [`follow`](Self::follow).
    pub fn state_at(&self, time: f64, state: &[f64], end: f64) -> Result<Vec<f64>, Error> {
        self.follow(time, state, end, |_| true)
    }
}
