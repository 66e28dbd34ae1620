//! The asymptotic series of a Fatou coordinate, with a bound on its error.
//!
//! With x′ = x (1 + g)^{1/3}, Abel's equation reads, with −1 on the left and +1 on the right,
//!
//! ```text
//!   [(1+g)^{−1/3} − 1]/(A x) + (c/3) ln(1+g) + Σ d_k x^k [(1+g)^{k/3} − 1] = ∓1
//! ```
//!
//! Each d_k makes one coefficient of this equation zero. What is left, r(x), bounds the error of the series: it is
//! the sum of r along the orbit towards the fixed point (docs/theory.md, Section 16).

use crate::coefficients::Coefficients;
use crate::error::Error;
use crate::fatou::hop_count::HopCount;
use crate::fatou::local_hop_model::{LocalHopModel, Side};
use crate::fatou::offset::Offset;
use crate::fatou::polynomial::ORDER;
use crate::fatou::taylor_model::Model;
use crate::local_map::LEFT_FACTOR;
use passive_hopper::MassRatio;

/// Number of terms d_k: the equation has coefficients up to `ORDER` − 2, and the first two vanish by A and c.
const TERMS: usize = ORDER - 3;

/// The largest A x. The bound on the error is about 10⁻⁶ there, and falls fast towards the fixed point. A larger
/// value would need more terms.
const NEAREST_TURN: f64 = 0.12;

/// The errors of the series up to which a phase uses it, on the left and on the right. Smaller values leave more
/// hops to be followed one by one, and each of them adds to the error. With these, a phase errs by at most 10⁻¹²
/// for n ≤ 10 and M from 0.02 to 50.
const PHASE_ERRORS: [f64; 2] = [4e-13, 5e-13];

/// The error up to which a jump uses the series.
const JUMP_ERROR: f64 = 1e-8;

/// The range for an error is bisected so often: it is at most 0.1 % too small.
const BISECTIONS: u32 = 10;

/// No range is smaller than this part of the whole, where the rounding of the coefficients exceeds the wanted error.
const LEAST_PART: f64 = 0.25;

/// The largest |t| of the Taylor models on the left and on the right, where the drift is small. Beyond it the
/// series of the flights determine the error; on the left those of the second flight.
const LARGEST_WIDTHS: [f64; 2] = [0.2, 0.4];

/// Bound on the relative error of A in units of ε (docs/theory.md, Lemma 72: seven for λ, and the factor).
const DRIFT_ULPS: f64 = 8.0;

/// The series at one side of a fixed point.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AbelSeries {
    /// A.
    drift: f64,
    /// c.
    logarithm: f64,
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

/// A, c, and the largest |t| of the series.
fn leading(local: &Coefficients, side: Side) -> (f64, f64, f64) {
    let (a, beta, lambda) = (local.alpha_star, local.beta, local.lambda);
    let share = beta / (lambda * a);
    let [left, right] = LARGEST_WIDTHS;
    let (drift, logarithm, largest) = match side {
        Side::Left => (local.left_drift(), -2.0 - 3.0 / LEFT_FACTOR * share, left),
        Side::Right => (lambda / 3.0, 2.0 + 3.0 * share, right),
    };
    (drift, logarithm, (beta * NEAREST_TURN / drift).min(largest))
}

impl AbelSeries {
    pub(crate) fn on_the_right(local: &Coefficients, mass_ratio: MassRatio) -> Result<Self, Error> {
        let (.., width) = leading(local, Side::Right);
        Self::new(local, &LocalHopModel::new(local, mass_ratio, Side::Right, width), Side::Right)
    }

    /// On the left, from a hop up to the |t| of the series or farther.
    pub(crate) fn on_the_left(local: &Coefficients, hop: &LocalHopModel) -> Result<Self, Error> {
        let (.., width) = leading(local, Side::Left);
        Self::new(local, &hop.narrowed(width), Side::Left)
    }

