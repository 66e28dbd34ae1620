//! A later flight: from a state (x, V) on the ground with x > 0 to its landing.
//!
//! The landing is the root h of V(h) = V in its bracket, h being half the time of flight. With S, C, D, u of
//! [`HalfAngle`], Y = 1 + x and w = u − xS (derivation: `landing/half_time.rs`),
//!
//! ```text
//!   V(h) = h + S u/D − x S²/D       Γ = 2uw/D       dV/dh = Γ/D       d(Γ²)/dV = 2D dΓ/dh
//! ```
//!
//! The search takes the initial guess, a step of order four with eight-digit functions, and a step of order three with
//! full functions. The rest is corrected to first order. Most flights need no more; for the others the step of order
//! four is repeated.

use crate::kernel::scalar::ground_state::GroundState;
use crate::kernel::scalar::half_angle::HalfAngle;
use crate::kernel::scalar::landing_bracket::LandingBracket;
use crate::landing::error_bound::BACKWARD_ULPS;
use crate::landing::flight_ends::{TakeOff, state_after_flight};
use crate::landing::half_time::HalfTime;
use std::f64::consts::PI;

/// Largest number of steps of order four. Past it the general solver computes the hop.
///
/// One step suffices for most flights and two for nearly all. The limit ends searches that converge slowly or not at
/// all, for example next to the maximum of V(h), where F has a double root.
const STEPS: usize = 8;

/// Longest last step, for h ≥ 1; for h < 1 it is relative to h.
///
/// [`half_angle_moved`] uses three terms of Taylor's series. The relative size of the fourth is LAST_STEP⁴ ≈ 8·10⁻¹⁹, a
/// hundredth of an ulp. With a longer last step digits would be lost; with a shorter one more searches would be
/// repeated.
const LAST_STEP: f64 = 3e-5;

/// Largest relative correction that is added to first order. What it leaves is below 10⁻¹⁷ of h, or of 1 where h > 1
/// (docs/theory.md, Lemma 59).
const FIRST_ORDER: f64 = 1e-9;

/// Bound on the direct rounding errors of x′, V′ and Γ, in ulps of the size 1 + x + |V| + τ + Γ (docs/theory.md,
/// Lemma 61).
///
/// It is twice [`LANDING_ULPS`](crate::landing::error_bound::LANDING_ULPS), because h is rounded once more after
/// the last step, by up to half an ulp of h; this moves x′ by 2h max(D, Γ) half ulps, for h up to 32π.
const KERNEL_LANDING_ULPS: f64 = 64.0;

/// Largest size · T/Γ of a flight that is accepted, with T the bound on the error of the time of flight and the size
/// 1 + x + |V| + τ + Γ. With the limit the bounds of [`land`] hold with all terms of second order (docs/theory.md,
/// Lemma 61). It fails next to a touch (Γ small) and for short flights from x < 10⁻⁶; the general solver computes
/// them. A larger limit needs larger constants in the bounds; a smaller one sends more hops away, in proportion to its
/// inverse for touches and to its inverse root for short flights.
const LARGEST_NONLINEARITY: f64 = 1.0 / 1024.0;

/// Part of the size that is added to |ṡ| and to |x′| in the bounds, for the terms of second order. They are below
/// 1.5·10⁻³ of the size where size · T/Γ is below [`LARGEST_NONLINEARITY`] (docs/theory.md, Lemma 61).
const SECOND_ORDER: f64 = 1.0 / 512.0;

/// 2/(1 − q), rounded up, with q < 0.01 from [`LARGEST_NONLINEARITY`]: T is the first-order bound 2 (S² + D) e/Γ on the
/// error of the time times 1/(1 − q) (docs/theory.md, Lemma 61).
const TWICE_LINEAR: f64 = 2.0625;

/// The end of a flight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlightEnd {
    pub(crate) state: GroundState,
    /// Γ².
    pub(crate) closing_speed_squared: f64,
    /// Bound on the error of Γ²: the rounding error of this flight, and the error that is propagated from its start.
    pub(crate) closing_speed_squared_error: f64,
    /// h, half the time.
    pub(crate) half_time: f64,
    /// Whether the search has ended at the landing and every decision is conclusive (I2). If false, the other fields
    /// have no meaning.
    pub(crate) accepted: bool,
}

