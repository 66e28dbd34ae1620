//! The fate of the exact orbit of an `f64`, followed with a bound on its error.
//!
//! ```text
//!   arithmetic          bound of a hop                              time of a hop
//!   f64                 sum of absolute values, in the kernel       a tenth of a microsecond
//!   f64                 signed derivative, landing by landing       some microseconds
//!   106 … 1024 bits     signed derivative                           tens of microseconds … milliseconds
//! ```
//!
//! Each row is used if the row above leaves a hop inconclusive. The orbit is then followed again from its start, which is
//! exact. Only two verdicts decide: the whole interval of the error lies inside a trap, or the hopper is grounded from all
//! of it. A speed beside the end of a trap is therefore followed further: its image lies on one side of α*_n.
//!
//! docs/theory.md, Theorem 79.

use crate::error::Error;
use crate::fates::slow_sides::SlowSides;
use crate::traps::trap::{Trap, TrapSide};
use passive_hopper::{
    Arithmetic, ExtendedOrbit, ExtendedStep, FixedPointSpeed, HopWithin, LiftOffMap, alpha_star,
    index_below,
};

/// The end of a followed orbit, with the number of hops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Verdict {
    /// In the trap of α*_n.
    Trapped(u64),
    Grounded,
    /// The budget of hops is used up.
    Budget,
    /// The arithmetic does not decide the next hop.
    Inconclusive {
        /// The speed before this hop.
        at: f64,
    },
}

/// Largest number of hops of a fate in each of [`Arithmetic::ALL`], a jump counted as one. On a quiet machine each of them takes
/// at most some tenths of a second. Past it the fate is undecided, for the reason
/// [`UndecidedReason::Precision`](basin_of_attraction::UndecidedReason::Precision).
const EXTENDED_BUDGETS: [usize; 4] = [2048, 512, 128, 64];

/// The map at one mass ratio, and its traps by their index.
pub(crate) struct CertainFates<'a, T> {
    pub(crate) map: &'a LiftOffMap,
    pub(crate) trap: T,
    pub(crate) slow: &'a SlowSides,
}

