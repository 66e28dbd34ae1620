//! The trap of a fixed point: an orbit that enters it never leaves, and converges to the fixed point.

use crate::error::Error;
use crate::traps::hump::{Hump, contact_length, distance_to_next};
use passive_hopper::{FixedPointSpeed, MassRatio, alpha_star};
use std::cmp::Ordering;
use std::f64::consts::PI;

/// Where a trap ends on the right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TrapEdge {
    /// The trap ends where f falls to α*_n on the contact part of the hump. f crosses α*_n downwards only once there
    /// (docs/theory.md, Theorem 29).
    Crossing,
    /// f stays above α*_n on the whole contact part, and the trap is taken up to its end, (n+1)π. f may stay
    /// above α*_n further on, in the sudden window; see [`immediate_basin`](crate::immediate_basin).
    ContactEnd,
    /// f stays above α*_n up to the next fixed point. A bound on the loss of a hop proves it, without computing
    /// the map.
    NextFixedPoint,
}

/// M₁ = (α*_1² − 1)/(α*_1² + 1): for M up to this a hop has at most one sudden lift-off (docs/theory.md, Theorem 20).
pub const ONE_SUDDEN: f64 = 0.905_619_101_548_377_4;

/// Whether no hop from the sudden window ((n+1)π, α*_{n+1}) can lose enough to fall to α*_n.
///
/// A hop loses α² − α′² = μ Σ Γ². A flight from (Y, V) has |ṡ| ≤ √(Y²+V²) = R. Its stretch stays above −R,
/// so that |Ṗ| ≤ √(V² + 2(Y+R)) = B. Hence Γ = ṡ − Ṗ ≤ R + B, and the landing has Y′ ≤ R and
/// |V′| ≤ max(R, B). For M ≤ [`ONE_SUDDEN`] a hop has at most two flights, and the sum at most two terms.
/// (docs/theory.md, Lemma 32)
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

/// Bound on the difference of the two sides of α² − α*_n² = μΓ² at the computed edge, in ulps of their common
/// value: 9 for the rounding of the left side, 29 for that of the right side, 1 for the difference, and 9 for the
/// last step of the search (docs/theory.md, Lemma 77). A larger value makes the band around an edge wider in which
/// the next hop decides.
const SIDES_ULPS: f64 = 48.0;

/// Bound on the error of δ(t) and of the spacing of t, in ulps of δ (docs/theory.md, Lemma 77).
const OFFSET_ULPS: f64 = 10.0;

/// Smallest |4μW − 1| at an edge for which Lemma 77 of docs/theory.md gives a bound. Nearer to the touch the
/// rounding of W and the curvature of the difference are no small part of its slope. An edge so near belongs to a μ
/// within [`NEAR_TOUCH`], where [`certain_offset`] gives the bound.
const SMALLEST_SLOPE: f64 = 1e-12;

/// Relative distance of μ from the μ_c of the touch, up to which the computed numbers do not tell whether f falls
/// to α*_n: μ_c has a relative error of 100ε at most (docs/theory.md, Lemma 77). A larger value makes the part of a
/// trap that is left unclear, a 10⁻⁷ of it, wider like its root, at more mass ratios beside a crisis.
const NEAR_TOUCH: f64 = 256.0 * f64::EPSILON;

/// Bound on the error of the offset δ at which f falls to α*_n, if the exact offset is below δ (docs/theory.md,
/// Lemma 77).
///
/// The derivative of α² − α*_n² − μΓ² by δ is 2α (1 − 4μW). The error of δ is the error of both sides divided by
/// it. Where the lemma gives no bound, the bound is δ itself: no speed is then certainly inside.
///
/// `t` lies left of the touch, where f falls to α*_n only once (Theorem 29). So it is the first fall.
fn crossing_error(hump: &Hump, mu: f64, t: f64) -> f64 {
    let (delta, w) = (hump.delta(t), hump.w(t));
    if !((4.0 * mu * w - 1.0).abs() > SMALLEST_SLOPE) {
        return delta;
    }
    let alpha = hump.star.value() + delta;
    let sides = delta * (alpha + hump.star.value());
    let slope = 2.0 * alpha * (4.0 * mu * w - 1.0).abs();
    f64::EPSILON * (SIDES_ULPS * sides / slope + OFFSET_ULPS * delta)
}

/// An offset up to which all are in the trap, for every μ within [`NEAR_TOUCH`] of `touch`.
///
/// (α² − α*_n²)/Γ² falls up to the touch (docs/theory.md, Theorem 29), so that Δ becomes shorter as μ grows: the
/// trap of a larger μ lies in all of these traps. At twice the distance the edge has a slope, and Lemma 77 bounds
/// its error.
fn certain_offset(hump: &Hump, touch: f64) -> Result<f64, Error> {
    let mu = touch * (1.0 + 2.0 * NEAR_TOUCH);
    let inside = |t: f64| hump.delta(t) - crossing_error(hump, mu, t);
    // Without a fall no offset is certain.
    Ok(hump.first_fall(mu)?.map_or(0.0, inside))
}

