//! The remainders of small hops and of the series of the fixed points.

use crate::first_flight::{factorial_term, sign};
use crate::interval::{fraction, split};
use crate::left::Half;
use crate::model::Model;
use interval_arithmetic::Enclosure;

/// The range of (loss/((32/9) μα⁵) − 1 + (8/5) α²)/α⁴ for 0 ≤ α ≤ 0.3.
pub(crate) fn small_hop_remainder(mu: Enclosure) -> Enclosure {
    const ORDER: usize = 24;
    /// The models hold for 0 ≤ h ≤ 0.65. At α = 0.3, h is below 0.6.
    const WIDTH: f64 = 0.65;
    const LARGEST_ALPHA: f64 = 0.300_001;
    let one = Enclosure::from(1.0);
    let constant = Model::constant(one, ORDER, WIDTH);
    let h = Model::linear(one, ORDER, WIDTH);
    let half = Half::new(&h);
    // (h² − S²)/h⁴ = Σ (−1)^k 2^{2k+3} h^{2k}/(2k+4)!
    let rise = Model::entire(
        |k| {
            if k.is_multiple_of(2) {
                factorial_term(k + 4) * (sign(k / 2) * 2f64.powi(k as i32 + 3))
            } else {
                Enclosure::from(0.0)
            }
        },
        ORDER,
        WIDTH,
    );
    let alpha = &rise * &half.d.reciprocal(); // α/h
    // Γ/h³ = 2 (u/h³)²/(D/h³)
    let closing = (&half.u.squared() * &half.d.reciprocal()).scaled(Enclosure::from(2.0));
    let squares = closing.squared();
    let inverse = alpha.squared().reciprocal(); // h²/α²
    let fourth = h.squared().squared();
    let ratio = (&(&fourth * &squares) * &inverse).scaled(mu);
    let root = (&constant - &ratio).power(0.5, one);
    let sum = (&constant + &root).reciprocal();
    let sixth = &inverse.squared() * &inverse;
    let loss = (&(&squares * &sixth) * &sum).scaled(fraction(9.0, 32.0));
    let series = &constant - &(&h.squared() * &alpha.squared()).scaled(fraction(8.0, 5.0));
    // The first four coefficients vanish by Lemma 39.
    let remainder = (&loss - &series).without(4);
    let mut range = Enclosure::from(0.0);
    for h in split(0.0, WIDTH, 40) {
        let alpha = alpha.range(h);
        if (alpha * h).low() > LARGEST_ALPHA {
            return range;
        }
        range = range.hull(&(remainder.range(h) / alpha.squared().squared()));
    }
    panic!("α = 0.3 lies beyond the width of the models");
}

/// The range of q¹¹ (ŝ − α*_n) for n ≥ 1, where ŝ is the sum of the series up to q⁻⁹.
pub(crate) fn fixed_point_remainder() -> Enclosure {
    const ORDER: usize = 40;
    /// 1/q ≤ 2/(3π) = 0.21220659….
    const WIDTH: f64 = 0.212_207;
    let w = Model::linear(Enclosure::from(1.0), ORDER, WIDTH);
    let square = w.squared();
    let r = fraction;
    let mut sum = Model::constant(Enclosure::from(0.0), ORDER, WIDTH);
    for c in [r(781.0, 315.0), r(146.0, 105.0), r(13.0, 15.0), r(2.0, 3.0), r(1.0, 1.0)] {
        sum = &sum * &square;
        sum.terms[0] = sum.terms[0] + c;
    }
    // ŝ = q (1 − w² sum). F(α) = α − q + arctan(1/α) vanishes at α*_n.
    let constant = Model::constant(Enclosure::from(1.0), ORDER, WIDTH);
    let x = &w * &(&constant - &(&square * &sum)).reciprocal(); // 1/ŝ
    let minus_square = -&x.squared();
    let norm = x.norm();
    let mut angle = Model::constant(Enclosure::from(0.0), ORDER, WIDTH);
    for k in (0..ORDER).rev() {
        angle = &angle * &minus_square;
        angle.terms[0] = angle.terms[0] + r(1.0, (2 * k + 1) as f64);
    }
    angle.rest += norm.powi(2 * ORDER as i32) / (1.0 - norm);
    // F(ŝ) = arctan x − w sum. Its first eleven coefficients vanish by Lemma 40.
    let residual = (&(&x * &angle) - &(&w * &sum)).without(11);
    let range = residual.range(Enclosure::new(0.0, WIDTH));
    // F′ = α²/(1+α²) lies between 0.9528 and 1 for α ≥ 4.4934.
    Enclosure::new(range.low(), (range / Enclosure::new(0.9528, 1.0)).high())
}
