//! A later flight: from a state (x, V) on the ground with x > 0 to its landing.
//!
//! The landing is the root h of V(h) = V in its bracket, h being half the time of flight. With S, C, D, u of
//! [`HalfAngle`], Y = 1 + x and w = u − xS (derivation: `landing/half_time.rs`),
//!
//! ```text
//!   V(h) = h + S u/D − x S²/D       Γ = 2uw/D       dV/dh = Γ/D       d(Γ²)/dV = 2D dΓ/dh
//! ```
//!
//! The search: the initial guess, a step of order four with eight-digit functions, a step of order three with full
//! functions, and what is left to first order. Most flights need no more; the others repeat the first step.

use crate::kernel::scalar::ground_state::GroundState;
use crate::kernel::scalar::half_angle::HalfAngle;
use crate::kernel::scalar::landing_bracket::LandingBracket;
use crate::landing::error_bound::LANDING_ULPS;
use std::f64::consts::PI;

/// Steps of order four that a search may take before the careful path takes over.
///
/// One suffices for most flights and two for nearly all. The limit ends searches that converge slowly or not at all,
/// such as next to the maximum of V(h), where F has a double root.
const STEPS: usize = 8;

/// Longest last step, for h ≥ 1; for h < 1 it is relative to h.
///
/// [`half_angle_moved`] uses three terms of Taylor's series. The fourth is of the relative size
/// LAST_STEP⁴ ≈ 8·10⁻¹⁹, a hundredth of an ulp. A longer last step would lose digits; a shorter one would repeat
/// more searches.
const LAST_STEP: f64 = 3e-5;

/// Largest relative correction that is added to first order: its square, 10⁻¹⁸, is below an ulp.
const FIRST_ORDER: f64 = 1e-9;

/// The end of a flight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlightEnd {
    pub(crate) state: GroundState,
    /// Γ².
    pub(crate) closing_speed_squared: f64,
    /// Bound on the error of Γ² that is propagated from the start of the flight. The rounding of this flight itself is
    /// counted at the end of the hop.
    pub(crate) closing_speed_squared_error: f64,
    /// h, half the time.
    pub(crate) half_time: f64,
    /// Whether the search has ended at the landing and no verdict is inconclusive (I2). If not, nothing else of this
    /// flight means anything.
    pub(crate) accepted: bool,
}

/// F(h) = h² − YS² − VD = D (V(h) − V), which has no quotient; and F′/2, F″/2, F‴/4.
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

/// The step of order three, Halley's: −2FF′/(2F′² − FF″). Enough for the last step, and cheaper.
#[inline(always)]
pub(crate) fn third_order_step(at: &HalfAngle, state: &GroundState) -> f64 {
    let [f, half_first, half_second, _] = residual_function(at, state);
    -f * half_first / (2.0 * (half_first * half_first) - 0.5 * (f * half_second))
}

/// The landing a last `step` away from `at`.
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
    let rho = u * inverse;
    let w = u - x * sin;
    let raw = 2.0 * rho * w; // Γ at h, before the correction

    // What is left, V(h) − V, is corrected to first order: δh = −(V(h) − V) D/Γ and δΓ = −½ (V(h) − V)/Γ · d(Γ²)/dV.
    let residual = (h - v) + (sin * rho - x * (square * inverse));
    let loss_slope = -4.0 * (h * sin * w + u * (h * sin + x * cos) + 2.0 * square * rho * w); // d(Γ²)/dV
    let per_speed = d / (2.0 * (u * w)); // 1/Γ, from u and w: it need not wait for the division in ρ
    let residual_over_gamma = residual * per_speed;
    let change_of_h = -residual_over_gamma * d;
    let change_of_gamma = -0.5 * residual_over_gamma * loss_slope;
    let closing = raw + change_of_gamma;
    // x′ = x + 2h (V − h) and V′ = V − 2h + κΓ, at h + δh.
    let excess = (x + 2.0 * h * (v - h)) + 2.0 * change_of_h * (v - 2.0 * h);
    let velocity = (v - 2.0 * h) - 2.0 * change_of_h + kappa * closing;

    // I4: the errors at the start, carried through the flight by its linear map (`landing/flight_derivative.rs`) with
    // every term positive: 1.5 > |cos τ| + |sin τ| and 2.5 > |sin τ| + 1 − cos τ.
    let size = y + v.abs() + 2.0 * h + closing;
    let rounding = LANDING_ULPS * f64::EPSILON * size;
    let before = error + 4.0 * f64::EPSILON * size; // 4: the rounding of the residual acts like an error of V
    let time_error = 2.0 * (square + d) * before * per_speed;
    // |ṡ| = |V cos τ − Y sin τ|. It can cancel; the 10⁻⁵ of the size keeps a part for the error of ṡ itself.
    let rate = (v * (1.0 - 2.0 * square) - 2.0 * y * product).abs() + 1e-5 * size;
    let excess_error = rounding + 1.5 * before + rate * time_error;
    let closing_error = 2.5 * before + excess.abs() * time_error;
    let velocity_error = rounding + before + time_error + kappa * closing_error;
    let error = if excess_error > velocity_error { excess_error } else { velocity_error };

    let scale = if h < 1.0 { h } else { 1.0 };
    // `&`, not `&&`: no branches. Every comparison is false for NaN, so that NaN is never accepted (I7).
    let accepted = (step.abs() <= LAST_STEP * scale)
        & (change_of_h.abs() <= FIRST_ORDER * scale)
        & (change_of_gamma.abs() <= FIRST_ORDER * raw)
        & (h > bracket.left)
        & (h < bracket.right)
        & ((bracket.parity_sign == 0.0) | (bracket.parity_sign * u < 0.0))
        & (bracket.certain > 0.0)
        & (excess.abs() > error); // the sign of x′ decides whether the landing is sudden
    FlightEnd {
        state: GroundState { excess, velocity, error },
        closing_speed_squared: closing * closing,
        closing_speed_squared_error: 2.0 * closing * closing_error,
        half_time: h + change_of_h,
        accepted,
    }
}

/// The functions at h + `e`, by three terms of Taylor's series: S′ = C, C′ = −S, D′ = 2S², u′ = −hS, and so on.
/// Cheaper than new sines, and D and u do not cancel.
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

/// The flight from `start`; `None` where the careful path must decide.
///
/// The first round does what the loops of `batch/later_flights.rs` do, in the same order of operations (I1).
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