/// Bound on the error of an edge that is given by a closed form, relative to Δ (docs/theory.md, Lemma 76).
const CLOSED_FORM_ERROR: f64 = 2.0 * f64::EPSILON;

/// Bound on the error of the 100 bits of α*_n, relative to α*_n: 2⁻¹⁰⁰. The theorem gives 2⁻¹⁰¹
/// (docs/theory.md, Lemma 65).
const FIXED_POINT_ERROR: f64 = 7.9e-31;

/// Where a speed lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TrapSide {
    /// In the trap.
    Inside,
    /// Outside the trap.
    Outside,
    /// Within the error of an end of the trap.
    Unclear,
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
    /// ratios next to a [crisis](crate::crisis). Some ulps beside a crisis it is the distance to the other end that
    /// the trap may have. All offsets from 0 to `delta` − `error` are in the trap.
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
            error: CLOSED_FORM_ERROR * delta,
            edge,
        };
        let found = match hump.first_fall(mu)? {
            Some(t) => Trap {
                error: crossing_error(&hump, mu, t),
                ..trap(hump.delta(t), TrapEdge::Crossing)
            },
            None if cannot_fall(n, mass_ratio) => {
                trap(distance_to_next(n), TrapEdge::NextFixedPoint)
            }
            None => trap(contact_length(n), TrapEdge::ContactEnd),
        };
        let touch = hump.touch_of_fixed_point()?.mu;
        if (mu - touch).abs() > NEAR_TOUCH * touch {
            return Ok(found);
        }
        // The exact map may fall below α*_n next to the touch, or stay above it up to the end of the contact part.
        let error = found.delta - certain_offset(&hump, touch)?;
        let edge = match found.edge {
            TrapEdge::NextFixedPoint => TrapEdge::ContactEnd,
            edge => edge,
        };
        Ok(Trap { error, edge, ..found })
    }

    /// Whether `alpha` > 0 certainly lies in the trap.
    ///
    /// False for a speed within [`error`](Self::error) of the upper end: [`side`](Self::side) calls it unclear. The
    /// next hop decides there, because f(α) < α*_n beyond the end.
    pub fn contains(&self, alpha: f64) -> bool {
        self.side(alpha) == TrapSide::Inside
    }

    /// On which side of the ends of the trap the exact number `alpha` > 0 lies.
    ///
    /// The offset α − α*_n is computed from the 100 bits of α*_n, and compared with Δ ± [`error`](Self::error).
    pub fn side(&self, alpha: f64) -> TrapSide {
        if self.edge == TrapEdge::NextFixedPoint {
            // 100 bits of both ends.
            let before = FixedPointSpeed::new(self.n + 1).compare(alpha) == Ordering::Less;
            let after = self.fixed_point.compare(alpha) != Ordering::Less;
            return if before && after { TrapSide::Inside } else { TrapSide::Outside };
        }
        self.side_of_offset(self.fixed_point.offset_of(alpha), 0.0)
    }

    /// On which side of the ends of the trap a speed lies whose offset from α*_n is within `error` of `offset`.
    pub fn side_of_offset(&self, offset: f64, error: f64) -> TrapSide {
        // The roundings of the offset to `f64` and of α*_n.
        let error =
            error + f64::EPSILON * offset.abs() + FIXED_POINT_ERROR * self.fixed_point.value();
        let (above, below) = (offset, self.delta - offset);
        if above > error && below > error + self.error {
            TrapSide::Inside
        } else if above < -error || below < -(error + self.error) {
            TrapSide::Outside
        } else {
            TrapSide::Unclear
        }
    }

    /// The upper end, α*_n + Δ_n, rounded to `f64`.
    pub fn right(&self) -> f64 {
        self.fixed_point.value() + self.delta
    }

    /// Bound on the error of [`right`](Self::right).
    pub fn right_error(&self) -> f64 {
        self.error + self.fixed_point.error() + 0.5 * f64::EPSILON * self.right()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the slope of the two sides vanishes, no offset is certainly in the trap. Just beside it the lemma's bound
    /// applies, and it is smaller than the offset.
    #[test]
    fn an_edge_without_a_slope_contains_nothing() {
        for n in [0, 1, 2, 7, 100] {
            let hump = Hump::new(n).unwrap();
            let t = 0.5;
            let (delta, level) = (hump.delta(t), 0.25 / hump.w(t)); // 4μW = 1
            for part in [0.0, 9e-13, -9e-13] {
                let error = crossing_error(&hump, level * (1.0 + part), t);
                assert_eq!(error, delta, "{n} {part}");
                let (fixed_point, edge) = (hump.star, TrapEdge::Crossing);
                let trap = Trap { n, fixed_point, delta, error, edge };
                for inside in [0.001, 0.5, 0.999] {
                    assert_eq!(trap.side_of_offset(inside * delta, 0.0), TrapSide::Unclear);
                }
            }
            for part in [1.1e-12, -1.1e-12] {
                let error = crossing_error(&hump, level * (1.0 + part), t);
                assert!(error > 1e-3 * delta && error < 0.1 * delta, "{n} {part}");
            }
        }
    }
}
