//! Flight from the ground in terms of half its time, without cancellation.
//!
//! A flight from (y₁, ẏ₁, y₂, ẏ₂) = (1+x, V, 0, 0) lands after τ = 2h. With
//!
//! ```text
//!   S = sin h,  C = cos h,  D = h − S C,  u = h C − S,  ρ = u/D,  σ = S²/D
//! ```
//!
//! every quantity at the landing is a rational function of these six. The formulas follow from τ = 2h in G(τ) = 0 and
//! G'(τ), without V:
//!
//! ```text
//!   speed at the start   V       = h + S ρ − x σ                      (G = 0)
//!   closing speed        Γ = −G' = 2 ρ (u − x S)
//!   stretch at the end   1 + x', x' = x + 2 h (S ρ − x σ)
//!   its derivative       dV/dh   = 2 ρ (u − x S)/D = Γ/D
//! ```
//!
//! For x = 0, V is A(h) of the paper's Eq. (11), and Γ its closing speed Γ(h).
//!
//! Proof: docs/theory.md, Lemma 5.

use crate::precision::real::{Extended, Real};

/// The functions of h, half the time of flight, from which every quantity of a landing is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HalfTime<R> {
    /// Half the time of flight.
    pub(crate) h: R,
    /// S = sin h.
    pub(crate) sin: R,
    /// C = cos h.
    pub(crate) cos: R,
    /// D = h − sin h cos h > 0, half of τ − sin τ.
    pub(crate) d: R,
    /// u = h cos h − sin h, zero at h = α*_n.
    pub(crate) u: R,
    /// ρ = u/D, from −½ at h → 0.
    pub(crate) rho: R,
    /// σ = S²/D, about 3/(2h) at h → 0.
    pub(crate) sigma: R,
}

/// Below this h the `f64` functions are series: the closed forms would cancel. Up to this h the first dropped terms of
/// the series are below 2⁻⁵⁵ of the sum. From this h on the closed forms are as accurate as the series (test
/// `series_and_closed_forms_meet`).
const SERIES_BELOW: f64 = 0.5;

/// Below this h the extended functions are series. The series stop when a term is small, not after a fixed number of
/// terms. From this h on the closed forms lose only some bits. `EPSILON` has a margin for these bits.
const EXTENDED_SERIES_BELOW: f64 = 1.0;

impl HalfTime<f64> {
    /// The functions at `h` > 0.
    ///
    /// This is not [`extended_at`](Self::extended_at) with `R` = `f64`: its series have a fixed length, and ρ and σ
    /// at small h are quotients of u/h³ and D/h³, because h³ underflows below h = 10⁻¹⁰⁸.
    pub(crate) fn at(h: f64) -> Self {
        let (sin, cos) = pxfm::f_sincos(h);
        if h < SERIES_BELOW {
            return Self::by_series(h, sin, cos);
        }
        let d = h - sin * cos;
        let u = h * cos - sin;
        HalfTime { h, sin, cos, d, u, rho: u / d, sigma: sin * sin / d }
    }

    /// D/h³ and u/h³ by their Taylor series:
    /// D = ½(2h − sin 2h) = Σ_{k≥1} (−1)^{k+1} 2^{2k} h^{2k+1}/(2k+1)!,
    /// u = Σ_{k≥1} (−1)^k 2k h^{2k+1}/(2k+1)!.
    fn by_series(h: f64, sin: f64, cos: f64) -> Self {
        let square = h * h;
        let (mut d_hat, mut u_hat) = (0.0, 0.0);
        for &(d_term, u_term) in SERIES.iter().rev() {
            d_hat = d_hat * square + d_term;
            u_hat = u_hat * square + u_term;
        }
        let cube = square * h;
        let ratio = sin / h;
        HalfTime {
            h,
            sin,
            cos,
            d: d_hat * cube,
            u: u_hat * cube,
            rho: u_hat / d_hat,
            // Where 1/h overflows, σ is the largest number: a start with x = 0 then gives x σ = 0, not 0 · ∞.
            sigma: (ratio * ratio / (d_hat * h)).at_most_largest(),
        }
    }

