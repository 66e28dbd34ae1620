//! The remainder on the right side, the law of the approach, and the length of the trap.

use crate::first_flight::First;
use crate::interval::{cube_root, fraction, split};
use crate::model::Model;
use interval_arithmetic::Enclosure;

/// Terms of the models.
const ORDER: usize = 28;
/// The models hold for 0 ≤ t ≤ 1.25. At δ = 0.1 t is below 1.18.
const WIDTH: f64 = 1.25;
/// Parts of 0 ≤ t ≤ 1.25.
const PARTS: u32 = 40;
/// At least ∛0.1 = 0.46415888…
pub(crate) const LARGEST_ROOT: f64 = 0.464_159;

/// G = (δ − δ′)/(λδ^{4/3}) is at least this for 0 ≤ δ ≤ 0.1 (docs/theory.md, Theorem 67).
pub(crate) const SMALLEST_LOSS: f64 = 0.879;

/// ℓ₅, ℓ₆, ℓ₇, ℓ₈ of docs/theory.md, Theorem 35.
pub(crate) fn coefficients(p: Enclosure, beta: Enclosure, mu: Enclosure) -> [Enclosure; 4] {
    let i = Enclosure::from;
    let (square, cube) = (p.squared(), beta.squared() * beta);
    [
        beta * p,
        -(beta.squared() * (i(4.0) - square * 25.0) / i(40.0)),
        -(p * (i(24.0) - square * 43.0) / ((i(1.0) + square) * 12.0)),
        beta * (cube * (mu * 25_200.0 + i(144.0)) - (cube * 29_400.0 + i(403_200.0)) * square
            + cube * 83_825.0 * square.squared())
            / i(403_200.0),
    ]
}

/// 1 + Σ ℓ_k v^k with the given coefficients.
fn sum(first: &First, coefficients: &[Enclosure]) -> Model {
    let mut sum = first.constant(0.0);
    let v = first.omega.shifted();
    for &l in coefficients.iter().rev() {
        sum.terms[0] = sum.terms[0] + l;
        sum = &sum * &v;
    }
    sum.terms[0] = sum.terms[0] + Enclosure::from(1.0);
    sum
}

/// The ranges over one box of p and μ, for 0 ≤ δ ≤ 0.1.
pub(crate) struct Right {
    /// G = (δ − δ′)/(λδ^{4/3}).
    pub(crate) loss: Enclosure,
    /// (G − 1 − ℓ₅v − … − ℓ₈v⁴)/v⁵.
    pub(crate) remainder: Enclosure,
    /// With ε = vG(v) ≤ ⅓: (G⁻³ − [1 − 3ℓ₅ε + (9ℓ₅² − 3ℓ₆)ε²])/ε³.
    pub(crate) trap_remainder: Enclosure,
}

impl Right {
    pub(crate) fn new(p: Enclosure, mu: Enclosure) -> Self {
        let first = First::new(p, 1.0, ORDER, WIDTH);
        let loss = first.relative_loss(&first.closing.squared(), mu);
        let l = coefficients(p, first.beta, mu);
        // The first five coefficients vanish by Theorem 35, the first three of the trap by Lemma 40.
        let remainder = (&loss - &sum(&first, &l)).without(5);
        let epsilon = &first.omega.shifted() * &loss;
        let second = l[0].squared() * 9.0 - l[1] * 3.0;
        let series = &(&first.constant(1.0) - &epsilon.scaled(l[0] * 3.0))
            + &epsilon.squared().scaled(second);
        let inverse = loss.reciprocal();
        let trap = (&(&inverse.squared() * &inverse) - &series).without(3);
        let mut ranges = Right {
            loss: Enclosure::from(1.0),
            remainder: Enclosure::from(0.0),
            trap_remainder: Enclosure::from(0.0),
        };
        for t in split(0.0, WIDTH, PARTS) {
            let omega = first.omega.range(t);
            if (omega * t).low() > LARGEST_ROOT {
                return ranges;
            }
            let loss = loss.range(t);
            let fifth = omega.squared().squared() * omega;
            ranges.loss = ranges.loss.hull(&loss);
            ranges.remainder = ranges.remainder.hull(&(remainder.range(t) / fifth));
            let ratio = omega * loss; // ε/t
            if (ratio * t).low() <= 1.0 / 3.0 {
                let cube = ratio.squared() * ratio;
                ranges.trap_remainder = ranges.trap_remainder.hull(&(trap.range(t) / cube));
            }
        }
        panic!("δ = 0.1 lies beyond the width of the models");
    }
}

