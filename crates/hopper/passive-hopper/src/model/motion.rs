//! Flight of both masses in closed form, from any state.
//!
//! ```text
//!   s(τ) = s₀ cos τ + ṡ₀ sin τ        P(τ) = P₀ + Ṗ₀ τ − τ²/2        G = (1+M) y₂ = P − s
//!   G(τ) = G₀ + Ġ₀ τ + (s₀−1)(1−cos τ) + (1−cos τ−τ²/2) + ṡ₀ (τ−sin τ)
//! ```
//!
//! The second form of G keeps its digits at small τ, where a lift-off is a triple root.

use crate::model::mass_ratio::MassRatio;
use crate::model::state::HopperState;

/// The largest lift-off speed, 2⁴³, and the largest coordinate or rate of a state. The spring's phase at the landing is
/// of this size. Above it two neighbouring `f64` are 2⁻⁹ or more apart, too coarse for a phase. Hops with speeds above
/// 2²⁸ are computed in extended arithmetic; past 2⁴³ the functions return errors.
pub const LARGEST_LIFT_OFF_SPEED: f64 = 8_796_093_022_208.0;

/// A flight from a given state. Times count from this state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    mass_ratio: f64,
    /// s₀ and ṡ₀.
    pub(crate) stretch: (f64, f64),
    /// P₀ and Ṗ₀.
    pub(crate) momentum: (f64, f64),
    /// G₀ = (1+M) y₂ and Ġ₀.
    pub(crate) height: (f64, f64),
}

/// Up to this time the second form of G is used. At τ = 1 the smallest of its differences, 1 − cos τ − τ²/2, is
/// −0.04: past it the first form cancels at most some five bits, and the second one would subtract terms that grow
/// with τ². Any time near 1 would do. A much smaller one would lose digits of the first form, whose terms nearly
/// cancel there.
const NEAR_START: f64 = 1.0;

impl Flight {
    /// The flight that starts in `state`.
    pub fn new(mass_ratio: MassRatio, state: &HopperState) -> Self {
        let m = mass_ratio.value();
        Flight {
            mass_ratio: m,
            stretch: (state.stretch(), state.stretch_rate()),
            momentum: (state.momentum_coordinate(m), state.momentum_rate(m)),
            height: ((1.0 + m) * state.lower_position, (1.0 + m) * state.lower_velocity),
        }
    }

    #[cfg(feature = "hybrid-system")]
    /// The first coordinate or rate over [`LARGEST_LIFT_OFF_SPEED`] or not a number; `None` if there is none.
    pub(crate) fn unresolved(&self) -> Option<f64> {
        [self.stretch, self.momentum, self.height]
            .into_iter()
            .flat_map(|(value, rate)| [value, rate])
            .find(|value| !(value.abs() <= LARGEST_LIFT_OFF_SPEED))
    }

    /// s(τ) and ṡ(τ).
    pub fn stretch(&self, time: f64) -> (f64, f64) {
        let (sin, cos) = pxfm::f_sincos(time);
        let (s, rate) = self.stretch;
        (s * cos + rate * sin, rate * cos - s * sin)
    }

    /// G(τ) = (1+M) y₂ and G'(τ).
    pub fn height(&self, time: f64) -> (f64, f64) {
        let (s, s_rate) = self.stretch;
        if time.abs() > NEAR_START {
            let (p, p_rate) = self.momentum;
            let (now, now_rate) = self.stretch(time);
            return (p + time * (p_rate - 0.5 * time) - now, p_rate - time - now_rate);
        }
        let half = 0.5 * time;
        let sin_half = pxfm::f_sin(half);
        let versine = 2.0 * sin_half * sin_half; // 1 − cos τ
        let sin_minus = pxfm::f_sinmx(time); // sin τ − τ
        let bend = 2.0 * pxfm::f_sinmx(half) * (half + sin_half); // 1 − cos τ − τ²/2
        let (g, g_rate) = self.height;
        (
            g + g_rate * time + (s - 1.0) * versine + bend - s_rate * sin_minus,
            g_rate + (s - 1.0) * pxfm::f_sin(time) + sin_minus + s_rate * versine,
        )
    }

    /// The state of both masses at `time`.
    pub fn state(&self, time: f64) -> HopperState {
        let (g, g_rate) = self.height(time);
        let (s, s_rate) = self.stretch(time);
        let whole = 1.0 + self.mass_ratio;
        let (lower_position, lower_velocity) = (g / whole, g_rate / whole);
        HopperState {
            upper_position: lower_position + s,
            upper_velocity: lower_velocity + s_rate,
            lower_position,
            lower_velocity,
        }
    }
}
