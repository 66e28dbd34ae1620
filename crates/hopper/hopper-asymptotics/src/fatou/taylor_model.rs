//! Taylor models: polynomials with a bound on what they leave out.
//!
//! A model stands for every function g for which there are fixed numbers e_k and a function R with
//!
//! ```text
//!   g(u) = Σ (t_k + e_k) u^k + R(u) u^ORDER      |e_k| ≤ r_k     |R(u)| ≤ rest      0 < u ≤ 1,  k < ORDER
//! ```
//!
//! The radii r_k hold the rounding errors, and the rest holds the terms beyond the polynomial. For a function that
//! is analytic at 0 the numbers t_k + e_k are its Taylor coefficients. So a coefficient that is known exactly may
//! be put in, with the radius
//! 0. Models that contain two functions contain their mean.
//!
//! Each operation is computed for the middles t_k, and its rounding errors are added to the radii. Quotients and
//! solutions of equations are computed for the middles first. The equation is then evaluated as a model, and gives
//! their radii.

use crate::fatou::polynomial::{EVEN_POWERS, ORDER, Polynomial, Truncated};
use std::ops::{Add, Mul, Neg, Sub};

/// A polynomial in u, 0 ≤ u ≤ 1, with bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Model {
    pub(crate) terms: [f64; ORDER],
    pub(crate) radii: [f64; ORDER],
    pub(crate) rest: f64,
}

/// Bound on the relative rounding error of a sum of up to [`ORDER`] products, for each of its terms: one rounding
/// of the product and fewer than `ORDER` of the sums, each of ½ε; rounded up.
const SUM: f64 = 0.5 * f64::EPSILON * (ORDER as f64 + 2.0);

/// Makes a sum or product of bounds a bound in spite of its rounding: they have fewer than 40 operations each.
const UP: f64 = 1.0 + 40.0 * f64::EPSILON;

impl Model {
    pub(crate) const ZERO: Model = Model { terms: [0.0; ORDER], radii: [0.0; ORDER], rest: 0.0 };

    /// A polynomial without errors.
    pub(crate) fn exact(polynomial: Polynomial) -> Self {
        Model { terms: polynomial.0, ..Model::ZERO }
    }

    /// A number that is known to within `radius`.
    pub(crate) fn constant(value: f64, radius: f64) -> Self {
        let mut model = Model::ZERO;
        (model.terms[0], model.radii[0]) = (value, radius);
        model
    }

    /// Σ coefficient(k) u^k, where `coefficient` gives the middle and the radius of every k up to `ORDER`, and the
    /// coefficients from `ORDER` on have the sum of absolute values `rest`.
    pub(crate) fn series(coefficient: impl Fn(usize) -> (f64, f64), rest: f64) -> Self {
        let mut model = Model { rest, ..Model::ZERO };
        for k in 0..ORDER {
            (model.terms[k], model.radii[k]) = coefficient(k);
        }
        model
    }

    /// The model with a constant term that is known to within `radius`.
    pub(crate) fn with_constant(mut self, value: f64, radius: f64) -> Self {
        (self.terms[0], self.radii[0]) = (value, radius);
        self
    }

    /// u · self.
    pub(crate) fn shifted(&self) -> Self {
        let mut model = Model::ZERO;
        model.terms[1..].copy_from_slice(&self.terms[..ORDER - 1]);
        model.radii[1..].copy_from_slice(&self.radii[..ORDER - 1]);
        let last = self.terms[ORDER - 1].abs() + self.radii[ORDER - 1];
        model.rest = (self.rest + last) * UP;
        model
    }

    /// g(`part` · u), for 0 < `part` ≤ 1 with a relative error of ε.
    pub(crate) fn narrowed(&self, part: f64) -> Self {
        let mut model = Model::ZERO;
        let mut power = 1.0;
        for k in 0..ORDER {
            // The error of `part`, and one rounding of each factor.
            let relative = (2 * k) as f64 * f64::EPSILON;
            model.terms[k] = power * self.terms[k];
            model.radii[k] = (power * self.radii[k] + relative * model.terms[k].abs()) * UP;
            power *= part;
        }
        model.rest = power * self.rest * UP;
        model
    }

