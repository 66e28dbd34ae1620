//! Motions by Taylor's method.
//!
//! À. Jorba, M. Zou, *A software package for the numerical integration of ODEs by means of high-order Taylor methods*,
//! Experimental Mathematics 14 (2005).

use crate::error::Error;
use crate::evaluate::compute;
use crate::formulas::length;
use crate::series::{Coefficients, Series};
use crate::step_length::{
    allowed, horner, order_of, powi, root, safety, shortened, value_and_size, value_and_slope,
};

/// The most steps of one call. A motion of a million steps takes seconds to minutes; one that needs more comes next to a
/// pole or is stiff.
const MOST_STEPS: usize = 1_000_000;

/// How often a step is halved, until it is some 10⁻¹⁸ of its first length: next to the end of a field's domain.
const MOST_HALVINGS: usize = 60;

/// How much larger than the tolerance times the order the error of a rate may be, times the step. The terms that are left
/// out give one of about 1/7. A smaller number shortens steps of fields that spread errors fast; a larger one sees less.
const RATE_ERROR: f64 = 30.0;

/// How much larger than the tolerance times the order, of its largest term, the distance of a watched formula from its
/// polynomial may be. It is only trusted to show where zeros are; the zeros themselves are those of the formula.
const WATCHED_ERROR: f64 = 1000.0;

/// A step is tested against the field at its end, and at this part of it: no simple fraction, at which a field that
/// repeats itself would look like its series.
const INSIDE: f64 = 0.381_966_011_250_105_1;

/// A term of a lower order may be so many times larger than the last two let expect. A smaller number shortens steps of
/// regular series; a larger one sees fewer of those with gaps, such as 1/(1 + x⁴).
const GAP: f64 = 1000.0;

/// For a watched formula a step is made no shorter than this part of it: next to a pole of the formula its values are
/// looked at instead.
const SHORTEST_FOR_WATCHED: f64 = 1.0 / 1024.0;

/// The motion ẋ = f(t, x; p), by its Taylor series, step by step.
///
/// The order follows from the relative tolerance, and each step from the last two coefficients, so that the terms that
/// are left out are below the tolerance. A tolerance holds for one step; errors add up along the motion as it spreads
/// them. Stiff fields need as many steps as explicit methods do.
#[derive(Debug, Clone)]
pub struct TaylorFlow<'s> {
    series: &'s Series,
    order: usize,
    /// The smallest relative tolerance, to which the order belongs.
    tolerance: f64,
    /// For each component of the state: the absolute and the relative tolerance.
    tolerances: Vec<(f64, f64)>,
    /// The longest step, of time.
    longest_step: f64,
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
    /// The state at its end.
    pub state_at_end: Vec<f64>,
    /// The field at its end.
    pub rate_at_end: Vec<f64>,
    /// For each watched formula, whether its polynomial is the formula, as far as two values show.
    pub trusted: Vec<bool>,
    /// Values of the parts, and the slopes of the polynomials, where they were compared last.
    parts: Vec<f64>,
    slopes: Vec<f64>,
}

impl Step {
    /// The state at a time of the step.
    pub fn state(&self, time: f64) -> Vec<f64> {
        self.coefficients.states().map(|series| horner(series, time - self.time)).collect()
    }

    /// The watched formulas at a time of the step.
    pub fn watched(&self, time: f64) -> Vec<f64> {
        self.coefficients.all_watched().map(|series| horner(series, time - self.time)).collect()
    }
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
    #[must_use]
    pub fn longest_step(mut self, time: f64) -> Self {
        self.longest_step = time;
        self
    }

    /// The order of the polynomials.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Memory for a step, of length zero at the time zero.
    ///
    /// # Errors
    /// None for the orders of tolerances.
    pub fn memory(&self) -> Result<Step, Error> {
        let dimension = self.series.dimension();
        Ok(Step {
            time: 0.0,
            end: 0.0,
            coefficients: self.series.memory(self.order)?,
            state_at_end: vec![0.0; dimension],
            rate_at_end: vec![0.0; dimension],
            trusted: Vec::new(),
            slopes: vec![0.0; dimension],
            parts: self.series.field.numbers(),
        })
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
        let length = self.length_for_state(step).min((end - time).abs());
        let length = self.length_for_watched(step, length);
        step.end = match end >= time {
            true => (time + length).min(end),
            false => (time - length).max(end),
        };
        if !step.end.is_finite() {
            return Err(Error::Time { time, end });
        }
        if step.end == time && end != time {
            return Err(Error::Stuck { time, end });
        }
        self.shorten(step)
    }

    /// The length of a step of whose state the terms that are left out are below the tolerances.
    fn length_for_state(&self, step: &Step) -> f64 {
        let mut sizes = [0.0_f64; 2];
        let largest = step.coefficients.states().map(|series| series[0].abs()).fold(0.0, f64::max);
        for (series, tolerances) in step.coefficients.states().zip(&self.tolerances) {
            let allowed = allowed(*tolerances, series[0].abs(), largest);
            for (size, order) in sizes.iter_mut().zip([self.order - 1, self.order]) {
                let part = series[order].abs() / allowed;
                // 0/0: a component that is zero and stays.
                *size = if part > *size { part } else { *size };
            }
        }
        let [before, last] = sizes.map(|size| self.tolerance * size);
        let radius = |size: f64, order: usize| root(size, order).recip();
        let radius = radius(before, self.order - 1).min(radius(last, self.order));
        let radius = self.without_gaps(step, radius.min(f64::MAX), largest);
        (safety(self.order) * radius).min(self.longest_step)
    }

