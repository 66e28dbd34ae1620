//! The remainder on the left side, with the second flight.

use crate::first_flight::{First, factorial_term, sign};
use crate::interval::{fraction, split};
use crate::model::Model;
use interval_arithmetic::Enclosure;

/// Terms of the models.
const ORDER: usize = 12;
/// The models hold for −0.25 ≤ t ≤ 0. At δ = −10⁻³, t is above −0.23.
const WIDTH: f64 = 0.25;
/// Parts of 0 ≤ |t| ≤ 0.25.
const PARTS: u32 = 20;
/// ∛10⁻³.
const LARGEST_ROOT: f64 = 0.1;

/// The functions sin h/h, D/h³ and u/h³ of a model h = O(|t|).
pub(crate) struct Half {
    pub(crate) sin: Model,
    pub(crate) d: Model,
    pub(crate) u: Model,
}

impl Half {
    pub(crate) fn new(h: &Model) -> Self {
        let square = h.squared();
        let i = Enclosure::from;
        // sin h/h = Σ (−1)^k h^{2k}/(2k+1)!,  D/h³ = Σ (−1)^k 4^{k+1} h^{2k}/(2k+3)!,
        // u/h³ = −Σ (−1)^k (2k+2) h^{2k}/(2k+3)!
        Half {
            sin: even(&square, |k| factorial_term(2 * k + 1) * sign(k)),
            d: even(&square, |k| factorial_term(2 * k + 3) * (sign(k) * 4f64.powi(k as i32 + 1))),
            u: even(&square, |k| -(factorial_term(2 * k + 3) * i(sign(k) * (2 * k + 2) as f64))),
        }
    }
}

/// Σ c_k x^k for x = h² ≤ ½ and |c_{k+1}| ≤ |c_k|/2 ≤ ½.
fn even(x: &Model, term: impl Fn(usize) -> Enclosure) -> Model {
    let order = x.terms.len();
    let norm = x.norm();
    assert!(norm <= 0.5);
    let mut sum = Model::constant(Enclosure::from(0.0), order, x.width);
    for k in (0..order).rev() {
        sum = &sum * x;
        sum.terms[0] = sum.terms[0] + term(k);
    }
    // x = O(t²), and the terms from x^order on are below 2 · norm^order.
    sum.rest += 2.0 * norm.powi(order as i32);
    sum
}

/// The ranges over one box of p and κ, for −10⁻³ ≤ δ ≤ 0.
pub(crate) struct Left {
    /// ((δ − δ′)/(10λ|δ|^{4/3}) − 1 − c₁v − c₂v²)/v³.
    pub(crate) remainder: Enclosure,
    /// x₂/(a|t|): the stretch after the second flight.
    pub(crate) second_excess: Enclosure,
    /// V₁/a, the velocity at the start of the second flight.
    pub(crate) velocity: Enclosure,
}

impl Left {
    pub(crate) fn new(p: Enclosure, kappa: Enclosure, mu: Enclosure) -> Self {
        let first = First::new(p, -1.0, ORDER, WIDTH);
        let one = Enclosure::from(1.0);
        let size = Model::linear(one, ORDER, WIDTH); // |t|
        let half = &first.constant(1.0) - &size.scaled(p * 0.5); // 1 + pη
        let beyond = (&(&first.cosine * &first.b) * &first.q.reciprocal())
            .scaled(Enclosure::from(2.0) / (one + p.squared())); // (α − h)/|t|
        let excess = (&half * &beyond).scaled(Enclosure::from(2.0)); // x₁/(a|t|)
        let square = &size * &size;
        let velocity =
            &(&(&size * &beyond).scaled(p) - &half) + &(&square * &first.closing).scaled(kappa);
        let second = |ratio: &Model| {
            // h₂ = |t| · ratio
            let h = &size * ratio;
            let half = Half::new(&h);
            let left =
                &(&(&h.scaled(p) - &velocity) * &half.d) + &(&(&h * &half.sin) * &half.u).scaled(p);
            (&(&excess * &half.sin.squared()) * &left.reciprocal(), half)
        };
        // Each iteration makes one more coefficient right.
        let mut ratio = first.constant(1.5);
        for _ in 0..=ORDER {
            ratio.rest = 0.0;
            ratio = second(&ratio).0;
        }
        // The map takes a band about the polynomial into itself. So the band holds a fixed point, which is the landing.
        ratio.rest *= 2.0;
        let (image, half_time) = second(&ratio);
        assert!(image.rest < ratio.rest, "{} {}", image.rest, ratio.rest);
        let h = &size * &ratio;
        // Γ₂/(a t²) = 2 (u/D) ratio [p h ratio u − x sin] with the functions of `Half`
        let bracket = &(&(&h * &ratio) * &half_time.u).scaled(p) - &(&excess * &half_time.sin);
        let closing = (&(&(&half_time.u * &half_time.d.reciprocal()) * &ratio) * &bracket)
            .scaled(Enclosure::from(2.0));
        let squares = &first.closing.squared() + &closing.squared();
        let loss = first.relative_loss(&squares, mu).scaled(fraction(1.0, 10.0));
        let v = first.omega.shifted();
        let c1 = -(first.beta * p);
        let c2 = -(first.beta.squared()
            * (fraction(34.0, 25.0) + p.squared() * fraction(31.0, 80.0)
                - kappa * fraction(9.0, 10.0)));
        let series = &(&first.constant(1.0) + &v.scaled(c1)) + &v.squared().scaled(c2);
        // The first three coefficients vanish by Theorem 36.
        let remainder = (&loss - &series).without(3);
        let after = &excess + &(&ratio * &(&velocity - &h.scaled(p))).scaled(Enclosure::from(2.0));
        let mut ranges = Left {
            remainder: Enclosure::from(0.0),
            second_excess: after.range(Enclosure::from(0.0)),
            velocity: velocity.range(Enclosure::from(0.0)),
        };
        for t in split(0.0, WIDTH, PARTS) {
            let omega = first.omega.range(t);
            if (omega * t).low() > LARGEST_ROOT {
                return ranges;
            }
            let cube = omega.squared() * omega;
            ranges.remainder = ranges.remainder.hull(&(remainder.range(t) / cube));
            ranges.second_excess = ranges.second_excess.hull(&after.range(t));
            ranges.velocity = ranges.velocity.hull(&velocity.range(t));
        }
        panic!("δ = −10⁻³ lies beyond the width of the models");
    }
}
