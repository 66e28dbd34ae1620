//! Are the decisions of a hop, and its value, larger than their errors?
//!
//! A *decision* of a hop is the sign of a computed number: whether a landing is sudden (x′), on which branch a flight
//! lands (the maximum test), whether the hopper lifts off again (α′²). A decision is *inconclusive* if the number is
//! not larger than the bound on its error. The hop is then computed again in longer arithmetic.
//!
//! The error has three parts. Each flight adds the rounding errors of its own landing. The search for the landing
//! leaves an error that acts like one of the start speed. Each flight also propagates the error of its start to its
//! end, by its derivative and a bound on the terms of second order. The propagated part grows along a chain of
//! sudden lift-offs.
//!
//! The bounds are derived in docs/theory.md, section 13: the rounding of a landing in Lemma 58, the kernel's in
//! Lemma 61, propagation in Theorem 60, the decisions in Theorem 66.

use crate::landing::flight_derivative::{FlightDerivative, Variation};
use crate::landing::flight_ends::{Landing, TakeOff};
use crate::landing::half_time_root::LARGE_DIFFERENCE;
use crate::landing::next_landing::{MaximumTest, maximum_test};
use std::f64::consts::PI;

/// Bound on the direct rounding errors of x′, V′ and Γ at a landing, in ulps of the sum of all quantities in it,
/// 1 + x + |V| + τ + Γ.
///
/// docs/theory.md, Lemma 58: 28 suffice for x′, 17 for V′ and 12 for Γ; Lemma 63: 32 for the longer arithmetics. A
/// larger value sends more hops to the longer arithmetic: with twice the value twice as many decisions are
/// inconclusive, some in 10¹².
pub(crate) const LANDING_ULPS: f64 = 32.0;

/// Bound on the rounding error of the residual V(h) − V, in ulps of |V − h| + min(1, τ) in the general solver, and of
/// 1 + x + |V| + τ + Γ in the kernel and in longer arithmetic. It acts like an error of V at the start of the flight.
///
/// docs/theory.md, Lemmas 58, 61 and 63. The derivation comes nearest to this value at h = ½ in the general solver
/// (28.2 of 32 half ulps) and at h = π/4 in the kernel, where D = h − sin h cos h cancels most. The largest error
/// of the general solver that a search found is 5.6 (a test in `half_time_root.rs`).
pub(crate) const BACKWARD_ULPS: f64 = 16.0;

/// Largest sum q of the terms that Theorem 60 of docs/theory.md compares with Γ: with q below this number the
/// linear map of the flight, with a part 4q added, bounds the change of its landing. A flight with a larger q
/// nearly touches the ground, or is so short that its start is hardly known. It counts as inconclusive.
///
/// The theorem needs q ≤ ¼. A smaller limit keeps the bound near the linear one and sends some flights in 10¹² more to
/// the longer arithmetic.
const LARGEST_NONLINEARITY: f64 = 1.0 / 16.0;

/// The propagated error is increased by this part of its bound without cancellation, for the rounding errors of the
/// derivative's coefficients in `f64`. They are below 64 ulps apart from the error of the phase, which is counted
/// separately (docs/theory.md, Theorem 60). The value 10⁻⁶ also covers the rounding of the bound itself and changes no
/// bound noticeably.
const DERIVATIVE_ERROR: f64 = 1e-6;

/// Factor of ετ in the error of the derivative's sines: their phase τ is stored with an error of ετ/2 and h = τ/2 +
/// rest with as much, and |d sin τ|, |d(1 − cos τ)| ≤ dτ, twice for each product.
const PHASE_ULPS: f64 = 4.0;

/// Factor of (1 + x + |V| + τ + Γ) T² in the terms of second order of x′ and Γ, with T a bound on the change of the
/// time. Taylor's formula gives ½; the first-order correction of the search leaves ½ T² in x′ and 14 times the sum
/// in Γ (docs/theory.md, Theorem 60). T² is 10⁻²⁶ except near a touch.
const SECOND_ORDER: f64 = 16.0;

