//! Taylor models: polynomials with a bound on what they leave out.
//!
//! A model stands for every function g with
//!
//! ```text
//!   |g(u) − Σ t_k u^k| ≤ Σ r_k u^k + rest · u^ORDER          0 ≤ u ≤ 1,  k < ORDER
//! ```
//!
//! The radii r_k hold the rounding errors, and the rest holds the terms beyond the polynomial. Each operation is computed for the
//! middles t_k, and its rounding errors are added to the radii. Roots and quotients are computed for the middles first. The
//! equation that they solve is then evaluated as a model, and gives their radii.

use std::ops::{Add, Mul, Neg, Sub};

/// The number of terms. More terms cost time with their square; fewer leave more hops to be followed one by one. With sixteen
/// the series of a Fatou coordinate has 10⁻¹² at A x = 0.036, and 10⁻⁶ at 0.12.
pub(crate) const ORDER: usize = 16;

/// A polynomial in u, 0 ≤ u ≤ 1, with bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Model {
    pub(crate) terms: [f64; ORDER],
    pub(crate) radii: [f64; ORDER],
    pub(crate) rest: f64,
}

/// Bound on the relative rounding error of a sum of up to [`ORDER`] products, for each of its terms: one rounding of the
/// product and fewer than `ORDER` of the sums, each of ½ε; rounded up.
const SUM: f64 = 0.5 * f64::EPSILON * (ORDER as f64 + 2.0);

/// Makes a sum or product of bounds a bound in spite of its rounding: they have fewer than 40 operations each.
const UP: f64 = 1.0 + 40.0 * f64::EPSILON;

impl Model {
    pub(crate) const ZERO: Model = Model { terms: [0.0; ORDER], radii: [0.0; ORDER], rest: 0.0 };

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

    /// u · self.
    pub(crate) fn shifted(&self) -> Self {
        let mut model = Model::ZERO;
        model.terms[1..].copy_from_slice(&self.terms[..ORDER - 1]);
        model.radii[1..].copy_from_slice(&self.radii[..ORDER - 1]);
        let last = self.terms[ORDER - 1].abs() + self.radii[ORDER - 1];
        model.rest = (self.rest + last) * UP;
        model
    }

    /// self / u, for a model whose constant term is exactly 0. The computed constant term is dropped.
    ///
    /// The last term is not known any more, and becomes a part of the rest.
    pub(crate) fn lowered(&self) -> Self {
        let mut model = Model::ZERO;
        model.terms[..ORDER - 1].copy_from_slice(&self.terms[1..]);
        model.radii[..ORDER - 1].copy_from_slice(&self.radii[1..]);
        // rest · u^(ORDER − 1): the middle is 0 and the radius is the rest.
        model.radii[ORDER - 1] = self.rest;
        model
    }

    /// `factor` · self, for a factor with the relative error `relative`.
    pub(crate) fn scaled(&self, factor: f64, relative: f64) -> Self {
        let mut model = Model { rest: self.rest * factor.abs() * (1.0 + relative) * UP, ..Model::ZERO };
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
        let mut others = Model { ..*self };
        others.terms[0] = 0.0;
        // The negative terms only: positive ones raise the sum.
        let negative: f64 = others.terms.iter().map(|t| (-t).max(0.0)).sum();
        let radii: f64 = self.radii.iter().sum();
        first - (negative + radii + self.rest) * UP - f64::EPSILON * first.abs()
    }

    /// The model with the errors of `residual` / `least` added, where self solves an equation with this residual, and
    /// `least` is a lower bound of the absolute slope of the equation by the unknown.
    pub(crate) fn within(&self, residual: &Model, least: f64) -> Self {
        let mut model = *self;
        for k in 0..ORDER {
            let error = residual.terms[k].abs() + residual.radii[k];
            model.radii[k] = (model.radii[k] + error / least) * UP;
        }
        model.rest = (model.rest + residual.rest / least) * UP;
        model
    }

    /// 1/self, for a model that is positive at every u.
    pub(crate) fn reciprocal(&self) -> Self {
        let mut inverse = Model::ZERO;
        inverse.terms[0] = 1.0 / self.terms[0];
        for k in 1..ORDER {
            let sum: f64 = (1..=k).map(|j| self.terms[j] * inverse.terms[k - j]).sum();
            inverse.terms[k] = -sum * inverse.terms[0];
        }
        let residual = &(self * &inverse) - &Model::constant(1.0, 0.0);
        inverse.within(&residual, self.least())
    }

    /// (1 + self)^`power` for |self| ≤ `size` < 1 and |`power`| ≤ 1, from the powers of self, of which the first is self.
    pub(crate) fn binomial(powers: &[Model; ORDER], power: f64, size: f64) -> Self {
        let mut sum = Model::constant(1.0, 0.0);
        let mut coefficient = 1.0;
        for (k, model) in powers.iter().enumerate() {
            coefficient *= (power - k as f64) / (k + 1) as f64;
            sum = &sum + &model.scaled(coefficient, 4.0 * f64::EPSILON * (k + 1) as f64);
        }
        // |coefficient| ≤ 1 for |power| ≤ 1.
        sum.beyond_powers(powers, size)
    }

    /// ln(1 + self) for |self| ≤ `size` < 1, from the powers of self.
    pub(crate) fn logarithm(powers: &[Model; ORDER], size: f64) -> Self {
        let mut sum = Model::ZERO;
        for (k, model) in powers.iter().enumerate() {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            sum = &sum + &model.scaled(sign / (k + 1) as f64, f64::EPSILON);
        }
        sum.beyond_powers(powers, size)
    }

    /// Adds a bound on Σ_{k > ORDER} |z|^k for a z = u · (…) with |z| ≤ `size`: at most |z|^ORDER · size/(1 − size), and
    /// |z|^ORDER is at most the rest of its model times u^ORDER.
    fn beyond_powers(mut self, powers: &[Model; ORDER], size: f64) -> Self {
        let last = &powers[ORDER - 1];
        self.rest = (self.rest + last.rest * size / (1.0 - size)) * UP;
        self
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
        let most = |model: &Model| -> [f64; ORDER] {
            std::array::from_fn(|k| model.terms[k].abs() + model.radii[k])
        };
        let (a, b) = (most(self), most(other));
        let sizes = other.terms.map(f64::abs);
        // The rounding error of a product of two middles is counted with the radius of the first one.
        for j in 0..ORDER {
            let (middle, size) = (self.terms[j], a[j]);
            let radius = self.radii[j] + SUM * middle.abs();
            for k in 0..ORDER - j {
                product.terms[j + k] += middle * other.terms[k];
                product.radii[j + k] += size * other.radii[k] + radius * sizes[k];
            }
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