    /// The radius at which terms of lower orders are no larger than the last two let expect.
    fn without_gaps(&self, step: &Step, mut radius: f64, largest: f64) -> f64 {
        let first = self.order / 2;
        for (series, tolerances) in step.coefficients.states().zip(&self.tolerances) {
            let scale = allowed(*tolerances, series[0].abs(), largest) / self.tolerance;
            let mut power = powi(radius, first);
            for (k, coefficient) in series.iter().enumerate().skip(first) {
                if coefficient.abs() * power > GAP * scale {
                    radius = root(coefficient.abs() / scale, k).recip();
                    power = powi(radius, k);
                }
                power *= radius;
            }
        }
        radius
    }

    /// The length at which also the last terms of the watched formulas are small beside their largest ones: a formula
    /// may bend more than the state, as sin(x) does along x = t.
    fn length_for_watched(&self, step: &Step, length: f64) -> f64 {
        let least = SHORTEST_FOR_WATCHED * length;
        let watched = step.coefficients.all_watched();
        watched.fold(length, |length, series| {
            let tolerance = WATCHED_ERROR * self.tolerance;
            let found = shortened(series.len(), |k| series[k].abs(), tolerance, length);
            // Without values there is nothing to be shortened for.
            if found >= least { found } else { length.min(least) }
        })
    }

    /// Shortens a step until the field at its end, and inside it, is that of its polynomial; state and field at the end
    /// stand in the step then.
    fn shorten(&self, step: &mut Step) -> Result<(), Error> {
        let end = step.end;
        let mut refused = None;
        for _ in 0..MOST_HALVINGS {
            step.trusted.clear();
            step.trusted.resize(step.coefficients.all_watched().len(), true);
            let inside = step.time + INSIDE * (step.end - step.time);
            match self
                .agrees(step, inside)
                .and_then(|agrees| Ok(agrees && self.agrees(step, step.end)?))
            {
                Ok(true) => return Ok(()),
                Ok(false) => refused = None,
                Err(error) => refused = Some(error),
            }
            step.end = step.time + 0.5 * (step.end - step.time);
            if step.end == step.time {
                break;
            }
        }
        Err(refused.unwrap_or(Error::Stuck { time: step.time, end }))
    }

    /// Computes the state and the field at a time of a step; true if the field is that of the polynomial.
    fn agrees(&self, step: &mut Step, time: f64) -> Result<bool, Error> {
        let length = time - step.time;
        let components = step.state_at_end.iter_mut().zip(&mut step.slopes);
        for ((state, slope), series) in components.zip(step.coefficients.states()) {
            (*state, *slope) = value_and_slope(series, length);
        }
        let field = &self.series.field;
        field.check_start(&time, &step.state_at_end)?;
        let values = &field.nodes[..self.series.value_parts];
        compute(values, &time, &step.state_at_end, &mut step.parts, 1);
        let parts = &step.parts[..self.series.field_parts];
        if let Some(part) = parts.iter().position(|value| !value.is_finite()) {
            return Err(field.no_value(part, &time, &step.state_at_end));
        }
        for (rate, &at) in step.rate_at_end.iter_mut().zip(&field.outputs) {
            *rate = parts[at];
        }
        self.trust(step, length);
        Ok(self.goes_on(step, length))
    }

    /// Compares the watched formulas with their polynomials.
    fn trust(&self, step: &mut Step, length: f64) {
        let allowed = WATCHED_ERROR * self.order as f64 * (self.tolerance + f64::EPSILON);
        for (place, series) in step.coefficients.all_watched().enumerate() {
            let value = self.series.watched_part(place).map_or(f64::NAN, |part| step.parts[part]);
            let (polynomial, size) = value_and_size(series, length);
            // NaN is no trust.
            step.trusted[place] &= (polynomial - value).abs() <= allowed * size;
        }
    }

    /// The rate at a time of a step is that of its polynomial. Where it is not, the field is not the one of the series:
    /// (1 + t/2)² is the motion of ẋ = √x for t > −2 alone.
    fn goes_on(&self, step: &Step, length: f64) -> bool {
        let ends = step.state_at_end.iter().zip(&step.rate_at_end);
        // The rate of the terms that are left out is some `order` times as large as they are, and the field spreads an
        // error of the state, of any component, by some factor in a step. A field of another branch is off by all of its
        // rate.
        let mut most = f64::MIN_POSITIVE;
        let mut off = 0.0_f64;
        let starts = step.coefficients.states().zip(&self.tolerances);
        for (((series, tolerances), (state, rate_at_end)), rate) in
            starts.zip(ends).zip(&step.slopes)
        {
            let size = series[0].abs().max(state.abs());
            most = most.max(self.order as f64 * allowed(*tolerances, size, size));
            let rounding = f64::EPSILON * (rate * length).abs();
            let own = (rate - rate_at_end).abs() * length.abs() - RATE_ERROR * rounding;
            // NaN stays.
            off = if own <= off || off.is_nan() { off } else { own };
        }
        off <= RATE_ERROR * most
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
            self.step(time, &state, end, &mut step)?;
            if step.end == time {
                return if time == end { Ok(state) } else { Err(Error::Stuck { time, end }) };
            }
            time = step.end;
            state.copy_from_slice(&step.state_at_end);
            if !see(&step) || time == end {
                return Ok(state);
            }
        }
        Err(Error::Stuck { time, end })
    }

    /// The state at a later or an earlier time.
    ///
    /// # Errors
    /// As [`follow`](Self::follow).
    pub fn state_at(&self, time: f64, state: &[f64], end: f64) -> Result<Vec<f64>, Error> {
        self.follow(time, state, end, |_| true)
    }
}