/// dΓ²/dα = 8α Su changes by at most 16 α (1 + h) for each unit of h, as |(Su)′| ≤ 2 (1 + h) (docs/theory.md, Lemma
/// 62).
const LOSS_BEND: f64 = 16.0;

/// A change e of the speed moves h by at most 2.5 e^{1/3}, and by 2e for h < π (docs/theory.md, Lemma 62).
fn largest_shift(half: f64, change: f64) -> f64 {
    if half < PI { 2.0 * change } else { 2.5 * pxfm::f_cbrt(change) }
}

/// A running bound on the error of the state on the ground.
///
/// The first landing is decided on the 100 bits of α*_n (docs/theory.md, Lemma 65). The decisions after it can be
/// inconclusive.
#[derive(Debug, Clone)]
pub(crate) struct ErrorBound {
    start: TakeOff,
    error: Variation,
    inconclusive: bool,
    flights: f64,
    /// Relative rounding error of the arithmetic.
    epsilon: f64,
    /// True if the sine of a stored argument is right to an ulp of the sine, as in `f64`. In the longer arithmetics the
    /// error of the sine is an ulp of the argument.
    sines_are_exact: bool,
    /// Bound on the error of Σ Γ² apart from that of the sum: of each landing, and propagated from flight to flight.
    loss: f64,
    /// The maximum test of the last flight that had two possible branches.
    last_test: Option<MaximumTest>,
}

impl ErrorBound {
    /// For a hop from `alpha` in `f64`.
    pub(crate) fn of_f64(alpha: f64) -> Self {
        Self::new(alpha, f64::EPSILON, true)
    }

    /// For a hop from `alpha` in an arithmetic with relative error `epsilon`.
    pub(crate) fn of_extended(alpha: f64, epsilon: f64) -> Self {
        Self::new(alpha, epsilon, false)
    }

    fn new(alpha: f64, epsilon: f64, sines_are_exact: bool) -> Self {
        ErrorBound {
            start: TakeOff { excess: 0.0, velocity: alpha },
            error: Variation { excess: 0.0, velocity: 0.0 },
            inconclusive: false,
            flights: 0.0,
            epsilon,
            sines_are_exact,
            loss: 0.0,
            last_test: None,
        }
    }

    /// The same bound for a hop whose lift-off speed is known to within `error`.
    pub(crate) fn with_speed_error(self, error: f64) -> Self {
        ErrorBound { error: Variation { excess: 0.0, velocity: error }, ..self }
    }

    /// Adds the error of V′ that a change of κ causes at the last landing, with closing speed `gamma`.
    pub(crate) fn add_kappa_error(&mut self, change: f64, gamma: f64) {
        /// More than the change of Γ by the errors, where the landing is conclusive.
        const CHANGE_OF_GAMMA: f64 = 1.05;
        self.error.velocity += CHANGE_OF_GAMMA * change * gamma;
    }

    /// Adds an error of x′ and V′ after the last landing.
    pub(crate) fn add_state_error(&mut self, error: f64) {
        self.error.excess += error;
        self.error.velocity += error;
    }

    #[cfg(feature = "hybrid-system")]
    /// The same bound for a flight that starts after a sudden landing, in a state without error.
    pub(crate) fn starting_at(self, start: TakeOff) -> Self {
        ErrorBound { start, flights: 1.0, ..self }
    }

    /// Propagates the bound through a flight to its landing. The maximum test of the branch is computed in `f64`.
    pub(crate) fn add_flight(&mut self, landing: &Landing, kappa: f64) {
        self.add_differentiated(landing, &FlightDerivative::new(self.start, landing, kappa), kappa);
    }

    /// As [`add_flight`](Self::add_flight), with the derivative of this flight.
    pub(crate) fn add_differentiated(&mut self, end: &Landing, by: &FlightDerivative, kappa: f64) {
        let TakeOff { excess, velocity } = self.start;
        let test = if velocity >= PI { maximum_test(excess, velocity) } else { f64::INFINITY };
        self.add(end, kappa, test, by);
    }

