//! The monotone branches of the map.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use crate::raster::rising_windows::rising_window;
use crate::traps::hump::Hump;
use basin_of_attraction::{Branch, Interval, monotone_branches};
use passive_hopper::{MassRatio, alpha_star};
use std::f64::consts::PI;

/// Samples of a part on which the map is known to be monotone. Such a part may contain one edge of grounding, which
/// samples on both sides of it bracket. With 64 intervals both sides have samples even if a gap of grounding takes up
/// nearly all of the part.
const SAMPLES_OF_MONOTONE_PART: usize = 65;

/// Whether the branches of the map up to α*_`to` are proved to be complete: every sudden window below it has one
/// branch.
pub(crate) fn branches_are_proved(mass_ratio: MassRatio, to: u64) -> bool {
    let rises = |n: u64| {
        rising_window(n).is_some_and(|window| mass_ratio.value() <= window.largest_mass_ratio)
    };
    // Few windows are proved to rise, so that the search ends early for a large `to`.
    (1..=to).all(rises)
}

/// Most samples of all windows together: at about a microsecond each they take a minute or two. More are a mistake,
/// such as a range of all fixed points, and would seem never to end.
const MOST_SAMPLES: usize = 100_000_000;

/// The monotone branches of the map from α*_`from` to α*_`to`.
///
/// On the contact parts all branches are found: the map is cut at its critical points, all of which are known
/// (docs/theory.md, Corollary 28). Each sudden window (nπ, α*_n) is searched with `samples` points, which may miss
/// branches narrower than their spacing. For M ≤ 0.905 a hop has at most one sudden lift-off (docs/theory.md,
/// Theorem 20), and the windows have few branches.
///
/// # Errors
/// As [`Fates::new`] and [`monotone_branches`]; [`Error::Window`] if fixed points have no labels;
/// [`basin_of_attraction::Error::TooManySamples`] for more than 10⁸ samples of all windows together.
pub fn branches(fates: &Fates, from: u64, to: u64, samples: usize) -> Result<Vec<Branch>, Error> {
    check_fixed_points(from, to)?;
    let humps = usize::try_from(to.saturating_sub(from)).unwrap_or(usize::MAX);
    let all = humps.saturating_mul(samples.saturating_add(3 * SAMPLES_OF_MONOTONE_PART));
    if all > MOST_SAMPLES {
        let remedy = "take fewer humps, or fewer samples in each window";
        let error =
            basin_of_attraction::Error::TooManySamples { samples: all, most: MOST_SAMPLES, remedy };
        return Err(error.into());
    }
    let mut branches = Vec::new();
    for n in from..to {
        branches.extend(contact_branches(fates, n)?);
        let (end, right) = ((n + 1) as f64 * PI, alpha_star(n + 1).next_down());
        branches.extend(monotone_branches(fates, Interval::new(end, right)?, samples)?);
    }
    Ok(branches)
}

/// The monotone branches of the map on the contact part of hump n, all of which are known.
pub(crate) fn contact_branches(fates: &Fates, n: u64) -> Result<Vec<Branch>, Error> {
    let hump = Hump::new(n)?;
    // The fixed point is excluded: a hop from it has no loss, and it belongs to neither side.
    let mut cuts = vec![hump.star.value().next_up()];
    if let Some((maximum, minimum)) = hump.critical(fates.map().mass_ratio().mu())? {
        cuts.extend([maximum, minimum].map(|t| hump.star.value() + hump.delta(t)));
    }
    cuts.push((n + 1) as f64 * PI);
    let mut branches = Vec::new();
    for pair in cuts.windows(2) {
        let part = Interval::new(pair[0], pair[1])?;
        branches.extend(monotone_branches(fates, part, SAMPLES_OF_MONOTONE_PART)?);
    }
    Ok(branches)
}

/// Returns an error if fixed points up to α*_`to` have no labels.
pub(crate) fn check_fixed_points(from: u64, to: u64) -> Result<(), Error> {
    if to <= HopperFate::LARGEST_LABEL {
        return Ok(());
    }
    let largest = alpha_star(HopperFate::LARGEST_LABEL);
    Err(Error::Window { bottom: alpha_star(from), top: alpha_star(to), largest })
}
