//! A hop near a fixed point as Taylor models, on either side.
//!
//! With a = α*_n, σ = ±1 for the right and the left side, and t = σ |t| the time of the first flight minus 2a, all
//! functions of `passive_hopper::LocalFlight` are entire in t or quotients of such functions:
//!
//! ```text
//!   δ = t³ N/Q    N = a (t − sin t)/t³ + t (t²/2 − 1 + cos t)/t⁴     Q = 2a + t − sin(2a + t)
//!   Γ₁ = t² b²/(R²Q)    b = (R² + aη) sin η/η − cos η    η = t/2    R² = 1 + a²
//! ```
//!
//! On the left the hopper lifts off again at once, with excess X = |t| X̂ and velocity V. The second flight lasts τ = |t| w:
//!
//! ```text
//!   0  = X̂ (1 − cos τ)/τ² + V w (τ − sin τ)/τ³ − |t| w² (τ²/2 − 1 + cos τ)/τ⁴
//!   Γ₂ = −t² w [V w (1 − cos τ)/τ² − |t| w² (τ − sin τ)/τ³ + X̂ sin τ/τ]
//! ```
//!
//! The hop loses ℓ with ℓ (2α − ℓ) = μ (Γ₁² + Γ₂²). Proof: docs/theory.md, Lemma 34 and Theorem 36; for the second flight
//! Theorem 68.

use crate::coefficients::Coefficients;
use crate::fatou::taylor_model::{Model, ORDER};
use passive_hopper::MassRatio;

/// A side of a fixed point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// δ < 0. Orbits leave, slowly at first.
    Left,
    /// δ > 0. Orbits approach, more and more slowly.
    Right,
}

impl Side {
    /// −1 or 1.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Side::Left => -1.0,
            Side::Right => 1.0,
        }
    }
}

/// Relative radius of a coefficient that is computed by up to ten operations from `a`, which itself errs by half an ulp and
/// occurs up to fourth power; rounded up.
const COEFFICIENT: f64 = 4.0 * f64::EPSILON;

/// The hop from |t| = `width` · u, 0 ≤ u ≤ 1.
pub(crate) struct LocalHopModel {
    /// |δ|^{1/3}/|t|.
    pub(crate) root: Model,
    /// (x′/x)³ − 1 for x = |δ|^{1/3}, x′ = |δ′|^{1/3}; its constant term is 0.
    pub(crate) growth: Model,
}

/// Σ c_k u^k with c_k = `factor(k)` · `width`^k/(k + `shift`)! and the signs + + − − of cos t + sin t; `largest` bounds
/// the factors.
fn sine_like(width: f64, shift: u32, largest: f64, factor: impl Fn(usize) -> f64) -> Model {
    let size = |k: usize| {
        let mut size = 1.0;
        for j in 1..=k {
            size *= width / f64::from(j as u32 + shift);
        }
        (1..=shift).fold(size, |size, j| size / f64::from(j))
    };
    let coefficient = |k: usize| {
        let sign = if k % 4 < 2 { 1.0 } else { -1.0 };
        let value = sign * factor(k) * size(k);
        // Each factor of the size rounds twice.
        (value, (COEFFICIENT + 2.0 * (k + 3) as f64 * f64::EPSILON) * largest * size(k))
    };
    // The later terms fall at least as fast as (1/18)^k for a width up to 1.
    Model::series(coefficient, 1.1 * largest * size(ORDER))
}

impl LocalHopModel {
    /// The hop on one side of a fixed point. For the left side |δ| must not exceed 10⁻³ up to `width`.
    pub(crate) fn new(local: &Coefficients, mass_ratio: MassRatio, side: Side, width: f64) -> Self {
        let first = FirstFlight::new(local, side, width);
        let kappa = mass_ratio.kappa();
        let closing = match side {
            Side::Right => first.closing,
            Side::Left => return Self::with_second(&first, mass_ratio, kappa),
        };
        Self::from_losses(&first, &(&closing * &closing), mass_ratio)
    }

    fn with_second(first: &FirstFlight, mass_ratio: MassRatio, kappa: f64) -> Self {
        let second = SecondFlight::new(first, kappa);
        let squares = &(&first.closing * &first.closing) + &(&second.closing * &second.closing);
        Self::from_losses(first, &squares, mass_ratio)
    }

