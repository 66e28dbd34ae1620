//! A hop in the coordinate of a fixed point: (n, δ) with α = α*_n + δ, to (n, δ′).
//!
//! δ′ = δ − μ Σ Γ²/(α + α′), with Γ of the first flight from `landing/local_flight.rs`. Only the subtraction of the
//! loss from δ can cancel, near the end of the trap of α*_n. There the hop is computed in extended arithmetic.

use crate::error::Error;
use crate::landing::error_bound::ErrorBound;
use crate::landing::flight_ends::{Landing, TakeOff};
use crate::landing::local_flight::NearFixedPoint;
use crate::landing::next_landing::next_landing;
use crate::map::extended_hop::{HopStart, extended_hop};
use crate::map::lift_off_map::LiftOffMap;
use crate::map::limits::{LARGEST_PLAIN_SPEED, SHORT_FLIGHT};
use crate::model::fixed_points::{alpha_star, exact_alpha_star, n_pi};
use crate::model::motion::LARGEST_LIFT_OFF_SPEED;

/// Up to this ratio of the loss to |δ| the plain result is used.
///
/// The plain loss has a relative error of up to 111 ulps, and δ′ = δ − loss must be right to 8 ulps: 1/16 is the
/// largest power of two that ensures this (docs/theory.md, Theorem 74). Hops with a larger loss are computed in
/// extended arithmetic. A smaller value would send more hops there.
const SMALL_LOSS: f64 = 1.0 / 16.0;

/// Smallest |δ| other than 0. Here t³ ∝ δ, the smallest term of δ(t), is 10⁸ times the smallest normal number, so
/// that no factor of the local functions underflows (docs/theory.md, Lemma 73). Further down the terms would lose
/// digits.
const SMALLEST_OFFSET: f64 = 1e-300;

/// A hop near a fixed point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalHop {
    /// δ′ = α′ − α*_n; `None` if the hopper is grounded.
    pub next: Option<f64>,
    /// δ − δ′, without cancellation; `None` if the hopper is grounded.
    ///
    /// The loss is about λ|δ|^{4/3}, ten times as much on the left. For |δ| below some 10⁻²³¹ (with λ = 1) it is a
    /// subnormal number and has fewer digits, and below 10⁻²⁴³ it rounds to 0. δ′ then is δ: the loss is far below
    /// its last digit.
    pub loss: Option<f64>,
    /// Number of sudden lift-offs.
    pub sudden: usize,
    /// t = τ − 2α*_n, the time of the first flight minus that of the lossless hop.
    pub time_shift: f64,
}

