//! The traps at one mass ratio, arranged for a fast look-up of the trap of a speed.

use crate::error::Error;
use crate::traps::trap::{Trap, TrapEdge};
use passive_hopper::{FixedPointSpeed, index_below};
use std::f64::consts::FRAC_1_PI;

/// The number of traps in the index, as many as [`Fates`](crate::Fates) stores. Each costs 1.4 µs for every mass ratio.
/// Speeds beyond these traps are [`Lookup::NotIndexed`], and their trap is computed for each speed.
const INDEXED_TRAPS: u64 = 64;

/// Steps down from the computed upper end of a trap to an `f64` that is certainly inside. The sum α*_n + (Δ −
/// error) is rounded once, so that two or three steps suffice. If they do not, the trap has no `f64` in the index,
/// which costs time and changes no label.
const STEPS_INSIDE: usize = 8;

/// The largest `f64` that is certainly in the trap, or one a few ulps smaller.
fn largest_inside(trap: &Trap) -> f64 {
    let end = trap.fixed_point.value() + (trap.delta - trap.error);
    let mut steps =
        std::iter::successors(Some(end), |end| Some(end.next_down())).take(STEPS_INSIDE);
    steps.find(|&end| trap.contains(end)).unwrap_or(f64::NEG_INFINITY)
}

/// The traps of the first fixed points as closed intervals of `f64` that are certainly inside, from α*_0 = 0 up.
pub(crate) struct TrapIndex {
    ends: Vec<(f64, f64)>,
}

/// The result of a look-up in a [`TrapIndex`].
pub(crate) enum Lookup {
    /// The speed lies in the trap of α*_n, which has these ends.
    Trap(u32, (f64, f64)),
    /// The speed lies in no trap.
    NoTrap,
    /// The speed lies beyond the traps of the index.
    NotIndexed,
}

impl TrapIndex {
    /// The traps of the fixed points up to `largest`; `trap` gives the trap of α*_n.
    pub(crate) fn new(
        largest: f64,
        trap: impl Fn(u64) -> Result<Trap, Error>,
    ) -> Result<Self, Error> {
        let last = index_below(largest)?.min(INDEXED_TRAPS - 1);
        let ends = |n: u64| {
            let trap = trap(n)?;
            let right = match trap.edge {
                TrapEdge::NextFixedPoint => FixedPointSpeed::new(n + 1).largest_below(),
                TrapEdge::Crossing | TrapEdge::ContactEnd => largest_inside(&trap),
            };
            Ok((trap.fixed_point.smallest_not_below(), right))
        };
        let mut ends = (0..=last).map(ends).collect::<Result<Vec<_>, Error>>()?;
        if last + 1 < INDEXED_TRAPS {
            // A speed in ((last+1)π, α*_{last+1}) has ⌊α/π⌋ = last + 1, one more than the last trap. With this empty
            // entry the look-up goes on to the trap below; without it the speed would seem to lie beyond the index.
            ends.push((f64::INFINITY, f64::INFINITY));
        }
        Ok(TrapIndex { ends })
    }

    /// The ends of the traps, by the index of their fixed points. The last entry may be empty, [∞, ∞].
    pub(crate) fn ends(&self) -> impl Iterator<Item = (u32, (f64, f64))> {
        (0..).zip(self.ends.iter().copied())
    }

    /// The trap that contains `alpha` > 0.
    pub(crate) fn find(&self, alpha: f64) -> Lookup {
        // α*_n ∈ (nπ, (n+1)π), so that ⌊α/π⌋ is the index of the largest α*_n ≤ α, or one more. Next to nπ rounding
        // may give n − 1 for n or the reverse. Both lead to trap n − 1, since α < α*_n.
        let n = (alpha * FRAC_1_PI) as usize;
        let Some(&(left, _)) = self.ends.get(n) else { return Lookup::NotIndexed };
        let n = n - usize::from(alpha < left).min(n);
        match self.ends.get(n) {
            Some(&(left, right)) if alpha >= left && alpha <= right => {
                Lookup::Trap(n as u32, (left, right))
            }
            _ => Lookup::NoTrap,
        }
    }
}
