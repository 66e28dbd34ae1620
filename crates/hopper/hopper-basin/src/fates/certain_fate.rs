//! The fate of the exact orbit of an `f64`, followed with a bound on its error.
//!
//! ```text
//!   arithmetic          bound of a hop                              time of a hop
//!   f64                 sum of absolute values, in the kernel       a tenth of a microsecond
//!   f64                 signed derivative, landing by landing       some microseconds
//!   106 … 1024 bits     signed derivative                           tens of microseconds … milliseconds
//! ```
//!
//! Each row is used if the row above leaves a hop inconclusive. The orbit is then followed again from its start,
//! which is exact. Only two verdicts decide: the whole interval of the error lies inside a trap, or the hopper is
//! grounded from all of it. A speed beside the end of a trap is therefore followed further: its image lies on one
//! side of α*_n.
//!
//! docs/theory.md, Theorem 79.

use crate::error::Error;
use crate::fates::slow_sides::SlowSides;
use crate::traps::trap::{Trap, TrapEdge, TrapSide};
use passive_hopper::{
    Arithmetic, ExtendedOrbit, ExtendedStep, FixedPointSpeed, HopWithin, LiftOffMap, alpha_star,
    compare_with_multiple_of_pi, index_below,
};
use std::cmp::Ordering;

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

/// Largest number of hops of a fate in each of [`Arithmetic::ALL`], a jump counted as one. Each of them takes at
/// most some tenths of a second: 0.3 ms a hop in 256 bits. Past it the fate is undecided, for the reason
/// [`UndecidedReason::Precision`](basin_of_attraction::UndecidedReason::Precision).
///
/// 256 bits have as many hops as 106: where the error of a jump is too large, they follow up to 2048 slow hops one
/// by one. For M ≥ 10 an orbit passes by several fixed points one after the other, and each multiplies its error.
const EXTENDED_BUDGETS: [usize; 4] = [2048, 2048, 128, 64];

/// Largest error of the upper end of a trap, relative to its length, at which a speed within the error is certainly
/// left of the map's minimum. The slope of the map's two sides at the end is then above 10⁻⁷ of its scale, and so
/// is the distance to the minimum. A larger value is not safe beside a crisis; a smaller one leaves more ends to
/// the next hop.
const CERTAIN_END: f64 = 1e-9;

/// An orbit in `f64`, with a bound on its error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlainOrbit {
    pub(crate) speed: f64,
    pub(crate) error: f64,
    /// Hops since the start, with those that were jumped over.
    pub(crate) hops: usize,
    /// Hops and jumps, for the budget.
    followed: usize,
    beside: Beside,
}

/// The last speeds of an orbit, as long as each of them lies within its error of an end of the same trap.
///
/// Up to the first fall f is not below α*_n, and beyond it f is below; left of α*_n as well, and no orbit rises
/// (docs/theory.md, Theorem 29). So if an orbit is in the trap at last, all these speeds were in it: the fate was
/// decided at the first one.
#[derive(Debug, Clone, Copy, Default)]
struct Beside {
    /// The index of the trap, and the hops at the first of these speeds.
    first: Option<(u64, usize)>,
    /// The error hid on which side of the end of the contact part a speed is, behind which f may stay above α*_n:
    /// the number of hops is open.
    open: bool,
}

impl Beside {
    /// Sees the side of a speed after so many hops; if it is inside, the number of hops at the first of these speeds.
    fn see(&mut self, trap: &Trap, side: TrapSide, hops: usize) -> Option<usize> {
        let first = self.first.filter(|(n, _)| *n == trap.n).map_or(hops, |(_, first)| first);
        if side == TrapSide::Inside {
            return Some(first);
        }
        let is_unclear = side == TrapSide::Unclear;
        let is_contact_end = trap.edge == TrapEdge::ContactEnd;
        // Beside a crisis f may stay above α*_n behind the end.
        let is_certain = trap.error < CERTAIN_END * trap.delta;
        self.open |= is_unclear && is_contact_end && is_certain;
        let ends_certainly = is_certain && !is_contact_end;
        self.first = (is_unclear && ends_certainly).then_some((trap.n, first));
        None
    }
}