impl LiftOffMap {
    /// The hop from α = α*_n + `delta`, in the coordinate δ.
    ///
    /// δ′ is right to 8 ulps of itself, from |δ| = 10⁻³⁰⁰ to the ends of (nπ, (n+1)π). An orbit in δ therefore
    /// follows the algebraic approach to α*_n without end. An orbit in α stops at |δ| ≈ 10⁻¹².
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::ONE);
    /// let hop = map.hop_near_fixed_point(1, 1e-60)?;
    /// // f(α* + δ) = α* + δ − λδ^{4/3}: far below the spacing of α.
    /// let lambda = hop.loss.expect("it hops again") / 1e-80;
    /// assert!((lambda - 3.616949794602146).abs() < 1e-14);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Offset`] unless n ≥ 1, α lies in (nπ, (n+1)π), and δ is zero or |δ| ≥ 10⁻³⁰⁰;
    /// [`Error::SuddenLiftOffBudget`] as for [`hop`](Self::hop); [`Error::Undecided`] if 1024 bits, or the budget of
    /// sudden lift-offs in them, do not suffice for the decisions and the digits of δ′.
    pub fn hop_near_fixed_point(&self, n: u64, delta: f64) -> Result<LocalHop, Error> {
        self.check_offset(n, delta)?;
        let star = exact_alpha_star(n);
        if delta == 0.0 {
            return Ok(LocalHop { next: Some(0.0), loss: Some(0.0), sudden: 0, time_shift: 0.0 });
        }
        let local = NearFixedPoint::new(star.high);
        let t = local.time_shift(delta);
        let plain = (local.a <= LARGEST_PLAIN_SPEED)
            .then(|| self.plain_hop_near(&local, delta, t))
            .flatten();
        plain.map_or_else(|| self.extended_hop_near(n, delta, t), Ok)
    }

    /// The error of an offset for which the hop has no value.
    pub(crate) fn check_offset(&self, n: u64, delta: f64) -> Result<(), Error> {
        let star = exact_alpha_star(n);
        // The interval (nπ, (n+1)π) in δ, to 100 bits.
        // The largest n has no successor; it is refused below, since its speed is too large.
        let (left, right) = (n_pi(n) - star, n_pi(n.saturating_add(1)) - star);
        let inside = left.compare(delta).is_gt() && right.compare(delta).is_lt();
        let resolved = delta == 0.0 || delta.abs() >= SMALLEST_OFFSET;
        if n == 0 || star.high > LARGEST_LIFT_OFF_SPEED || !inside || !resolved {
            return Err(Error::Offset { n, delta, left: left.high, right: right.high });
        }
        Ok(())
    }

    /// The hop in plain `f64`; `None` if the loss is not small compared with δ, or a decision is inconclusive.
    fn plain_hop_near(&self, local: &NearFixedPoint<f64>, delta: f64, t: f64) -> Option<LocalHop> {
        let mu = self.mass_ratio().mu();
        let kappa = self.mass_ratio().kappa();
        let (excess, velocity, closing_speed) = local.landing(t, kappa);
        let mut loss = closing_speed * closing_speed;
        let sudden = usize::from(delta < 0.0);
        if sudden > 0 {
            let start = TakeOff { excess, velocity };
            let next = next_landing(start, kappa);
            // A second sudden landing would make the loss large. The decision that the second landing is not sudden
            // must be larger than its error.
            let short = next.time < SHORT_FLIGHT;
            if next.sudden
                || !(short || Self::is_conclusive(local, start, t, closing_speed, &next, kappa))
            {
                return None;
            }
            loss += next.closing_speed * next.closing_speed;
        }
        let taken = mu * loss;
        if !(taken <= SMALL_LOSS * 2.0 * local.a * delta.abs()) {
            return None;
        }
        // δ′ = δ − μ Σ Γ²/(α + α′)
        let alpha = local.a + delta;
        let change = taken / (alpha + (alpha * alpha - taken).sqrt());
        Some(LocalHop { next: Some(delta - change), loss: Some(change), sudden, time_shift: t })
    }

    /// Whether the decision of the second landing is larger than its error.
    fn is_conclusive(
        local: &NearFixedPoint<f64>,
        start: TakeOff,
        t: f64,
        closing_speed: f64,
        next: &Landing,
        kappa: f64,
    ) -> bool {
        let TakeOff { excess, velocity } = start;
        let time = 2.0 * local.a + t;
        let mut error_bound = ErrorBound::of_f64(local.a);
        let first = Landing { time, closing_speed, excess, velocity, sudden: true };
        error_bound.add_flight(&first, kappa);
        error_bound.add_flight(next, kappa);
        !error_bound.landing_inconclusive()
    }

    /// The hop in extended arithmetic.
    fn extended_hop_near(&self, n: u64, delta: f64, time_shift: f64) -> Result<LocalHop, Error> {
        let hop = extended_hop(HopStart::Offset { n, delta }, self.mass_ratio())?;
        let sudden = hop.landings.len() - 1;
        if !(hop.certain && hop.precise) {
            return Err(Error::Undecided { alpha: alpha_star(n) + delta, sudden });
        }
        let (next, loss) = hop.next.map(|next| (next.offset, next.loss)).unzip();
        Ok(LocalHop { next, loss, sudden, time_shift })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::mass_ratio::MassRatio;

    /// (error of δ′, error of the loss) in ulps, against 512 bits.
    fn ulps(n: u64, mass_ratio: f64, delta: f64) -> (f64, f64) {
        let map = LiftOffMap::new(MassRatio::new(mass_ratio).unwrap());
        let hop = map.hop_near_fixed_point(n, delta).unwrap();
        let exact = map.reference_local_hop(n, delta).unwrap().unwrap();
        assert_eq!(hop.sudden, exact.sudden, "{n} {mass_ratio} {delta:e}");
        let next = exact.next.unwrap().error_of(hop.next.unwrap()) / hop.next.unwrap().abs();
        let loss = exact.loss.unwrap();
        let loss = loss.error_of(hop.loss.unwrap()) / loss.nearest;
        (next / f64::EPSILON, loss / f64::EPSILON)
    }

    /// Starts with the largest errors of a search: right, left with a short second flight, left with a long one,
    /// large n.
    const PLANTED: [(u64, f64, f64); 8] = [
        (1, 0.010907304827861081, 0.0002546572882442288),
        (9843555168, 0.13431827198618587, 1.2613044519465298e-25),
        (794, 2.108726604372915e-9, 0.015702838572973592),
        (1, 0.02783775485290209, -3.8359763625895474e-6),
        (9539457, 939042.7438450479, -1.6714438862110644e-13),
        (1, 1.720148734991015e-5, -1.0076174996334226),
        (1, 7.273548307447073e-6, -1.350997673072077),
        (100, 0.013613571355108071, 3.0869183734174e-23),
    ];

    #[test]
    fn planted_hops_are_right_to_eight_ulps() {
        for (n, mass_ratio, delta) in PLANTED {
            let (next, _) = ulps(n, mass_ratio, delta);
            assert!(next <= 8.0, "{n} {mass_ratio} {delta:e}: {next}");
        }
        // These errors are actual ones: one of them is more than the rounding of δ′ alone.
        let next = PLANTED.map(|(n, mass_ratio, delta)| ulps(n, mass_ratio, delta).0);
        assert!(next.iter().any(|&next| next > 0.5), "{next:?}");
    }

    /// Next to the largest loss of the plain arithmetic, on both sides of the limit, the loss has at most the error
    /// that the limit is derived from.
    #[test]
    fn losses_next_to_the_limit_have_the_derived_error() {
        const LOSS_ULPS: f64 = 111.0;
        for n in [1, 2, 30, 1000] {
            for mass_ratio in [0.003, 0.1, 1.0, 40.0] {
                for side in [1.0, -1.0] {
                    let map = LiftOffMap::new(MassRatio::new(mass_ratio).unwrap());
                    let share = |size: f64| {
                        let hop = map.hop_near_fixed_point(n, side * size).unwrap();
                        hop.loss.unwrap_or(f64::INFINITY) / size
                    };
                    // The share of the loss grows with |δ| here: bisection for 1/16.
                    let (mut low, mut high) = (1e-12, 0.05);
                    if share(high) < SMALL_LOSS {
                        continue;
                    }
                    while high / low > 1.0 + 1e-9 {
                        let middle = (low * high).sqrt();
                        if share(middle) < SMALL_LOSS { low = middle } else { high = middle }
                    }
                    for k in 0..20 {
                        let delta = side * low * (1.0 + 1e-7 * f64::from(k - 10));
                        let (next, loss) = ulps(n, mass_ratio, delta);
                        assert!(next <= 8.0 && loss <= LOSS_ULPS, "{n} {mass_ratio} {delta:e}");
                    }
                }
            }
        }
    }

    /// The loss is subnormal and then 0; δ′ stays right.
    #[test]
    fn losses_below_the_smallest_number_are_zero() {
        let map = LiftOffMap::new(MassRatio::ONE);
        let loss = |delta: f64| map.hop_near_fixed_point(1, delta).unwrap().loss.unwrap();
        assert!(loss(1e-230) > f64::MIN_POSITIVE);
        assert!(loss(1e-240) > 0.0 && loss(1e-240) < f64::MIN_POSITIVE);
        assert_eq!(loss(1e-245), 0.0);
        for delta in [1e-230, 1e-245, SMALLEST_OFFSET, -1e-245, -SMALLEST_OFFSET] {
            let hop = map.hop_near_fixed_point(1, delta).unwrap();
            let exact = map.reference_local_hop(1, delta).unwrap().unwrap();
            let error = exact.next.unwrap().error_of(hop.next.unwrap());
            assert!(error <= f64::EPSILON * delta.abs(), "{delta:e}");
            let error = exact.time_shift.error_of(hop.time_shift);
            assert!(error <= 8.0 * f64::EPSILON * hop.time_shift.abs(), "{delta:e}");
        }
    }

    /// The second landing of a flight that is shorter than `SHORT_FLIGHT` is below stretch one (docs/theory.md,
    /// Lemma 75).
    #[test]
    fn short_second_flights_end_in_contact() {
        for k in 0..2000 {
            let part = f64::from(k) / 2000.0;
            let delta = -pxfm::f_exp10(-12.0 * part) * 0.9;
            for (n, m) in [(1, 1e-6), (1, 1e6), (3, 1.0), (1000, 0.2)] {
                let local = NearFixedPoint::new(alpha_star(n));
                let kappa = MassRatio::new(m).unwrap().kappa();
                let (excess, velocity, _) = local.landing(local.time_shift(delta), kappa);
                let next = next_landing(TakeOff { excess, velocity }, kappa);
                assert!(
                    next.time >= SHORT_FLIGHT || (next.excess < 0.0 && !next.sudden),
                    "{n} {m}"
                );
            }
        }
    }
}
