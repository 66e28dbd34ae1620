//! The root h of V(h) = V in an interval on which V(h) increases, and the landing there.

use crate::landing::flight_ends::{Landing, is_sudden};
use crate::landing::half_time::HalfTime;

/// A root of V(h) = V: an `f64` h, and the rest to the exact root.
pub(crate) struct HalfTimeRoot {
    pub(crate) half: HalfTime<f64>,
    /// V(h) − V.
    residual: f64,
    /// The exact root minus h.
    rest: f64,
}

/// Guard on the number of steps, never reached: bisection alone ends within 64 + 53 steps of any bracket.
const MOST_STEPS: usize = 200;

/// Up to this |V − h| the residual is small enough at an ulp of V. Only for larger |V − h| an ulp of V − h may be
/// much less than one of V, and is asked for. Chosen, not derived.
const LARGE_DIFFERENCE: f64 = 8.0;

/// A relative correction whose square, 10⁻¹⁸, is less than an ulp: of such corrections the first order suffices.
const FIRST_ORDER: f64 = 1e-9;

impl HalfTimeRoot {
    /// Halley's method inside a bracket on which V(h) increases, from `start` or from the middle.
    ///
    /// The residual is a backward error in V. The search stops when it is about an ulp of V, or of V − h where that
    /// is much smaller. Then the map is right, even where h is not: at α*_n, a triple root, h is known to a third of
    /// the digits. The search also stops when the residual is so small that a correction of first order removes it.
    pub(crate) fn solve(excess: f64, velocity: f64, bracket: (f64, f64), start: f64) -> Self {
        let (mut left, mut right) = bracket;
        let mut h = if start > left && start < right { start } else { 0.5 * (left + right) };
        let mut half = HalfTime::at(h);
        let mut residual = (h - velocity) + half.speed_beyond_h(excess);
        for _ in 0..MOST_STEPS {
            let scale = velocity.abs().min(h).min((h - velocity).abs() + LARGE_DIFFERENCE);
            if residual.abs() <= f64::EPSILON * scale || is_linear(&half, residual, excess) {
                break;
            }
            if residual > 0.0 {
                right = h;
            } else {
                left = h;
            }
            let step =
                halley(residual, half.start_speed_slope(excess), half.start_speed_bend(excess));
            let halley = h - step;
            // A step out of the bracket is replaced by a bisection.
            let next = if halley > left && halley < right { halley } else { 0.5 * (left + right) };
            if next <= left || next >= right {
                break; // no f64 is left in the bracket
            }
            h = next;
            half = HalfTime::at(h);
            residual = (h - velocity) + half.speed_beyond_h(excess);
        }
        let rest =
            (-residual / half.start_speed_slope(excess)).clamp(left.min(h) - h, right.max(h) - h);
        // At a triple root both residual and slope may be zero.
        HalfTimeRoot { half, residual, rest: if rest.is_nan() { 0.0 } else { rest } }
    }

    /// The landing at the root, corrected to first order in `rest`; `sudden` if it is known already.
    pub(crate) fn landing(
        &self,
        excess: f64,
        velocity: f64,
        kappa: f64,
        sudden: Option<bool>,
    ) -> Landing {
        let half = &self.half;
        let (h, rest) = (half.h, self.rest);
        let loss_slope = half.loss_slope(excess);
        let uncorrected = half.closing_speed(excess);
        // Γ² changes by −residual d(Γ²)/dV.
        let change = self.residual / uncorrected * (loss_slope / uncorrected);
        let closing_speed = if change.abs() < 0.5 {
            uncorrected * (1.0 - change).sqrt()
        } else {
            // Next to a triple root Γ is nearly zero, and the correction may be as large as Γ² itself.
            (uncorrected * uncorrected - self.residual * loss_slope).max(0.0).sqrt()
        };
        // x' = x + 2h (V − h) on the parabola of the momentum coordinate, moved by `rest`.
        let landed = excess + 2.0 * h * (velocity - h) + 2.0 * rest * (velocity - 2.0 * h);
        let upper = (velocity - 2.0 * h) - 2.0 * rest + kappa * closing_speed;
        let sudden = sudden.unwrap_or(is_sudden(landed, upper));
        Landing { time: 2.0 * (h + rest), closing_speed, excess: landed, velocity: upper, sudden }
    }
}

/// Whether the residual is so small that corrections of first order leave less than an ulp: of h, and of Γ².
fn is_linear(half: &HalfTime<f64>, residual: f64, excess: f64) -> bool {
    let closing = half.closing_speed(excess);
    let step = residual.abs() / half.start_speed_slope(excess);
    step <= FIRST_ORDER * half.h.min(1.0)
        && (residual * half.loss_slope(excess)).abs() <= FIRST_ORDER * closing * closing
}

/// Halley's step, or Newton's where the two differ by more than a factor of two: there the bend is too large for
/// Halley's step to be an improvement.
fn halley(residual: f64, slope: f64, bend: f64) -> f64 {
    let newton = residual / slope;
    let bent = 1.0 - 0.5 * newton * (bend / slope);
    if bent > 0.5 && bent < 2.0 { newton / bent } else { newton }
}
