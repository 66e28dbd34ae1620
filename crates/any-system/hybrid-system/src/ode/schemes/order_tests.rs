//! Tests of the committed tables: order conditions in twice the digits, and the orders of convergence.

use super::scheme::{ALL_STAGES, Scheme};
use super::scheme_for::{NINE, SIX};
use crate::ode::chebyshev::CHEBYSHEV;

const PAIRS: [&Scheme; 2] = [&NINE, &SIX];

/// The largest relative error of a number that is rounded to the nearest double.
const UNIT: f64 = 0.5 * f64::EPSILON;

/// A sum in twice the digits of a double: its value, and the sum of the exact errors of its roundings.
#[derive(Clone, Copy, Default)]
struct Long(f64, f64);

impl Long {
    /// self + x, with Knuth's two-sum.
    fn plus(self, x: f64) -> Self {
        let sum = self.0 + x;
        let part = sum - self.0;
        Long(sum, self.1 + ((self.0 - (sum - part)) + (x - part)))
    }

    fn plus_long(self, other: Long) -> Self {
        self.plus(other.0).plus(other.1)
    }

    /// self · x; the error of the product by a fused multiply-add.
    fn times(self, x: f64) -> Self {
        let product = self.0 * x;
        Long(product, self.0.mul_add(x, -product) + self.1 * x)
    }

    fn value(self) -> f64 {
        self.0 + self.1
    }
}

/// cᵏ.
fn power(c: f64, k: i32) -> Long {
    (0..k).fold(Long(1.0, 0.0), |power, _| power.times(c))
}

/// Row i as single terms. A first factor multiplies the power zero of a node only, so that no moment contains it.
fn row(scheme: &Scheme, i: usize) -> impl Iterator<Item = (usize, f64)> {
    scheme.rows[i].iter().flatten().copied()
}

/// Σ wᵢ cᵢᵏ, and the effect on it of the roundings of each wᵢ and cᵢ: (k + 1)u Σ|wᵢ|cᵢᵏ.
fn moment(scheme: &Scheme, weights: impl Iterator<Item = (usize, f64)>, k: i32) -> (Long, f64) {
    let (mut sum, mut size) = (Long::default(), 0.0);
    for (i, weight) in weights {
        let term = power(scheme.times[i], k).times(weight);
        sum = sum.plus_long(term);
        size += term.value().abs();
    }
    (sum, f64::from(k + 1) * UNIT * size)
}

/// The first factor is the sum of all, and no other term of a row or of the weights has the first stage.
#[test]
fn first_factors_are_the_sums() {
    for scheme in PAIRS {
        assert_eq!((scheme.weights[0], scheme.errors[0], scheme.times[0]), (1.0, 0.0, 0.0));
        for i in 1..scheme.all_stages() {
            assert_eq!(scheme.rows[i][0][0], (0, scheme.times[i]));
            assert!(row(scheme, i).skip(1).all(|(j, a)| (j > 0 && j < i) || a == 0.0));
        }
        for (place, u) in scheme.nodes[0].iter().zip(CHEBYSHEV.nodes) {
            // The node u is rounded, and the place is.
            assert!((place - 0.5 * (1.0 + u)).abs() <= 2.0 * UNIT);
        }
    }
}

/// Σ bᵢ cᵢᵏ = 1/(k+1) for the weights of both orders, Σ wᵢ(s) cᵢᵏ = sᵏ⁺¹/(k+1) for the interpolant.
#[test]
fn quadrature_conditions_hold_to_the_rounding_of_the_numbers() {
    for scheme in PAIRS {
        for k in 1..scheme.order as i32 {
            let exact = Long(1.0, 0.0);
            let (sum, bound) = moment(scheme, scheme.weights.iter().copied().enumerate(), k);
            let off = sum.times(f64::from(k + 1)).plus(-exact.0).value();
            assert!(off.abs() <= f64::from(k + 1) * bound, "{k}: {off:e} {bound:e}");
            // The weights of the lower order are bᵢ − eᵢ.
            if k + 1 < scheme.order as i32 {
                let (errors, more) = moment(scheme, scheme.errors.iter().copied().enumerate(), k);
                let off = errors.value();
                assert!(off.abs() <= more + bound, "{k}: {off:e} {more:e}");
            }
        }
        for (j, u) in CHEBYSHEV.nodes.iter().enumerate() {
            let s = 0.5 * (1.0 + u);
            for k in 1..scheme.degree as i32 {
                let weights = scheme.nodes.iter().map(|row| row[j]).enumerate();
                let (sum, bound) = moment(scheme, weights, k);
                let exact = power(s, k + 1).times(-1.0);
                let off = sum.times(f64::from(k + 1)).plus_long(exact).value();
                // s is wrong by up to u, and sᵏ⁺¹ by (k + 1) times that.
                assert!(off.abs() <= f64::from(k + 1) * (bound + 2.0 * UNIT), "{j} {k}: {off:e}");
            }
        }
    }
}

/// Σ bᵢ aᵢⱼ cⱼᵏ = 1/((k+1)(k+2)): a tree with two inner nodes.
#[test]
fn conditions_with_a_row_hold_to_the_rounding_of_the_numbers() {
    for scheme in PAIRS {
        for k in 1..scheme.order as i32 - 1 {
            let (mut sum, mut bound) = (Long::default(), 0.0);
            for (i, &weight) in scheme.weights.iter().enumerate() {
                let (inner, effect) = moment(scheme, row(scheme, i), k);
                sum = sum.plus_long(inner.times(weight));
                bound += weight.abs() * (effect + UNIT * inner.value().abs());
            }
            let denominator = f64::from((k + 1) * (k + 2));
            let off = sum.times(denominator).plus(-1.0).value();
            assert!(off.abs() <= denominator * bound, "{k}: {off:e} {bound:e}");
        }
    }
}

