//! The trap of a fixed point: an orbit that enters it never leaves, and converges to the fixed point.
//!
//! The paper calls it the interval of attraction. The usual name is trapping region: f maps it into itself. The code
//! calls it a trap.

use crate::error::Error;
use crate::traps::hump::Hump;
use passive_hopper::{FixedPointSpeed, MassRatio, alpha_star};
use std::cmp::Ordering;
use std::f64::consts::PI;

/// Where a trap ends on the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TrapEdge {
    /// The trap ends where f falls to α*_n on the contact part of the hump. It is proved that f crosses α*_n
    /// downwards only once there.
    Crossing,
    /// f stays above α*_n on the whole contact part, and the trap is taken up to its end, (n+1)π. f may stay
    /// above α*_n further on, in the sudden window; see [`immediate_basin`](crate::immediate_basin).
    ContactEnd,
    /// f stays above α*_n up to the next fixed point. A bound on the loss of a hop proves it, without computing
    /// the map.
    NextFixedPoint,
}

/// (α*_1² − 1)/(α*_1² + 1): for M up to this a hop has at most one sudden lift-off.
const ONE_SUDDEN: f64 = 0.905_619_101_548_377_4;

/// Whether no hop from the sudden window ((n+1)π, α*_{n+1}) can lose enough to fall to α*_n.
///
/// A hop loses α² − α′² = μ Σ Γ². A flight from (Y, V) has |ṡ| ≤ √(Y²+V²) = R. Its stretch stays above −R,
/// so that |Ṗ| ≤ √(V² + 2(Y+R)) = B. Hence Γ = ṡ − Ṗ ≤ R + B, and the landing has Y′ ≤ R and
/// |V′| ≤ max(R, B). For M ≤ [`ONE_SUDDEN`] a hop has at most two flights, and the sum at most two terms.
/// (docs/model.md, "A bound without the map")
///
/// The condition is sufficient, not necessary.
fn cannot_fall(n: u64, mass_ratio: MassRatio) -> bool {
    if mass_ratio.value() > ONE_SUDDEN {
        return false;
    }
    let (mut y, mut v) = (1.0f64, alpha_star(n + 1)); // the fastest first flight
    let mut sum = 0.0; // bound on Σ Γ²
    for _ in 0..2 {
        let r = (y * y + v * v).sqrt();
        let b = (v * v + 2.0 * (y + r)).sqrt();
        sum += (r + b) * (r + b);
        (y, v) = (r, r.max(b));
    }
    // The slowest start, (n+1)π, has the shortest way down to α*_n.
    let (low, high) = (alpha_star(n), (n + 1) as f64 * PI);
    // The factor 1.001 covers the rounding of both sides, which is some 10⁻¹⁵ of them.
    1.001 * mass_ratio.mu() * sum < (high - low) * (high + low)
}

/// Bound on the rounding error of the offset δ at which f falls to α*_n.
///
/// The two sides of α² − α*_n² = μΓ² are computed to some ulps of their common value. The derivative of
/// their difference with respect to δ is 2α (1 − 4μW); the error of δ is the quotient.
fn crossing_error(hump: &Hump, mu: f64, t: f64) -> f64 {
    // Both sides together have some ten roundings. Against values of 40 digits the bound is never exceeded
    // (tests/against_reference.rs). The value is an estimate rounded up, not a proof.
    const ULPS: f64 = 16.0;
    let (delta, w) = (hump.delta(t), hump.w(t));
    let alpha = hump.star.value() + delta;
    let sides = delta * (alpha + hump.star.value());
    let slope = 2.0 * alpha * (4.0 * mu * w - 1.0).abs();
    // 2δ for the rounding of δ itself.
    f64::EPSILON * (ULPS * sides / slope + 2.0 * delta)
}

/// The trap of α*_n at one mass ratio: [α*_n, α*_n + Δ_n].
///
/// On the trap α*_n ≤ f(α) ≤ α: f maps it into itself, and every orbit in it converges to α*_n. For n = 0
/// the fixed point is 0, and the trap contains the speeds whose hops become ever lower but never stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trap {
    /// The index of the fixed point.
    pub n: u64,
    /// α*_n, to 100 bits.
    pub fixed_point: FixedPointSpeed,
    /// Δ_n, the length of the trap.
    pub delta: f64,
    /// Bound on the error of `delta`: some ulps, times the condition number of the edge, which is large for mass
    /// ratios next to a [crisis](crate::crisis).
    pub error: f64,
    /// Why the trap ends there.
    pub edge: TrapEdge,
}

impl Trap {
    /// The trap of α*_n.
    ///
    /// Δ_n has an error bound of a few ulps of itself, also for large n, where Δ_n is far smaller than an ulp
    /// of α*_n. The bound is larger for mass ratios next to a crisis.
    ///
    /// ```
    /// use hopper_basin::{Trap, TrapEdge};
    /// use passive_hopper::MassRatio;
    /// let trap = Trap::new(1, MassRatio::ONE)?;
    /// assert!((trap.delta - 0.0159187073552294).abs() < 1e-15);
    /// assert_eq!(trap.edge, TrapEdge::Crossing);
    /// // Below the crisis f stays above α*_1 on the whole contact part of hump 1:
    /// assert_eq!(Trap::new(1, MassRatio::new(0.1)?)?.edge, TrapEdge::ContactEnd);
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Index`] for humps beyond the largest lift-off speed.
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        let hump = Hump::new(n)?;
        let mu = mass_ratio.mu();
        let trap = |delta: f64, edge| Trap {
            n,
            fixed_point: hump.star,
            delta,
            error: f64::EPSILON * delta,
            edge,
        };
        Ok(match hump.first_fall(mu)? {
            Some(t) => Trap {
                error: crossing_error(&hump, mu, t),
                ..trap(hump.delta(t), TrapEdge::Crossing)
            },
            None if cannot_fall(n, mass_ratio) => {
                trap(hump.star.offset_of(alpha_star(n + 1)), TrapEdge::NextFixedPoint)
            }
            None => trap(hump.star.offset_of((n + 1) as f64 * PI), TrapEdge::ContactEnd),
        })
    }

    /// Whether `alpha` > 0 lies in the trap.
    ///
    /// The comparison with α*_n uses its 100 bits; the comparison with the upper end is exact to an ulp.
    pub fn contains(&self, alpha: f64) -> bool {
        let before_end = match self.edge {
            // `right` may round up to α*_{n+1}, which belongs to the next trap: compare with its 100 bits.
            TrapEdge::NextFixedPoint => {
                FixedPointSpeed::new(self.n + 1).compare(alpha) == Ordering::Less
            }
            TrapEdge::Crossing | TrapEdge::ContactEnd => alpha <= self.right(),
        };
        before_end && self.fixed_point.compare(alpha) != Ordering::Less
    }

    /// The upper end, α*_n + Δ_n, rounded to `f64`.
    pub fn right(&self) -> f64 {
        self.fixed_point.value() + self.delta
    }
}