/// The range of (K(u′) − K(u) − 1)/(v + s)³ with s = λv, over 0 ≤ v ≤ ∛0.1, 0 ≤ s ≤ 0.1 with s = z (v + s), from a
/// bound on the remainder of [`Right`].
pub(crate) fn hop_remainder(
    p: Enclosure,
    mu: Enclosure,
    z: Enclosure,
    remainder: f64,
) -> Enclosure {
    /// The remainder of G is of order 5.
    const ORDER: usize = 5;
    /// Largest λδ^{1/3} of the law.
    const LARGEST_STEP: f64 = 0.1;
    let one = Enclosure::from(1.0);
    let x = one - z;
    // w = v + s, v = xw, s = zw
    let width =
        (LARGEST_ROOT / x.low().max(1e-9)).min(LARGEST_STEP / z.low().max(1e-9)).min(0.5642);
    let constant = |value: f64| Model::constant(Enclosure::from(value), ORDER, width);
    let beta = cube_root(Enclosure::from(12.0) / (one + p.squared()));
    let l = coefficients(p, beta, mu);
    let mut loss = constant(1.0);
    let mut power = one;
    for (k, &l) in l.iter().enumerate() {
        power = power * x;
        loss.terms[k + 1] = l * power;
    }
    loss.rest = remainder * (x.high() * width).powi(5) * (1.0 + 1e-12);
    // With y = sG: (1 − y)^{±1/3} = 1 + y E±, and −ln(1 − y) = y Λ.
    let y = (&Model::linear(z, ORDER, width)) * &loss;
    let (down, up, logarithm) =
        (quotient(&y, 1.0 / 3.0), quotient(&y, -1.0 / 3.0), log_quotient(&y));
    let l5 = l[0] * x;
    let m = l5 + z * fraction(2.0, 3.0); // (ℓ₅v + ⅔s)/w
    let inverse =
        l[1] * x.squared() + z * l5 * fraction(4.0, 3.0) + z.squared() * fraction(14.0, 27.0)
            - m.squared()
            + z * m * fraction(1.0, 6.0); // e v²/w²
    // K(u′) − K(u) = (3/s)[y E₋] − (3ℓ₅v/s + 2) yΛ/3 + (3 e v²/s) y E₊, and y/s = G.
    let growth = (&up * &loss).scaled(Enclosure::from(3.0));
    let linear = Model::linear(m, ORDER, width);
    let square = &Model::linear(one, ORDER, width) * &Model::linear(inverse, ORDER, width);
    let change = &(&growth - &(&linear * &(&logarithm * &loss)))
        + &(&square * &(&down * &loss)).scaled(Enclosure::from(3.0));
    let rest = (&change - &constant(1.0)).without(3);
    rest.range(Enclosure::new(0.0, width))
}

/// The slope of rK, 1 − Lv − ev², for v and s = λv in the given intervals.
pub(crate) fn slope(p: Enclosure, v: Enclosure, s: Enclosure) -> Enclosure {
    let one = Enclosure::from(1.0);
    let beta = cube_root(Enclosure::from(12.0) / (one + p.squared()));
    let [l5, l6, ..] = coefficients(p, beta, Enclosure::from(0.0));
    let m = l5 * v + s * fraction(2.0, 3.0);
    let inverse =
        l6 * v.squared() + s * l5 * v * fraction(4.0, 3.0) + s.squared() * fraction(14.0, 27.0)
            - m.squared()
            + s * m * fraction(1.0, 6.0);
    one - m - inverse
}

/// ((1 − y)^s − 1)/y for y = O(w).
fn quotient(y: &Model, s: f64) -> Model {
    let mut factor = Enclosure::from(1.0);
    series(y, |k| {
        // −s (1 − s)(2 − s) …/k!
        let j = k as f64;
        factor = if k == 1 {
            Enclosure::from(-1.0) * exact_third(s)
        } else {
            factor * (Enclosure::from(j - 1.0) - exact_third(s)) / Enclosure::from(j)
        };
        factor
    })
}

/// s = ±⅓ as an interval.
fn exact_third(s: f64) -> Enclosure {
    fraction(s.signum(), 3.0)
}

/// −ln(1 − y)/y.
fn log_quotient(y: &Model) -> Model {
    series(y, |k| fraction(1.0, k as f64))
}

/// Σ_{k≥1} c_k y^{k−1} with |c_k| ≤ 1.
fn series(y: &Model, mut term: impl FnMut(usize) -> Enclosure) -> Model {
    let order = y.terms.len();
    let terms: Vec<_> = (1..=order).map(&mut term).collect();
    let norm = y.norm();
    assert!(norm < 1.0);
    let mut sum = Model::constant(Enclosure::from(0.0), order, y.width);
    for &c in terms.iter().rev() {
        sum = &sum * y;
        sum.terms[0] = sum.terms[0] + c;
    }
    sum.rest += norm.powi(order as i32) / (1.0 - norm) * (1.0 + 1e-12);
    sum
}
