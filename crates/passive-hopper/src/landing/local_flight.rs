//! The first flight from near a fixed point, in the offset of its time.
//!
//! With a = α*_n, α = a + δ, τ = 2a + t, η = t/2, h = a + η, exactly
//!
//! ```text
//!   δ(t) = N/Q      N = a (t − sin t) + (t²/2 − 1 + cos t)       Q = 2a + t − sin(2a + t) = 2D
//!   Γ    = 4 b²/(R² Q)        b = (1 + a² + aη) sin η − η cos η          R² = 1 + a²
//!   S u/D = −2 (a cos η + sin η) b/(R² Q)          dδ/dt = 4 b²/(R² Q²)
//! ```
//!
//! The landing equation α (τ − sin τ) = τ²/2 + cos τ − 1, minus a (τ − sin τ) on both sides, is δ Q = N. Because tan a
//! = a, sin 2a = 2a/R² and cos 2a = (1 − a²)/R². Hence a sin τ + cos τ = cos t − a sin t, which gives N. In the same
//! way cos a = ±1/R and sin a = ±a/R give u = h cos h − sin h = ∓b/R. With this u the formulas of `half_time.rs` give
//! Γ, S u/D and dδ/dt.
//!
//! No term cancels another, however small t is. Hence every function keeps its relative accuracy.
//!
//! Proof: docs/theory.md, Lemma 34. Lemma 80 bounds the rounding errors.

use crate::landing::extended_landing::ExtendedLanding;
use crate::model::fixed_points::alpha_star;
use crate::precision::real::{Extended, Real};

/// The flights near the fixed point a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NearFixedPoint<R> {
    /// a = α*_n.
    pub(crate) a: R,
    /// R² = 1 + a².
    r2: R,
}

/// (excess, velocity, Γ) at a landing.
type LandingState<R> = (R, R, R);

impl<R: Real> NearFixedPoint<R> {
    pub(crate) fn new(fixed_point: R) -> Self {
        NearFixedPoint { a: fixed_point, r2: fixed_point.squared() + 1.0 }
    }

    /// δ(t), Q(t).
    fn offset(&self, t: R) -> (R, R) {
        let (sin, cos) = t.sin_cos();
        let (rest, bend) = t.sine_remainders(sin, cos);
        let a = self.a;
        let sine = (a * 2.0 * cos + (-a.squared() + 1.0) * sin) / self.r2;
        let q = a * 2.0 + t - sine;
        ((a * rest + bend) / q, q)
    }

    /// b(η), sin η, cos η.
    fn b(&self, eta: R) -> (R, R, R) {
        let (sin, cos) = eta.sin_cos();
        ((self.a * (self.a + eta) + 1.0) * sin - eta * cos, sin, cos)
    }

    /// dδ/dt from η and Q.
    fn offset_slope(&self, eta: R, q: R) -> R {
        let scaled = self.b(eta).0 / q;
        scaled * 4.0 * scaled / self.r2
    }

    /// The landing after 2a + 2η, from b(η), sin η, cos η and Q.
    fn landing_state(&self, eta: R, (b, sin, cos): (R, R, R), q: R, kappa: R) -> LandingState<R> {
        let scale = b / (q * self.r2);
        let beyond = (self.a * cos + sin) * -2.0 * scale; // S u/D
        let h = self.a + eta;
        let closing_speed = b * 4.0 * scale;
        (h * 2.0 * beyond, beyond - h + kappa * closing_speed, closing_speed)
    }
}

/// Guard on the number of Newton steps in `f64`, never reached: from the expansion's three digits or more, four steps
/// give 15, and a fifth one sees that. 12 is a margin. A number below 4 would lose digits.
const NEWTON_STEPS: usize = 12;

/// A Newton step below this part of t is rounding error, four and a half ulps. The next step would be about its square
/// (docs/theory.md, Lemma 80). A smaller value would let the search go on until the guard.
const LAST_STEP: f64 = 1e-15;