    fn new(local: &Coefficients, hop: &LocalHopModel, side: Side) -> Result<Self, Error> {
        let (drift, logarithm, width) = leading(local, side);
        let [left_error, right_error] = PHASE_ERRORS;
        let phase_error = if side == Side::Left { left_error } else { right_error };
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
        series.solve(hop, side);
        let [range, jump] = [phase_error, JUMP_ERROR].map(|largest| {
            // The bound on the error grows with x.
            let fits = |part: f64| series.series_error(part * series.whole) <= largest;
            let (mut part, mut step) = (0.0, 1.0);
            for _ in 0..=BISECTIONS {
                if part + step <= 1.0 && fits(part + step) {
                    part += step;
                }
                step *= 0.5;
            }
            part.max(LEAST_PART) * series.whole
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
        let (powers, size) = (hop.growth.powers(), hop.growth.size());
        let relative = (DRIFT_ULPS + 2.0) * f64::EPSILON;
        // [(1+g)^{−1/3} − 1]/(A x) is g/u times a series in g, divided by A x/u.
        let bracket = &hop.rate * &Model::binomial_quotient(&powers, -1.0 / 3.0, size);
        let leading =
            (&bracket * &hop.root.reciprocal()).scaled(1.0 / (self.drift * self.width), relative);
        // c is known as well as A, and 2 is exact.
        let logarithms = Model::logarithm(&powers, size).scaled(self.logarithm() / 3.0, relative);
        let mut residual = &leading + &logarithms;
        // The first two coefficients are exactly 0 by the choice of A and c.
        residual.terms[..2].fill(0.0);
        residual.radii[..2].fill(0.0);
        let (root, fast) = (hop.root.shifted(), Model::binomial(&powers, 1.0 / 3.0, size));
        let (mut root_power, mut fast_power) = (root, fast);
        for k in 0..TERMS {
            let term = &root_power * &fast_power.with_constant(0.0, 0.0);
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
        self.logarithm
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
    pub(crate) fn series_error(&self, x: f64) -> f64 {
        let y = x / self.whole;
        let series = self.errors.iter().rev().fold(0.0, |sum, error| sum * y + error);
        // The tail has fewer than 40 roundings, and x errs by an ulp, which moves x^k by k ulps.
        (1.0 + 40.0 * f64::EPSILON) * series + 40.0 * f64::EPSILON * y * self.tail
    }

    /// Σ d_k x^k at x = |δ|^{1/3}, and a bound on the error of the sum with the exact terms of `leading_term.rs`.
    pub(crate) fn beyond_exact(&self, delta: f64) -> (f64, f64) {
        let x = pxfm::f_cbrt(delta.abs());
        let tail = self.tail(x);
        // ln |δ| errs by ε/4; the sums of the fractions, each below 2 + |tail|, by some halves of ε.
        let rounding = self.logarithm().abs() / 12.0 + 4.0 + tail.abs();
        (tail, self.series_error(x) + f64::EPSILON * rounding)
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

    /// The x at which Ψ has the value, and a bound on its relative error. The bound is infinite if the value with
    /// its error is not well within those of the series.
    pub(crate) fn root_at(&self, count: HopCount) -> (f64, f64) {
        // Newton's method for p = 1/(A x): Ψ = p − c ln(A p) + …, whose slope by p is 1 − c A x + …, near 1.
        let smallest = 1.0 / (self.drift * self.whole);
        // Most values lie on the turn of jumps: p − Ψ is nearly that at its end, where it is known.
        let (first, x) = self.jump;
        let known = if x > 0.0 { 1.0 / (self.drift * x) - (first + 1.0) } else { 0.0 };
        let mut p = smallest.max(count.hops + known);
        let at = |p: f64| {
            let x = (1.0 / (self.drift * p)).min(self.whole);
            (x, self.value(x))
        };
        let (mut x, mut found) = at(p);
        for _ in 0..NEWTON_STEPS {
            let residual = found.hops - count.hops;
            if residual.abs() <= (4.0 * f64::EPSILON * p).max(SMALL_PART * count.error) {
                break;
            }
            let slope = -self.drift * x * x * self.slope(x);
            p = smallest.max(p - residual / slope);
            (x, found) = at(p);
        }
        let error = found.error + count.error + (found.hops - count.hops).abs();
        // The slope by p is at least one half (docs/theory.md, Lemma 92.2): p errs by at most twice as much, and x
        // by r/(1 − r).
        let relative = 2.0 * error / p;
        let inside = relative <= LARGEST_ERROR && p * (1.0 - relative) >= SHORTEST * smallest;
        (x, if inside { relative / (1.0 - relative) + f64::EPSILON } else { f64::INFINITY })
    }

    /// The offset of a phase mantissa · 2^exponent at x below 2⁻³⁰⁰, where the other terms are below the last digit
    /// of 1/(A x), and its relative error. `error` is that of the phase, relative to the phase, and at most ½.
    pub(crate) fn deep_offset(&self, mantissa: f64, exponent: i64, error: f64) -> (Offset, f64) {
        // ln Ψ, and x = 1/(A Ψ).
        let logarithm = pxfm::f_log(mantissa) + exponent as f64 * std::f64::consts::LN_2;
        let root = -(logarithm + pxfm::f_log(self.drift));
        let log10 = 3.0 * root / std::f64::consts::LN_10;
        let power = log10.floor();
        let digits = pxfm::f_exp10(log10 - power);
        // An error of the logarithm is a relative error of the offset.
        let rounding = 8.0 * f64::EPSILON * (logarithm.abs() + root.abs()) * 3.0;
        (Offset::deep(digits, power as i64), rounding + cube_error(error / (1.0 - error)))
    }
}

/// The relative error of x³ for the relative error `relative` of x: (1 + r)³ − 1, and the rounding of the cube.
pub(crate) fn cube_error(relative: f64) -> f64 {
    3.0 * relative * (1.0 + relative) * (1.0 + relative) + 2.0 * f64::EPSILON
}

/// A residual of this part of the error of a phase ends the search for its x. A smaller part takes more steps.
const SMALL_PART: f64 = 1.0 / 16.0;

/// Most Newton steps of [`AbelSeries::root_at`]: five suffice, as the slope is between one half and two.
const NEWTON_STEPS: usize = 20;

/// The largest error of 1/(A x), relative to it, of an inverse: beyond it the inverse says little.
const LARGEST_ERROR: f64 = 0.5;

/// The largest x of the series is itself an inverse, up to this part of it for the roundings.
const SHORTEST: f64 = 1.0 - 1e-6;