    /// `factor` · self, for a factor with the relative error `relative`.
    pub(crate) fn scaled(&self, factor: f64, relative: f64) -> Self {
        let mut model =
            Model { rest: self.rest * factor.abs() * (1.0 + relative) * UP, ..Model::ZERO };
        for k in 0..ORDER {
            let term = factor * self.terms[k];
            model.terms[k] = term;
            let rounding = (relative + f64::EPSILON) * term.abs();
            model.radii[k] = (factor.abs() * (1.0 + relative) * self.radii[k] + rounding) * UP;
        }
        model
    }

    /// Bound on |g(u)|.
    pub(crate) fn size(&self) -> f64 {
        let sum: f64 = self.terms.iter().zip(&self.radii).map(|(t, r)| t.abs() + r).sum();
        (sum + self.rest) * UP
    }

    /// A lower bound of g(u).
    pub(crate) fn least(&self) -> f64 {
        let [first, ..] = self.terms;
        // The negative terms only: positive ones raise the sum.
        let negative: f64 = self.terms[1..].iter().map(|t| (-t).max(0.0)).sum();
        let radii: f64 = self.radii.iter().sum();
        first - (negative + radii + self.rest) * UP - f64::EPSILON * first.abs()
    }

    /// A lower bound of |g(u)|; negative or 0 if there is none.
    fn least_size(&self) -> f64 {
        self.least().max((-self).least())
    }

    /// |t_k| + r_k.
    fn sizes(&self) -> [f64; ORDER] {
        std::array::from_fn(|k| self.terms[k].abs() + self.radii[k])
    }

    /// The model with the errors of e, where slope · e = −residual, self is exact, and self + e is the solution.
    ///
    /// With the coefficients of the slope, S_0 e_k = −res_k − Σ_{j<k} S_{k−j} e_j. The products beyond the
    /// polynomial, and the rest of the residual, are divided by the slope as a function.
    pub(crate) fn with_errors(&self, residual: &Model, slope: &Model) -> Self {
        let sizes = slope.sizes();
        let first = sizes[0] - 2.0 * slope.radii[0];
        let least = slope.least_size();
        if !(first > 0.0 && least > 0.0) {
            return Model { rest: f64::INFINITY, ..*self };
        }
        let mut model = *self;
        let (mut known, mut rest) = (residual.sizes(), 0.0);
        for j in 0..ORDER {
            let error = known[j] / first * UP;
            for k in j + 1..ORDER {
                known[k] = (known[k] + error * sizes[k - j]) * UP;
            }
            model.radii[j] = error;
            rest += error * (sizes[ORDER - j..].iter().sum::<f64>() + slope.rest);
        }
        model.rest = (residual.rest + rest) / least * UP;
        model
    }

    /// Whether every function of self is one of `other`, for models with the same middles.
    pub(crate) fn lies_in(&self, other: &Model) -> bool {
        self.rest <= other.rest
            && self.radii.iter().zip(&other.radii).all(|(own, wider)| own <= wider)
    }

    /// The model with all bounds multiplied by `factor`.
    pub(crate) fn widened(&self, factor: f64) -> Self {
        let radii = self.radii.map(|radius| factor * radius);
        Model { radii, rest: factor * self.rest, ..*self }
    }

    /// 1/self, for a model that is positive at every u.
    pub(crate) fn reciprocal(&self) -> Self {
        let inverse = Model::exact(Polynomial(self.terms).reciprocal());
        // e = 1/g − y solves g e = 1 − g y.
        let residual = &(self * &inverse) - &Model::constant(1.0, 0.0);
        inverse.with_errors(&residual, self)
    }

    /// Adds `factor` · `other`, for a factor with the relative error `relative`, where `other` has no term below
    /// u^`first`. The rounding of up to `ORDER` + 1 such sums is counted, that of their bounds is not.
    pub(crate) fn add_multiple(&mut self, first: usize, other: &Model, factor: f64, relative: f64) {
        let (size, relative) = (factor.abs(), relative + SUM);
        let others = other.terms.iter().zip(&other.radii).skip(first);
        let sums = self.terms.iter_mut().zip(&mut self.radii).skip(first);
        for ((sum, bound), (term, radius)) in sums.zip(others) {
            *sum += factor * term;
            *bound += size * (radius + relative * term.abs());
        }
        self.rest += size * other.rest * (1.0 + relative);
    }