    /// d²V/dh², for steps of a root search: with w = u − x S, D V″ = 2(ρ′w + ρw′) − 2S² V′.
    pub(crate) fn start_speed_bend(&self, excess: f64) -> f64 {
        let HalfTime { h, sin, cos, d, u, rho, .. } = *self;
        let w = u - excess * sin;
        let rho_slope = -sin * (h + 2.0 * sin * rho) / d;
        let w_slope = -(h * sin + excess * cos);
        2.0 * (rho_slope * w + rho * w_slope - 2.0 * sin * sin * rho * w / d) / d
    }

    /// d(Γ²)/dV = 2 D dΓ/dh, finite even at a triple root.
    ///
    /// Inlined into the loops of the kernel, which have sin² and w already.
    #[inline(always)]
    pub(crate) fn loss_slope(&self, excess: f64) -> f64 {
        let HalfTime { h, sin, cos, u, rho, .. } = *self;
        let w = u - excess * sin;
        -4.0 * (h * sin * w + u * (h * sin + excess * cos) + 2.0 * (sin * sin) * rho * w)
    }
}

impl<R: Extended> HalfTime<R> {
    /// The functions at `h` > 0 in extended arithmetic.
    pub(crate) fn extended_at(h: R) -> Self {
        let (sin, cos) = h.sin_cos();
        if h.nearest() < EXTENDED_SERIES_BELOW {
            // As in `f64`, ρ and σ are quotients of u/h³ and D/h³, because h³ underflows in 106 bits.
            let (d_hat, u_hat) = extended_series(h);
            let cube = h.squared() * h;
            let sigma = (sin / h).squared() / (d_hat * h);
            return HalfTime {
                h,
                sin,
                cos,
                d: d_hat * cube,
                u: u_hat * cube,
                rho: u_hat / d_hat,
                sigma,
            };
        }
        let (d, u) = (h - sin * cos, h * cos - sin);
        HalfTime { h, sin, cos, d, u, rho: u / d, sigma: sin.squared() / d }
    }
}

impl<R: Real> HalfTime<R> {
    /// V − h: the start speed minus half the flight time, for a start at stretch 1 + `excess`.
    pub(crate) fn speed_beyond_h(&self, excess: R) -> R {
        self.sin * self.rho - excess * self.sigma
    }

    /// V(h), the speed at the start of the flight that lasts 2h: A(h) for `excess` = 0.
    pub(crate) fn start_speed(&self, excess: R) -> R {
        self.h + self.speed_beyond_h(excess)
    }

    /// Γ = −G', the closing speed of the lower mass times 1 + M.
    pub(crate) fn closing_speed(&self, excess: R) -> R {
        self.rho * 2.0 * (self.u - excess * self.sin)
    }

    /// dV/dh = Γ/D.
    pub(crate) fn start_speed_slope(&self, excess: R) -> R {
        // D underflows for h below 10⁻¹⁰⁸. The quotient is limited to the largest number: x = 0 then gives 0, not 0 ·
        // ∞.
        self.rho * 2.0 * (self.rho - excess * (self.sin / self.d).at_most_largest())
    }
}

/// D/h³ and u/h³ by their series.
fn extended_series<R: Extended>(h: R) -> (R, R) {
    let minus_square = -h.squared();
    let (mut d, mut u) = (R::from(0.0), R::from(0.0));
    let mut term = R::from(-1.0); // (−1)^k h^{2k−2}/(2k+1)!
    let mut power_of_four = 1.0;
    for k in 1..=MOST_TERMS {
        if k > 1 {
            term = term * minus_square;
        }
        term = term.over(2 * k * (2 * k + 1));
        power_of_four *= 4.0;
        d = d - term * power_of_four;
        u = u + term * f64::from(2 * k);
        if !(term.nearest().abs() * power_of_four > R::EPSILON * d.nearest()) {
            break;
        }
    }
    (d, u)
}

/// Guard on the number of terms, never reached: 4^k/(2k+1)! is below 2⁻¹⁰²⁴ for k = 110.
const MOST_TERMS: u32 = 110;

/// (coefficient of h^{2k−2} in D/h³, in u/h³), k = 1, 2, …, 10.
const SERIES: [(f64, f64); 10] = series();