    /// From Σ Γ²/t⁴.
    fn from_losses(first: &FirstFlight, squares: &Model, mass_ratio: MassRatio) -> Self {
        let width = first.width;
        let taken = squares.scaled(mass_ratio.mu(), COEFFICIENT); // μ Σ Γ²/t⁴
        let fourth = |model: &Model| {
            (0..4).fold(*model, |product, _| product.shifted().scaled(width, 0.0))
        };
        // The loss over t⁴: twice as many right coefficients at each step, here four more of them.
        let mut loss = Model::ZERO;
        let double = first.speed.scaled(2.0, 0.0);
        let mut known = 0;
        while known < ORDER {
            let divisor = &double - &fourth(&loss);
            loss = &taken * &divisor.reciprocal();
            known += 4;
        }
        loss.radii = [0.0; ORDER];
        loss.rest = 0.0;
        let divisor = &double - &fourth(&loss);
        let residual = &(&loss * &divisor) - &taken;
        // The slope by the loss is 2α − 2ℓ, and the loss is small: α is a lower bound.
        let loss = loss.within(&residual, first.speed.least());
        let ratio = &(&loss * &first.q) * &first.numerator.reciprocal();
        let growth = ratio.shifted().scaled(-first.side.sign() * width, f64::EPSILON);
        LocalHopModel { root: first.root(), growth }
    }
}

/// The first flight.
struct FirstFlight {
    side: Side,
    a: f64,
    beta: f64,
    width: f64,
    numerator: Model,
    q: Model,
    /// α.
    speed: Model,
    /// Γ₁/t².
    closing: Model,
    /// (α − h)/|t|.
    beyond: Model,
}

impl FirstFlight {
    fn new(local: &Coefficients, side: Side, width: f64) -> Self {
        let (a, sign) = (local.alpha_star, side.sign());
        let r2 = 1.0 + a * a;
        let by_parity = |even: f64, odd: f64| {
            move |k: usize| if k % 2 == 0 { even } else { sign * odd }
        };
        let numerator = sine_like(width, 3, a, by_parity(a, 1.0));
        // From u² on Q has the terms of −sin(2a + t); its first two terms are 2a³/R² and 2a²t/R².
        let (even, odd) = (-2.0 * a / r2, (a * a - 1.0) / r2);
        let mut q = sine_like(width, 0, 1.0, by_parity(even, odd));
        let linear = 2.0 * (a * a / r2);
        (q.terms[0], q.terms[1]) = (a * linear, sign * width * linear);
        (q.radii[0], q.radii[1]) = (COEFFICIENT * a * linear, COEFFICIENT * width * linear);
        let half = 0.5 * width;
        let b_factor = |k: usize| {
            if k % 2 == 0 { r2 / (k + 1) as f64 - 1.0 } else { sign * a }
        };
        let b = sine_like(half, 0, r2, b_factor);
        let turn = sine_like(half, 0, a, by_parity(a, 1.0)); // a cos η + sin η
        let over = q.scaled(r2, COEFFICIENT).reciprocal(); // 1/(R²Q)
        let closing = &(&b * &b) * &over;
        let beyond = (&(&turn * &b) * &over).scaled(-sign, 0.0);
        let cube = &numerator * &q.reciprocal(); // |δ|/|t|³
        let offset = (0..3).fold(cube, |m, _| m.shifted().scaled(width, f64::EPSILON));
        let speed = &Model::constant(a, f64::EPSILON * a) + &offset.scaled(sign, 0.0);
        FirstFlight { side, a, beta: local.beta, width, numerator, q, speed, closing, beyond }
    }

    /// (N/Q)^{1/3}.
    fn root(&self) -> Model {
        let square = self.a * self.a;
        let cube = 12.0 * (square / (1.0 + square)); // β³
        let mut ratio = (&self.numerator * &self.q.reciprocal()).scaled(cube, COEFFICIENT);
        // The constant term is 1, because β³ = 12a²/R².
        (ratio.terms[0], ratio.radii[0]) = (0.0, 0.0);
        let size = ratio.size();
        let root = Model::binomial(&ratio.powers(), 1.0 / 3.0, size);
        root.scaled(1.0 / self.beta, COEFFICIENT)
    }
}

/// The second flight, on the left.
struct SecondFlight {
    /// Γ₂/t².
    closing: Model,
}

/// The functions of the second flight for one w.
struct Functions {
    /// w², and the powers 1, y, y², … of y = τ².
    square: Model,
    powers: Vec<Model>,
}

impl Functions {
    /// Even powers of τ beyond the polynomial: y^k = O(u^{2k}).
    const POWERS: usize = ORDER / 2 + 1;