/// F(h) = h² − YS² − VD = D (V(h) − V), which has no quotient, and F′/2, F″/2, F‴/4.
#[inline(always)]
fn residual_function(at: &HalfAngle, state: &GroundState) -> [f64; 4] {
    let HalfAngle { h, sin, cos, d, .. } = *at;
    let (y, v) = (1.0 + state.excess, state.velocity);
    let (square, product) = (sin * sin, sin * cos);
    let double = 1.0 - 2.0 * square; // cos 2h
    let f = (h * h - y * square) - v * d;
    let half_first = h - y * product - v * square;
    let half_second = 1.0 - y * double - 2.0 * (v * product);
    [f, half_first, half_second, 2.0 * (y * product) - v * double]
}

/// The step of order four, Householder's third:
/// −F (F′² − ½FF″)/(F′ (F′² − FF″) + F²F‴/6).
#[inline(always)]
pub(crate) fn fourth_order_step(at: &HalfAngle, state: &GroundState) -> f64 {
    let [f, half_first, half_second, quarter_third] = residual_function(at, state);
    let (first, second, third) = (2.0 * half_first, 2.0 * half_second, 4.0 * quarter_third);
    let slope = first * first;
    -f * (slope - 0.5 * f * second) / (first * (slope - f * second) + f * f * third * (1.0 / 6.0))
}

/// The step of order three, Halley's: −2FF′/(2F′² − FF″). It suffices for the last step and is cheaper.
#[inline(always)]
pub(crate) fn third_order_step(at: &HalfAngle, state: &GroundState) -> f64 {
    let [f, half_first, half_second, _] = residual_function(at, state);
    -f * half_first / (2.0 * (half_first * half_first) - 0.5 * (f * half_second))
}

/// The landing after a last `step` from `at`.
#[inline(always)]
pub(crate) fn land(
    at: &HalfAngle,
    step: f64,
    start: &GroundState,
    bracket: &LandingBracket,
    kappa: f64,
) -> FlightEnd {
    let GroundState { excess: x, velocity: v, error } = *start;
    let y = 1.0 + x;
    let HalfAngle { h, sin, cos, d, u } = half_angle_moved(at, step);
    let (square, product) = (sin * sin, sin * cos);
    let inverse = 1.0 / d;
    let (rho, sigma) = (u * inverse, square * inverse);
    let w = u - x * sin;
    let raw = 2.0 * rho * w; // Γ at h, before the correction

    // The residual V(h) − V is corrected to first order: δh = −(V(h) − V) D/Γ and δΓ = −½ (V(h) − V)/Γ · d(Γ²)/dV.
    let residual = (h - v) + (sin * rho - x * sigma);
    let loss_slope = HalfTime { h, sin, cos, d, u, rho, sigma }.loss_slope(x);
    let per_speed = d / (2.0 * (u * w)); // 1/Γ, from u and w: it need not wait for the division in ρ
    let residual_over_gamma = residual * per_speed;
    let change_of_h = -residual_over_gamma * d;
    let change_of_gamma = -0.5 * residual_over_gamma * loss_slope;
    let closing = raw + change_of_gamma;
    let take_off = TakeOff { excess: x, velocity: v };
    let (excess, velocity) = state_after_flight(take_off, h, change_of_h, kappa, closing);

    // I4: the errors at the start are propagated through the flight by its linear map (`landing/flight_derivative.rs`),
    // with every term positive: 1.5 > |cos τ| + |sin τ| and 2.5 > |sin τ| + 1 − cos τ. Terms of second order are in the
    // constants (docs/theory.md, Lemma 61).
    let size = y + v.abs() + 2.0 * h + closing;
    let rounding = KERNEL_LANDING_ULPS * f64::EPSILON * size;
    let before = error + BACKWARD_ULPS * f64::EPSILON * size;
    let time_error = TWICE_LINEAR * (square + d) * before * per_speed;
    let second_order = SECOND_ORDER * size;
    // |ṡ| = |V cos τ − Y sin τ|.
    let rate = (v * (1.0 - 2.0 * square) - 2.0 * y * product).abs() + second_order;
    let excess_error = rounding + 1.5 * before + rate * time_error;
    let closing_error = rounding + 2.5 * before + (excess.abs() + second_order) * time_error;
    let velocity_error = rounding + before + time_error + kappa * closing_error;
    let error = if excess_error > velocity_error { excess_error } else { velocity_error };

    let scale = if h < 1.0 { h } else { 1.0 };
    // `&` instead of `&&` avoids branches. Every comparison is false for NaN, so that NaN is never accepted (I7).
    let accepted = (step.abs() <= LAST_STEP * scale)
        & (change_of_h.abs() <= FIRST_ORDER * scale)
        & (change_of_gamma.abs() <= FIRST_ORDER * raw)
        & (h > bracket.left)
        & (h < bracket.right)
        & ((bracket.parity_sign == 0.0) | (bracket.parity_sign * u < 0.0))
        & (bracket.certain > 0.0)
        & (size * time_error <= LARGEST_NONLINEARITY * closing)
        & (excess.abs() > error); // the sign of x′ decides whether the landing is sudden
    FlightEnd {
        state: GroundState { excess, velocity, error },
        closing_speed_squared: closing * closing,
        closing_speed_squared_error: (2.0 * closing + closing_error) * closing_error,
        half_time: h + change_of_h,
        accepted,
    }
}