const fn series() -> [(f64, f64); 10] {
    let mut table = [(0.0, 0.0); 10];
    let mut k = 1;
    let mut factorial = 1.0; // (2k+1)!
    let mut power_of_four = 1.0;
    let mut sign = 1.0; // (−1)^{k+1}
    while k <= 10 {
        factorial *= (2 * k) as f64 * (2 * k + 1) as f64;
        power_of_four *= 4.0;
        table[k - 1] = (sign * power_of_four / factorial, -sign * (2 * k) as f64 / factorial);
        sign = -sign;
        k += 1;
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::double_double::DoubleDouble;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    #[test]
    fn series_and_closed_forms_meet() {
        let h = SERIES_BELOW;
        let closed = HalfTime::at(h);
        let (sin, cos) = pxfm::f_sincos(h);
        let series = HalfTime::by_series(h, sin, cos);
        assert_relative_eq!(series.d, closed.d, max_relative = 2e-15);
        assert_relative_eq!(series.u, closed.u, max_relative = 5e-15);
        assert_relative_eq!(series.rho, closed.rho, max_relative = 6e-15);
        assert_relative_eq!(series.sigma, closed.sigma, max_relative = 2e-15);
    }

    #[test]
    fn small_h_has_the_limits_of_the_series() {
        for exponent in 1..140 {
            let h = 10f64.powi(-exponent);
            let half = HalfTime::at(h);
            assert_relative_eq!(half.start_speed(0.0), h / 2.0, max_relative = h * h + 1e-15);
            assert_relative_eq!(half.rho, -0.5, max_relative = h * h + 1e-15);
            assert!(half.sigma.is_finite());
        }
    }

    proptest! {
        /// The two ways to compute the functions agree.
        #[test]
        fn the_functions_agree_with_106_bits(h in 1e-3..60f64) {
            let (half, exact) = (HalfTime::at(h), HalfTime::extended_at(DoubleDouble::from(h)));
            // Absolute in the largest term of each: u vanishes at every α*_n.
            prop_assert!((half.d - exact.d.high).abs() <= 4e-15 * half.d);
            prop_assert!((half.u - exact.u.high).abs() <= 4e-15 * exact.u.high.abs() + 4e-16 * h);
            prop_assert!((half.sigma - exact.sigma.high).abs() <= 6e-15 * half.sigma);
        }

        /// The landing equation G(2h) = 0 itself, with V from the closed form.
        #[test]
        fn the_height_vanishes_at_the_landing(h in 0.5..60f64, excess in 0.0..40f64) {
            let half = HalfTime::at(h);
            let (v, tau) = (half.start_speed(excess), 2.0 * h);
            let (sin, cos) = pxfm::f_sincos(tau);
            let y = 1.0 + excess;
            let parabola = y + tau * (v - tau / 2.0);
            let stretch = y * cos + v * sin;
            let scale = y + v.abs() + tau * tau + 1.0;
            prop_assert!((parabola - stretch).abs() < 1e-14 * scale);
            // Stretch and closing speed there.
            let after = 1.0 + excess + 2.0 * h * half.speed_beyond_h(excess);
            prop_assert!((after - stretch).abs() < 1e-14 * scale);
            let closing = tau - v + v * cos - y * sin;
            prop_assert!((half.closing_speed(excess) - closing).abs() < 1e-13 * scale);
        }

        #[test]
        fn the_slope_is_the_derivative(h in 0.6..30f64, excess in 0.0..5f64) {
            let step = 1e-6;
            let difference = HalfTime::at(h + step).start_speed(excess)
                - HalfTime::at(h - step).start_speed(excess);
            let slope = HalfTime::at(h).start_speed_slope(excess);
            prop_assert!((difference / (2.0 * step) - slope).abs() < 1e-6 * (1.0 + slope.abs()) * (1.0 + excess));
            let difference = HalfTime::at(h + step).start_speed_slope(excess)
                - HalfTime::at(h - step).start_speed_slope(excess);
            let bend = HalfTime::at(h).start_speed_bend(excess);
            prop_assert!((difference / (2.0 * step) - bend).abs() < 1e-5 * (1.0 + bend.abs()) * (1.0 + excess));
        }
    }
}
