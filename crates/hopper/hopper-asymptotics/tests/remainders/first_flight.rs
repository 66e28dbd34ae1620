//! The first flight near a fixed point, as Taylor models in |t|.
//!
//! The parameter is p = 1/a. All quantities are scaled with a, so that p = 0 is no exception (docs/theory.md, Lemma
//! 34).

use crate::interval::cube_root;
use crate::model::Model;
use interval_arithmetic::Enclosure;

/// 1/k!
pub(crate) fn factorial_term(k: usize) -> Enclosure {
    (1..=k).fold(Enclosure::from(1.0), |product, j| product / Enclosure::from(j as f64))
}

/// (−1)^k
pub(crate) fn sign(k: usize) -> f64 {
    if k.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// The functions of the first flight, scaled with a: all are models in t with p = 1/a as a parameter.
pub(crate) struct First {
    pub(crate) p: Enclosure,
    /// β.
    pub(crate) beta: Enclosure,
    /// ω = v/t.
    pub(crate) omega: Model,
    /// δ.
    pub(crate) delta: Model,
    /// Γ/(a t²).
    pub(crate) closing: Model,
    /// b/(a² t).
    pub(crate) b: Model,
    /// Q/a.
    pub(crate) q: Model,
    /// cos η + p sin η.
    pub(crate) cosine: Model,
}

impl First {
    /// For t = side · |t|, as models in |t|.
    pub(crate) fn new(p: Enclosure, side: f64, order: usize, width: f64) -> Self {
        let zero = Enclosure::from(0.0);
        let one = Enclosure::from(1.0);
        let entire = |term: &dyn Fn(usize) -> Enclosure| Model::entire(term, order, width);
        let s = |k: usize| if k.is_multiple_of(2) { 1.0 } else { side };
        // (t − sin t)/t³ and (t²/2 − 1 + cos t)/t³
        let e3 = entire(&|k| {
            if k.is_multiple_of(2) { factorial_term(k + 3) * sign(k / 2) } else { zero }
        });
        let e4 = entire(&|k| {
            if k % 2 == 1 { factorial_term(k + 3) * (sign(k / 2) * s(k)) } else { zero }
        });
        let sin = entire(&|k| {
            if k % 2 == 1 { factorial_term(k) * (sign(k / 2) * s(k)) } else { zero }
        });
        let cos =
            entire(&|k| if k.is_multiple_of(2) { factorial_term(k) * sign(k / 2) } else { zero });
        // sin η/t and cos η, η = t/2
        let half = |k: usize| Enclosure::from(0.5f64.powi(k as i32));
        let sin_half = entire(&|k| {
            if k.is_multiple_of(2) {
                factorial_term(k + 1) * half(k + 1) * sign(k / 2)
            } else {
                zero
            }
        });
        let cos_half = entire(&|k| {
            if k.is_multiple_of(2) { factorial_term(k) * half(k) * sign(k / 2) } else { zero }
        });
        let square = p.squared();
        let r2 = one + square; // R²/a²
        let t = Model::linear(Enclosure::from(side), order, width);
        let constant = |value: Enclosure| Model::constant(value, order, width);
        // Q/a = 2 + p t − p [2p cos t + (p² − 1) sin t]/(1 + p²)
        let q = &(&constant(Enclosure::from(2.0)) + &t.scaled(p))
            - &(&cos.scaled(p * 2.0) + &sin.scaled(square - one)).scaled(p / r2);
        // The constant term is 2 − 2p²/(1+p²) = 2/(1+p²); this form has p once.
        let mut q = q;
        q.terms[0] = Enclosure::from(2.0) / r2;
        let quotient = &(&e3 + &e4.scaled(p)) * &q.reciprocal(); // δ/t³
        let beta = cube_root(Enclosure::from(12.0) / r2);
        let omega = quotient.power(1.0 / 3.0, one / beta);
        let delta = &(&(&quotient * &t) * &t) * &t;
        // b/(a² t) = (1 + p² + pη) sin η/t − p² cos η/2
        let b =
            &(&(&constant(r2) + &t.scaled(p * 0.5)) * &sin_half) - &cos_half.scaled(square * 0.5);
        let mut b = b;
        b.terms[0] = Enclosure::from(0.5);
        let closing = (&b.squared() * &q.reciprocal()).scaled(Enclosure::from(4.0) / r2);
        let cosine = &cos_half + &(&t * &sin_half).scaled(p);
        First { p, beta, omega, delta, closing, b, q, cosine }
    }

    /// A constant of the same order and width.
    pub(crate) fn constant(&self, value: f64) -> Model {
        Model::constant(Enclosure::from(value), self.q.terms.len(), self.q.width)
    }

    /// G = (δ − δ′)/(λ v⁴) from Σ Γ²/(a² t⁴).
    pub(crate) fn relative_loss(&self, squares: &Model, mu: Enclosure) -> Model {
        let order = squares.terms.len();
        let one = Model::constant(Enclosure::from(1.0), order, squares.width);
        let alpha = &one + &self.delta.scaled(self.p);
        let mut fourth = squares.clone();
        for _ in 0..4 {
            fourth = fourth.shifted();
        }
        let ratio = &fourth.scaled(mu) * &alpha.squared().reciprocal();
        let root = (&one - &ratio).power(0.5, Enclosure::from(1.0));
        let sum = &alpha * &(&one + &root);
        let omega4 = self.omega.squared().squared();
        let beta4 = self.beta.squared().squared();
        (squares * &(&omega4 * &sum).reciprocal()).scaled(Enclosure::from(8.0) / beta4)
    }
}
