//! Basins at a fixed mass ratio, and over the plane of mass ratio and lift-off speed.

use crate::{Error, Fates, HopperFate};
use basin_of_attraction::{
    Branch, Grid, Interval, IntervalSet, LabelImage, equally_spaced_shares, monotone_branches,
    preimage_levels, raster,
};
use passive_hopper::{MassRatio, alpha_star};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// The shares of all fates on [α*_from, α*_to] by the paper's protocol (Sec. VI): `points` equally
/// spaced points on each interval between neighbouring fixed points, fractions averaged over the
/// intervals. Keys are [labels](HopperFate::label).
///
/// # Errors
/// As [`Fates::new`].
pub fn shares(
    mass_ratio: MassRatio,
    from: u64,
    to: u64,
    points: usize,
) -> Result<BTreeMap<u16, f64>, Error> {
    let fates = Fates::new(mass_ratio)?;
    let label = |alpha: f64| fates.fate(alpha).map_or(HopperFate::UNDECIDED, HopperFate::label);
    let mut sums = BTreeMap::new();
    for n in from..to {
        let hump = Interval::new(alpha_star(n).high, alpha_star(n + 1).high)?;
        for (label, share) in equally_spaced_shares(hump, points, label) {
            *sums.entry(label).or_insert(0.0) += share;
        }
    }
    let humps = to.saturating_sub(from).max(1) as f64;
    sums.values_mut().for_each(|share| *share /= humps);
    Ok(sums)
}

/// The share of incessant hopping among `shares`: all labels of fixed points n ≥ 1.
pub fn incessant_share(shares: &BTreeMap<u16, f64>) -> f64 {
    shares.range(1..=HopperFate::LARGEST_LABEL as u16).map(|(_, share)| share).sum()
}

/// The basins over a window of (M, α): M to the right, α upwards, labels as in
/// [`HopperFate::label`].
///
/// A pixel is judged by its middle. The result does not depend on the number of threads.
///
/// # Errors
/// [`Error::Window`] unless the speeds are positive and their fixed points have labels, errors of
/// [`MassRatio::new`] and of [`raster`].
pub fn basin_raster(
    grid: Grid,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<LabelImage, Error> {
    let largest = alpha_star(HopperFate::LARGEST_LABEL).high;
    if !(grid.y.left >= 0.0 && grid.y.right <= largest) {
        return Err(Error::Window { bottom: grid.y.left, top: grid.y.right, largest });
    }
    // Every column has a valid mass ratio if the outermost have.
    if grid.columns > 0 {
        for column in [0, grid.columns - 1] {
            Fates::new(MassRatio::new(grid.x_at(column))?)?;
        }
    }
    let prepare = |m: f64| MassRatio::new(m).map_err(Error::from).and_then(Fates::new).ok();
    let label = |fates: &Option<Fates>, alpha: f64| {
        let fate = fates.as_ref().and_then(|fates| fates.fate(alpha).ok());
        fate.map_or(HopperFate::UNDECIDED, HopperFate::label)
    };
    Ok(raster(grid, prepare, label, progress)?)
}

/// The monotone branches of the map from α*_`from` to α*_`to`.
///
/// The contact parts are cut at their critical points, of which theory knows all. The sudden
/// windows (nπ, α*_n) are searched with `samples` points each: pieces that are narrower are not
/// seen (for M ≤ 0.905 a hop has at most one sudden lift-off, and the windows are simple).
///
/// # Errors
/// As [`Fates::new`].
pub fn branches(fates: &Fates, from: u64, to: u64, samples: usize) -> Result<Vec<Branch>, Error> {
    let mu = fates.map().mass_ratio().mu();
    let mut branches = Vec::new();
    for n in from..to {
        let hump = crate::hump::Hump::new(n);
        let (left, end) = (hump.star.high.next_up(), (n + 1) as f64 * PI);
        let right = alpha_star(n + 1).high.next_down();
        let mut cuts = vec![left];
        if let Some((maximum, minimum)) = hump.critical(mu)? {
            cuts.extend([hump.alpha(maximum), hump.alpha(minimum)]);
        }
        cuts.push(end);
        for pair in cuts.windows(2) {
            // Between cuts only an edge of grounding can lie, which a few samples bracket.
            branches.extend(monotone_branches(fates, Interval::new(pair[0], pair[1])?, 65)?);
        }
        branches.extend(monotone_branches(fates, Interval::new(end, right)?, samples)?);
    }
    Ok(branches)
}

/// The basin of α*_n in the window [α*_n, α*_top], level by level: level k enters the trap after
/// exactly k hops (paper, Sec. VI A).
///
/// # Errors
/// As [`branches`].
pub fn basin_levels(
    fates: &Fates,
    n: u64,
    top: u64,
    depth: usize,
    samples: usize,
) -> Result<Vec<IntervalSet>, Error> {
    let trap = fates.trap(n)?;
    let branches = branches(fates, n, top, samples)?;
    let trap = Interval::new(trap.star.high, trap.right())?;
    Ok(preimage_levels(fates, &branches, trap, depth))
}
