//! The intervals of attraction: once in, for ever in.

use crate::Error;
use crate::hump::Hump;
use passive_hopper::{DoubleDouble, MassRatio};
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
}

/// The trap of α*_n at one mass ratio: [α*_n, α*_n + Δ_n].
///
/// On it α*_n ≤ f(α) ≤ α, so that an orbit that enters stays and converges to α*_n. For n = 0 the
/// fixed point is 0, and the trap holds the hops that die out but never stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trap {
    /// Index of the fixed point.
    pub n: u64,
    /// α*_n.
    pub star: DoubleDouble,
    /// Δ_n, the length of the trap.
    pub delta: f64,
    /// Why it ends there.
    pub edge: TrapEdge,
}

impl Trap {
    /// The trap of α*_n.
    ///
    /// Δ_n is right to about 1e-15 absolutely, plus a few ulps.
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
    /// [`Error::Root`] if a bracket that theory guarantees does not hold (none is known).
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        let hump = Hump::new(n);
        let trap = |delta, edge| Trap { n, star: hump.star, delta, edge };
        Ok(match hump.first_fall(mass_ratio.mu())? {
            Some(delta) => trap(delta, TrapEdge::Crossing),
            None => trap(hump.star.offset_of((n + 1) as f64 * PI), TrapEdge::ContactEnd),
        })
    }

    /// Whether `alpha` > 0 lies in the trap; decided on 100 bits at its lower end, and to an ulp at
    /// the upper one.
    pub fn contains(&self, alpha: f64) -> bool {
        self.star.compare(alpha) != Ordering::Less && alpha <= self.right()
    }

    /// The upper end, α*_n + Δ_n.
    pub fn right(&self) -> f64 {
        self.star.high + self.delta
    }
}
