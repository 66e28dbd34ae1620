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
use crate::traps::trap::{Trap, TrapSide};
use passive_hopper::{
    Arithmetic, ExtendedOrbit, ExtendedStep, HopWithin, LiftOffMap, alpha_star, index_below,
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

/// Largest number of hops of a fate in each of [`Arithmetic::ALL`]. On a quiet machine each of them takes at most some tenths
/// of a second. A larger value decides more of the orbits that leave a fixed point slowly; past it the fate is undecided, for
/// the reason [`UndecidedReason::Precision`](basin_of_attraction::UndecidedReason::Precision).
const EXTENDED_BUDGETS: [usize; 4] = [2048, 512, 128, 64];

/// Largest |δ| left of a fixed point for which the number of hops to leave it is estimated. Beyond it the number is small.
const SLOW: f64 = 1e-3;

/// The map at one mass ratio, and its traps by their index.
pub(crate) struct CertainFates<'a, T> {
    pub(crate) map: &'a LiftOffMap,
    pub(crate) trap: T,
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
        for hops in 0..=budget {
            if let Some(n) = self.trap_within(speed, error)? {
                return Ok((Verdict::Trapped(n), hops));
            }
            if hops == budget {
                break;
            }
            match hop(self.map, speed, error) {
                HopWithin::Next { speed: next, error: bound } => (speed, error) = (next, bound),
                HopWithin::Grounded => return Ok((Verdict::Grounded, hops + 1)),
                HopWithin::Inconclusive => {
                    return Ok((Verdict::Inconclusive { at: speed }, hops));
                }
            }
        }
        Ok((Verdict::Budget, budget))
    }

    /// The index of the trap that contains all speeds within `error` of `speed`.
    fn trap_within(&self, speed: f64, error: f64) -> Result<Option<u64>, Error> {
        let trap = (self.trap)(index_below(speed)?)?;
        let side = if error == 0.0 {
            trap.side(speed)
        } else {
            trap.side_of_offset(trap.fixed_point.offset_of(speed), error)
        };
        Ok((side == TrapSide::Inside).then_some(trap.n))
    }

    /// The verdict in longer arithmetic, within a budget of hops of the caller and one of this arithmetic; `None` if the
    /// second is used up, or would be by an estimate.
    fn in_extended(
        &self,
        alpha: f64,
        (budget, most): (usize, usize),
        arithmetic: Arithmetic,
    ) -> Result<(Option<Verdict>, usize), Error> {
        let mut orbit = ExtendedOrbit::new(self.map, alpha, arithmetic)?;
        for hops in 0..=budget {
            let speed = orbit.speed();
            let mut n = index_below(speed)?;
            let (mut offset, mut error) = orbit.offset_from(n);
            if offset < 0.0 && n > 0 {
                // The rounded speed lies above α*_n, and the orbit below it.
                n -= 1;
                (offset, error) = orbit.offset_from(n);
            }
            if (self.trap)(n)?.side_of_offset(offset, error) == TrapSide::Inside {
                return Ok((Some(Verdict::Trapped(n)), hops));
            }
            if hops == budget {
                break;
            }
            if hops >= most || self.hops_to_leave(n + 1, &orbit) > (most - hops) as f64 {
                return Ok((None, hops));
            }
            match orbit.hop() {
                Ok(ExtendedStep::LiftsOff) => {}
                Ok(ExtendedStep::Grounded) => return Ok((Some(Verdict::Grounded), hops + 1)),
                Ok(ExtendedStep::Inconclusive) | Err(_) => {
                    return Ok((Some(Verdict::Inconclusive { at: speed }), hops));
                }
            }
        }
        Ok((Some(Verdict::Budget), budget))
    }

    /// Five sixths of the number of hops that the orbit takes to leave α*_n to the left: at offset δ it needs about
    /// 3/(10λ|δ|^{1/3}) (docs/theory.md, Theorem 38). 0 if it is not near.
    ///
    /// The estimate only avoids work that would end in an undecided fate. It decides no fate.
    fn hops_to_leave(&self, n: u64, orbit: &ExtendedOrbit) -> f64 {
        // α*_n − speed in `f64` is accurate enough unless it is small.
        if alpha_star(n) - orbit.speed() > SLOW {
            return 0.0;
        }
        let (offset, _) = orbit.offset_from(n);
        let a = alpha_star(n);
        // β³ = 12a²/(1+a²), λ = μaβ⁴/8 (docs/theory.md, Section 7).
        let beta = pxfm::f_cbrt(12.0 / (1.0 + 1.0 / (a * a)));
        let lambda = self.map.mass_ratio().mu() * a * beta * beta * beta * beta / 8.0;
        0.25 / (lambda * pxfm::f_cbrt(offset.abs()))
    }
}
