//! All basins at one mass ratio as intervals, at every mass ratio.

use crate::error::Error;
use crate::hop::strip::Strip;
use crate::line::ProvedLine;
use basin_of_attraction::{Interval, IntervalBasins, Refinement, StopReason};
use hopper_basin::{BranchGround, Fates, HopperBasins, HopperFate, hopper_basins};
use passive_hopper::alpha_star;

/// Parts of the window of a sweep, each with a budget of its own. They affect the time, and what stays open.
const PARTS: usize = 64;

/// The share of a part that the first sweep may leave open, and the factor from one sweep to the next. They affect
/// the time: with a smaller factor more sweeps are for nothing, with a larger one the last sweep resolves more than
/// is asked for.
const COARSEST: f64 = 0.1;
const FINER: f64 = 10.0;

/// Most speeds of a part.
const SPEEDS: usize = 1_000_000;

/// No finer sweep begins if the last one found more than this part of the intervals that are asked for. A larger
/// number ends earlier, with more that is undecided; a smaller one could end with several times as many intervals
/// as asked for.
const MORE: usize = 4;

/// The largest M at which windows are enclosed. Above it, their hops have hundreds of landings, and needles in them
/// are narrower than any spacing of `f64` (docs/theory.md, Section 4: 10⁻²² at M = 50), so that a sweep would take
/// long for little.
const LARGEST_ENCLOSED: f64 = 50.0;

/// The basins of all fates on [α*_`from`, α*_`to`], from images of intervals that are enclosed with rounding
/// outwards. No label is wrong, at any M. Levels are not counted.
///
/// Sweeps become finer until no more than `undecided` of the refinement is open, or until one finds a quarter of
/// its `intervals`; its other limits have no effect.
///
/// ```
/// use basin_of_attraction::Refinement;
/// use hopper_basin::Fates;
/// use hopper_proof::proved_basins;
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(2.0)?)?;
/// let refinement = Refinement { undecided: 0.01, ..Refinement::default() };
/// let found = proved_basins(&fates, 1, 2, refinement)?;
/// assert_eq!(found.probes.wrong, 0);
/// assert!(found.basins.undecided() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Error::Speeds`] unless `from` < `to` and all fixed points have labels; [`Error::Basin`] for a refinement that
/// is no number.
pub fn proved_basins(
    fates: &Fates,
    from: u64,
    to: u64,
    refinement: Refinement,
) -> Result<HopperBasins, Error> {
    let Refinement { undecided, intervals, .. } = refinement;
    // Neither a negative number nor NaN is a length.
    Interval::new(0.0, undecided).map_err(hopper_basin::Error::from)?;
    let last = to.min(HopperFate::LARGEST_LABEL + 1);
    let window = Interval { left: alpha_star(from.min(last)), right: alpha_star(last) };
    let strip = Strip::at(fates.map().mass_ratio().value())?;
    let mut share = COARSEST;
    let basins = loop {
        let line = ProvedLine::new(strip, window, PARTS, share, SPEEDS)?;
        let found = IntervalBasins::from_known(window, line.intervals(), StopReason::IntervalLimit)
            .map_err(hopper_basin::Error::from)?;
        if found.undecided() <= undecided {
            break found.with_stop_reason(StopReason::Resolved);
        }
        // A share so small that rounding decides what stays open would not end.
        if found.intervals().len() >= intervals / MORE || share < f64::EPSILON {
            break found;
        }
        share /= FINER;
    };
    Ok(HopperBasins::probed(basins, BranchGround::Enclosures, fates)?)
}

/// The basins of all fates on [α*_`from`, α*_`to`]: by branches, sharp to an ulp of the map and with levels, where
/// it is proved which branches there are ([`hopper_basins`]); else by enclosures ([`proved_basins`]). Above M = 50
/// the sudden windows stay undecided.
///
/// # Errors
/// Those of both.
pub fn basins_at_every_mass_ratio(
    fates: &Fates,
    from: u64,
    to: u64,
    samples: usize,
    refinement: Refinement,
) -> Result<HopperBasins, Error> {
    let found = hopper_basins(fates, from, to, samples, refinement)?;
    let resolved = found.basins.stop_reason() == StopReason::Resolved;
    let can_be_enclosed = fates.map().mass_ratio().value() <= LARGEST_ENCLOSED;
    if found.ground == BranchGround::ContactParts && !resolved && can_be_enclosed {
        return proved_basins(fates, from, to, refinement);
    }
    Ok(found)
}
