//! The root h of V(h) = V in an interval on which V(h) increases, and the landing there.

use crate::landing::flight_ends::{Landing, TakeOff, is_sudden, state_after_flight};
use crate::landing::half_time::HalfTime;

/// A root of V(h) = V: an `f64` h, and the exact root minus this h.
pub(crate) struct HalfTimeRoot {
    pub(crate) half: HalfTime<f64>,
    /// V(h) − V.
    residual: f64,
    /// The exact root minus h.
    rest: f64,
    /// The interval that holds the root, with its ends rounded.
    pub(crate) bracket: (f64, f64),
}

/// Number of steps after which only the middle of the bracket is taken. Halving alone leaves no `f64` in a bracket
/// after 53 steps from a bracket of the root's own size, and after 1127 from one that reaches down to 0. So the
/// search always ends by one of the rules of docs/theory.md, Lemma 59. Halley's steps converge long before in all
/// tests.
const HALLEY_STEPS: usize = 200;

/// Added to |V − h| in the scale of the tolerance, so that the tolerance is not zero where V − h vanishes.
///
/// The rounding error of the residual is up to 16 ulps of |V − h| + 1 (docs/theory.md, Lemma 58): a tolerance far below
/// that would not be met. A residual within the tolerance is still removed to first order, so that a larger value would
/// cost accuracy only where that fails, next to a touch. The error bound counts the tolerance there
/// (`error_bound.rs`).
pub(crate) const LARGE_DIFFERENCE: f64 = 8.0;

/// Largest relative corrections of h and of Γ² that are left to first order. What they leave is at most 8·10⁻¹⁸ of
/// h, or of 1 where h > 1: a tenth of half an ulp (docs/theory.md, Lemma 59). A larger value would lose digits; a
/// smaller one costs steps.
const FIRST_ORDER: f64 = 1e-9;

/// The correction may leave the bracket by this many ε = 2⁻⁵² of h: the ends nπ and (n+1)π of a bracket are rounded
/// by an ulp, and a landing may lie between the rounded end and the exact one. V(h) increases there too.
const ROUNDED_ENDS: f64 = 1.0;

impl HalfTimeRoot {
    /// Halley's method inside a bracket on which V(h) increases, from `start` or from the middle.
    ///
    /// The residual is a backward error in V. The search stops when the residual is about an ulp of V, or an ulp of |V
    /// − h| + 8 where this is smaller. The map is then accurate even where h is not: at α*_n, a triple root, h has only
    /// a third of its digits. The search also stops when the residual is so small that a correction of first order
    /// removes it.
    pub(crate) fn solve(excess: f64, velocity: f64, bracket: (f64, f64), start: f64) -> Self {
        let (mut left, mut right) = bracket;
        let mut h = if start > left && start < right { start } else { 0.5 * (left + right) };
        let mut half = HalfTime::at(h);
        let mut residual = (h - velocity) + half.speed_beyond_h(excess);
        for step_number in 0.. {
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
            let inside = halley > left && halley < right && step_number < HALLEY_STEPS;
            let next = if inside { halley } else { 0.5 * (left + right) };
            if !(next > left && next < right) {
                break; // no f64 is left in the bracket, or an end of it is NaN
            }
            h = next;
            half = HalfTime::at(h);
            residual = (h - velocity) + half.speed_beyond_h(excess);
        }
        let beyond = ROUNDED_ENDS * f64::EPSILON * h;
        let rest = (-residual / half.start_speed_slope(excess))
            .clamp(left.min(h) - h - beyond, right.max(h) - h + beyond);
        // At a triple root both residual and slope may be zero.
        let rest = if rest.is_nan() { 0.0 } else { rest };
        HalfTimeRoot { half, residual, rest, bracket }
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
        let start = TakeOff { excess, velocity };
        let (landed, upper) = state_after_flight(start, h, rest, kappa, closing_speed);
        let sudden = sudden.unwrap_or(is_sudden(landed, upper));
        Landing { time: 2.0 * (h + rest), closing_speed, excess: landed, velocity: upper, sudden }
    }
}

/// Whether the residual is so small that corrections of first order leave errors below an ulp, both of h and of Γ².
fn is_linear(half: &HalfTime<f64>, residual: f64, excess: f64) -> bool {
    let closing = half.closing_speed(excess);
    let step = residual.abs() / half.start_speed_slope(excess);
    step <= FIRST_ORDER * half.h.min(1.0)
        && (residual * half.loss_slope(excess)).abs() <= FIRST_ORDER * closing * closing
}

/// Halley's step, or Newton's step where the two differ by more than a factor of two: there the second derivative is
/// too large for Halley's step to be an improvement.
fn halley(residual: f64, slope: f64, bend: f64) -> f64 {
    let newton = residual / slope;
    let bent = 1.0 - 0.5 * newton * (bend / slope);
    if bent > 0.5 && bent < 2.0 { newton / bent } else { newton }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landing::error_bound::BACKWARD_ULPS;
    use crate::precision::long::Long;
    use crate::precision::real::Real;
    use basin_of_attraction::SplitMix64;

    /// |computed − exact| of V(h) − V, with V next to V(h), over |V − h| + min(1, τ), in ulps.
    fn residual_error(h: f64, excess: f64) -> f64 {
        let (half, exact) = (HalfTime::at(h), HalfTime::extended_at(Long::<4>::from(h)));
        let velocity = exact.start_speed(Long::from(excess)).nearest();
        let residual = (h - velocity) + half.speed_beyond_h(excess);
        let longer =
            Long::<4>::from(h) - Long::from(velocity) + exact.speed_beyond_h(excess.into());
        let error = (longer - Long::from(residual)).nearest().abs();
        error / (f64::EPSILON * ((velocity - h).abs() + (2.0 * h).min(1.0)))
    }

    /// docs/theory.md, Lemma 58.
    #[test]
    fn residuals_err_by_less_than_their_bound() {
        let generator = SplitMix64::from_state(58);
        let mut largest = (0.0, 0.0, 0.0);
        for k in 0..40_000u64 {
            let part = |i| generator.uniform(4 * k + i);
            let h = match k % 3 {
                0 => 0.5 + 0.1 * part(0),
                1 => 0.5 + 60.0 * part(0) * part(0),
                _ => 0.5 * pxfm::f_exp10(-8.0 * part(0)),
            };
            let excess = pxfm::f_exp10(12.0 * part(1) - 8.0);
            let error = residual_error(h, excess);
            if error > largest.0 {
                largest = (error, h, excess);
            }
        }
        assert!(largest.0 <= BACKWARD_ULPS, "{largest:?}");
        // The largest of these 40 000 errors. One ulp, an earlier bound, is exceeded five times.
        let planted = residual_error(0.525493336423793, 5547.378407116755);
        assert!(planted > 5.6 && largest.0 >= planted, "{planted} {largest:?}");
    }
}
