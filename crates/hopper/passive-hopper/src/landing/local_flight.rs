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
//! Proof: docs/theory.md, Lemma 34. Lemma 73 bounds the rounding errors.

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
/// (docs/theory.md, Lemma 73). A smaller value would let the search go on until the guard.
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
        // A search that the guard ended is right to its rounding error: see `EXTENDED_NEWTON_STEPS`.
        let time = (self.a + eta) * 2.0;
        ExtendedLanding { closing_speed, excess, velocity, time, settled: true }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::fixed_points::{exact_alpha_star, fixed_point_in};
    use crate::precision::long::Long;
    use crate::precision::real::Real;

    /// 256 bits: of the digits of t, 15 and more are left for |δ| ≥ 10⁻¹⁵⁰.
    type Bits = Long<4>;

    /// The relative errors of t(δ) and of Γ(t(δ)), in units 2⁻⁵³, against 256 bits.
    fn errors(n: u64, delta: f64) -> [f64; 2] {
        let local = NearFixedPoint::new(exact_alpha_star(n).high);
        let t = local.time_shift(delta);
        let closing_speed = local.landing(t, 0.0).2;
        let star = fixed_point_in::<Bits>(n);
        let exact = NearFixedPoint::new(star).extended_landing(Bits::from(delta), Bits::from(0.0));
        let shift = exact.time - star * 2.0;
        let relative = |value: f64, exact: Bits| {
            ((exact + -value) / exact).nearest().abs() * (2.0 / f64::EPSILON)
        };
        [relative(t, shift), relative(closing_speed, exact.closing_speed)]
    }

    /// docs/theory.md, Lemma 73.
    #[test]
    fn times_and_closing_speeds_have_the_derived_errors() {
        const TIME: f64 = 7.0;
        const CLOSING_SPEED: f64 = 40.0;
        let mut largest = [0.0, 0.0];
        // The last two had the largest errors of t in a search.
        let planted = [(4999, 1.3502490543059118), (1, -1.350997673072077)];
        let sizes = (0..400).map(|k| pxfm::f_exp10(-0.05 * f64::from(k)));
        let all = [1, 2, 5, 40, 1000, 1 << 30]
            .into_iter()
            .flat_map(|n| sizes.clone().flat_map(move |size| [(n, 1.3 * size), (n, -1.3 * size)]));
        for (n, delta) in all.chain(planted) {
            let [time, closing_speed] = errors(n, delta);
            assert!(time <= TIME && closing_speed <= CLOSING_SPEED, "{n} {delta:e}");
            largest = [time.max(largest[0]), closing_speed.max(largest[1])];
        }
        assert!(largest[0] > 1.0 && largest[1] > 3.0, "{largest:?}");
    }

    /// The two conditions of docs/theory.md, Lemma 73: t δ′(t) ≥ 2δ and 0 ≤ t Γ′(t) ≤ 2Γ.
    #[test]
    fn logarithmic_slopes_of_the_flight_are_bounded() {
        for n in [1u64, 2, 3, 10, 1000] {
            let flight = LocalFlight::new(n);
            let star = alpha_star(n);
            let end = |m: u64| 2.0 * (m as f64 * std::f64::consts::PI - star);
            for k in 1..200 {
                let part = f64::from(k) / 200.0;
                for t in [part * end(n), part * end(n + 1)] {
                    let step = 1e-5 * t;
                    let slope = |f: fn(&LocalFlight, f64) -> f64| {
                        let difference = f(&flight, t + step) - f(&flight, t - step);
                        difference / (2e-5 * f(&flight, t))
                    };
                    let (offset, closing) =
                        (slope(LocalFlight::delta), slope(LocalFlight::closing_speed));
                    // 10⁻⁸ for the difference quotients.
                    assert!(offset >= 2.0 - 1e-8, "{n} {t}: {offset}");
                    assert!((-1e-8..=2.0 + 1e-8).contains(&closing), "{n} {t}: {closing}");
                }
            }
        }
    }
}
