//! The immediate basin of a fixed point: the part of its basin that begins at the fixed point.
//!
//! A [`Trap`] ends at the latest where the contact part of its hump ends. The immediate basin may continue in the
//! sudden window. Theory gives no formula for its end there, and a scan searches for it.

use crate::error::Error;
use crate::traps::crisis::crisis;
use crate::traps::trap::{Trap, TrapEdge};
use passive_hopper::{FixedPointSpeed, LiftOffMap, MassRatio};

/// More points than this are refused: a scan of ten million hops takes about a second.
const MOST_POINTS: f64 = 1e7;

/// The immediate basin of α*_n: the largest interval [α*_n, α*_n + Δ) on which f ≥ α*_n, at most up to α*_{n+1}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImmediateBasin {
    /// Δ, the length.
    pub delta: f64,
    /// Bound on the error of Δ, provided that the scan missed no earlier end.
    pub error: f64,
    /// Why the immediate basin ends there.
    pub edge: ImmediateBasinEdge,
}

/// Where an immediate basin ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ImmediateBasinEdge {
    /// On the contact part of the hump. f crosses α*_n downwards only once there (docs/theory.md, Theorem 29).
    Contact,
    /// In the sudden window, at the first speed with f < α*_n that a scan found. The scan may have missed an
    /// earlier interval with f < α*_n, if that is narrower than the spacing.
    Sudden {
        /// The spacing of the scan.
        width: f64,
    },
    /// At the next fixed point; proved by a bound on the loss of a hop (docs/theory.md, Lemma 32).
    NextFixedPoint,
    /// At the next fixed point: the scan found no speed with f < α*_n. It may have missed an interval narrower
    /// than the spacing.
    NotFound {
        /// The spacing of the scan.
        width: f64,
    },
}

/// The immediate basin of α*_n at the mass ratio of `map`.
///
/// On the contact part of hump n the result is certain. The sudden window beyond it is scanned at a spacing of
/// `width`. For M ≳ 10 the map has needles narrower than any spacing of `f64` (canards): the result then
/// holds for the given width only.
///
/// ```
/// use hopper_basin::{ImmediateBasinEdge, immediate_basin};
/// use passive_hopper::{LiftOffMap, MassRatio};
/// let found = immediate_basin(&LiftOffMap::new(MassRatio::new(10.0)?), 1, 1e-3)?;
/// assert!((found.delta - 2.57746178999).abs() < 1e-10);
/// assert!(matches!(found.edge, ImmediateBasinEdge::Sudden { .. }));
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// As [`Trap::new`]; [`Error::Spacing`] unless `width` is positive and gives between one and ten million
/// points; [`Error::Hopper`] where the map cannot be evaluated.
pub fn immediate_basin(map: &LiftOffMap, n: u64, width: f64) -> Result<ImmediateBasin, Error> {
    let trap = Trap::new(n, map.mass_ratio())?;
    let edge = match trap.edge {
        TrapEdge::Crossing => ImmediateBasinEdge::Contact,
        TrapEdge::NextFixedPoint => ImmediateBasinEdge::NextFixedPoint,
        TrapEdge::ContactEnd => return scan(map, &trap, width),
    };
    Ok(ImmediateBasin { delta: trap.delta, error: trap.error, edge })
}

/// The immediate basin of a trap that takes up the whole contact part.
fn scan(map: &LiftOffMap, trap: &Trap, width: f64) -> Result<ImmediateBasin, Error> {
    let next = FixedPointSpeed::new(trap.n + 1);
    let (left, right) = (trap.right(), next.value().next_down());
    let points = ((right - left) / width).ceil();
    if !(width > 0.0 && (1.0..=MOST_POINTS).contains(&points)) {
        return Err(Error::Spacing { spacing: width, length: right - left });
    }
    // The image is compared with the `f64` nearest to α*_n, not with the 100 bits of α*_n. Next to α*_n the computed
    // image may equal this `f64` even if the `f64` lies below α*_n: this does not count as a fall. Grounding counts as
    // a fall.
    let falls = |alpha: f64| -> Result<bool, Error> {
        Ok(map.image(alpha)?.is_none_or(|image| image < trap.fixed_point.value()))
    };
    let mut above = left;
    for point in 1..=points as u64 {
        let at = (left + (right - left) * (point as f64 / points)).min(right);
        if falls(at)? {
            let mut below = at;
            // Bisection down to neighbouring `f64`: the first fall is no jump over α*_n (docs/theory.md, Lemma 33).
            while above.next_up() < below {
                let middle = above + 0.5 * (below - above);
                if falls(middle)? { below = middle } else { above = middle }
            }
            let delta = trap.fixed_point.offset_of(below);
            let error = edge_error(map, below)?;
            return Ok(ImmediateBasin { delta, error, edge: ImmediateBasinEdge::Sudden { width } });
        }
        above = at;
    }
    let delta = trap.fixed_point.offset_of(next.value());
    Ok(ImmediateBasin {
        delta,
        error: f64::EPSILON * delta,
        edge: ImmediateBasinEdge::NotFound { width },
    })
}