    /// As [`add_flight`](Self::add_flight), with the maximum test that decided the branch, or infinity if only one
    /// branch was possible.
    pub(crate) fn add_flight_on_branch(&mut self, landing: &Landing, kappa: f64, test: f64) {
        self.add(landing, kappa, test, &FlightDerivative::new(self.start, landing, kappa));
    }

    fn add(&mut self, landing: &Landing, kappa: f64, test: f64, derivative: &FlightDerivative) {
        let first = self.flights == 0.0;
        self.flights += 1.0;
        let TakeOff { excess, velocity } = self.start;
        let size = 1.0 + excess + velocity.abs() + landing.time + landing.closing_speed;
        let rounding = LANDING_ULPS * self.epsilon * size;
        if !first {
            // The test is V cos V − Y sin V. Its own rounding errors are below 2 ulps of the size, an error e of Y
            // changes it by at most e, and an error e of V by at most (x + V) e (docs/theory.md, Lemma 64).
            let slack = rounding + self.error.excess + size * self.error.velocity;
            self.inconclusive |= test.abs() <= slack;
            let two_branches = test.is_finite();
            self.last_test = two_branches.then_some(MaximumTest { value: test, error: slack });
        }
        let half = 0.5 * landing.time;
        let difference = (velocity - half).abs();
        let backward = if self.sines_are_exact {
            BACKWARD_ULPS * self.epsilon * (difference + landing.time.min(1.0))
        } else {
            BACKWARD_ULPS * self.epsilon * size
        };
        // The largest residual at which the search may stop. It is removed to first order. The rest of it is
        // smaller than the whole (docs/theory.md, Lemma 59).
        let scale = velocity.abs().min(half).min(difference + LARGE_DIFFERENCE);
        let stop = self.epsilon * (scale + landing.closing_speed);
        let change = Variation {
            excess: self.error.excess,
            velocity: self.error.velocity + backward + stop,
        };
        if first && !landing.sudden {
            self.loss += self.only_loss(landing, derivative, change.velocity);
        } else {
            let (after, closing) = self.propagate((landing, derivative), kappa, change, size);
            let closing = rounding + closing;
            self.loss += (2.0 * landing.closing_speed + closing) * closing;
            self.error = Variation {
                excess: rounding + after.excess,
                velocity: rounding + after.velocity + kappa * rounding,
            };
        }
        if !first {
            self.inconclusive |= !(landing.excess.abs() > self.error.excess);
        }
        self.start = landing.take_off();
    }

    /// Bound on the error of Γ² of a first flight that ends in contact, for an error of its speed up to `change`.
    ///
    /// The state after it does not matter, and Γ² is smooth where the time of flight is not, next to α*_n
    /// (docs/theory.md, Lemma 62).
    fn only_loss(&self, landing: &Landing, derivative: &FlightDerivative, change: f64) -> f64 {
        let slope = derivative.largest_loss_slope();
        let half = 0.5 * landing.time;
        let bend = LOSS_BEND * (1.0 + half) * largest_shift(half, change);
        change * (slope + bend * self.start.velocity)
    }

    /// Bounds on the errors of the state after a flight, and of Γ, for errors before the flight that are bounded by
    /// `change`: the linear map of the flight, a part of its bound without cancellation, and the terms of second order
    /// (docs/theory.md, Theorem 60). A flight that is too far from linear is inconclusive.
    fn propagate(
        &mut self,
        (landing, derivative): (&Landing, &FlightDerivative),
        kappa: f64,
        change: Variation,
        size: f64,
    ) -> (Variation, f64) {
        let by_excess = Variation { velocity: 0.0, ..change };
        let by_velocity = Variation { excess: 0.0, ..change };
        let (a, a_closing) = derivative.carry(by_excess);
        let (b, b_closing) = derivative.carry(by_velocity);
        let (most, most_closing) = derivative.bound(change);
        let tau = landing.time;
        // The time changes by less than T = 2N/Γ; two ulps of τ are for the last bits of h.
        let time = 2.0 * derivative.largest_delay(change) + 2.0 * self.epsilon * tau;
        let later = tau + time;
        let nonlinearity = (0.5 * landing.excess.abs() * time
            + size * time * time / 6.0
            + later.min(1.0) * change.excess
            + (0.5 * later * later).min(2.0) * change.velocity)
            / landing.closing_speed;
        // `!` refuses NaN, of a landing with Γ = 0.
        self.inconclusive |= !(nonlinearity <= LARGEST_NONLINEARITY);
        let part = DERIVATIVE_ERROR + PHASE_ULPS * f64::EPSILON * tau + 4.0 * nonlinearity;
        let rest = time * (change.excess + change.velocity + SECOND_ORDER * size * time);
        let after = Variation {
            excess: a.excess.abs() + b.excess.abs() + part * most.excess + rest,
            velocity: a.velocity.abs() + b.velocity.abs() + part * most.velocity + kappa * rest,
        };
        (after, a_closing.abs() + b_closing.abs() + part * most_closing + rest)
    }

