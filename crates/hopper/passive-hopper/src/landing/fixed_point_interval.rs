//! The interval (nπ, (n+1)π) of lift-off speeds around a fixed point, which decides the first landing.
//!
//! ```text
//!   α              first landing    has h in         because
//!   (nπ, α*_n)     sudden           (nπ, α)          A(nπ) = nπ, A(h) − h = S u/D > 0
//!   (α*_n, (n+1)π) into contact     (α, (n+1)π)      A((n+1)π) = (n+1)π, A(h) − h < 0
//! ```
//!
//! with A(h) the lift-off speed of the flight that lasts 2h, which increases (docs/theory.md,
//! Theorem 7). For n = 0 only the second line applies.

use crate::model::fixed_points::{exact_alpha_star, n_pi};
use crate::precision::double_double::DoubleDouble;
use std::cmp::Ordering;
use std::f64::consts::PI;

/// Where a lift-off speed α lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FixedPointInterval {
    /// α ∈ (nπ, (n+1)π).
    pub(crate) n: u64,
    /// α*_n.
    pub(crate) fixed_point: DoubleDouble,
    /// α ∈ (nπ, α*_n), n ≥ 1: the first landing is sudden.
    pub(crate) sudden: bool,
}

impl FixedPointInterval {
    /// The interval of `alpha` > 0, decided on 100 bits.
    pub(crate) fn of(alpha: f64) -> Self {
        let alpha_over_pi = alpha / PI;
        let mut n = alpha_over_pi as u64;
        let part = alpha_over_pi - n as f64;
        // The quotient has an error of an ulp, at most 2⁻¹¹ for α ≤ 2⁴³. Only within 10⁻³ of an integer can ⌊α/π⌋
        // be wrong, and the 100 bits of nπ are needed.
        if part < 1e-3 && n > 0 && n_pi(n).compare(alpha) == Ordering::Less {
            n -= 1;
        } else if part > 0.999 && n_pi(n + 1).compare(alpha) != Ordering::Less {
            n += 1;
        }
        let fixed_point = exact_alpha_star(n);
        let sudden = n > 0 && fixed_point.compare(alpha) == Ordering::Less;
        FixedPointInterval { n, fixed_point, sudden }
    }

    /// The interval of h that holds the first landing.
    pub(crate) fn half_time_bracket(&self, alpha: f64) -> (f64, f64) {
        if self.sudden { (self.n as f64 * PI, alpha) } else { (alpha, (self.n + 1) as f64 * PI) }
    }

    /// h to a few digits, from an expansion of the inverse of A.
    ///
    /// About α*_n, with δ = α − α*_n, w = (12 δ a²/(1+a²))^{1/3} and a = α*_n, the flight lasts
    /// 2a + w + w²/(4a) + (4 + 25/a²) w³/240 − (36 − 65/a²) w⁴/(2880 a) + w⁵/1400 + …: the inverse series of δ(t) in
    /// `local_flight.rs`, without the parts of the last term that have 1/a².
    pub(crate) fn half_time_estimate(&self, alpha: f64) -> f64 {
        if self.n == 0 {
            // A(h) = h/2 (1 + h²/15 + …) at 0, hence h ≈ 2α/(1 + 4α²/15). The coefficient 0.01676 makes h = π at
            // α = π, where A(π) = π.
            let square = alpha * alpha;
            return 2.0 * alpha / (1.0 + square * (4.0 / 15.0 - 0.016_76 * square));
        }
        let a = self.fixed_point.high;
        let square = a * a;
        let w = pxfm::f_cbrt(12.0 * (alpha - a) * (square / (1.0 + square)));
        let t2 = 1.0 / (4.0 * a);
        let t3 = (4.0 + 25.0 / square) / 240.0;
        let t4 = (36.0 - 65.0 / square) / (2880.0 * a);
        a + 0.5 * w * (1.0 + w * (t2 + w * (t3 + w * (w * (1.0 / 1400.0) - t4))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// docs/theory.md, Lemma 65: the computed α*_n errs by less than 2⁻¹⁰¹ of it. No `f64` is nearer than 2⁻⁸⁰ of
    /// it for these n, so that each is on the right side.
    #[test]
    fn no_number_is_as_near_to_a_fixed_point_as_its_error() {
        for n in 1..20_000 {
            let star = exact_alpha_star(n);
            // The nearest f64 is `high`.
            assert!(star.low.abs() > 2f64.powi(-80) * star.high, "{n}: {:e}", star.low);
        }
    }

    /// The nearest `f64` to any nπ below 2⁴³ is 1.238·10⁻¹⁸ away, at n = 29 (docs/theory.md, Lemma 65): the interval is
    /// decided rightly there.
    #[test]
    fn the_number_nearest_to_a_multiple_of_pi_is_on_its_right_side() {
        let pi = n_pi(29);
        assert!((pi.low.abs() / 1.237_961_3e-18 - 1.0).abs() < 1e-6, "{:e}", pi.low);
        let (below, above) = if pi.low > 0.0 {
            (pi.high, pi.high.next_up())
        } else {
            (pi.high.next_down(), pi.high)
        };
        assert_eq!(FixedPointInterval::of(below).n, 28);
        assert_eq!(FixedPointInterval::of(above).n, 29);
    }
}
