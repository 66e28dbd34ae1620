//! The asymptotic series of a Fatou coordinate, with a bound on its error.
//!
//! With x′ = x (1 + g)^{1/3}, Abel's equation reads, with −1 on the left and +1 on the right,
//!
//! ```text
//!   [(1+g)^{−1/3} − 1]/(A x) + (c/3) ln(1+g) + Σ d_k x^k [(1+g)^{k/3} − 1] = ∓1
//! ```
//!
//! Each d_k makes one coefficient of this equation zero. What is left, r(x), bounds the error of the series: it is the sum of
//! r along the orbit towards the fixed point (docs/theory.md, Section 16).

use crate::coefficients::Coefficients;
use crate::error::Error;
use crate::fatou::fatou_coordinate::HopCount;
use crate::fatou::local_hop_model::{LocalHopModel, Side};
use crate::fatou::offset::Offset;
use crate::fatou::taylor_model::{Model, ORDER};
use passive_hopper::MassRatio;

/// Number of terms d_k: the equation has coefficients up to `ORDER` − 2, and the first two vanish by A and c.
const TERMS: usize = ORDER - 3;

/// The largest A x. The bound on the error is about 10⁻⁶ there, and falls fast towards the fixed point. A larger value would
/// need more terms.
const NEAREST_TURN: f64 = 0.12;

/// The errors of the series up to which a phase and a jump use it. Smaller values leave more hops to be followed one by one.
const ERRORS: [f64; 2] = [1e-12, 1e-8];

/// The range for an error is searched among this many parts of the whole range, so that it is a few per cent too small.
const PARTS: u32 = 32;

/// No range is smaller than this part of the whole, where the rounding of the coefficients exceeds the wanted error.
const LEAST_PART: f64 = 0.25;

/// The largest |t| of the Taylor models on the left and on the right, where the drift is small. Beyond it the series of the
/// flights determine the error; on the left those of the second flight.
const LARGEST_WIDTHS: [f64; 2] = [0.2, 0.4];

/// Bound on the relative error of A in units of ε (docs/theory.md, Lemma 72: seven for λ, and the factor).
const DRIFT_ULPS: f64 = 8.0;

/// The series at one side of a fixed point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AbelSeries {
    /// A.
    drift: f64,
    /// c as −2 or 2, exactly, and the rest.
    logarithm: (f64, f64),
    /// d_k W^k, k = 1, 2, …
    scaled: [f64; TERMS],
    /// W, the largest |t| of the Taylor models.
    width: f64,
    /// The largest x of all.
    whole: f64,
    /// The largest x of a phase, and Ψ there.
    range: (f64, HopCount),
    /// The turn on which a jump ends: its smallest Ψ, an integer, and an x at or beyond its end, where Ψ is one more.
    jump: (f64, f64),
    /// The bound on the error of the series: coefficients of y^k, y = x/`whole`.
    errors: [f64; ORDER + 1],
    /// Σ |d_k| x^k at the largest x.
    tail: f64,
}

impl AbelSeries {
    pub(crate) fn new(
        local: &Coefficients,
        mass_ratio: MassRatio,
        side: Side,
    ) -> Result<Self, Error> {
        let (a, beta, lambda) = (local.alpha_star, local.beta, local.lambda);
        let share = beta / (lambda * a);
        let [left, right] = LARGEST_WIDTHS;
        let (drift, logarithm, largest) = match side {
            Side::Left => (10.0 * lambda / 3.0, (-2.0, -0.3 * share), left),
            Side::Right => (lambda / 3.0, (2.0, 3.0 * share), right),
        };
        let width = (beta * NEAREST_TURN / drift).min(largest);
        let hop = LocalHopModel::new(local, mass_ratio, side, width);
        let mut series = AbelSeries {
            drift,
            logarithm,
            scaled: [0.0; TERMS],
            width,
            whole: width * hop.root.least(),
            range: (0.0, HopCount { hops: 0.0, error: 0.0 }),
            jump: (0.0, 0.0),
            errors: [0.0; ORDER + 1],
            tail: 0.0,
        };
        series.solve(&hop, side);
        let [range, jump] = ERRORS.map(|largest| {
            let fits = |part: &f64| series.series_error(part * series.whole) <= largest;
            let parts = (1..=PARTS).rev().map(|k| f64::from(k) / f64::from(PARTS));
            parts.into_iter().find(fits).unwrap_or(0.0).max(LEAST_PART) * series.whole
        });
        series.range = (range, series.value(range));
        // One more than the next integer leaves room for the error of a phase.
        let first = series.value(jump).hops.ceil() + 1.0;
        series.jump = (first, series.root_at(HopCount { hops: first + 1.0, error: 0.0 }).0);
        let found = [series.drift, series.whole, series.errors.iter().sum(), series.tail];
        if found.iter().all(|number| number.is_finite() && *number >= 0.0) && series.range.0 > 0.0 {
            Ok(series)
        } else {
            Err(Error::Drift { n: local.n, drift })
        }
    }

