//! The interval with the landing of a later flight and no other root, and the initial guess of the search.
//!
//! ```text
//!   V < π                                     (max(V, 0), π)
//!   V ≥ π, before the maximum of branch m     (mπ, V)
//!   V ≥ π, after it                           (max(V, α*_m), (m+1)π)          m = ⌊V/π⌋
//! ```
//!
//! The flight lands before the maximum if V < (m+½)π and (−1)^m (V cos V − Y sin V) ≥ 0; see the head of
//! `landing/next_landing.rs` and docs/theory.md, Theorem 12.

use crate::kernel::scalar::ground_state::GroundState;
use crate::kernel::scalar::half_angle::{HalfAngle, negated_if_odd};
use crate::kernel::scalar::initial_guess;
use crate::landing::next_landing::MaximumTest;
use crate::precision::nearest_integer::nearest_integer;
use std::f64::consts::{FRAC_1_PI, PI};

/// From this V on the general solver computes the flight.
///
/// The value is a little above the largest speed of the first-flight table, 100, so that hardly any hop of the table
/// reaches it. The half-angle functions would allow 2²⁰. The initial guesses were not tested there.
const LARGEST_VELOCITY: f64 = 128.0;

/// Within this distance of mπ, in units of π, the general solver computes the flight.
///
/// There ⌊V/π⌋ depends on rounding. The rounding error of V/π below [`LARGEST_VELOCITY`] is 10⁻¹⁴ (two roundings of
/// a number up to 41), and that of (m+1)π and mπ as much. The error of V itself does no harm: the flights on both
/// sides of mπ land on one branch (docs/theory.md, Theorem 12). The value 10⁻⁹ leaves two flights in 10⁹ to the
/// general solver.
const NEAR_MULTIPLE_OF_PI: f64 = 1e-9;

/// Bound on the error of the sine and cosine in the maximum test, and of the test relative to 1 + x + V: the terms that
/// [`HalfAngle::to_eight_digits`] omits are below 1.8·10⁻⁹ (docs/theory.md, Lemma 57).
pub(crate) const EIGHT_DIGITS: f64 = 2e-9;

/// The maximum test of the kernel for a flight with V ≥ π, with the bound on its error; m = ⌊V/π⌋ has this `parity`.
///
/// The same formula as `maximum_test` of `landing/next_landing.rs`; written again because eight digits of the sines
/// suffice here and cost less, and because the parity comes with m, without a branch.
#[inline(always)]
fn kernel_maximum_test(state: &GroundState, parity: u64) -> MaximumTest {
    let GroundState { excess, velocity, error } = *state;
    let at = HalfAngle::to_eight_digits(velocity);
    let value = negated_if_odd(velocity * at.cos - (1.0 + excess) * at.sin, parity);
    // |test| must be larger than its error: that of the sines, and that of x and V, where |∂test/∂x| ≤ 1 and
    // |∂test/∂V| ≤ x + V (docs/theory.md, Lemma 64).
    let size = 1.0 + excess + velocity;
    MaximumTest { value, error: EIGHT_DIGITS * size + error + size * error }
}

/// The maximum test that decides the branch of the flight from `state`, or `None` for V < π: there is one branch.
pub(crate) fn maximum_test_of(state: &GroundState) -> Option<MaximumTest> {
    let (_, parity) = nearest_integer(state.velocity * FRAC_1_PI - 0.5);
    (state.velocity >= PI).then(|| kernel_maximum_test(state, parity))
}

/// The bracket of a flight's landing.
///
/// All fields are numbers, also the flags: vector instructions fill and read arrays of them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LandingBracket {
    pub(crate) left: f64,
    pub(crate) right: f64,
    /// The initial guess, which may lie outside the bracket.
    pub(crate) guess: f64,
    /// The parity sign (−1)^m if the landing must lie above α*_m, that is where u (−1)^m < 0; 0 if there is no such
    /// condition. The condition is not part of the bracket, because its end would need α*_m.
    pub(crate) parity_sign: f64,
    /// 1 if rounding cannot have chosen the wrong bracket, else 0.
    pub(crate) certain: f64,
}

