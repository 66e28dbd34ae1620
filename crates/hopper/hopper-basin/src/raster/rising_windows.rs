//! The sudden windows (nπ, α*_n) on which the map is proved to rise.
//!
//! The proof (docs/theory.md, Theorem 48) encloses the derivative with intervals: `cargo xtask prove rising`, and a
//! test of `hopper-proof` for the table here.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::traps::trap::{Trap, TrapEdge};
use basin_of_attraction::Interval;
use passive_hopper::alpha_star;
use std::f64::consts::PI;

/// The distance from α*_n at which the part ends on which the raster takes the map to rise.
///
/// At α*_n the slope changes like the cube root of the distance. Speeds in the remaining 10⁻³ have no lap; in a
/// raster of the paper's window they are 0.03 % of the rows.
const DISTANCE_FROM_STAR: f64 = 1e-3;

/// For the windows n = 1, 2, …: the largest M. It must be below 0.9056, up to which a hop has at most one sudden
/// lift-off.
///
/// Near 0.905 the smallest slope tends to zero with n, and a proof needs ever more boxes.
const PROVED: [f64; 10] = [0.905, 0.905, 0.905, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9];

/// A part of a sudden window on which the map is proved to rise, for small mass ratios.
///
/// For these mass ratios a hop has at most one sudden lift-off, and the map is continuous on the window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RisingWindow {
    /// From nπ to 10⁻³ below α*_n.
    pub part: Interval,
    /// The largest M of the proof.
    pub largest_mass_ratio: f64,
}

/// Window n if n is in 1, …, 10; `None` for all other windows, for which there is no proof.
pub fn rising_window(n: u64) -> Option<RisingWindow> {
    let at = usize::try_from(n).ok()?.checked_sub(1)?;
    let &largest_mass_ratio = PROVED.get(at)?;
    let part = Interval { left: n as f64 * PI, right: alpha_star(n) - DISTANCE_FROM_STAR };
    Some(RisingWindow { part, largest_mass_ratio })
}

/// The trap of α*_n, with the window beyond it if f stays above α*_n there.
///
/// If f ≥ α*_n on the whole contact part of hump n, and f is continuous at (n+1)π and rises from there to α*_{n+1}
/// (docs/theory.md, Theorems 23, 48 and 81), f ≥ α*_n on the whole window.
pub(crate) fn trap_with_window(fates: &Fates, n: u64) -> Result<Trap, Error> {
    let trap = fates.trap(n)?;
    let ratio = fates.map().mass_ratio().value();
    let rises = rising_window(n + 1).is_some_and(|window| ratio <= window.largest_mass_ratio);
    match trap.edge {
        TrapEdge::ContactEnd if rises => Ok(Trap { edge: TrapEdge::NextFixedPoint, ..trap }),
        _ => Ok(trap),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fates::hopper_fate::HopperFate;
    use passive_hopper::MassRatio;

    /// Only windows 1 to 10 have a proof.
    #[test]
    fn a_window_other_than_1_to_10_has_no_proof() {
        for n in [0, 11, 12, u64::MAX] {
            assert_eq!(rising_window(n), None);
        }
        let window = rising_window(1).unwrap();
        assert!(window.largest_mass_ratio > 0.9 && window.part.contains(4.0));
    }

    /// A trap that reaches over its window has the fates of single orbits, up to the next fixed point.
    #[test]
    fn a_trap_over_a_window_has_the_fates_of_its_orbits() {
        let mut extended = 0;
        for k in 0..600u32 {
            let part = |step: f64| (f64::from(k) * step).fract();
            let fates = Fates::new(MassRatio::new(0.01 + 0.4 * part(0.618_033_988_75)).unwrap());
            let (fates, n) = (fates.unwrap(), u64::from(k % 3));
            let trap = trap_with_window(&fates, n).unwrap();
            if fates.trap(n).unwrap().edge != TrapEdge::ContactEnd {
                assert_eq!(trap, fates.trap(n).unwrap());
                continue;
            }
            assert_eq!(trap.edge, TrapEdge::NextFixedPoint);
            let (left, right) = ((n + 1) as f64 * PI, alpha_star(n + 1));
            for alpha in [left + (right - left) * part(0.754_877_666_25), right - 1e-9 * right] {
                assert!(trap.contains(alpha));
                let label = fates.fate(alpha).unwrap().label();
                assert_eq!(
                    label,
                    HopperFate::label_of_fixed_point(n),
                    "M = {}, α = {alpha}",
                    fates.map().mass_ratio().value()
                );
            }
            extended += 1;
        }
        assert!(extended > 100, "{extended}");
    }
}
