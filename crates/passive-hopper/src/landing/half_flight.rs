//! Flight from the ground in terms of half its time, with nothing lost to cancellation.
//!
//! A flight from (y₁, ẏ₁, y₂, ẏ₂) = (1+x, V, 0, 0) lands after τ = 2h. With
//!
//! ```text
//!   S = sin h,  C = cos h,  D = h − S C,  u = h C − S,  ρ = u/D,  σ = S²/D
//! ```
//!
//! everything at the landing is rational in these (derivation: model.md §3, with τ = 2h put into
//! G(τ) = 0 and G'(τ), and V eliminated):
//!
//! ```text
//!   speed at the start   V       = h + S ρ − x σ                      (G = 0)
//!   closing speed        Γ = −G' = 2 ρ (u − x S)
//!   stretch at the end   1 + x', x' = x + 2 h (S ρ − x σ)
//!   its derivative       dV/dh   = 2 ρ (u − x S)/D = Γ/D
//! ```
//!
//! For x = 0 this is A(h) of the paper's Eq. (11) and its closing speed Γ(h).

/// The functions of h that every landing is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfFlight {
    /// Half the time of flight.
    pub h: f64,
    /// S = sin h.
    pub sin: f64,
    /// C = cos h.
    pub cos: f64,
    /// D = h − sin h cos h > 0.
    pub d: f64,
    /// u = h cos h − sin h, zero at h = α*_n.
    pub u: f64,
    /// ρ = u/D, from −½ at h → 0.
    pub rho: f64,
    /// σ = S²/D, about 3/(2h) at h → 0.
    pub sigma: f64,
}

/// Below this h the series are used; their first dropped terms are under 2⁻⁵⁵ there.
const SERIES_BELOW: f64 = 0.5;

impl HalfFlight {
    /// The functions at `h` > 0.
    pub fn at(h: f64) -> Self {
        let (sin, cos) = pxfm::f_sincos(h);
        if h < SERIES_BELOW {
            return Self::by_series(h, sin, cos);
        }
        let d = h - sin * cos;
        let u = h * cos - sin;
        HalfFlight { h, sin, cos, d, u, rho: u / d, sigma: sin * sin / d }
    }

    /// D/h³ and u/h³ by their Taylor series: the closed forms cancel.
    ///
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
        HalfFlight {
            h,
            sin,
            cos,
            d: d_hat * cube,
            u: u_hat * cube,
            rho: u_hat / d_hat,
            // Capped where 1/h overflows, so that a start with x = 0 gives 0 and not 0 · ∞.
            sigma: (ratio * ratio / (d_hat * h)).min(f64::MAX),
        }
    }

    /// V − h: the start speed beyond half the flight time, for a start at stretch 1 + `excess`.
    pub fn speed_beyond_h(&self, excess: f64) -> f64 {
        self.sin * self.rho - excess * self.sigma
    }

    /// V(h), the speed at the start of the flight that lasts 2h: A(h) for `excess` = 0.
    pub fn start_speed(&self, excess: f64) -> f64 {
        self.h + self.speed_beyond_h(excess)
    }

    /// Γ = −G', the closing speed times 1 + M.
    pub fn closing_speed(&self, excess: f64) -> f64 {
        2.0 * self.rho * (self.u - excess * self.sin)
    }

    /// dV/dh = Γ/D.
    pub fn start_speed_slope(&self, excess: f64) -> f64 {
        // Capped as σ is: D underflows for h below 1e-108.
        2.0 * self.rho * (self.rho - excess * (self.sin / self.d).min(f64::MAX))
    }

    /// d²V/dh², for steps of a root search: with w = u − x S, D V″ = 2(ρ′w + ρw′) − 2S² V′.
    pub(crate) fn start_speed_bend(&self, excess: f64) -> f64 {
        let HalfFlight { h, sin, cos, d, u, rho, .. } = *self;
        let w = u - excess * sin;
        let rho_slope = -sin * (h + 2.0 * sin * rho) / d;
        let w_slope = -(h * sin + excess * cos);
        2.0 * (rho_slope * w + rho * w_slope - 2.0 * sin * sin * rho * w / d) / d
    }

    /// d(Γ²)/dV = 2 D dΓ/dh, finite even at a triple root.
    pub(crate) fn loss_slope(&self, excess: f64) -> f64 {
        let HalfFlight { h, sin, cos, u, rho, .. } = *self;
        let w = u - excess * sin;
        -4.0 * (h * sin * w + u * (h * sin + excess * cos) + 2.0 * sin * sin * rho * w)
    }

    /// W = sin h (sin h − h cos h): α' dα'/dα = α (1 − 4μW) on the contact intervals.
    pub fn w(&self) -> f64 {
        -self.sin * self.u
    }
}

/// (coefficient of h^{2k−2} in D/h³, in u/h³), k = 1, 2, …
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
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    #[test]
    fn series_and_closed_forms_meet() {
        let h = SERIES_BELOW;
        let closed = HalfFlight::at(h);
        let (sin, cos) = pxfm::f_sincos(h);
        let series = HalfFlight::by_series(h, sin, cos);
        assert_relative_eq!(series.d, closed.d, max_relative = 2e-15);
        assert_relative_eq!(series.u, closed.u, max_relative = 5e-15);
        assert_relative_eq!(series.rho, closed.rho, max_relative = 6e-15);
        assert_relative_eq!(series.sigma, closed.sigma, max_relative = 2e-15);
    }

    #[test]
    fn small_h_has_the_limits_of_the_series() {
        for exponent in 1..140 {
            let h = 10f64.powi(-exponent);
            let half = HalfFlight::at(h);
            assert_relative_eq!(half.start_speed(0.0), h / 2.0, max_relative = h * h + 1e-15);
            assert_relative_eq!(half.rho, -0.5, max_relative = h * h + 1e-15);
            assert!(half.sigma.is_finite());
        }
    }

    proptest! {
        /// The landing equation G(2h) = 0 itself, with V from the closed form.
        #[test]
        fn the_height_vanishes_at_the_landing(h in 0.5..60f64, excess in 0.0..40f64) {
            let half = HalfFlight::at(h);
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
            let difference = HalfFlight::at(h + step).start_speed(excess)
                - HalfFlight::at(h - step).start_speed(excess);
            let slope = HalfFlight::at(h).start_speed_slope(excess);
            prop_assert!((difference / (2.0 * step) - slope).abs() < 1e-6 * (1.0 + slope.abs()) * (1.0 + excess));
            let difference = HalfFlight::at(h + step).start_speed_slope(excess)
                - HalfFlight::at(h - step).start_speed_slope(excess);
            let bend = HalfFlight::at(h).start_speed_bend(excess);
            prop_assert!((difference / (2.0 * step) - bend).abs() < 1e-5 * (1.0 + bend.abs()) * (1.0 + excess));
        }
    }
}
