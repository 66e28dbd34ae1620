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
//! On the left the hopper lifts off again at once, and has a second landing (`second_flight.rs`). It loses ℓ with
//! ℓ (2α − ℓ) = μ (Γ₁² + Γ₂²). Proof: docs/theory.md, Lemma 34 and Theorem 36.

use crate::coefficients::Coefficients;
use crate::fatou::polynomial::ORDER;
use crate::fatou::second_flight::SecondFlight;
use crate::fatou::taylor_model::Model;
use crate::local_map::LEFT_FACTOR;
use passive_hopper::MassRatio;
use std::sync::OnceLock;

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

/// Relative radius of a coefficient that is computed by up to ten operations from `a`, which itself errs by half an
/// ulp and occurs up to fourth power; rounded up.
const COEFFICIENT: f64 = 4.0 * f64::EPSILON;

/// The hop from |t| = `width` · u, 0 ≤ u ≤ 1.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LocalHopModel {
    pub(crate) width: f64,
    /// |δ|^{1/3}/|t|.
    pub(crate) root: Model,
    /// g = (x′/x)³ − 1 for x = |δ|^{1/3}, x′ = |δ′|^{1/3}.
    pub(crate) growth: Model,
    /// g/u.
    pub(crate) rate: Model,
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
    /// The hop on one side of a fixed point. For the left side |δ| must not exceed 0.0109 up to `width`
    /// (docs/theory.md, Theorem 81).
    pub(crate) fn new(local: &Coefficients, mass_ratio: MassRatio, side: Side, width: f64) -> Self {
        let stored = usize::try_from(local.n).ok().and_then(|n| FIRST_FLIGHTS.get(n));
        match (side, stored) {
            (Side::Left, Some(first)) if width <= LARGEST_LEFT_WIDTH => {
                let make = || Box::new(FirstFlight::new(local, side, LARGEST_LEFT_WIDTH));
                Self::after(&first.get_or_init(make).narrowed(width), mass_ratio, local)
            }
            _ => Self::after(&FirstFlight::new(local, side, width), mass_ratio, local),
        }
    }

    fn after(first: &FirstFlight, mass_ratio: MassRatio, local: &Coefficients) -> Self {
        let mut squares = first.closing_squared;
        if first.side == Side::Left {
            let second = first.next(mass_ratio.kappa());
            squares = &squares + &(&second.closing * &second.closing);
        }
        Self::from_losses(first, &squares, mass_ratio, local)
    }

    /// From Σ Γ²/t⁴.
    fn from_losses(
        first: &FirstFlight,
        squares: &Model,
        mass_ratio: MassRatio,
        local: &Coefficients,
    ) -> Self {
        let width = first.width;
        // T = μ Σ Γ²/t⁴ and ℓ = α (1 − √(1 − z)) with z = t⁴ T/α², so that ℓ/t⁴ = (T/α) (½ + z/8 + z²/16 + …).
        let taken = squares.scaled(mass_ratio.mu(), COEFFICIENT);
        let over = &taken * &first.inverse_speed;
        let z = &over * &first.inverse_speed;
        let z = (0..4).fold(z, |product, _| product.shifted().scaled(width, 0.0));
        // z is O(u⁴), and each power of it has four more terms that vanish.
        let (mut sum, mut power, mut coefficient) = (Model::constant(0.5, 0.0), z, 0.5);
        for k in 1..=LOSS_TERMS {
            coefficient *= (2 * k - 1) as f64 / (2 * k + 2) as f64;
            sum = &sum + &power.scaled(coefficient, COEFFICIENT);
            if k < LOSS_TERMS {
                power = &power * &z;
            }
        }
        // The coefficients fall: the later terms are below the last one, O(u^ORDER), times |z|/(1 − |z|).
        let size = z.size();
        let later = if size < 1.0 { size / (1.0 - size) } else { f64::INFINITY };
        sum.rest += power.rest * later;
        let ratio = &(&over * &sum) * &first.inverse_cube;
        let rate = ratio.scaled(-first.side.sign() * width, f64::EPSILON);
        // x is |t|/β, and g is −λx on the right and 10λx on the left, to leading order.
        let leading = match first.side {
            Side::Left => LEFT_FACTOR * local.lambda,
            Side::Right => -local.lambda,
        } * width
            / local.beta;
        let rate = rate.with_constant(leading, GROWTH_ULPS * f64::EPSILON * leading.abs());
        LocalHopModel { width, root: first.root, growth: rate.shifted(), rate }
    }

    /// The same hop from the points up to |t| = `width`, at most that of self.
    pub(crate) fn narrowed(&self, width: f64) -> Self {
        let part = width / self.width;
        // g/u = part · (g/(part u)).
        let rate = self.rate.narrowed(part).scaled(part, f64::EPSILON);
        LocalHopModel { width, root: self.root.narrowed(part), growth: rate.shifted(), rate }
    }
}

/// The largest |t| on the left. At 0.3 |δ| is below 2.5·10⁻³: one sudden lift-off follows up to 0.0109
/// (docs/theory.md, Theorem 81). The polynomials of a hop err by some 10⁻⁶ there. A larger value would need more
/// terms.
pub(crate) const LARGEST_LEFT_WIDTH: f64 = 0.3;

