//! The traps at one mass ratio as a ladder.

use crate::itinerary::Itinerary;
use crate::known::Known;
use crate::{Error, Fates, TrapEdge};
use passive_hopper::{FixedPointSpeed, index_below};
use std::f64::consts::FRAC_1_PI;

/// Traps in a ladder; those of larger n are asked one by one.
const RUNGS: u64 = 64;

/// The traps as closed intervals of `f64`, from 0 = α*_0 up.
pub(crate) struct Ladder {
    traps: Vec<(f64, f64)>,
}

impl Ladder {
    /// The traps of all fixed points up to the one below `alpha`.
    pub(crate) fn below(fates: &Fates, alpha: f64) -> Result<Self, Error> {
        let last = index_below(alpha)?.min(RUNGS - 1);
        let trap = |n: u64| {
            let trap = fates.trap(n)?;
            let right = match trap.edge {
                TrapEdge::NextFixedPoint => FixedPointSpeed::new(n + 1).largest_below(),
                TrapEdge::Crossing | TrapEdge::ContactEnd => trap.right(),
            };
            Ok((trap.fixed_point.smallest_not_below(), right))
        };
        let mut traps = (0..=last).map(trap).collect::<Result<Vec<_>, Error>>()?;
        if last + 1 < RUNGS {
            // Nobody is on the next rung, but some are on the way to it.
            traps.push((f64::INFINITY, f64::INFINITY));
        }
        Ok(Ladder { traps })
    }

    /// All traps, from below, with their ends.
    pub(crate) fn traps(&self) -> impl Iterator<Item = (Known, (f64, f64))> {
        (0..).zip(&self.traps).map(|(n, &between)| (trap(n), between))
    }

    /// The trap that holds `alpha` > 0, as [`Traps`](basin_of_attraction::Traps) for [`Fates`] has it.
    pub(crate) fn trap(&self, alpha: f64, fates: &Fates) -> Option<(Known, (f64, f64))> {
        // α*_n ∈ (nπ, (n+1)π), so that ⌊α/π⌋ is the index below or one more, if it is right; next to nπ, where
        // it may not be, the two differ in nothing: neither trap begins there.
        let n = (alpha * FRAC_1_PI) as usize;
        let Some(&(left, _)) = self.traps.get(n) else { return not_one(alpha, fates) };
        let n = n - usize::from(alpha < left).min(n);
        let &(left, right) = self.traps.get(n)?;
        (alpha >= left && alpha <= right).then(|| (trap(n as u32), (left, right)))
    }
}

fn trap(n: u32) -> Known {
    Known { itinerary: Itinerary::in_trap(n), label: n as u16 }
}

fn not_one(alpha: f64, fates: &Fates) -> Option<(Known, (f64, f64))> {
    use basin_of_attraction::Traps;
    let label = fates.label(alpha)?;
    // No ends, so that nobody takes it for the trap of others.
    Some((Known { itinerary: Itinerary::START, label }, (f64::NAN, f64::NAN)))
}