/// Bound on the error of a speed `alpha` at which the computed map crosses a given value: an ulp of `alpha`, and the
/// error of the computed map divided by its slope.
fn edge_error(map: &LiftOffMap, alpha: f64) -> Result<f64, Error> {
    let ulp = f64::EPSILON * alpha;
    let (hop, slopes) = (map.hop(alpha)?, map.slopes(alpha)?);
    // A grounded hop has no slope. This case occurs only if f falls from α*_n to the ground between two neighbouring
    // `f64`. The bound is then one ulp.
    let (Some(next), Some(slopes)) = (hop.next, slopes) else { return Ok(ulp) };
    // `LiftOffMap` states its error as 4 (1 + sudden) of this unit.
    let unit = slopes.error_unit(alpha, map.mass_ratio().value(), next);
    Ok(ulp + 4.0 * (1 + hop.sudden) as f64 * unit / slopes.by_speed.abs())
}

/// Mass ratios tried by [`upper_crisis_bracket`] before it bisects, in geometric steps. Each costs a scan. Mass
/// ratios at which orbits fall again may lie between two neighbouring ones; they are then missed, and the bracket is
/// too low. More would miss fewer. If the largest M is five times 1/M_c(n), neighbouring ones differ by 5 %.
const TRIED_MASS_RATIOS: u32 = 32;

/// The relative length to which [`upper_crisis_bracket`] closes its bracket. Each factor of 10 costs three to four
/// scans more. Below an ulp, 2·10⁻¹⁶, the middle of the bracket would be one of its ends, and the bisection would not
/// end.
const BRACKET_LENGTH: f64 = 1e-6;

/// Two mass ratios above 1 that enclose the largest one at which orbits of hump n fall below α*_n: at the first
/// of the pair a fall was found, at the second none.
///
/// This is the counterpart for M > 1 of the [`crisis`], which concerns only the contact part. Here the sudden window
/// counts too: it is scanned at a spacing of `width`, as by [`immediate_basin`]. If the window never adds a fall, both
/// numbers are 1/M_c(n), where the contact part stops letting orbits fall.
///
/// The bracket is closed to a relative length of 10⁻⁶. The absence of falls at larger mass ratios is checked at only 32
/// mass ratios between 1/M_c(n) and `largest`.
///
/// # Errors
/// As [`immediate_basin`] and [`crisis`]; [`Error::LargestMassRatio`] if a fall is found at `largest`.
pub fn upper_crisis_bracket(n: u64, width: f64, largest: f64) -> Result<(f64, f64), Error> {
    let contact = 1.0 / crisis(n)?.mass_ratio;
    let falls = |m: f64| -> Result<bool, Error> {
        let found = immediate_basin(&LiftOffMap::new(MassRatio::new(m)?), n, width)?;
        Ok(!matches!(
            found.edge,
            ImmediateBasinEdge::NotFound { .. } | ImmediateBasinEdge::NextFixedPoint
        ))
    };
    // Mass ratio k of the geometric steps from 1/M_c(n) to the largest.
    let at = |k: u32| {
        let part = f64::from(k) / f64::from(TRIED_MASS_RATIOS);
        contact * pxfm::f_pow(largest / contact, part)
    };
    let mut without_falls = None;
    for k in (0..=TRIED_MASS_RATIOS).rev() {
        if falls(at(k))? {
            let Some(mut above) = without_falls else {
                return Err(Error::LargestMassRatio { n, largest });
            };
            let mut below = at(k);
            while above - below > BRACKET_LENGTH * above {
                let middle = 0.5 * (below + above);
                if falls(middle)? { below = middle } else { above = middle }
            }
            return Ok((below, above));
        }
        without_falls = Some(at(k));
    }
    Ok((contact, contact))
}