impl NearFixedPoint<f64> {
    /// t(δ), by Newton's method from its expansion in δ^{1/3} (`fixed_point_interval.rs` has more terms of this
    /// expansion).
    ///
    /// As t³ ∝ δ, the method converges quadratically in relative terms, however small δ is. The last step is applied
    /// before the search stops, unlike in extended arithmetic: here one more step is cheaper than one more test.
    pub(crate) fn time_shift(&self, delta: f64) -> f64 {
        let square = self.a * self.a;
        let w = pxfm::f_cbrt(delta) * pxfm::f_cbrt(12.0 * square / self.r2);
        let mut t = w * (1.0 + w * (0.25 / self.a + w * (4.0 + 25.0 / square) / 240.0));
        for _ in 0..NEWTON_STEPS {
            let (offset, q) = self.offset(t);
            let step = (offset - delta) / self.offset_slope(0.5 * t, q);
            if !step.is_finite() {
                break; // δ = 0, where the slope is 0
            }
            t -= step;
            if step.abs() <= LAST_STEP * t.abs() {
                break;
            }
        }
        t
    }

    /// (excess, velocity, Γ) at the first landing. Q comes from sin η and cos η by the double angle, which saves a sine
    /// and a cosine of t.
    pub(crate) fn landing(&self, t: f64, kappa: f64) -> LandingState<f64> {
        let a = self.a;
        let (square, eta) = (a * a, 0.5 * t);
        let (b, sin, cos) = self.b(eta);
        let sine = 2.0 * (a * (1.0 - 2.0 * sin * sin) + (1.0 - square) * sin * cos);
        let q = (2.0 * a + t) - sine / self.r2;
        self.landing_state(eta, (b, sin, cos), q, kappa)
    }
}

/// Guard on the number of Newton steps in extended arithmetic. From 15 digits each step doubles them, and seven suffice
/// for 1024 bits. 40 leaves room for starts with fewer digits. Where the last bits of the step are rounding, they may
/// stay above the bound for ever: the guard ends the search, and t is right to its rounding error.
const EXTENDED_NEWTON_STEPS: usize = 40;

impl<R: Extended> NearFixedPoint<R> {
    /// The first landing from α = a + `delta`.
    pub(crate) fn extended_landing(&self, delta: R, kappa: R) -> ExtendedLanding<R> {
        let start = NearFixedPoint::new(self.a.nearest()).time_shift(delta.nearest());
        let mut t = R::from(start);
        for _ in 0..EXTENDED_NEWTON_STEPS {
            let (offset, q) = self.offset(t);
            let slope = self.offset_slope(t * 0.5, q);
            if slope.nearest() == 0.0 {
                break;
            }
            let step = (offset - delta) / slope;
            if !(step.nearest().abs() > R::EPSILON * t.nearest().abs()) {
                break;
            }
            t = t - step;
        }
        let q = self.offset(t).1;
        let eta = t * 0.5;
        let (excess, velocity, closing_speed) = self.landing_state(eta, self.b(eta), q, kappa);
        ExtendedLanding { closing_speed, excess, velocity, time: (self.a + eta) * 2.0 }
    }
}

/// The first flight from near α*_n, as functions of t = τ − 2α*_n, the time of flight minus that of the lossless
/// flight.
///
/// Every function keeps its relative accuracy, however small t is.
///
/// ```
/// use passive_hopper::LocalFlight;
/// let flight = LocalFlight::new(1);
/// let t = flight.time_shift(1e-30);
/// assert!((flight.delta(t) / 1e-30 - 1.0).abs() < 1e-14);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalFlight(NearFixedPoint<f64>);

impl LocalFlight {
    /// The flights near α*_n, n ≥ 1. For n = 0 use [`HalfFlight`](crate::HalfFlight), which keeps its accuracy there;
    /// this function replaces n = 0 by n = 1.
    pub fn new(n: u64) -> Self {
        LocalFlight(NearFixedPoint::new(alpha_star(n.max(1))))
    }

    /// δ(t), the offset of the lift-off speed from α*_n.
    pub fn delta(&self, t: f64) -> f64 {
        self.0.offset(t).0
    }

    /// t(δ), the inverse of [`delta`](Self::delta).
    pub fn time_shift(&self, delta: f64) -> f64 {
        self.0.time_shift(delta)
    }

    /// Γ(t), the closing speed.
    pub fn closing_speed(&self, t: f64) -> f64 {
        self.0.landing(t, 0.0).2
    }

    /// W(t) = sin h (sin h − h cos h) of α′ dα′/dα = α (1 − 4μW).
    pub fn w(&self, t: f64) -> f64 {
        let (b, sin, cos) = self.0.b(0.5 * t);
        (self.0.a * cos + sin) * (b / self.0.r2)
    }
}
