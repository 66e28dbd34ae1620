//! A hop in the coordinate of a fixed point: (n, δ) with α = α*_n + δ, to (n, δ′).
//!
//! δ′ = δ − μ Σ Γ²/(α + α′), with Γ of the first flight from `landing/local_flight.rs`. Only the subtraction of the
//! loss from δ can cancel, near the end of the trap of α*_n. There the hop is computed in extended arithmetic.

use crate::error::Error;
use crate::landing::error_bound::ErrorBound;
use crate::landing::flight_ends::{Landing, TakeOff};
use crate::landing::local_flight::NearFixedPoint;
use crate::landing::next_landing::next_landing;
use crate::map::extended_hop::{Start, extended_hop};
use crate::map::lift_off_map::LiftOffMap;
use crate::map::limits::LARGEST_PLAIN_SPEED;
use crate::model::fixed_points::{alpha_star, exact_alpha_star, n_pi};
use crate::model::motion::LARGEST_LIFT_OFF_SPEED;

/// Up to this ratio of the loss to |δ| the plain result is used.
///
/// The plain loss has a relative error of up to 111 ulps, and δ′ = δ − loss must be right to 8 ulps: 1/16 is the largest
/// power of two that ensures this (docs/theory.md, Theorem 81). Hops with a larger loss are computed in extended
/// arithmetic. A smaller value would send more hops there.
const SMALL_LOSS: f64 = 1.0 / 16.0;

/// Smallest |δ| other than 0. Here t³ ∝ δ, the smallest term of δ(t), is 10⁸ times the smallest normal number, so that no
/// factor of the local functions underflows (docs/theory.md, Lemma 80). Further down the terms would lose digits.
const SMALLEST_OFFSET: f64 = 1e-300;

/// A second flight that is shorter than this is not followed by a sudden lift-off, whatever the rounding of its landing
/// (docs/theory.md, Lemma 82). The lemma needs τ < α*_1 = 4.49. The error of δ′ is derived for flights shorter than 1
/// (Theorem 81); the landings of longer ones are decided with their error bound.
const SHORT_FLIGHT: f64 = 1.0;

/// A hop near a fixed point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalHop {
    /// δ′ = α′ − α*_n; `None` if the hopper is grounded.
    pub next: Option<f64>,
    /// δ − δ′, without cancellation; `None` if the hopper is grounded.
    ///
    /// The loss is about λ|δ|^{4/3}, ten times as much on the left. For |δ| below some 10⁻²³¹ (with λ = 1) it is a subnormal
    /// number and has fewer digits, and below 10⁻²⁴³ it rounds to 0. δ′ then is δ: the loss is far below its last digit.
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
        let hop = extended_hop(Start::Offset { n, delta }, self.mass_ratio())?;
        let sudden = hop.landings.len() - 1;
        if !(hop.certain && hop.precise) {
            return Err(Error::Undecided { alpha: alpha_star(n) + delta, sudden });
        }
        let (next, loss) = hop.next.map(|next| (next.offset, next.loss)).unzip();
        Ok(LocalHop { next, loss, sudden, time_shift })
    }
}
