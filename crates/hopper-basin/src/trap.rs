//! The intervals of attraction: once in, for ever in.

use crate::Error;
use crate::hump::Hump;
use crate::reach::crossing_error;
use passive_hopper::{FixedPointSpeed, MassRatio, alpha_star};
use std::cmp::Ordering;
use std::f64::consts::PI;

/// Where a trap ends on the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TrapEdge {
    /// Where f first falls to α*_n on the contact interval: the only crossing there, proved.
    Crossing,
    /// f stays above α*_n on the whole contact interval; the trap is taken up to (n+1)π. Beyond,
    /// where the first landing is sudden, f may stay above as well.
    ContactEnd,
    /// f stays above α*_n up to the next fixed point: no hop from there loses enough to reach it,
    /// by a bound that needs no map.
    NextFixedPoint,
}

/// For M up to this a hop has at most one sudden lift-off (theory: b.3): (α*_1² − 1)/(α*_1² + 1).
const ONE_SUDDEN: f64 = 0.905_619_101_548_377_4;

/// Whether μ Σ Γ² of any hop from ((n+1)π, α*_{n+1}) is too small to reach α*_n.
///
/// From (Y, V) a flight has |ṡ| ≤ √(Y²+V²) = R and, since the stretch stays above −R,
/// |Ṗ| ≤ √(V² + 2(Y+R)) = B; Γ = ṡ − Ṗ ≤ R + B, and after the landing Y' ≤ R and |V'| ≤ max(R, B).
/// With at most one sudden lift-off there are two such terms.
fn cannot_fall(n: u64, mass_ratio: MassRatio) -> bool {
    if mass_ratio.value() > ONE_SUDDEN {
        return false;
    }
    let (mut y, mut v) = (1.0f64, alpha_star(n + 1));
    let mut loss = 0.0;
    for _ in 0..2 {
        let r = (y * y + v * v).sqrt();
        let b = (v * v + 2.0 * (y + r)).sqrt();
        loss += (r + b) * (r + b);
        (y, v) = (r, r.max(b));
    }
    let (low, high) = (alpha_star(n), (n + 1) as f64 * PI);
    // A thousandth to spare for the roundings of the bound itself.
    1.001 * mass_ratio.mu() * loss < (high - low) * (high + low)
}

/// The trap of α*_n at one mass ratio: [α*_n, α*_n + Δ_n].
///
/// On it α*_n ≤ f(α) ≤ α, so that an orbit that enters stays and converges to α*_n. For n = 0 the
/// fixed point is 0, and the trap holds the hops that die out but never stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trap {
    /// Index of the fixed point.
    pub n: u64,
    /// α*_n, to 100 bits.
    pub fixed_point: FixedPointSpeed,
    /// Δ_n, the length of the trap.
    pub delta: f64,
    /// Bound on the error of `delta`: some ulps, times the condition of the edge, which is bad next to
    /// a [crisis](crate::crisis).
    pub error: f64,
    /// Why it ends there.
    pub edge: TrapEdge,
}

impl Trap {
    /// The trap of α*_n.
    ///
    /// Δ_n has its bound beside it, however large n and small Δ_n are: a few ulps, but for mass ratios
    /// next to a crisis.
    ///
    /// ```
    /// use hopper_basin::{Trap, TrapEdge};
    /// use passive_hopper::MassRatio;
    /// let trap = Trap::new(1, MassRatio::ONE)?;
    /// assert!((trap.delta - 0.0159187073552294).abs() < 1e-15);
    /// assert_eq!(trap.edge, TrapEdge::Crossing);
    /// // Below the crisis the whole hump is above its fixed point:
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

    /// Whether `alpha` > 0 lies in the trap; decided on 100 bits at its lower end, and to an ulp at
    /// the upper one.
    pub fn contains(&self, alpha: f64) -> bool {
        let before_end = match self.edge {
            TrapEdge::NextFixedPoint => {
                FixedPointSpeed::new(self.n + 1).compare(alpha) == Ordering::Less
            }
            TrapEdge::Crossing | TrapEdge::ContactEnd => alpha <= self.right(),
        };
        before_end && self.fixed_point.compare(alpha) != Ordering::Less
    }

    /// The upper end, α*_n + Δ_n.
    pub fn right(&self) -> f64 {
        self.fixed_point.value() + self.delta
    }
}