    /// Finds the d_k, and the bound.
    fn solve(&mut self, hop: &LocalHopModel, side: Side) {
        let powers = hop.growth.powers();
        let size = hop.growth.size();
        let relative = (DRIFT_ULPS + 2.0) * f64::EPSILON;
        // [(1+g)^{−1/3} − 1]/(A x): the constant term of the bracket is exactly 0.
        let bracket = without_constant(Model::binomial(&powers, -1.0 / 3.0, size));
        let leading = (&bracket.lowered() * &hop.root.reciprocal())
            .scaled(1.0 / (self.drift * self.width), relative);
        // The rest of c is known as well as A, and its whole is exact.
        let logarithms = Model::logarithm(&powers, size).scaled(self.logarithm() / 3.0, relative);
        let mut residual = &leading + &logarithms;
        // These two vanish by the choice of A and c.
        residual.terms[..2].fill(0.0);
        residual.radii[..2].fill(0.0);
        let (root, fast) = (hop.root.shifted(), Model::binomial(&powers, 1.0 / 3.0, size));
        let (mut root_power, mut fast_power) = (root, fast);
        for k in 0..TERMS {
            let term = &root_power * &without_constant(fast_power);
            let order = k + 2;
            self.scaled[k] = -residual.terms[order] / term.terms[order];
            residual = &residual + &term.scaled(self.scaled[k], 0.0);
            (root_power, fast_power) = (&root_power * &root, &fast_power * &fast);
        }
        // |1/x′ − 1/x| is at least this.
        let rate = self.drift * leading.scaled(side.sign(), 0.0).least();
        for k in 2..=ORDER {
            let size = match residual.terms.get(k) {
                Some(term) => term.abs() + residual.radii[k],
                None => residual.rest,
            };
            // The sum over the orbit, an integral of y^k; on the right with the first point itself.
            self.errors[k - 1] += size / ((k - 1) as f64 * rate * self.whole);
            if side == Side::Right {
                self.errors[k] += size;
            }
        }
        let largest = self.whole / self.width;
        self.tail = self.scaled.iter().rev().fold(0.0, |sum, d| (sum + d.abs()) * largest);
    }

    pub(crate) fn drift(&self) -> f64 {
        self.drift
    }

    pub(crate) fn logarithm(&self) -> f64 {
        self.logarithm.0 + self.logarithm.1
    }

    /// d_k.
    pub(crate) fn coefficient(&self, k: usize) -> Option<f64> {
        let index = k.checked_sub(1)?;
        self.scaled.get(index).map(|d| d / self.width.powi(k as i32))
    }

    /// The largest x of a phase.
    pub(crate) fn range(&self) -> f64 {
        self.range.0
    }

    /// The largest x of all, with an error of some 10⁻⁶.
    pub(crate) fn whole(&self) -> f64 {
        self.whole
    }

    /// Ψ at the largest x of a phase.
    pub(crate) fn nearest(&self) -> HopCount {
        self.range.1
    }

    /// The smallest Ψ of the turn on which a jump ends.
    pub(crate) fn end_of_jump(&self) -> f64 {
        self.jump.0
    }

    /// The x at which this turn begins.
    pub(crate) fn first_of_jump(&self) -> f64 {
        self.jump.1
    }

    /// Σ d_k x^k.
    fn tail(&self, x: f64) -> f64 {
        let v = x / self.width;
        self.scaled.iter().rev().fold(0.0, |sum, d| (sum + d) * v)
    }

    /// Bound on the error of Σ d_k x^k with that of the series.
    fn series_error(&self, x: f64) -> f64 {
        let y = x / self.whole;
        let series = self.errors.iter().rev().fold(0.0, |sum, error| sum * y + error);
        // The tail has fewer than 40 roundings.
        series + 20.0 * f64::EPSILON * y * self.tail
    }