/// (x, y, z)˙ = (xy, z, −y) from (1, 1, 0): y = cos t and x = exp(sin t).
fn field(state: [f64; 3]) -> [f64; 3] {
    [state[0] * state[1], state[2], -state[1]]
}

fn exact(time: f64) -> f64 {
    pxfm::f_exp(pxfm::f_sin(time))
}

/// The slope at the start, and the differences from it at all other stages of a step of this size.
fn slopes(scheme: &Scheme, state: [f64; 3], size: f64) -> [[f64; 3]; ALL_STAGES] {
    let first = field(state);
    let mut slopes = [first; ALL_STAGES];
    for i in 1..scheme.all_stages() {
        let slope = field(moved(state, size, row(scheme, i), &slopes));
        slopes[i] = std::array::from_fn(|axis| slope[axis] - first[axis]);
    }
    slopes
}

fn moved(
    state: [f64; 3],
    size: f64,
    terms: impl Iterator<Item = (usize, f64)>,
    slopes: &[[f64; 3]; ALL_STAGES],
) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (j, a) in terms {
        (0..3).for_each(|axis| sum[axis] += a * slopes[j][axis]);
    }
    std::array::from_fn(|axis| state[axis] + size * sum[axis])
}

/// The error of x at the time 8 after this many equal steps.
fn error(scheme: &Scheme, weights: &[f64], steps: u32) -> f64 {
    let size = 8.0 / f64::from(steps);
    let mut state = [1.0, 1.0, 0.0];
    for _ in 0..steps {
        let slopes = slopes(scheme, state, size);
        state = moved(state, size, weights.iter().copied().enumerate(), &slopes);
    }
    (state[0] - exact(8.0)).abs()
}

/// The largest error of x at the nodes of a first step of this size.
fn error_inside(scheme: &Scheme, size: f64) -> f64 {
    let start = [1.0, 1.0, 0.0];
    let slopes = slopes(scheme, start, size);
    let at = |(j, u): (usize, &f64)| {
        let weights = scheme.nodes.iter().map(|row| row[j]).enumerate();
        (moved(start, size, weights, &slopes)[0] - exact(0.5 * (1.0 + u) * size)).abs()
    };
    CHEBYSHEV.nodes.iter().enumerate().map(at).fold(0.0, f64::max)
}

/// The part of the ratio of errors that must be seen. Higher terms of the error change the ratio by some percent; one
/// order less would make it a quarter.
const SEEN: f64 = 0.9;

/// The step is halved twice. Inside a step the error of an interpolant of order p is of order hᵖ⁺¹.
#[test]
fn errors_fall_with_the_order_when_steps_are_halved() {
    for scheme in PAIRS {
        // Errors of order six need shorter steps before their first term is the largest.
        let steps = if scheme.order < 8 { 32 } else { 8 };
        let terms = scheme.weights.iter().zip(scheme.errors);
        let lower: Vec<f64> = terms.map(|(b, e)| b - e).collect();
        for (weights, order) in [(scheme.weights, scheme.order), (&lower, scheme.order - 1)] {
            let (long, short) = (error(scheme, weights, steps), error(scheme, weights, 4 * steps));
            assert!(long / short > SEEN * 4f64.powi(order as i32), "{order}: {long:e} {short:e}");
        }
        let size = 8.0 / f64::from(steps);
        let (long, short) = (error_inside(scheme, size), error_inside(scheme, 0.25 * size));
        let order = scheme.degree as i32;
        assert!(long / short > SEEN * 4f64.powi(order + 1), "inside {order}: {long:e} {short:e}");
    }
}

/// With short steps the roundings remain: of each slope, times its weight, and of each state.
#[test]
fn errors_of_short_steps_are_roundings() {
    for scheme in PAIRS {
        let weights: f64 = scheme.weights.iter().map(|b| b.abs()).sum();
        for steps in [256, 1024] {
            // |ẋ| < 3, and the flow magnifies an error by less than e².
            let bound = 3.0 * 8.0 * UNIT * (weights + f64::from(steps));
            let error = error(scheme, scheme.weights, steps);
            assert!(error < bound, "{steps}: {error:e} {bound:e}");
        }
    }
}

/// ẋ = max(0, t − θ) over a step from 0 to 1: x(1) = (1 − θ)²/2. All sums are over the slopes at the stages.
#[test]
fn errors_over_kinks_are_six_times_their_estimate_at_most() {
    const PLACES: u32 = 4999;
    for scheme in PAIRS {
        for place in 1..=PLACES {
            let kink = f64::from(place) / f64::from(PLACES + 1);
            // The slope at the start is zero, and the differences from it are the slopes.
            let sum = |weights: &[f64]| -> f64 {
                let slopes = scheme.times.iter().map(|c| (c - kink).max(0.0));
                weights.iter().zip(slopes).skip(1).map(|(w, slope)| w * slope).sum()
            };
            let error = 0.5 * (1.0 - kink).powi(2) - sum(scheme.weights);
            let usual = scheme.kink_ratio * sum(scheme.errors).abs();
            let estimate = usual.max(sum(scheme.kinks).abs());
            assert!(error.abs() < 6.0 * estimate, "{} {kink}: {error:e}", scheme.order);
        }
    }
}
