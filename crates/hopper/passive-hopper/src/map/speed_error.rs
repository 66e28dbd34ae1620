//! How far α′² moves if the lift-off speed and the mass ratio move by at most given errors.
//!
//! The derivative of α′² = α² − μ Σ Γ² along the flights of a hop keeps its signs, so that the parts of a chain of
//! flights cancel as they do in the map. An orbit that leaves a fixed point slowly then loses a factor near 1 at
//! each hop. A sum of absolute values would lose a factor of 2 to 12 there, and after some ten hops all digits.
//!
//! ```text
//!   |F(ξ) − F(α)| ≤ |∂F/∂α| g + g² + second order          |ξ − α| ≤ g
//! ```
//!
//! The mass ratio enters by κ = M/(1+M) alone, as μ = κ (1 − κ). A change of κ adds Γ dκ to dV at each landing.
//!
//! docs/theory.md, Lemma 78: the first order is proved, the second is an estimate.

use crate::kernel::scalar::hop::MassFactors;
use crate::landing::flight_derivative::{FlightDerivative, Variation};
use crate::landing::flight_ends::{Landing, TakeOff};

/// The second order in units of q times the sum of the absolute values of all terms of the derivative, for each
/// flight of the hop. q is the largest relative change of a time of flight, of a closing speed or of the stretch of
/// a sudden lift-off within the error. A term of the derivative has at most five factors that change with q, each
/// of them by about q, and the changes add up from flight to flight. It is an estimate: searches that climb to
/// large ratios needed up to about 16, and found none that needs 64. `cargo xtask check-bounds` measures the bound
/// against longer arithmetic.
const SECOND_ORDER: f64 = 64.0;

/// Largest q. Beyond it the expansion is not used, and the orbit is followed in longer arithmetic.
const LARGEST_CHANGE: f64 = 1.0 / 64.0;

/// Bound on the change of Σ Γ² in units of Σ Γ |dΓ|: 2, and the second order, for the product with the change of μ.
/// With relative changes of at most 1/64 the second order is below the first.
const CHANGES_OF_BOTH: f64 = 4.0;

/// Rounding error of the slope, in ulps of the sizes of its terms, for each flight. The coefficients of a flight's
/// derivative err by less than 32 ulps (docs/theory.md, Theorem 60); 64 leaves room for the sums. It is an estimate
/// as well. It does not contain the error of the phase in the sines, 4ετ. In `f64` the second order is larger than
/// that, because the error of the speed is at least its rounding. In longer arithmetic it is neglected; it matters
/// only if the slope cancels to a part 4ετ of its terms. A larger value makes no visible difference: this term is
/// 10⁻¹⁴ of the bound, unless the slope cancels.
const SLOPE_ULPS: f64 = 64.0;

/// The largest changes of a speed and of κ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Changes {
    pub(crate) speed: f64,
    pub(crate) kappa: f64,
}

impl Changes {
    /// No change of κ.
    pub(crate) fn of_speed(speed: f64) -> Self {
        Changes { speed, kappa: 0.0 }
    }
}

/// Bound on |F(ξ, κ′) − F(α, κ)| for all ξ and κ′ within `changes`, to second order, from the `landings` of the hop
/// from `alpha`. `None` if the changes are too large for the expansion.
pub(crate) fn change_of_square(
    alpha: f64,
    changes: Changes,
    landings: &[Landing],
    factors: MassFactors,
) -> Option<f64> {
    if changes == Changes::of_speed(0.0) {
        return Some(0.0);
    }
    tangent_of_square(alpha, changes, landings, factors).map(|tangent| tangent.change())
}

/// The tangent of F: |F(α + y, κ + k) − F(α, κ) − `by_speed` y − `by_kappa` k| ≤ `rounding` s + `second` s², where
/// s ≤ 1 is the larger one of |y| and |k| in units of the largest changes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SquareTangent {
    pub(crate) changes: Changes,
    pub(crate) by_speed: f64,
    pub(crate) by_kappa: f64,
    /// Bound on the errors of the slopes, times the changes.
    pub(crate) rounding: f64,
    /// The second order.
    pub(crate) second: f64,
}

impl SquareTangent {
    /// Bound on the change of F, for s = 1.
    pub(crate) fn change(&self) -> f64 {
        self.first_order() + self.rounding + self.second
    }

    /// Bound on the part of the slopes.
    pub(crate) fn first_order(&self) -> f64 {
        (self.changes.speed * self.by_speed).abs() + (self.changes.kappa * self.by_kappa).abs()
    }
}

/// The tangent of F at `alpha`; `None` if the changes are too large for the expansion.
pub(crate) fn tangent_of_square(
    alpha: f64,
    changes: Changes,
    landings: &[Landing],
    factors: MassFactors,
) -> Option<SquareTangent> {
    let mut start = TakeOff { excess: 0.0, velocity: alpha };
    let mut sums = TangentSums::new(alpha, changes, factors);
    for landing in landings {
        sums.add(landing, &FlightDerivative::new(start, landing, factors.kappa));
        start = landing.take_off();
    }
    sums.tangent()
}