/// The first flights on the left of α*_n, n < 64, up to this |t|: they do not depend on the mass ratio. At larger n
/// each hop computes its own.
static FIRST_FLIGHTS: [OnceLock<Box<FirstFlight>>; 64] = [const { OnceLock::new() }; 64];

/// Bound on the relative error of λ/β with three more operations, in units of ε (docs/theory.md, Lemma 72).
const GROWTH_ULPS: f64 = 10.0;

/// Terms of the series of a loss: z^k is O(u^{4k}).
const LOSS_TERMS: usize = ORDER / 4;

/// The first flight. It does not depend on the mass ratio.
struct FirstFlight {
    side: Side,
    a: f64,
    width: f64,
    /// |δ|^{1/3}/|t| = (N/Q)^{1/3}.
    root: Model,
    /// Q/N.
    inverse_cube: Model,
    /// 1/α.
    inverse_speed: Model,
    /// Γ₁/t², and its square.
    closing: Model,
    closing_squared: Model,
    /// X̂ = x/|t| after the flight.
    excess: Model,
    /// The velocity after it without the part κΓ₁.
    velocity: Model,
}

impl FirstFlight {
    fn new(local: &Coefficients, side: Side, width: f64) -> Self {
        let (a, sign) = (local.alpha_star, side.sign());
        let r2 = 1.0 + a * a;
        let by_parity = |even: f64, odd: f64| {
            move |k: usize| if k.is_multiple_of(2) { even } else { sign * odd }
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
            if k.is_multiple_of(2) { r2 / (k + 1) as f64 - 1.0 } else { sign * a }
        };
        let b = sine_like(half, 0, r2, b_factor);
        let turn = sine_like(half, 0, a, by_parity(a, 1.0)); // a cos η + sin η
        let over = q.scaled(r2, COEFFICIENT).reciprocal(); // 1/(R²Q)
        // b = a², Q = 2a³/R² and a cos η + sin η = a at t = 0.
        let error = 0.5 * f64::EPSILON * a;
        let closing = (&(&b * &b) * &over).with_constant(0.5 * a, error);
        let beyond = (&(&turn * &b) * &over).scaled(-sign, 0.0).with_constant(-sign * 0.5, 0.0);
        let cube = &numerator * &over.scaled(r2, COEFFICIENT); // N/Q = |δ|/|t|³
        let offset = (0..3).fold(cube, |m, _| m.shifted().scaled(width, f64::EPSILON));
        let speed = &Model::constant(a, f64::EPSILON * a) + &offset.scaled(sign, 0.0);
        let mut half_time = Model::constant(a, error); // h = a + t/2
        half_time.terms[1] = 0.5 * sign * width;
        // X̂ = 2h (α − h)/|t|, which is a at t = 0.
        let excess = (&half_time * &beyond).scaled(2.0, 0.0).with_constant(a, error);
        FirstFlight {
            side,
            a,
            width,
            root: cube_root(&cube, local),
            inverse_cube: &q * &numerator.reciprocal(),
            inverse_speed: speed.reciprocal(),
            closing,
            closing_squared: &closing * &closing,
            excess,
            velocity: &by_time(&beyond, width) - &half_time,
        }
    }

    /// The same flight from the points up to |t| = `width`, at most that of self.
    fn narrowed(&self, width: f64) -> Self {
        let narrowed = |model: &Model| model.narrowed(width / self.width);
        FirstFlight {
            width,
            side: self.side,
            a: self.a,
            root: narrowed(&self.root),
            inverse_cube: narrowed(&self.inverse_cube),
            inverse_speed: narrowed(&self.inverse_speed),
            closing: narrowed(&self.closing),
            closing_squared: narrowed(&self.closing_squared),
            excess: narrowed(&self.excess),
            velocity: narrowed(&self.velocity),
        }
    }

    /// The second flight, on the left.
    fn next(&self, kappa: f64) -> SecondFlight {
        let width = self.width;
        let rebound = by_time(&by_time(&self.closing, width), width).scaled(kappa, COEFFICIENT);
        SecondFlight::new(self.a, self.excess, &self.velocity + &rebound, width)
    }
}

/// |t| · model.
fn by_time(model: &Model, width: f64) -> Model {
    model.shifted().scaled(width, 0.0)
}

/// (N/Q)^{1/3} from N/Q.
fn cube_root(of: &Model, local: &Coefficients) -> Model {
    let square = local.alpha_star * local.alpha_star;
    let cube = 12.0 * (square / (1.0 + square)); // β³
    let mut ratio = of.scaled(cube, COEFFICIENT);
    // The constant term is exactly 1, because β³ = 12a²/R².
    (ratio.terms[0], ratio.radii[0]) = (0.0, 0.0);
    let size = ratio.size();
    let root = Model::binomial(&ratio.powers(), 1.0 / 3.0, size);
    root.scaled(1.0 / local.beta, COEFFICIENT)
}