impl PlainOrbit {
    pub(crate) fn new(alpha: f64) -> Self {
        PlainOrbit { speed: alpha, error: 0.0, hops: 0, followed: 0, beside: Beside::default() }
    }

    /// Whether longer arithmetic is needed to tell the number of hops.
    pub(crate) fn count_is_open(&self) -> bool {
        self.beside.open
    }

    /// Takes the next hop; the verdict if the orbit ends with it.
    pub(crate) fn hop(&mut self, hop: HopWithin) -> Option<Verdict> {
        let verdict = match hop {
            HopWithin::Next { speed, error } => {
                (self.speed, self.error) = (speed, error);
                None
            }
            HopWithin::Grounded => Some(Verdict::Grounded),
            HopWithin::Inconclusive => return Some(Verdict::Inconclusive { at: self.speed }),
        };
        self.hops += 1;
        self.followed += 1;
        verdict
    }
}

/// The map at one mass ratio, and its traps by their index.
pub(crate) struct CertainFates<'a, T> {
    pub(crate) map: &'a LiftOffMap,
    pub(crate) trap: T,
    pub(crate) slow: &'a SlowSides,
}

impl<T: Fn(u64) -> Result<Trap, Error>> CertainFates<'_, T> {
    /// The verdict on the exact orbit of `alpha`, and the number of hops until it was known.
    pub(crate) fn verdict(&self, alpha: f64, budget: usize) -> Result<(Verdict, usize), Error> {
        let (plain, open) = self.in_f64(alpha, budget, LiftOffMap::hop_within)?;
        let mut verdict = plain;
        if let Verdict::Inconclusive { .. } = plain.0 {
            let (signed, open) = self.in_f64(alpha, budget, LiftOffMap::signed_hop_within)?;
            verdict = signed;
            if !matches!(signed.0, Verdict::Inconclusive { .. }) && !open {
                return Ok(signed);
            }
        } else if !open {
            return Ok(plain);
        }
        for (arithmetic, most) in Arithmetic::ALL.into_iter().zip(EXTENDED_BUDGETS) {
            match self.in_extended(alpha, (budget, most), arithmetic)? {
                (Some(inconclusive @ Verdict::Inconclusive { .. }), hops) => {
                    // A fate that `f64` knows stays, with the number of hops that it found.
                    if let Verdict::Inconclusive { .. } = verdict.0 {
                        verdict = (inconclusive, hops);
                    }
                }
                (Some(decided), hops) => return Ok((decided, hops)),
                // A longer arithmetic would use up its budget as well.
                (None, _) => break,
            }
        }
        Ok(verdict)
    }

    /// The verdict in `f64`, with one of the two bounds, and whether its number of hops is open.
    fn in_f64(
        &self,
        alpha: f64,
        budget: usize,
        hop: impl Fn(&LiftOffMap, f64, f64) -> HopWithin,
    ) -> Result<((Verdict, usize), bool), Error> {
        let mut orbit = PlainOrbit::new(alpha);
        loop {
            if let Some(verdict) = self.until_next_hop(&mut orbit, budget)? {
                return Ok(((verdict, orbit.hops), orbit.count_is_open()));
            }
            if let Some(verdict) = orbit.hop(hop(self.map, orbit.speed, orbit.error)) {
                return Ok(((verdict, orbit.hops), orbit.count_is_open()));
            }
        }
    }

    /// Takes the orbit to its next hop, over the slow hops beside a fixed point; the verdict if there is one before.
    pub(crate) fn until_next_hop(
        &self,
        orbit: &mut PlainOrbit,
        budget: usize,
    ) -> Result<Option<Verdict>, Error> {
        loop {
            let n = index_below(orbit.speed)?;
            let (trap, side) = self.side_within(n, orbit.speed, orbit.error)?;
            if let Some(hops) = orbit.beside.see(&trap, side, orbit.hops) {
                orbit.hops = hops;
                return Ok(Some(Verdict::Trapped(n)));
            }
            if orbit.followed == budget {
                return Ok(Some(Verdict::Budget));
            }
            let Some(offset) = self.slow.offset_if_near(orbit.speed, n + 1) else {
                return Ok(None);
            };
            let error = orbit.error + f64::EPSILON * -offset;
            let Some((slow, offset, bound)) = self.slow.leave(n + 1, offset, error) else {
                return Ok(None);
            };
            orbit.speed = alpha_star(n + 1) + offset;
            // Half an ulp each for α*, and for the sum.
            orbit.error = bound + f64::EPSILON * orbit.speed;
            orbit.hops = orbit.hops.saturating_add(usize::try_from(slow).unwrap_or(usize::MAX));
            orbit.followed += 1;
        }
    }

    /// The trap of α*_n, and where all speeds within `error` of `speed`, which lies above α*_n, are.
    fn side_within(&self, n: u64, speed: f64, error: f64) -> Result<(Trap, TrapSide), Error> {
        let trap = (self.trap)(n)?;
        if error != 0.0 {
            let side = trap.side_of_offset(trap.fixed_point.offset_of(speed), error);
            return Ok((trap, side));
        }
        let side = match trap.side(speed) {
            TrapSide::Unclear if self.is_at_end_of(&trap, speed)? => TrapSide::Inside,
            side => side,
        };
        Ok((trap, side))
    }

    /// Whether an exact speed within the error of the upper end of a trap is in it.
    ///
    /// Up to the first fall f is not below α*_n, and beyond it f is below (docs/theory.md, Theorem 29). So the next
    /// speed decides.
    fn is_at_end_of(&self, trap: &Trap, speed: f64) -> Result<bool, Error> {
        // Beside a crisis the error is large, whatever the computed edge is.
        if !(trap.error < CERTAIN_END * trap.delta) {
            return Ok(false);
        }
        if trap.edge == TrapEdge::ContactEnd {
            return Ok(compare_with_multiple_of_pi(speed, trap.n + 1) == Some(Ordering::Less));
        }
        for arithmetic in Arithmetic::ALL {
            let mut orbit = ExtendedOrbit::new(self.map, speed, arithmetic)?;
            if !matches!(orbit.hop(), Ok(ExtendedStep::LiftsOff)) {
                continue;
            }
            let (offset, error) = orbit.offset_from(trap.n);
            if offset.abs() > error {
                return Ok(offset > 0.0);
            }
        }
        Ok(false)
    }

    /// The verdict in longer arithmetic, within a budget of hops of the caller and one of this arithmetic; `None`
    /// if the second is used up.
    fn in_extended(
        &self,
        alpha: f64,
        (budget, most): (usize, usize),
        arithmetic: Arithmetic,
    ) -> Result<(Option<Verdict>, usize), Error> {
        let mut orbit = ExtendedOrbit::new(self.map, alpha, arithmetic)?;
        let (mut hops, mut beside) = (0, Beside::default());
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
            let trap = (self.trap)(n)?;
            let mut side = trap.side_of_offset(offset, error);
            // Beside a crisis the end is no end of the contact part for certain.
            let is_contact_end =
                trap.edge == TrapEdge::ContactEnd && trap.error < CERTAIN_END * trap.delta;
            if side == TrapSide::Unclear && is_contact_end && offset > error {
                side = match orbit.compare_with_multiple_of_pi(n + 1) {
                    Some(Ordering::Less) => TrapSide::Inside,
                    Some(_) => TrapSide::Outside,
                    None => side,
                };
            }
            if let Some(hops) = beside.see(&trap, side, hops) {
                return Ok((Some(Verdict::Trapped(n)), hops));
            }
            if followed == budget {
                break;
            }
            if followed >= most {
                return Ok((None, hops));
            }
            // A jump leaves the error of its phase, the same in all arithmetics. Where a longer one can follow the
            // slow hops, it keeps its digits.
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

    /// Moves the orbit to the end of its slow hops left of α*_n, and gives their number; `None` if it is not near,
    /// or they are less than `fewest`.
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