    /// Σ_{k ≥ 0} c_k z^k for |z| ≤ `size` < 1, from the powers of z, of which the first is z. `coefficient` gives
    /// c_k from c_{k−1}, which is 1 for k = 0; |c_k| ≤ 1, and c_k is right to 4kε.
    pub(crate) fn power_series(
        powers: &[Model; ORDER],
        size: f64,
        coefficient: impl Fn(usize, f64) -> f64,
    ) -> Self {
        let mut last = coefficient(0, 1.0);
        let mut sum = Model::constant(last, 0.0);
        for (k, power) in powers.iter().enumerate() {
            last = coefficient(k + 1, last);
            sum.add_multiple(k + 1, power, last, 4.0 * (k + 1) as f64 * f64::EPSILON);
        }
        sum.radii = sum.radii.map(|radius| radius * UP);
        // Σ_{k > ORDER} |z|^k is at most |z|^ORDER · size/(1 − size), and |z|^ORDER is at most the rest of its
        // model times u^ORDER.
        let beyond = if size < 1.0 { size / (1.0 - size) } else { f64::INFINITY };
        sum.rest = (sum.rest + powers[ORDER - 1].rest * beyond) * UP;
        sum
    }

    /// (1 + z)^`power` for |z| ≤ `size` < 1 and |`power`| ≤ 1, from the powers of z.
    pub(crate) fn binomial(powers: &[Model; ORDER], power: f64, size: f64) -> Self {
        let next = |k: usize, last: f64| match k {
            0 => 1.0,
            k => last * ((power - (k - 1) as f64) / k as f64),
        };
        Self::power_series(powers, size, next)
    }

    /// [(1 + z)^`power` − 1]/z, as [`binomial`](Self::binomial).
    pub(crate) fn binomial_quotient(powers: &[Model; ORDER], power: f64, size: f64) -> Self {
        let next = |k: usize, last: f64| last * ((power - k as f64) / (k + 1) as f64);
        Self::power_series(powers, size, next)
    }

    /// ln(1 + z), as [`binomial`](Self::binomial).
    pub(crate) fn logarithm(powers: &[Model; ORDER], size: f64) -> Self {
        let next = |k: usize, _: f64| match k {
            0 => 0.0,
            k if k % 2 == 0 => -1.0 / k as f64,
            k => 1.0 / k as f64,
        };
        Self::power_series(powers, size, next)
    }

    /// self, self², …, self^ORDER, for a model whose constant term is 0.
    pub(crate) fn powers(&self) -> [Model; ORDER] {
        let mut powers = [*self; ORDER];
        for k in 1..ORDER {
            powers[k] = &powers[k - 1] * self;
        }
        powers
    }
}

impl Add for &Model {
    type Output = Model;
    fn add(self, other: &Model) -> Model {
        let mut sum = Model { rest: (self.rest + other.rest) * UP, ..Model::ZERO };
        for k in 0..ORDER {
            sum.terms[k] = self.terms[k] + other.terms[k];
            let rounding = f64::EPSILON * sum.terms[k].abs();
            sum.radii[k] = (self.radii[k] + other.radii[k] + rounding) * UP;
        }
        sum
    }
}

impl Neg for &Model {
    type Output = Model;
    fn neg(self) -> Model {
        Model { terms: self.terms.map(|term| -term), ..*self }
    }
}

impl Sub for &Model {
    type Output = Model;
    fn sub(self, other: &Model) -> Model {
        self + &-other
    }
}