    /// Bounds on the errors of x′ and V′ after the last flight; zero after a first landing that starts a contact.
    pub(crate) fn state_error(&self) -> Variation {
        self.error
    }

    /// The maximum test of the last flight, or `None` if only one branch was possible.
    pub(crate) fn last_test(&self) -> Option<MaximumTest> {
        self.last_test
    }

    /// Bound on the rounding errors of one flight in its part μ Γ²/α² of the ratio. The propagated part comes on top of
    /// it.
    pub(crate) fn rounding_of_loss(&self) -> f64 {
        LANDING_ULPS * self.epsilon
    }

    /// Whether the decision of a landing, sudden or not and on which branch, was inconclusive.
    pub(crate) fn landing_inconclusive(&self) -> bool {
        self.inconclusive
    }

    /// Whether any decision is inconclusive, including the sign of `ratio` = α′²/α² = 1 − μ Σ Γ²/α².
    pub(crate) fn inconclusive(&self, ratio: f64, mu: f64, alpha: f64) -> bool {
        self.inconclusive || !(ratio.abs() > self.ratio_error(mu, alpha))
    }

    /// Bound on the error of α′²/α²: the roundings of μ, of the squares and of the sum, which are below 4 + 2 flights
    /// halves of an ulp, and of a first Γ² that starts a contact, below 24 ulps; and the part of the later landings
    /// (docs/theory.md, Theorem 66).
    pub(crate) fn ratio_error(&self, mu: f64, alpha: f64) -> f64 {
        LANDING_ULPS * self.epsilon * (2.0 + self.flights) + self.propagated(mu, alpha)
    }