/// The sums over the flights of a hop from which its tangent follows.
#[derive(Debug, Clone)]
pub(crate) struct TangentSums {
    alpha: f64,
    changes: Changes,
    factors: MassFactors,
    /// x at the start of the next flight.
    excess: f64,
    /// The derivatives of the state there.
    by_speed: Variation,
    by_kappa: Variation,
    /// Σ Γ ∂Γ by the speed and by κ; Σ Γ².
    speed_sum: f64,
    kappa_sum: f64,
    squares: f64,
    /// For the largest changes: the terms of ΓdΓ by absolute value, and the part of the second order from a change
    /// of x′.
    sizes: f64,
    bend: f64,
    largest_change: f64,
    flights: f64,
}

impl TangentSums {
    pub(crate) fn new(alpha: f64, changes: Changes, factors: MassFactors) -> Self {
        TangentSums {
            alpha,
            changes,
            factors,
            excess: 0.0,
            by_speed: Variation { excess: 0.0, velocity: 1.0 },
            by_kappa: Variation { excess: 0.0, velocity: 0.0 },
            speed_sum: 0.0,
            kappa_sum: 0.0,
            squares: 0.0,
            sizes: 0.0,
            bend: 0.0,
            largest_change: 0.0,
            flights: 0.0,
        }
    }

    /// Adds the next flight.
    pub(crate) fn add(&mut self, landing: &Landing, flight: &FlightDerivative) {
        let (changes, kappa) = (self.changes, self.factors.kappa);
        self.flights += 1.0;
        let gamma = landing.closing_speed;
        if !(gamma > 0.0) {
            self.largest_change = f64::INFINITY;
            return;
        }
        let size = Variation {
            excess: changes.speed * self.by_speed.excess.abs()
                + changes.kappa * self.by_kappa.excess.abs(),
            velocity: changes.speed * self.by_speed.velocity.abs()
                + changes.kappa * self.by_kappa.velocity.abs(),
        };
        let (most, most_closing) = flight.bound(size);
        // |dτ|: the bound of V′ is |dV| + |dτ| + κ |dΓ|.
        let time = (most.velocity - size.velocity - kappa * most_closing).abs();
        let mut change = (time / landing.time.min(1.0)).max(most_closing / gamma);
        if self.excess > 0.0 {
            // Just above nπ the stretch after a landing changes much faster than the times.
            change = change.max(size.excess / self.excess);
        }
        self.largest_change = self.largest_change.max(change);
        let (after, closing) = flight.carry(self.by_speed);
        self.speed_sum += gamma * closing;
        self.by_speed = after;
        if changes.kappa > 0.0 {
            let (mut after, closing) = flight.carry(self.by_kappa);
            after.velocity += gamma;
            self.kappa_sum += gamma * closing;
            self.by_kappa = after;
        }
        self.squares += gamma * gamma;
        self.sizes += gamma * most_closing;
        self.bend += gamma * most.excess * time;
        self.excess = landing.excess;
    }

    /// The tangent; `None` if the changes are too large for the expansion.
    pub(crate) fn tangent(&self) -> Option<SquareTangent> {
        let &TangentSums { alpha, changes, flights, largest_change, squares, sizes, .. } = self;
        if !(largest_change <= LARGEST_CHANGE) {
            return None;
        }
        let MassFactors { mu, kappa } = self.factors;
        // dμ = (1 − 2κ) dκ − dκ²
        let slope_of_mu = 1.0 - 2.0 * kappa;
        let change_of_mu = (slope_of_mu.abs() + changes.kappa) * changes.kappa;
        let second = changes.speed * changes.speed
            + 2.0 * mu * (SECOND_ORDER * flights * largest_change * sizes + self.bend)
            + changes.kappa * changes.kappa * squares
            + CHANGES_OF_BOTH * change_of_mu * sizes;
        let terms = alpha * changes.speed + mu * sizes + change_of_mu * squares;
        let tangent = SquareTangent {
            changes,
            by_speed: 2.0 * (alpha - mu * self.speed_sum),
            by_kappa: -(slope_of_mu * squares + 2.0 * mu * self.kappa_sum),
            rounding: SLOPE_ULPS * flights * f64::EPSILON * terms,
            second,
        };
        tangent.change().is_finite().then_some(tangent)
    }
}

#[cfg(test)]
mod tests {
    use crate::map::hop_within::HopWithin;
    use crate::map::lift_off_map::LiftOffMap;
    use crate::model::mass_ratio::MassRatio;

    /// Just above nπ the stretch after a landing is small, and an error of the speed changes it most. A bound
    /// without the relative change of the stretch was up to 1.4 times too small here.
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
