//! A step of Taylor's method, and the test that its polynomials are the motion.

use crate::algebra::Arithmetic;
use crate::elementwise::Elementwise;
use crate::error::Error;
use crate::evaluate::compute;
use crate::series::{Coefficients, Series};
use crate::step_length::{allowed, horner, value_and_size, value_and_slope};
use crate::taylor_flow::TaylorFlow;

/// How much larger than the tolerance times the order the error of a rate may be, times the step. The terms that are left
/// out give one of about 1/7. A smaller number shortens steps of fields that spread errors fast; a larger one sees less.
pub(crate) const RATE_ERROR: f64 = 30.0;

/// How much larger than the tolerance times the order, of its largest term, the distance of a watched formula from its
/// polynomial may be. It is only trusted to show where zeros are; the zeros themselves are those of the formula. A smaller number would
/// look at values where the polynomial does; a larger one would trust one that misses a short dip.
pub(crate) const WATCHED_ERROR: f64 = 1000.0;

/// A step is tested against the field at its end, and at this part of it: no simple fraction, at which a field that
/// repeats itself would look like its series.
pub(crate) const INSIDE: f64 = 0.381_966_011_250_105_1;

/// A step of a motion: the polynomials that are the motion on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Step<A = f64> {
    /// The time at which it begins.
    pub time: A,
    /// The time at which it ends.
    pub end: A,
    /// The coefficients of state and watched formulas, in powers of the time since the beginning.
    pub coefficients: Coefficients<A>,
    /// The state at its end.
    pub state_at_end: Vec<A>,
    /// The field at its end.
    pub rate_at_end: Vec<A>,
    /// For each watched formula, whether its polynomial is the formula: 1 or 0.
    trust: Vec<A>,
    /// Values of the parts, and the slopes of the polynomials, where they were compared last.
    pub(crate) parts: Vec<A>,
    slopes: Vec<A>,
}

impl Step {
    /// The state at a time of the step.
    pub fn state(&self, time: f64) -> Vec<f64> {
        self.coefficients.states().map(|series| horner(series, time - self.time)).collect()
    }

    /// The number of coefficients in memory.
    pub fn size(&self) -> usize {
        self.coefficients.all.len()
    }

    /// Whether the polynomial of a watched formula is the formula, as far as two values show.
    pub fn is_trusted(&self, formula: usize) -> bool {
        self.trust.get(formula).is_some_and(|trust| *trust == 1.0)
    }

    /// The watched formulas at a time of the step.
    pub fn watched(&self, time: f64) -> Vec<f64> {
        self.coefficients.all_watched().map(|series| horner(series, time - self.time)).collect()
    }
}

/// Memory for a step of length zero, at the time zero.
pub(crate) fn memory<A: Elementwise>(series: &Series, order: usize) -> Result<Step<A>, Error> {
    let zeros = || vec![A::zero(); series.dimension()];
    Ok(Step {
        time: A::zero(),
        end: A::zero(),
        coefficients: series.memory(order)?,
        state_at_end: zeros(),
        rate_at_end: zeros(),
        trust: Vec::new(),
        slopes: zeros(),
        parts: series.field.numbers(),
    })
}

/// Memory for what a step shows, without that for its computation.
pub(crate) fn outline(series: &Series, order: usize) -> Result<Step, Error> {
    let zeros = || vec![0.0; series.dimension()];
    Ok(Step {
        time: 0.0,
        end: 0.0,
        coefficients: series.outline(order)?,
        state_at_end: zeros(),
        rate_at_end: zeros(),
        trust: Vec::new(),
        slopes: Vec::new(),
        parts: Vec::new(),
    })
}

impl<A: Arithmetic> Step<A> {
    /// Writes what the step shows: of one lane, as `of` takes it.
    pub(crate) fn show(&self, of: impl Fn(&A) -> f64, into: &mut Step) {
        (into.time, into.end) = (of(&self.time), of(&self.end));
        self.coefficients.show(&of, &mut into.coefficients);
        for (from, into) in [
            (&self.state_at_end, &mut into.state_at_end),
            (&self.rate_at_end, &mut into.rate_at_end),
            (&self.trust, &mut into.trust),
        ] {
            into.clear();
            into.extend(from.iter().map(&of));
        }
    }
}

/// The time inside a step at which it is tested.
#[inline(always)]
pub(crate) fn inside<A: Elementwise>(step: &Step<A>) -> A {
    step.time.with(step.end, |time, end| time + INSIDE * (end - time))
}