impl Mul for &Model {
    type Output = Model;
    fn mul(self, other: &Model) -> Model {
        let mut product = Model::ZERO;
        let (a, b) = (self.sizes(), other.sizes());
        let sizes = other.terms.map(f64::abs);
        // The rounding error of a product of two middles is counted with the radius of the first one.
        for (j, (&middle, &size)) in self.terms.iter().zip(&a).enumerate() {
            // Powers have many terms that are exactly 0.
            if size == 0.0 {
                continue;
            }
            let radius = self.radii[j] + SUM * middle.abs();
            let terms = product.terms[j..].iter_mut().zip(&other.terms);
            terms.for_each(|(term, factor)| *term += middle * factor);
            let radii = product.radii[j..].iter_mut().zip(other.radii.iter().zip(&sizes));
            radii.for_each(|(sum, (error, factor))| *sum += size * error + radius * factor);
        }
        product.radii = product.radii.map(|radius| radius * UP);
        // The products beyond the polynomial: every pair with j + k ≥ ORDER, by the sums of b from the end.
        let mut tail = 0.0;
        let mut rest = 0.0;
        for j in 1..ORDER {
            tail += b[ORDER - j];
            rest += a[j] * tail;
        }
        let (sum_a, sum_b) = (a.iter().sum::<f64>(), b.iter().sum::<f64>());
        product.rest =
            (rest + sum_a * other.rest + sum_b * self.rest + self.rest * other.rest) * UP;
        product
    }
}

impl Truncated for Model {
    fn number(value: f64) -> Self {
        Model::constant(value, 0.0)
    }

    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }

    fn negative(&self) -> Self {
        -self
    }

    fn shifted_by(&self, factor: f64) -> Self {
        self.shifted().scaled(factor, 0.0)
    }

    fn combination(powers: &[Self; EVEN_POWERS], coefficients: [f64; EVEN_POWERS]) -> Self {
        let mut sum = Model::ZERO;
        for (j, (power, factor)) in powers.iter().zip(coefficients).enumerate() {
            sum.add_multiple(2 * j, power, factor, 4.0 * f64::EPSILON);
        }
        sum.rest += coefficients[EVEN_POWERS - 1].abs() * powers[EVEN_POWERS - 1].rest;
        sum.widened(UP)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The members g = 1 + (½ ± r) u have the reciprocals Σ (−½ ∓ r)^k u^k, whose coefficients err by about k
    /// r/2^{k−1}.
    #[test]
    fn reciprocals_bound_each_coefficient() {
        let radius = 1e-3;
        let model = Model::series(
            |k| match k {
                0 => (1.0, 0.0),
                1 => (0.5, radius),
                _ => (0.0, 0.0),
            },
            0.0,
        );
        let inverse = model.reciprocal();
        for slope in [0.5 - radius, 0.5 + radius] {
            let mut exact: f64 = 1.0;
            for k in 0..ORDER {
                let off = (inverse.terms[k] - exact).abs();
                assert!(off <= inverse.radii[k] + 1e-16, "{k}: {off:e} {:e}", inverse.radii[k]);
                exact *= -slope;
            }
            // What the polynomial leaves out, divided by u^ORDER.
            for u in [0.1, 0.5, 1.0] {
                assert!((exact / (1.0 + slope * u)).abs() <= inverse.rest);
            }
        }
        // The bounds are of the size of the errors.
        assert!(inverse.radii[1] < 1.01 * radius && inverse.radii[2] < 2.1 * radius);
        assert!(Model::constant(1.0, 2.0).reciprocal().rest.is_infinite());
    }

    #[test]
    fn series_of_a_function_agree_with_its_values() {
        // z = u/4 − u²/8.
        let z = Model::series(|k| ([0.0, 0.25, -0.125].get(k).copied().unwrap_or(0.0), 0.0), 0.0);
        let (powers, size) = (z.powers(), z.size());
        let value =
            |model: &Model, u: f64| model.terms.iter().rev().fold(0.0, |sum, t| sum * u + t);
        for u in [0.1, 0.5, 1.0f64] {
            let at = 0.25 * u - 0.125 * u * u;
            let cases = [
                (Model::binomial(&powers, -1.0 / 3.0, size), 1.0 / pxfm::f_cbrt(1.0 + at)),
                (
                    Model::binomial_quotient(&powers, -1.0 / 3.0, size),
                    (1.0 / pxfm::f_cbrt(1.0 + at) - 1.0) / at,
                ),
                (Model::logarithm(&powers, size), pxfm::f_log1p(at)),
            ];
            for (model, exact) in cases {
                let bound = model.rest * u.powi(ORDER as i32) + model.radii.iter().sum::<f64>();
                assert!((value(&model, u) - exact).abs() <= bound + 4e-15, "{u}");
                assert!(model.rest < 1e-4);
            }
        }
    }
}