/// The functions at h + `e`, by three terms of Taylor's series: S′ = C, C′ = −S, D′ = 2S², u′ = −hS, and so on. This is
/// cheaper than new sines, and D and u do not cancel.
#[inline(always)]
fn half_angle_moved(at: &HalfAngle, e: f64) -> HalfAngle {
    let HalfAngle { h, sin, cos, d, u } = *at;
    let half = 0.5 * e * e; // e²/2
    let cubed = half * e * (1.0 / 3.0); // e³/6
    let sine = e - cubed; // sin e
    let (square, product) = (sin * sin, sin * cos);
    HalfAngle {
        h: h + e,
        sin: sin + (cos * sine - sin * half),
        cos: cos - (sin * sine + cos * half),
        d: d + (2.0 * square * e + 4.0 * product * half + 4.0 * (1.0 - 2.0 * square) * cubed),
        u: u - (h * sin * e + (sin + h * cos) * half + (2.0 * cos - h * sin) * cubed),
    }
}

/// The flight from `start`; `None` if the general solver must decide.
///
/// The first round has the same operations in the same order as the loops of `batch/later_flights.rs` (I1).
#[inline]
pub(crate) fn later_flight(start: &GroundState, kappa: f64) -> Option<FlightEnd> {
    let bracket = if start.velocity < PI {
        LandingBracket::below_pi(start)
    } else {
        LandingBracket::from_pi(start)
    };
    let mut at = HalfAngle::to_eight_digits(bracket.first_point());
    for _ in 0..STEPS {
        at = HalfAngle::at(bracket.moved(at.h, fourth_order_step(&at, start)));
        let last = third_order_step(&at, start);
        if last.abs() <= LAST_STEP {
            let end = land(&at, last, start, &bracket, kappa);
            if end.accepted {
                return Some(end);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landing::extended_landing::ExtendedLanding;
    use crate::landing::next_landing::{before_maximum, next_root};
    use crate::precision::long::Long;
    use crate::precision::real::Real;
    use basin_of_attraction::SplitMix64;

    type Four = Long<4>;

    /// docs/theory.md, Lemma 61: starts whose errors are 0, or known to 10⁻¹⁴ … 10⁻⁵. The exact landings from the
    /// corners of the error's square are within the bounds of an accepted flight.
    #[test]
    fn accepted_landings_are_within_their_bounds() {
        let generator = SplitMix64::from_state(61);
        let (mut accepted, mut largest) = (0, 0f64);
        for k in 0..6000u64 {
            let part = |i| generator.uniform(8 * k + i);
            let error = if k % 2 == 0 { 0.0 } else { pxfm::f_exp10(-14.0 + 9.0 * part(0)) };
            let velocity = 40.0 * part(1) * part(2) - 8.0;
            let excess = pxfm::f_exp10(8.0 * part(3) - 5.0);
            let start = TakeOff { excess, velocity };
            let kappa = part(4);
            let state = GroundState { excess, velocity, error };
            let Some(end) = later_flight(&state, kappa) else { continue };
            accepted += 1;
            let branch = before_maximum(start);
            for (dx, dv) in [(error, error), (-error, error), (error, -error), (-error, -error)] {
                let (x, v) = (Four::from(excess) + dx, Four::from(velocity) + dv);
                let moved = TakeOff { excess: x.nearest(), velocity: v.nearest() };
                let exact =
                    ExtendedLanding::near(&next_root(moved, branch), x, v, Four::from(kappa));
                let off = |exact: Four, found: f64| (exact - Four::from(found)).nearest().abs();
                let of_state = off(exact.excess, end.state.excess)
                    .max(off(exact.velocity, end.state.velocity));
                let of_square = off(exact.closing_speed.squared(), end.closing_speed_squared);
                assert!(of_state <= end.state.error, "{state:?} {kappa}: {of_state:e}");
                assert!(of_square <= end.closing_speed_squared_error, "{state:?}: {of_square:e}");
                largest = largest.max(of_state / end.state.error);
            }
        }
        assert!(accepted > 4000 && largest > 0.5, "{accepted} {largest}");
    }
}
