//! Ends of intervals, moved inwards until every speed between them has the fate of the interval.
//!
//! An interval of level k was found as the preimage of one of level k − 1, by a root that is right to some ulps.
//! Here its ends are confirmed, from level 0 up:
//!
//! ```text
//!   level 0     the fate of the end itself, followed with a bound on its error
//!   level k     the image of each end, in 106 bits with a bound on its error, lies inside the same confirmed interval of level
//!               k − 1 and the same fate
//! ```
//!
//! An end beside an interval of level 0 is also followed by itself: whether a speed beside the end of a trap needs
//! no hop or some is not seen in its image.
//!
//! The map is monotone between the ends (docs/theory.md, Lemma 50), so that all speeds between them then lead into
//! that interval. In 53 bits the bounds of thousands of levels would add up beside the slow side of a fixed point.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::{Fates, HOP_BUDGET};
use crate::fates::hopper_fate::HopperFate;
use basin_of_attraction::{Interval, IntervalBasins, LabelledInterval};
use passive_hopper::{Arithmetic, ExtendedOrbit, ExtendedStep};

/// Most doublings of the distance, in ulps, by which an end is moved: 10⁻¹² in all. The true ends lie 6 ulps away
/// at most (M = 0.12, 0.2 and 0.5). An interval that needs more is left out, and stays undecided: it lies beside a
/// critical point, where the map is flat. A larger number would keep more of those.
const DOUBLINGS: u32 = 10;

/// The same intervals with confirmed ends. The number of hops of grounded ones has the hop that grounds.
pub(crate) fn with_inward_ends(
    fates: &Fates,
    basins: IntervalBasins,
) -> Result<IntervalBasins, Error> {
    let parts = basins.intervals();
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by_key(|&at| parts[at].level);
    let mut confirmed: Vec<Option<Interval>> = vec![None; parts.len()];
    for at in order {
        let own = &parts[at];
        confirmed[at] = match own.level {
            Some(0) => by_fates(fates, own)?,
            _ => by_images(fates, at, parts, &confirmed)?,
        };
    }
    let narrower = parts.iter().zip(confirmed).filter_map(|(own, interval)| {
        // A trap is entered; the ground is reached by one more hop.
        let grounded = usize::from(own.label == HopperFate::GROUNDED);
        let level = own.level.map(|level| level + grounded);
        Some(LabelledInterval { interval: interval?, label: own.label, level })
    });
    let narrower = narrower.collect();
    Ok(basins.with_intervals(narrower)?)
}

/// The first end from `start` on, inwards up to `last`, for which `found` gives something.
fn inwards<T>(
    start: f64,
    last: f64,
    found: impl Fn(f64) -> Result<Option<T>, Error>,
) -> Result<Option<(f64, T)>, Error> {
    let ulp = (start.next_up() - start).copysign(last - start);
    for moved in std::iter::once(0).chain((0..=DOUBLINGS).map(|k| 1u64 << k)) {
        let end = start + moved as f64 * ulp;
        // Past the other end.
        if (last - end) * ulp < 0.0 {
            break;
        }
        if let Some(found) = found(end)? {
            return Ok(Some((end, found)));
        }
    }
    Ok(None)
}

/// Whether a speed has the fate of an interval, after its number of hops.
fn has_fate(fates: &Fates, end: f64, own: &LabelledInterval) -> Result<bool, Error> {
    // The speed 0, at which the trap of α*_0 begins, has no hop.
    if end == 0.0 {
        return Ok(true);
    }
    let (fate, hops) = fates.fate_within(end, HOP_BUDGET)?;
    let grounded = usize::from(own.label == HopperFate::GROUNDED);
    Ok(fate.label() == own.label && own.level.is_none_or(|level| level + grounded == hops))
}

/// An interval of level 0: a trap, or a gap in which the hopper is grounded.
fn by_fates(fates: &Fates, own: &LabelledInterval) -> Result<Option<Interval>, Error> {
    let Interval { left, right } = own.interval;
    let has_fate = |end: f64| Ok(has_fate(fates, end, own)?.then_some(()));
    let Some((left, ())) = inwards(left, right, has_fate)? else { return Ok(None) };
    let Some((right, ())) = inwards(right, left, has_fate)? else { return Ok(None) };
    Ok(Some(Interval { left, right }))
}

/// Whether a speed is so near to a neighbour of level 0 that the ends of both may overlap.
fn is_beside_level_0(end: f64, at: usize, parts: &[LabelledInterval]) -> bool {
    let reach = f64::from(1u32 << DOUBLINGS) * (end.next_up() - end);
    let neighbours = [at.checked_sub(1), Some(at + 1)].into_iter().flatten();
    neighbours.filter_map(|at| parts.get(at)).any(|part| {
        let Interval { left, right } = part.interval;
        part.level == Some(0) && left - reach <= end && end <= right + reach
    })
}

/// The interval `at` of a higher level.
fn by_images(
    fates: &Fates,
    at: usize,
    parts: &[LabelledInterval],
    confirmed: &[Option<Interval>],
) -> Result<Option<Interval>, Error> {
    let own = &parts[at];
    let Interval { left, right } = own.interval;
    let below = own.level.and_then(|level| level.checked_sub(1));
    let into = |end: f64| {
        if is_beside_level_0(end, at, parts) && !has_fate(fates, end, own)? {
            return Ok(None);
        }
        let mut orbit = ExtendedOrbit::new(fates.map(), end, Arithmetic::Bits106)?;
        if orbit.hop()? != ExtendedStep::LiftsOff {
            return Ok(None);
        }
        let (speed, error) = (orbit.speed(), orbit.error());
        // The rounded image may lie just beside its interval.
        let first = parts.partition_point(|part| part.interval.right < speed.next_down());
        let is_inside = |interval: Interval| {
            orbit.minus(interval.left) >= error && orbit.minus(interval.right) <= -error
        };
        Ok((first..parts.len().min(first + 2)).find(|&at| {
            parts[at].label == own.label
                && parts[at].level == below
                && confirmed[at].is_some_and(is_inside)
        }))
    };
    let Some((left, at_left)) = inwards(left, right, into)? else { return Ok(None) };
    let Some((right, at_right)) = inwards(right, left, into)? else { return Ok(None) };
    Ok((at_left == at_right).then_some(Interval { left, right }))
}
