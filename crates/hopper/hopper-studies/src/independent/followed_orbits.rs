//! Fates by following orbits of a map into traps whose edges were searched on that map.

use super::map::Map;
use super::trap_edge::trap_edge;
use crate::error::Error;
use passive_hopper::{MassRatio, alpha_star};
use std::f64::consts::PI;

/// Most hops of an orbit. The orbits of the claims need a few dozen; the slowest are those that start left of a fixed
/// point, and a point at 10⁻⁶ of the window from it needs some hundred.
const HOPS: usize = 100_000;

/// The orbits of one map at one mass ratio.
pub(crate) struct FollowedOrbits<'a, F> {
    map: &'a F,
    mass_ratio: MassRatio,
    /// α*_n and the right end of its trap, from n = 1 on.
    traps: Vec<(f64, f64)>,
}

impl<'a, F: Map> FollowedOrbits<'a, F> {
    /// The orbits that start below α*_`top`.
    pub(crate) fn new(map: &'a F, mass_ratio: MassRatio, top: u64) -> Result<Self, Error> {
        let trap = |n: u64| {
            let edge = trap_edge(map, n, mass_ratio)?;
            Ok((alpha_star(n), edge.map_or((n + 1) as f64 * PI, |edge| edge.alpha)))
        };
        Ok(FollowedOrbits {
            map,
            mass_ratio,
            traps: (1..top).map(trap).collect::<Result<_, Error>>()?,
        })
    }

    /// The number of hops after which the orbit is in a trap, and the trap's index. `None` if it falls below α*_1 or is
    /// grounded.
    pub(crate) fn end(&self, mut alpha: f64) -> Result<Option<(usize, u64)>, Error> {
        for hops in 0..HOPS {
            let below = self.traps.partition_point(|trap| trap.0 <= alpha);
            let Some(trap) = below.checked_sub(1).map(|k| self.traps[k]) else { return Ok(None) };
            if alpha <= trap.1 {
                return Ok(Some((hops, below as u64)));
            }
            match (self.map)(alpha, self.mass_ratio)? {
                Some(next) => alpha = next,
                None => return Ok(None),
            }
        }
        Err(Error::CheckFailed(format!("an orbit is at {alpha} after {HOPS} hops")))
    }
}