    fn new(w: &Model, width: f64) -> Self {
        let square = w * w;
        let y = square.shifted().shifted().scaled(width * width, f64::EPSILON);
        let mut powers = vec![Model::constant(1.0, 0.0)];
        for k in 1..=Self::POWERS {
            powers.push(&powers[k - 1] * &y);
        }
        Functions { square, powers }
    }

    /// Σ (−1)^j factor(j) y^j/(2j + shift)!. The terms left out are less than the last one that is kept, which has only a
    /// rest: it is counted twice.
    fn sum(&self, shift: usize, factor: impl Fn(usize) -> f64) -> Model {
        let mut sum = Model::ZERO;
        let mut factorial = (1..=shift).map(|k| k as f64).product::<f64>();
        for (j, power) in self.powers.iter().enumerate() {
            let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
            let coefficient = sign * factor(j) / factorial;
            sum = &sum + &power.scaled(coefficient, COEFFICIENT);
            if j + 1 == self.powers.len() {
                sum.rest += coefficient.abs() * power.size();
            }
            factorial *= ((2 * j + shift + 1) * (2 * j + shift + 2)) as f64;
        }
        sum
    }
}

impl SecondFlight {
    fn new(first: &FirstFlight, kappa: f64) -> Self {
        let (a, width) = (first.a, first.width);
        let by_size = |model: &Model| model.shifted().scaled(width, 0.0); // |t| · model
        let mut half_time = Model::constant(a, f64::EPSILON * a); // h = a + t/2
        half_time.terms[1] = 0.5 * first.side.sign() * width;
        let excess = (&half_time * &first.beyond).scaled(2.0, 0.0); // X̂
        let rebound = by_size(&by_size(&first.closing)).scaled(kappa, COEFFICIENT);
        let velocity = &(&by_size(&first.beyond) - &half_time) + &rebound;
        // w to three orders (docs/theory.md, Theorem 36), and Newton's method for the middles.
        let mut w = Model::constant(3.0, 0.0);
        w.terms[1] = -0.75 / a * width;
        w.terms[2] = -(1.4 - 1.5 * kappa + 0.125 / (a * a)) * width * width;
        let mut known = 3;
        while known < ORDER {
            let f = Functions::new(&w, width);
            let (value, with_s3) = Self::equation(&f, &w, &excess, &velocity, width);
            let one = |shift| f.sum(shift, |j| 2.0 * j as f64);
            let third = by_size(&(&f.square * &one(4)));
            let inner = &(&(&excess * &one(2)) + &(&(&velocity * &w) * &one(3))) - &third;
            let direct = &with_s3 - &by_size(&(&w * &f.sum(4, |_| 2.0)));
            let slope = &(&inner * &w.reciprocal()) + &direct;
            let step = &value * &slope.scaled(-1.0, 0.0).reciprocal();
            w.terms = (&w + &step).terms;
            known *= 2;
        }
        let f = Functions::new(&w, width);
        let (residual, _) = Self::equation(&f, &w, &excess, &velocity, width);
        // |∂E/∂w| ≥ |V| (1/6 − τ²/40) − τ³/360, for 0 < τ up to `time` (docs/theory.md, Lemma 82).
        let time = 1.001 * width * w.size();
        let fastest = velocity.scaled(-1.0, 0.0).least();
        let slope = fastest * (1.0 / 6.0 - time * time / 40.0) - time * time * time / 360.0;
        let w = w.within(&residual, slope);
        let f = Functions::new(&w, width);
        let bracket = &(&(&velocity * &w) * &f.sum(2, |_| 1.0))
            - &by_size(&(&f.square * &f.sum(3, |_| 1.0)));
        let bracket = &bracket + &(&excess * &f.sum(1, |_| 1.0));
        SecondFlight { closing: (&w * &bracket).scaled(-1.0, 0.0) }
    }

    /// E(w) = X̂ C₂ + V w S₃ − |t| w² C₄, and V S₃.
    fn equation(
        f: &Functions,
        w: &Model,
        excess: &Model,
        velocity: &Model,
        width: f64,
    ) -> (Model, Model) {
        let with_s3 = velocity * &f.sum(3, |_| 1.0);
        let third = (&f.square * &f.sum(4, |_| 1.0)).shifted().scaled(width, 0.0);
        let value = &(&(excess * &f.sum(2, |_| 1.0)) + &(w * &with_s3)) - &third;
        (value, with_s3)
    }
}