impl LandingBracket {
    /// The bracket for V < π. There is only one branch, so that the bracket is certain.
    #[inline(always)]
    pub(crate) fn below_pi(state: &GroundState) -> Self {
        let GroundState { excess, velocity, .. } = *state;
        LandingBracket {
            left: if velocity > 0.0 { velocity } else { 0.0 },
            right: PI,
            guess: initial_guess::below_pi(excess, velocity),
            parity_sign: 0.0,
            certain: 1.0,
        }
    }

    /// The bracket for V ≥ π.
    #[inline(always)]
    pub(crate) fn from_pi(state: &GroundState) -> Self {
        let GroundState { excess, velocity, .. } = *state;
        let velocity_over_pi = velocity * FRAC_1_PI;
        let (m, parity) = nearest_integer(velocity_over_pi - 0.5); // ⌊V/π⌋
        let part = velocity_over_pi - m; // in [0, 1]
        let MaximumTest { value: test, error: slack } = kernel_maximum_test(state, parity);
        let before_maximum = (test >= 0.0) & (part < 0.5);
        let (low, high) = (m * PI, (m + 1.0) * PI);
        let certain = (test.abs() > slack)
            & (part > NEAR_MULTIPLE_OF_PI)
            & (part < 1.0 - NEAR_MULTIPLE_OF_PI)
            & (velocity < LARGEST_VELOCITY);
        let sign = if before_maximum { -1.0 } else { 1.0 };
        LandingBracket {
            left: if before_maximum { low } else { velocity },
            right: if before_maximum { velocity } else { high },
            guess: initial_guess::from_pi(excess, velocity, m, sign),
            parity_sign: if before_maximum { 0.0 } else { negated_if_odd(1.0, parity) },
            certain: if certain { 1.0 } else { 0.0 },
        }
    }

    /// `h` moved by `step`. If the result would lie outside the bracket (I3), `h` moves half way to the end that it
    /// would pass.
    #[inline(always)]
    pub(crate) fn moved(&self, h: f64, step: f64) -> f64 {
        let next = h + step;
        // A NaN fails the comparisons and is replaced by a point inside the bracket.
        let next = if next > self.left { next } else { 0.5 * (h + self.left) };
        if next < self.right { next } else { 0.5 * (h + self.right) }
    }

    /// The guess if it lies inside the bracket, else the middle.
    #[inline(always)]
    pub(crate) fn first_point(&self) -> f64 {
        let inside = (self.guess > self.left) & (self.guess < self.right);
        if inside { self.guess } else { 0.5 * (self.left + self.right) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landing::next_landing::maximum_test;
    use crate::precision::double_double::DoubleDouble;
    use basin_of_attraction::SplitMix64;

    /// docs/theory.md, Lemma 64, for exact starts. The error comes to nine tenths of its bound, 1.8·10⁻⁹ of 2·10⁻⁹,
    /// where V is an odd multiple of π/4 and Y ≪ V or V ≪ Y; 20 000 speeds next to such multiples find it.
    #[test]
    fn the_maximum_test_errs_by_less_than_its_bound() {
        let generator = SplitMix64::from_state(64);
        let mut largest = 0f64;
        for k in 0..20_000u64 {
            let eighth = (5 + 2 * (k % 70)) as f64 * 0.25 * PI;
            let near = 1e-3 * (generator.uniform(2 * k) - 0.5);
            let velocity = if k % 2 == 0 { eighth + near } else { eighth + 1e3 * near };
            let excess = 1e6 * generator.uniform(2 * k + 1).powi(12);
            let state = GroundState { excess, velocity, error: 0.0 };
            let test = maximum_test_of(&state).unwrap();
            let exact = maximum_test(DoubleDouble::from(excess), DoubleDouble::from(velocity));
            largest = largest.max((test.value - exact).abs() / test.error);
        }
        assert!(largest <= 1.0 && largest > 0.8, "{largest}");
    }
}