    /// The part of the bound on the error of α′²/α² that was propagated from flight to flight.
    pub(crate) fn propagated(&self, mu: f64, alpha: f64) -> f64 {
        mu * (self.loss / alpha / alpha)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landing::extended_landing::ExtendedLanding;
    use crate::landing::next_landing::{before_maximum, next_landing, next_root};
    use crate::precision::long::Long;
    use crate::precision::real::Real;
    use basin_of_attraction::SplitMix64;

    type Four = Long<4>;

    /// A bound in the middle of a hop, with this error of the state.
    fn after_first(start: TakeOff, error: f64) -> ErrorBound {
        let mut bound = ErrorBound::of_f64(1.0);
        bound.flights = 1.0;
        bound.start = start;
        bound.error = Variation { excess: error, velocity: error };
        bound
    }

    /// The landing from (x + dx, V + dV) in 256 bits, on the branch of (x, V).
    fn moved_landing(start: TakeOff, dx: f64, dv: f64, kappa: f64) -> ExtendedLanding<Four> {
        let branch = before_maximum(start);
        let (x, v) = (Four::from(start.excess) + dx, Four::from(start.velocity) + dv);
        let moved = TakeOff { excess: x.nearest(), velocity: v.nearest() };
        ExtendedLanding::near(&next_root(moved, branch), x, v, Four::from(kappa))
    }

    /// docs/theory.md, Theorem 60: starts whose errors are known to 10⁻¹² … 10⁻⁴ only, next to touches (V near h
    /// cot h = Y) and with short flights. The landings from the corners of the error's square are within the bound.
    /// A bound without the terms of second order is exceeded.
    #[test]
    fn landings_from_the_corners_are_within_the_bound() {
        let generator = SplitMix64::from_state(60);
        let kappa = 0.5;
        let (mut conclusive, mut largest, mut over_linear) = (0, 0f64, 0f64);
        for k in 0..4000u64 {
            let part = |i| generator.uniform(8 * k + i);
            let error = pxfm::f_exp10(-12.0 + 8.0 * part(0));
            let velocity = 3.2 + 12.0 * part(1);
            let (sin, cos) = pxfm::f_sincos(velocity);
            let touch = velocity * cos / sin - 1.0; // x of a touch
            let near = error * pxfm::f_exp10(4.0 * part(2));
            let start = match k % 3 {
                0 if touch > 0.0 => TakeOff { excess: touch - near, velocity },
                1 => TakeOff { excess: near, velocity: -5.0 * part(1) - 0.1 },
                _ => TakeOff { excess: 5.0 * part(2) + 0.01, velocity: velocity - 10.0 },
            };
            if !(start.excess > 2.0 * error) {
                continue;
            }
            let landing = next_landing(start, kappa);
            let mut bound = after_first(start, error);
            let change = Variation { excess: error, velocity: error };
            let derivative = FlightDerivative::new(start, &landing, kappa);
            bound.add_flight(&landing, kappa);
            if bound.landing_inconclusive() {
                continue;
            }
            conclusive += 1;
            let linear = derivative.bound(change).0.excess;
            for (dx, dv) in [(error, error), (-error, error), (error, -error), (-error, -error)] {
                let exact = moved_landing(start, dx, dv, kappa);
                let off_excess = (exact.excess - Four::from(landing.excess)).nearest().abs();
                let off_velocity = (exact.velocity - Four::from(landing.velocity)).nearest().abs();
                assert!(off_excess <= bound.error.excess, "{start:?} ± {error:e}: {off_excess:e}");
                assert!(off_velocity <= bound.error.velocity, "{start:?} ± {error:e}");
                let squares =
                    exact.closing_speed.squared() - Four::from(landing.closing_speed).squared();
                assert!(squares.nearest().abs() <= bound.loss, "{start:?} ± {error:e}");
                largest = largest.max(off_excess / bound.error.excess);
                over_linear = over_linear.max(off_excess / linear);
            }
        }
        // The bound is nearly met, and the linear bound alone does not hold.
        assert!(conclusive > 1000 && largest > 0.999, "{conclusive} {largest}");
        assert!(over_linear > 1.03, "{over_linear}");
    }

    /// docs/theory.md, Lemma 62: Γ² of a first flight next to α*_n, where Γ and its slope vanish.
    #[test]
    fn the_loss_of_a_first_flight_next_to_a_fixed_point_is_within_its_bound() {
        use crate::landing::local_flight::NearFixedPoint;
        use crate::model::fixed_points::fixed_point_in;
        let mut largest = 0f64;
        for n in [1u64, 3, 20] {
            let star = fixed_point_in::<Four>(n);
            let local = NearFixedPoint::new(star);
            for k in 0..60 {
                let delta = 2f64.powi(-k);
                for part in [1e-3, 0.5, 1.0, 4.0] {
                    let e = part * delta;
                    let at =
                        |delta: f64| local.extended_landing(Four::from(delta), Four::from(0.5));
                    let (landing, moved) = (at(delta), at(delta + e));
                    let change =
                        (moved.closing_speed.squared() - landing.closing_speed.squared()).nearest();
                    let alpha = (star + delta).nearest();
                    let bound = ErrorBound::of_f64(alpha);
                    if e > 1e-3 || delta > 1.0 {
                        continue;
                    }
                    let landing = landing.rounded(false);
                    let derivative = FlightDerivative::new(bound.start, &landing, 0.5);
                    let most = bound.only_loss(&landing, &derivative, e);
                    assert!(change.abs() <= most, "{n} {delta:e} {e:e}: {change:e} {most:e}");
                    largest = largest.max(change.abs() / most);
                }
            }
        }
        assert!(largest > 0.6, "{largest}");
    }
}