/// The end of a step of this length towards `end`, which may be earlier: it is no further away.
#[inline(always)]
pub(crate) fn end_of<A: Elementwise>(time: A, length: A, end: A) -> A {
    let later = A::sum(&time, &length).smaller(end);
    let earlier = A::difference(&time, &length).larger(end);
    time.exceeds(end).select(earlier, later)
}

impl TaylorFlow<'_> {
    /// Where the field at the end of a step, and inside it, is that of its polynomial; state and field at the end stand in
    /// the step then.
    #[inline(always)]
    pub(crate) fn is_right<A: Elementwise>(&self, step: &mut Step<A>) -> A {
        step.trust.clear();
        step.trust.resize(step.coefficients.all_watched().len(), A::one());
        let holds = self.agrees(step, inside(step));
        if !holds.any() {
            return holds;
        }
        A::product(&holds, &self.agrees(step, step.end))
    }

    /// Where the field at a time of a step is that of the polynomial.
    #[inline(always)]
    fn agrees<A: Elementwise>(&self, step: &mut Step<A>, time: A) -> A {
        let length = self.field_at(step, time);
        self.trust(step, length);
        self.goes_on(step, length)
    }

    /// Computes state, field and slopes of the polynomial at a time of a step; the time since the step began.
    #[inline(always)]
    pub(crate) fn field_at<A: Elementwise>(&self, step: &mut Step<A>, time: A) -> A {
        let length = A::difference(&time, &step.time);
        let components = step.state_at_end.iter_mut().zip(&mut step.slopes);
        for ((state, slope), series) in components.zip(step.coefficients.states()) {
            (*state, *slope) = value_and_slope(series, length);
        }
        let field = &self.series.field;
        let values = &field.nodes[..self.series.value_parts];
        compute(values, &time, &step.state_at_end, &mut step.parts, 1);
        for (rate, &at) in step.rate_at_end.iter_mut().zip(&field.outputs) {
            *rate = step.parts[at];
        }
        length
    }

    /// Compares the watched formulas with their polynomials.
    #[inline(always)]
    fn trust<A: Elementwise>(&self, step: &mut Step<A>, length: A) {
        let allowed = WATCHED_ERROR * self.order as f64 * (self.tolerance + f64::EPSILON);
        for (place, series) in step.coefficients.all_watched().enumerate() {
            let value = self.series.watched_part(place).map(|part| step.parts[part]);
            let (polynomial, size) = value_and_size(series, length);
            let off = A::difference(&polynomial, &value.unwrap_or(A::number(f64::NAN)));
            // NaN is no trust.
            let is_near = off.with(size, |off, size| f64::from(off.abs() <= allowed * size));
            step.trust[place] = A::product(&step.trust[place], &is_near);
        }
    }

    /// Where the rate at a time of a step is that of its polynomial. Elsewhere the field has no value, or is not the one
    /// of the series: (1 + t/2)² is the motion of ẋ = √x for t > −2 alone.
    #[inline(always)]
    fn goes_on<A: Elementwise>(&self, step: &Step<A>, length: A) -> A {
        let ends = step.state_at_end.iter().zip(&step.rate_at_end);
        // The rate of the terms that are left out is some `order` times as large as they are, and the field spreads an
        // error of the state, of any component, by some factor in a step. A field of another branch is off by all of its
        // rate.
        let mut most = A::number(f64::MIN_POSITIVE);
        let mut off = A::zero();
        let starts = step.coefficients.states().zip(&self.tolerances);
        for (((series, tolerances), (state, rate_at_end)), rate) in
            starts.zip(ends).zip(&step.slopes)
        {
            let size = state.size().larger(series[0].size());
            most = A::times(&allowed(*tolerances, size, size), self.order as f64).larger(most);
            let rounding = rate.with(length, |rate, length| f64::EPSILON * (rate * length).abs());
            let error = rate.with(*rate_at_end, |rate, other| (rate - other).abs());
            let error = error.with(length, |error, length| error * length.abs());
            let own = error.with(rounding, |error, rounding| error - RATE_ERROR * rounding);
            // NaN stays.
            off = off.with(own, |off, own| if own <= off || off.is_nan() { off } else { own });
        }
        // Zero, or NaN where a part or a component has no value.
        for values in [&step.parts[..self.series.field_parts], &step.state_at_end] {
            for value in values {
                off = A::sum(&off, &A::times(value, 0.0));
            }
        }
        off.with(most, |off, most| f64::from(off <= RATE_ERROR * most))
    }
}