impl<T: Fn(u64) -> Result<Trap, Error>> CertainFates<'_, T> {
    /// The verdict on the exact orbit of `alpha`, and the number of hops until it was known.
    pub(crate) fn verdict(&self, alpha: f64, budget: usize) -> Result<(Verdict, usize), Error> {
        let plain = self.in_f64(alpha, budget, LiftOffMap::hop_within)?;
        let Verdict::Inconclusive { .. } = plain.0 else { return Ok(plain) };
        let signed = self.in_f64(alpha, budget, LiftOffMap::signed_hop_within)?;
        let Verdict::Inconclusive { .. } = signed.0 else { return Ok(signed) };
        let mut verdict = signed;
        for (arithmetic, most) in Arithmetic::ALL.into_iter().zip(EXTENDED_BUDGETS) {
            match self.in_extended(alpha, (budget, most), arithmetic)? {
                (Some(inconclusive @ Verdict::Inconclusive { .. }), hops) => {
                    verdict = (inconclusive, hops);
                }
                (Some(decided), hops) => return Ok((decided, hops)),
                // A longer arithmetic would use up its budget as well.
                (None, _) => break,
            }
        }
        Ok(verdict)
    }

    /// The verdict in `f64`, with one of the two bounds.
    fn in_f64(
        &self,
        alpha: f64,
        budget: usize,
        hop: impl Fn(&LiftOffMap, f64, f64) -> HopWithin,
    ) -> Result<(Verdict, usize), Error> {
        let (mut speed, mut error) = (alpha, 0.0);
        let mut hops = 0;
        for followed in 0..=budget {
            let n = index_below(speed)?;
            if let Some(n) = self.trap_within(n, speed, error)? {
                return Ok((Verdict::Trapped(n), hops));
            }
            if followed == budget {
                break;
            }
            if let Some(offset) = self.slow.offset_if_near(speed, n + 1)
                && let Some((slow, offset, bound)) =
                    self.slow.leave(n + 1, offset, error + f64::EPSILON * -offset)
            {
                speed = alpha_star(n + 1) + offset;
                // Half an ulp each for α*, and for the sum.
                error = bound + f64::EPSILON * speed;
                hops = hops.saturating_add(usize::try_from(slow).unwrap_or(usize::MAX));
                continue;
            }
            match hop(self.map, speed, error) {
                HopWithin::Next { speed: next, error: bound } => (speed, error) = (next, bound),
                HopWithin::Grounded => return Ok((Verdict::Grounded, hops + 1)),
                HopWithin::Inconclusive => {
                    return Ok((Verdict::Inconclusive { at: speed }, hops));
                }
            }
            hops += 1;
        }
        Ok((Verdict::Budget, hops))
    }

    /// The index of the trap that contains all speeds within `error` of `speed`, which lies above α*_n.
    fn trap_within(&self, n: u64, speed: f64, error: f64) -> Result<Option<u64>, Error> {
        let trap = (self.trap)(n)?;
        let side = if error == 0.0 {
            trap.side(speed)
        } else {
            trap.side_of_offset(trap.fixed_point.offset_of(speed), error)
        };
        Ok((side == TrapSide::Inside).then_some(trap.n))
    }

    /// The verdict in longer arithmetic, within a budget of hops of the caller and one of this arithmetic; `None` if the
    /// second is used up.
    fn in_extended(
        &self,
        alpha: f64,
        (budget, most): (usize, usize),
        arithmetic: Arithmetic,
    ) -> Result<(Option<Verdict>, usize), Error> {
        let mut orbit = ExtendedOrbit::new(self.map, alpha, arithmetic)?;
        let mut hops = 0;
        for followed in 0..=budget {
            let speed = orbit.speed();
            let mut n = index_below(speed)?;
            let (mut offset, mut error) = orbit.offset_from(n);
            // The rounded speed may lie on the other side of a fixed point than the orbit.
            if offset < 0.0 && n > 0 {
                n -= 1;
                (offset, error) = orbit.offset_from(n);
            } else if let above @ (0.0.., _) = orbit.offset_from(n + 1) {
                n += 1;
                (offset, error) = above;
            }
            if (self.trap)(n)?.side_of_offset(offset, error) == TrapSide::Inside {
                return Ok((Some(Verdict::Trapped(n)), hops));
            }
            if followed == budget {
                break;
            }
            if followed >= most {
                return Ok((None, hops));
            }
            // A jump leaves the error of its phase, the same in all arithmetics. Where a longer one can follow the slow hops, it
            // keeps its digits.
            let fewest = if arithmetic == Arithmetic::Bits106 { 1 } else { most - followed };
            if let Some(jumped) = self.jump_in_extended(n + 1, fewest, &mut orbit)? {
                hops = hops.saturating_add(jumped);
                continue;
            }
            match orbit.hop() {
                Ok(ExtendedStep::LiftsOff) => hops += 1,
                Ok(ExtendedStep::Grounded) => return Ok((Some(Verdict::Grounded), hops + 1)),
                Ok(ExtendedStep::Inconclusive) | Err(_) => {
                    return Ok((Some(Verdict::Inconclusive { at: speed }), hops));
                }
            }
        }
        Ok((Some(Verdict::Budget), hops))
    }

    /// Moves the orbit to the end of its slow hops left of α*_n, and gives their number; `None` if it is not near, or they are
    /// less than `fewest`.
    fn jump_in_extended(
        &self,
        n: u64,
        fewest: usize,
        orbit: &mut ExtendedOrbit,
    ) -> Result<Option<usize>, Error> {
        if self.slow.offset_if_near(orbit.speed().min(below(n)), n).is_none() {
            return Ok(None);
        }
        let (offset, rest, error) = orbit.long_offset_from(n);
        let Some(jump) = self.slow.long_jump(n, (offset, rest), error) else { return Ok(None) };
        if jump.hops < fewest as u64 {
            return Ok(None);
        }
        orbit.move_to(n, jump.delta, jump.error)?;
        Ok(Some(jump.hops as usize))
    }
}

/// The largest `f64` below α*_n: a speed with more bits may round to a number above.
fn below(n: u64) -> f64 {
    FixedPointSpeed::new(n).largest_below()
}