    /// c ln x + Σ d_k x^k at x = |`delta`|^{1/3}, as an integer and a rest, and a bound on the error.
    pub(crate) fn beyond_leading(&self, delta: Offset) -> (f64, f64, f64) {
        let x = pxfm::f_cbrt(delta.nearest().abs());
        let (high, low) = delta.logarithm_in_two_parts(); // ln |δ|
        let (two, rest) = self.logarithm;
        // Thirds of the sum in two parts: the remainder of the first quotient is exact.
        let third = two * high / 3.0;
        let remainder = 3.0f64.mul_add(-third, two * high) + two * low;
        let whole = third.floor();
        let varying = rest * high / 3.0;
        let sum = (third - whole) + remainder / 3.0 + varying + self.tail(x);
        let rounding = f64::EPSILON * ((DRIFT_ULPS + 6.0) * varying.abs() + sum.abs() + 6.0);
        (whole, sum, self.series_error(x) + rounding)
    }

    /// Ψ at 0 < x ≤ `whole`.
    pub(crate) fn value(&self, x: f64) -> HopCount {
        let leading = 1.0 / (self.drift * x);
        let logarithms = self.logarithm() * pxfm::f_log(x);
        let hops = leading + logarithms + self.tail(x);
        // An ulp of x moves the logarithm by ε. A and c err by some ulps.
        let rounding = (DRIFT_ULPS + 4.0) * (leading + logarithms.abs()) + self.logarithm().abs();
        HopCount { hops, error: self.series_error(x) + f64::EPSILON * rounding }
    }

    /// dΨ/dx of the series.
    pub(crate) fn slope(&self, x: f64) -> f64 {
        let v = x / self.width;
        let terms = self.scaled.iter().enumerate().rev();
        let tail = terms.fold(0.0, |sum, (k, d)| sum * v + (k + 1) as f64 * d);
        (self.logarithm() - 1.0 / (self.drift * x)) / x + tail / self.width
    }

    /// The x at which Ψ has the value, and a bound on its error.
    pub(crate) fn root_at(&self, count: HopCount) -> (f64, f64) {
        let mut x = (1.0 / (self.drift * count.hops)).min(self.whole);
        // Newton's method on 1/Ψ, which is nearly linear in x.
        for _ in 0..NEWTON_STEPS {
            let found = self.value(x).hops;
            let step = (found - count.hops) * found / (count.hops * self.slope(x));
            let next = (x - step).clamp(0.25 * x, 4.0 * x);
            let small = (next - x).abs() <= 2.0 * f64::EPSILON * x;
            x = next;
            if small {
                break;
            }
        }
        let found = self.value(x);
        let error = found.error + count.error + (found.hops - count.hops).abs();
        // The slope of Ψ over one error: at least half of the leading one (docs/theory.md, Section 16).
        (x, 2.0 * error * self.drift * x * x + f64::EPSILON * x)
    }

    /// The offset of a phase mantissa · 2^exponent beyond the range of `f64`, and its relative error. The terms d_k x^k are
    /// below 10⁻²⁰⁰ there.
    pub(crate) fn deep_offset(&self, mantissa: f64, exponent: i64) -> (Offset, f64) {
        let c = self.logarithm();
        let two = std::f64::consts::LN_2;
        // ln Ψ; x = 1/(A (Ψ − c ln x)), and the correction is far below the digits of Ψ.
        let logarithm = pxfm::f_log(mantissa) + exponent as f64 * two;
        let root = -(logarithm + pxfm::f_log(self.drift));
        let correction = c * root * pxfm::f_exp(-logarithm); // relative to Ψ
        let log10 = 3.0 * (root + correction) / std::f64::consts::LN_10;
        let power = log10.floor();
        let digits = pxfm::f_exp10(log10 - power);
        // An error of the logarithm is a relative error of the offset.
        let relative = 8.0 * f64::EPSILON * (logarithm.abs() + root.abs()) * 3.0;
        (Offset::deep(digits, power as i64), relative)
    }
}

/// Most Newton steps of [`AbelSeries::root_at`]: from three digits four suffice.
const NEWTON_STEPS: usize = 12;

/// The model without its constant term, which is exactly 1 and cancels.
fn without_constant(mut model: Model) -> Model {
    (model.terms[0], model.radii[0]) = (0.0, 0.0);
    model
}
