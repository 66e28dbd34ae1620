//! The second flight of a hop from the left of a fixed point, as a Taylor model.
//!
//! After the sudden lift-off with the excess X = |t| X̂ and the velocity V it lasts τ = |t| w:
//!
//! ```text
//!   0  = E(w) = X̂ C₂ + V w S₃ − |t| w² C₄       C_k, S_k = Σ_j (−1)^j τ^{2j}/(2j + k)!
//!   Γ₂ = −t² w [V w C₂ − |t| w² S₃ + X̂ S₁]
//! ```
//!
//! Proof: docs/theory.md, Theorem 36; Theorem 81 that this is the landing, and the last one; Lemma 91.

use crate::fatou::polynomial::{EVEN_POWERS, ORDER, Polynomial, Truncated};
use crate::fatou::taylor_model::Model;

/// The second flight.
pub(crate) struct SecondFlight {
    /// Γ₂/t².
    pub(crate) closing: Model,
}

/// The bounds on w are tried with this factor. Those that follow are larger than the first ones by the relative
/// size of the errors, below 10⁻⁶, and by the difference of the two slopes of the equation.
const TRIAL: f64 = 1.1;

/// The start of the second flight, in units of |t| ≤ `width`.
struct FlightStart<T> {
    /// X̂.
    excess: T,
    /// V.
    velocity: T,
    width: f64,
}

/// w and its functions.
struct Flight<T> {
    w: T,
    /// |t| w².
    third: T,
    /// 1, y, y², … with y = τ². The last one is O(u^ORDER).
    powers: [T; EVEN_POWERS],
}

impl<T: Truncated> Flight<T> {
    fn new(w: T, width: f64) -> Self {
        let third = w.times(&w).shifted_by(width);
        let y = third.shifted_by(width);
        let mut powers = [T::number(1.0); EVEN_POWERS];
        for k in 1..powers.len() {
            powers[k] = powers[k - 1].times(&y);
        }
        Flight { w, third, powers }
    }

    /// Σ_{j ≥ from} (−1)^j factor(j) y^{j − from}/(2j + `shift`)!. The terms alternate and fall, because y < 1:
    /// those after the last power are together less than the last term.
    fn sum(&self, shift: usize, from: usize, factor: impl Fn(usize) -> f64) -> T {
        let mut factorial = (1..=2 * from + shift).map(|k| k as f64).product::<f64>();
        let coefficients = std::array::from_fn(|i| {
            let j = i + from;
            let sign = if j.is_multiple_of(2) { 1.0 } else { -1.0 };
            let coefficient = sign * factor(j) / factorial;
            factorial *= ((2 * j + shift + 1) * (2 * j + shift + 2)) as f64;
            coefficient
        });
        T::combination(&self.powers, coefficients)
    }

    /// C_k or S_k.
    fn entire(&self, shift: usize) -> T {
        self.sum(shift, 0, |_| 1.0)
    }

    /// (dC_k/dw)/(t² w), of which every term has lost one power of y.
    fn slope(&self, shift: usize) -> T {
        self.sum(shift, 1, |j| 2.0 * j as f64)
    }
}

impl<T: Truncated> FlightStart<T> {
    /// E(w).
    fn equation(&self, f: &Flight<T>) -> T {
        let first = self.excess.times(&f.entire(2));
        let second = self.velocity.times(&f.w).times(&f.entire(3));
        first.plus(&second).minus(&f.third.times(&f.entire(4)))
    }

    /// ∂E/∂w = t² w (X̂ D₂ + V w D₃ − |t| w² D₄) + V S₃ − 2 |t| w C₄, with the slopes D_k.
    fn slope(&self, f: &Flight<T>) -> T {
        let inner = self.excess.times(&f.slope(2));
        let inner = inner.plus(&self.velocity.times(&f.w).times(&f.slope(3)));
        let inner = inner.minus(&f.third.times(&f.slope(4)));
        let by_time = f.w.shifted_by(self.width); // |t| w
        let indirect = by_time.shifted_by(self.width).times(&inner);
        let direct = self.velocity.times(&f.entire(3));
        let third = by_time.times(&f.entire(4));
        indirect.plus(&direct).minus(&third).minus(&third)
    }
}

/// w by Newton's method, and ∂E/∂w there. `a` is α*_n.
fn approximate(start: &FlightStart<Polynomial>, a: f64) -> (Polynomial, Polynomial) {
    // w to two orders (docs/theory.md, Theorem 36); a step doubles the number of right terms.
    let mut w = Polynomial::number(3.0);
    w.0[1] = -0.75 / a * start.width;
    let mut known = 2;
    loop {
        let f = Flight::new(w, start.width);
        let slope = start.slope(&f);
        if known >= ORDER {
            return (w, slope);
        }
        w = w.minus(&start.equation(&f).times(&slope.reciprocal()));
        known *= 2;
    }
}

impl SecondFlight {
    /// The flight with X̂ = `excess` and V = `velocity` < 0 after a landing of α*_n = `a`, for |t| = `width` · u.
    pub(crate) fn new(a: f64, excess: Model, velocity: Model, width: f64) -> Self {
        let (x, v) = (Polynomial(excess.terms), Polynomial(velocity.terms));
        let (w, slope) = approximate(&FlightStart { excess: x, velocity: v, width }, a);
        let start = FlightStart { excess, velocity, width };
        let middle = Model::exact(w);
        // w = 3 at t = 0, where X̂ = a and V = −a.
        let middle = middle.with_constant(3.0, 0.0);
        let residual = start.equation(&Flight::new(middle, width)).with_constant(0.0, 0.0);
        let trial = middle.with_errors(&residual, &Model::exact(slope)).widened(TRIAL);
        // With e = w − middle, e = −residual/S, where S is the mean slope between the two. For every e within the
        // trial bounds S is one of the functions `slope`, and the right side is again within them. So the iteration
        // from e = 0 stays there; it converges, because the residual is small, and its limit is within them too.
        let f = Flight::new(trial, width);
        if !middle.with_errors(&residual, &start.slope(&f)).lies_in(&trial) {
            return SecondFlight { closing: Model { rest: f64::INFINITY, ..Model::ZERO } };
        }
        let bracket = start.velocity.times(&f.w).times(&f.entire(2));
        let bracket = bracket.minus(&f.third.times(&f.entire(3)));
        let bracket = bracket.plus(&start.excess.times(&f.entire(1)));
        let closing = f.w.times(&bracket).negative();
        SecondFlight { closing: closing.with_constant(1.5 * a, f64::EPSILON * a) }
    }
}
