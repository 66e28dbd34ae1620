//! Tests of the committed tables: order conditions in twice the digits, and the orders of convergence.

use super::scheme::{ALL_STAGES, Scheme};
use super::{eight, nine};
use crate::ode::chebyshev::CHEBYSHEV;

const PAIRS: [&Scheme; 2] = [&nine::PAIR, &eight::PAIR];

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

/// Row i as single terms.
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

/// The factor of the first stage makes each sum right to its own last digit.
#[test]
fn sums_are_right_to_the_rounding_of_the_first_factor() {
    for scheme in PAIRS {
        let sum = |terms: &[f64]| terms.iter().fold(Long::default(), |sum, &x| sum.plus(x));
        let (weights, errors) = (scheme.weights, scheme.errors);
        assert!(sum(weights).plus(-1.0).value().abs() <= UNIT * weights[0].abs());
        assert!(sum(errors).value().abs() <= UNIT * errors[0].abs());
        for i in 1..ALL_STAGES {
            let sum = row(scheme, i).fold(Long::default(), |sum, (_, a)| sum.plus(a));
            let (time, first) = (scheme.times[i], scheme.rows[i][0][0].1);
            assert!(sum.plus(-time).value().abs() <= UNIT * (first.abs() + time), "{i}");
        }
        for (j, u) in CHEBYSHEV.nodes.iter().enumerate() {
            let column = || scheme.nodes.iter().map(|row| row[j]);
            let sum = column().fold(Long::default(), |sum, w| sum.plus(w)).plus(-0.5);
            // The node u is rounded, too.
            let bound = UNIT * (scheme.nodes[0][j].abs() + 0.5 * u.abs());
            assert!(sum.plus(-0.5 * u).value().abs() <= bound, "{j}");
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
            for k in 1..8 {
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

/// The slopes of a step of this size.
fn slopes(scheme: &Scheme, state: [f64; 3], size: f64) -> [[f64; 3]; ALL_STAGES] {
    let mut slopes = [[0.0; 3]; ALL_STAGES];
    for i in 0..ALL_STAGES {
        slopes[i] = field(moved(state, size, row(scheme, i), &slopes));
    }
    slopes
}

fn moved(
    mut state: [f64; 3],
    size: f64,
    terms: impl Iterator<Item = (usize, f64)>,
    slopes: &[[f64; 3]; ALL_STAGES],
) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (j, a) in terms {
        (0..3).for_each(|axis| sum[axis] += a * slopes[j][axis]);
    }
    (0..3).for_each(|axis| state[axis] += size * sum[axis]);
    state
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

#[test]
fn errors_fall_with_the_order_of_the_pair_when_steps_are_halved() {
    for scheme in PAIRS {
        let lower: Vec<f64> = scheme.weights.iter().zip(scheme.errors).map(|(b, e)| b - e).collect();
        for (weights, order) in [(scheme.weights, scheme.order), (&lower, scheme.order - 1)] {
            for steps in [8, 16, 32, 64, 128, 256, 512,1024,2048] {
                println!("{order} {steps} {:e} {:e}", error(scheme, weights, steps), error(scheme,weights,steps)/error(scheme,weights,2*steps));
            }
        }
        for size in [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125] {
            let slopes = slopes(scheme, [1.0, 1.0, 0.0], size);
            let worst = CHEBYSHEV.nodes.iter().enumerate().map(|(j, u)| {
                let weights = scheme.nodes.iter().map(|row| row[j]).enumerate();
                let x = moved([1.0, 1.0, 0.0], size, weights, &slopes)[0];
                (x - exact(0.5 * (1.0 + u) * size)).abs()
            }).fold(0.0, f64::max);
            println!("inside {size} {worst:e}");
        }
    }
}
