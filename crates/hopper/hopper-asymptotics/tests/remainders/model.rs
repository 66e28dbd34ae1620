//! Taylor models: a polynomial with a bound on the rest.

use interval_arithmetic::Enclosure;
use std::ops::{Add, Mul, Neg, Sub};

/// A function of t on [0, W]: f(t) = Σ_{k<K} c_k t^k + (t/W)^K φ(t) with |φ| ≤ `rest`.
///
/// Sums, products and powers give models that hold for every function in their operands. The c_k contain the Taylor
/// coefficients of f at 0.
#[derive(Debug, Clone)]
pub(crate) struct Model {
    /// c_0, …, c_{K−1}.
    pub(crate) terms: Vec<Enclosure>,
    /// The bound on φ.
    pub(crate) rest: f64,
    /// W.
    pub(crate) width: f64,
}

/// Factor on sums of positive numbers, for their rounding: each sum here has fewer than 10⁴ operations of relative
/// error 2⁻⁵³, together below 10⁻¹¹.
const ROUNDING: f64 = 1.0 + 1e-11;

impl Model {
    /// A constant.
    pub(crate) fn constant(value: Enclosure, order: usize, width: f64) -> Self {
        let mut terms = vec![Enclosure::from(0.0); order];
        terms[0] = value;
        Model { terms, rest: 0.0, width }
    }

    /// `slope` · t.
    pub(crate) fn linear(slope: Enclosure, order: usize, width: f64) -> Self {
        let mut model = Model::constant(Enclosure::from(0.0), order, width);
        model.terms[1] = slope;
        model
    }

    /// Σ c_k t^k for all k, with c_k from `term`, |c_k| ≤ 1/k!, and W ≤ 2.
    pub(crate) fn entire(term: impl Fn(usize) -> Enclosure, order: usize, width: f64) -> Self {
        assert!(width <= 2.0 && order >= 4);
        let terms: Vec<_> = (0..order).map(&term).collect();
        // Σ_{k≥K} W^k/k! ≤ 2 W^K/K!, as W/(K+1) ≤ ½.
        let first = (1..=order).fold(1.0, |product, k| product * width / k as f64);
        Model { terms, rest: 2.0 * first * ROUNDING, width }
    }

    /// Σ |c_k| W^k + rest ≥ |f|.
    pub(crate) fn norm(&self) -> f64 {
        let sum = self.terms.iter().rev().fold(0.0, |sum, c| sum * self.width + c.magnitude());
        (sum + self.rest) * ROUNDING
    }

    /// f/t^m for a function whose first m coefficients are zero by a proof.
    pub(crate) fn without(&self, m: usize) -> Self {
        for c in &self.terms[..m] {
            assert!(c.contains(0.0), "{c:?} is not zero");
        }
        let mut terms = self.terms[m..].to_vec();
        // The first m terms are lost at the other end: the order falls by m.
        let scale = self.width.powi(m as i32);
        if terms.is_empty() {
            terms.push(Enclosure::from(0.0));
        }
        Model { terms, rest: self.rest / scale * ROUNDING, width: self.width }
    }

    /// t f.
    pub(crate) fn shifted(&self) -> Self {
        let mut terms = vec![Enclosure::from(0.0)];
        terms.extend(&self.terms);
        let last = terms.pop().unwrap();
        let order = terms.len();
        let rest = self.rest * self.width + last.magnitude() * self.width.powi(order as i32);
        Model { terms, rest: rest * ROUNDING, width: self.width }
    }

    pub(crate) fn scaled(&self, factor: Enclosure) -> Self {
        let terms = self.terms.iter().map(|&c| c * factor).collect();
        Model { terms, rest: self.rest * factor.magnitude() * ROUNDING, width: self.width }
    }

    /// self^s for |s| ≤ 1 and a model whose constant term is positive.
    pub(crate) fn power(&self, s: f64, root_of_constant: Enclosure) -> Self {
        let order = self.terms.len();
        let constant = self.terms[0];
        assert!(constant.low() > 0.0);
        let mut w = self.scaled(Enclosure::from(1.0) / constant);
        w.terms[0] = Enclosure::from(0.0);
        let norm = w.norm();
        assert!(norm < 1.0, "no convergence: {norm}");
        // (1 + w)^s = Σ binom(s, k) w^k. The |binom(s, k)| do not grow, and are at most 1.
        let mut binomials = vec![Enclosure::from(1.0)];
        for k in 1..order {
            let factor =
                (Enclosure::from(s) - Enclosure::from((k - 1) as f64)) / Enclosure::from(k as f64);
            binomials.push(binomials[k - 1] * factor);
        }
        let mut sum = Model::constant(binomials[order - 1], order, self.width);
        for k in (0..order - 1).rev() {
            sum = &sum * &w;
            sum.terms[0] = sum.terms[0] + binomials[k];
        }
        // w = O(t), and |w| ≤ norm (t/W): the rest of the sum is (t/W)^K Σ_{k≥K} |binom| norm^k.
        sum.rest += norm.powi(order as i32) / (1.0 - norm) * ROUNDING;
        sum.scaled(root_of_constant)
    }

    pub(crate) fn reciprocal(&self) -> Self {
        self.power(-1.0, Enclosure::from(1.0) / self.terms[0])
    }

    pub(crate) fn squared(&self) -> Self {
        self * self
    }

    /// The range over `t` in [0, W].
    pub(crate) fn range(&self, t: Enclosure) -> Enclosure {
        let sum = self.terms.iter().rev().fold(Enclosure::from(0.0), |sum, &c| sum * t + c);
        sum + Enclosure::new(-self.rest, self.rest)
    }
}

impl Add for &Model {
    type Output = Model;
    fn add(self, other: &Model) -> Model {
        assert!(self.terms.len() == other.terms.len() && self.width == other.width);
        let terms = self.terms.iter().zip(&other.terms).map(|(&a, &b)| a + b).collect();
        Model { terms, rest: (self.rest + other.rest) * ROUNDING, width: self.width }
    }
}

impl Neg for &Model {
    type Output = Model;
    fn neg(self) -> Model {
        self.scaled(Enclosure::from(-1.0))
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
        let order = self.terms.len();
        assert!(order == other.terms.len() && self.width == other.width);
        let mut terms = vec![Enclosure::from(0.0); order];
        // Terms of order K and more, at t = W.
        let mut beyond = 0.0;
        let powers: Vec<f64> = (0..2 * order).map(|k| self.width.powi(k as i32)).collect();
        for (i, &a) in self.terms.iter().enumerate() {
            if a.magnitude() == 0.0 {
                continue;
            }
            for (j, &b) in other.terms.iter().enumerate() {
                if i + j < order {
                    terms[i + j] = terms[i + j] + a * b;
                } else {
                    beyond += a.magnitude() * b.magnitude() * powers[i + j];
                }
            }
        }
        let rest = beyond + self.rest * other.norm() + other.rest * self.norm();
        Model { terms, rest: rest * ROUNDING, width: self.width }
    }
}
