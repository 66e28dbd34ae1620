//! How far α′² moves if the lift-off speed moves by at most a given error.
//!
//! The derivative of α′² = α² − μ Σ Γ² along the flights of a hop keeps its signs, so that the parts of a chain of flights
//! cancel as they do in the map. An orbit that leaves a fixed point slowly then loses a factor near 1 at each hop. A sum of
//! absolute values would lose a factor of 2 to 12 there, and after some ten hops all digits.
//!
//! ```text
//!   |F(ξ) − F(α)| ≤ |∂F/∂α| g + g² + second order          |ξ − α| ≤ g
//! ```
//!
//! docs/theory.md, Lemma 78: the first order is proved, the second is an estimate.

use crate::kernel::scalar::hop::MassFactors;
use crate::landing::flight_derivative::{FlightDerivative, Variation};
use crate::landing::flight_ends::{Landing, TakeOff};

/// The second order in units of q times the sum of the absolute values of all terms of the derivative, for each flight of
/// the hop. q is the largest relative change of a time of flight, of a closing speed or of the stretch of a sudden lift-off
/// within the error. A term of the derivative has at most five factors that change with q, each of them by about q, and the
/// changes add up from flight to flight. It is an estimate: searches that climb to large ratios needed up to about 16, and
/// found none that needs 64. `cargo xtask check-bounds` measures the bound against longer arithmetic.
const SECOND_ORDER: f64 = 64.0;

/// Largest q. Beyond it the expansion is not used, and the orbit is followed in longer arithmetic.
const LARGEST_CHANGE: f64 = 1.0 / 64.0;

/// Rounding error of the slope, in ulps of the sizes of its terms, for each flight. The coefficients of a flight's derivative
/// err by less than 32 ulps (docs/theory.md, Theorem 60); 64 leaves room for the sums. It is an estimate as well. It does
/// not contain the error of the phase in the sines, 4ετ. In `f64` the second order is larger than that, because the error of
/// the speed is at least its rounding. In longer arithmetic it is neglected; it matters only if the slope cancels to a part
/// 4ετ of its terms. A larger value makes no visible difference: this term is 10⁻¹⁴ of the bound, unless the slope cancels.
const SLOPE_ULPS: f64 = 64.0;

/// Bound on |F(ξ) − F(α)| for |ξ − α| ≤ `error`, to second order, from the `landings` of the hop from `alpha`. `None` if
/// the error is too large for the expansion.
pub(crate) fn change_of_square(
    alpha: f64,
    error: f64,
    landings: &[Landing],
    factors: MassFactors,
) -> Option<f64> {
    if error == 0.0 {
        return Some(0.0);
    }
    tangent_of_square(alpha, error, landings, factors).map(|tangent| tangent.change(error))
}

/// The tangent of F: |F(α + y) − F(α) − `slope` y| ≤ `rounding` |y| + `second` y².
#[derive(Debug, Clone, Copy)]
pub(crate) struct SquareTangent {
    pub(crate) slope: f64,
    /// Bound on the error of `slope`.
    pub(crate) rounding: f64,
    /// The second order.
    pub(crate) second: f64,
}

impl SquareTangent {
    /// Bound on |F(α + y) − F(α)| for |y| ≤ `error`.
    pub(crate) fn change(&self, error: f64) -> f64 {
        error * (self.slope.abs() + self.rounding + self.second * error)
    }
}

/// The tangent of F at `alpha`, for |y| ≤ `error`; `None` if the error is too large for the expansion.
pub(crate) fn tangent_of_square(
    alpha: f64,
    error: f64,
    landings: &[Landing],
    MassFactors { mu, kappa }: MassFactors,
) -> Option<SquareTangent> {
    let mut start = TakeOff { excess: 0.0, velocity: alpha };
    let mut by_speed = Variation { excess: 0.0, velocity: 1.0 };
    // Σ Γ ∂Γ/∂α; its terms by absolute value; the part of the second order from a change of x′.
    let (mut sum, mut sizes, mut bend) = (0.0, 0.0, 0.0);
    let mut largest_rate = 0.0_f64;
    for landing in landings {
        let gamma = landing.closing_speed;
        if !(gamma > 0.0) {
            return None;
        }
        let flight = FlightDerivative::new(start, landing, kappa);
        let (after, closing) = flight.carry(by_speed);
        let size = Variation { excess: by_speed.excess.abs(), velocity: by_speed.velocity.abs() };
        let (most, most_closing) = flight.bound(size);
        // |∂τ/∂α|: the bound of V′ is |dV| + |dτ| + κ |dΓ|.
        let time = (most.velocity - size.velocity - kappa * most_closing).abs();
        largest_rate = largest_rate.max(time / landing.time.min(1.0)).max(most_closing / gamma);
        if start.excess > 0.0 {
            // Just above nπ the stretch after a landing changes much faster than the times.
            largest_rate = largest_rate.max(size.excess / start.excess);
        }
        sum += gamma * closing;
        sizes += gamma * most_closing;
        bend += gamma * most.excess * time;
        by_speed = after;
        start = landing.take_off();
    }
    if !(error * largest_rate <= LARGEST_CHANGE) {
        return None;
    }
    let flights = landings.len() as f64;
    let second = 1.0 + 2.0 * mu * (SECOND_ORDER * flights * largest_rate * sizes + bend);
    let rounding = SLOPE_ULPS * flights * f64::EPSILON * (alpha + mu * sizes);
    let tangent = SquareTangent { slope: 2.0 * (alpha - mu * sum), rounding, second };
    tangent.change(error).is_finite().then_some(tangent)
}

#[cfg(test)]
mod tests {
    use crate::map::hop_within::HopWithin;
    use crate::map::lift_off_map::LiftOffMap;
    use crate::model::mass_ratio::MassRatio;

    /// Just above nπ the stretch after a landing is small, and an error of the speed changes it most. A bound without the
    /// relative change of the stretch was up to 1.4 times too small here.
    #[test]
    fn speeds_just_above_multiples_of_pi_meet_their_bound() {
        for (m, alpha, error) in [
            (35.338_767_201_397_19, 62.831_894_844_550_58, 5.925_672_633_463_667_5e-6),
            (31.133_898_172_755_95, 59.694_486_541_050_64, 0.000_573_896_046_755_097_7),
            (12.122_335_839_410_708, 62.834_019_476_662_8, 1.985_687_607_994_052e-5),
        ] {
            let map = LiftOffMap::new(MassRatio::new(m).unwrap());
            for (error, decided) in [(error, false), (1e-5 * error, true)] {
                let found = map.signed_hop_within(alpha, error);
                let HopWithin::Next { speed, error: bound } = found else {
                    assert!(!decided, "M = {m}, α = {alpha}: {found:?}");
                    continue; // no bound is claimed
                };
                for k in -8..=8 {
                    let start = alpha + 0.999 * error * f64::from(k) / 8.0;
                    let next = map.image(start).unwrap().unwrap();
                    assert!((next - speed).abs() <= bound, "M = {m}, from {start}: {next}");
                }
            }
        }
    }
}
