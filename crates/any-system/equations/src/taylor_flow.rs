//! Motions by Taylor's method.
//!
//! À. Jorba, M. Zou, *A software package for the numerical integration of ODEs by means of high-order Taylor methods*,
//! Experimental Mathematics 14 (2005).

use crate::elementwise::Elementwise;
use crate::error::Error;
use crate::formulas::length;
use crate::series::Series;
use crate::step::{Step, end_of, inside, memory};
use crate::step_length::order_of;

/// The most steps of one call. A motion of a million steps takes seconds to minutes; one that needs more comes next to a
/// pole or is stiff.
pub(crate) const MOST_STEPS: usize = 1_000_000;

/// How often a step is halved, until it is some 10⁻¹⁸ of its first length: next to the end of a field's domain.
pub(crate) const MOST_HALVINGS: usize = 60;

/// The motion ẋ = f(t, x; p), by its Taylor series, step by step.
///
/// The order follows from the relative tolerance, and each step from the last two coefficients, so that the terms that
/// are left out are below the tolerance. A tolerance holds for one step; errors add up along the motion as it spreads
/// them. Stiff fields need as many steps as explicit methods do.
#[derive(Debug, Clone)]
pub struct TaylorFlow<'s> {
    pub(crate) series: &'s Series,
    pub(crate) order: usize,
    /// The smallest relative tolerance, to which the order belongs.
    pub(crate) tolerance: f64,
    /// For each component of the state: the absolute and the relative tolerance.
    pub(crate) tolerances: Vec<(f64, f64)>,
    /// The longest step, of time.
    pub(crate) longest_step: f64,
}

impl<'s> TaylorFlow<'s> {
    /// The motion of a series' field: the error of a component in a step is its size times `relative` and `absolute`,
    /// added. With an `absolute` of 0 the size is that of the largest component.
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
        Ok(TaylorFlow {
            series,
            order: order_of(relative),
            tolerance: relative,
            tolerances: vec![(absolute, relative); series.dimension()],
            longest_step: f64::INFINITY,
        })
    }

    /// The same with tolerances of each component: absolute and relative. The order stays.
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::Tolerance`] for one that is negative or not finite, or two of zero.
    pub fn tolerances(mut self, each: Vec<(f64, f64)>) -> Result<Self, Error> {
        length("tolerances", self.series.dimension(), each.len())?;
        let sensible = |tolerance: f64| (0.0..f64::MAX).contains(&tolerance);
        for &(absolute, relative) in &each {
            if !(sensible(absolute) && sensible(relative) && absolute + relative > 0.0) {
                return Err(Error::Tolerance { relative, absolute });
            }
        }
        self.tolerances = each;
        Ok(self)
    }

    /// The same with no step longer than this time.
    ///
    /// # Errors
    /// [`Error::LongestStep`] unless it is positive.
    pub fn longest_step(mut self, time: f64) -> Result<Self, Error> {
        if !(time > 0.0) {
            return Err(Error::LongestStep { longest: time });
        }
        self.longest_step = time;
        Ok(self)
    }

    /// The order of the polynomials.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Memory for a step, of length zero at the time zero.
    ///
    /// # Errors
    /// Never, for a flow that [`new`](Self::new) has made.
    pub fn memory(&self) -> Result<Step, Error> {
        memory(self.series, self.order)
    }

    /// The step from a state towards `end`, which may be earlier: it ends there at the latest. A step after which the
    /// field has no value, as beyond the end of its domain, or is another one than that of the series, has half its
    /// length.
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::NoValue`] if the field or its series has no value at the state; [`Error::Time`] for
    /// a time that is not finite; [`Error::Stuck`] if no step moves the time.
    pub fn step(&self, time: f64, state: &[f64], end: f64, step: &mut Step) -> Result<(), Error> {
        if !time.is_finite() || end.is_nan() {
            return Err(Error::Time { time, end });
        }
        self.series.expand(&time, state, &mut step.coefficients)?;
        step.time = time;
        let length = self.length_for_state(&step.coefficients).min((end - time).abs());
        let length = self.length_for_watched(&step.coefficients, |x| *x, length);
        step.end = end_of(time, length, end);
        if !step.end.is_finite() {
            return Err(Error::Time { time, end });
        }
        if step.end == time && end != time {
            return Err(Error::Stuck { time, end });
        }
        self.shorten(step)
    }

    /// Shortens a step until the field at its end, and inside it, is that of its polynomial; state and field at the end
    /// stand in the step then.
    fn shorten(&self, step: &mut Step) -> Result<(), Error> {
        let end = step.end;
        for _ in 0..MOST_HALVINGS {
            if self.is_right(step).any() {
                return Ok(());
            }
            let shorter = step.time + 0.5 * (step.end - step.time);
            if shorter == step.time {
                break;
            }
            step.end = shorter;
        }
        let stuck = Error::Stuck { time: step.time, end };
        Err(self.without_value(step).unwrap_or(stuck))
    }

    /// The error of the first part of the field without a value, inside a step or at its end.
    fn without_value(&self, step: &mut Step) -> Option<Error> {
        let field = &self.series.field;
        [inside(step), step.end].into_iter().find_map(|time| {
            self.field_at(step, time);
            if let Err(error) = field.check_start(&time, &step.state_at_end) {
                return Some(error);
            }
            let parts = &step.parts[..self.series.field_parts];
            let part = parts.iter().position(|value| !value.is_finite())?;
            Some(field.no_value(part, &time, &step.state_at_end))
        })
    }

    /// The steps up to `end`, which `see` receives one after the other; the state there. It goes on while `see` returns
    /// true.
    ///
    /// # Errors
    /// As [`step`](Self::step); [`Error::Stuck`] also after a million steps.
    pub fn follow(
        &self,
        time: f64,
        state: &[f64],
        end: f64,
        mut see: impl FnMut(&Step) -> bool,
    ) -> Result<Vec<f64>, Error> {
        if !(time.is_finite() && end.is_finite()) {
            return Err(Error::Time { time, end });
        }
        let (mut state, mut time) = (state.to_vec(), time);
        let mut step = self.memory()?;
        for _ in 0..MOST_STEPS {
            let start = time;
            time = self.one_step(time, &mut state, end, &mut step)?;
            if time == start || !see(&step) || time == end {
                return Ok(state);
            }
        }
        Err(Error::Stuck { time, end })
    }

    /// One step of a motion, to the time that is returned.
    pub(crate) fn one_step(
        &self,
        time: f64,
        state: &mut [f64],
        end: f64,
        step: &mut Step,
    ) -> Result<f64, Error> {
        self.step(time, state, end, step)?;
        if step.end != time {
            state.copy_from_slice(&step.state_at_end);
        } else if time != end {
            return Err(Error::Stuck { time, end });
        }
        Ok(step.end)
    }

    /// The state at a later or an earlier time.
    ///
    /// # Errors
    /// As [`follow`](Self::follow).
    pub fn state_at(&self, time: f64, state: &[f64], end: f64) -> Result<Vec<f64>, Error> {
        self.follow(time, state, end, |_| true)
    }
}
