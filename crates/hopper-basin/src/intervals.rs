//! Basins at a fixed mass ratio as intervals.

use crate::basin::branches;
use crate::{Error, Fates, HopperFate};
use basin_of_attraction::{
    Branch, Image, Interval, IntervalBasins, Refinement, ScalarMap, interval_basins,
};
use passive_hopper::alpha_star;

/// All basins between two fixed points.
#[derive(Debug, Clone, PartialEq)]
pub struct HopperBasins {
    /// The intervals, with labels as in [`HopperFate::label`].
    pub basins: IntervalBasins,
    /// Turns of the map in the sudden windows closer together than this would not have been seen.
    /// On the contact parts all branches are known. For M ≤ 0.905 the map is analytic inside a
    /// window, with few turns; for larger M see [`crate::shares`] and its samples.
    pub spacing: f64,
}

/// The basins of all fates on [α*_`from`, α*_`to`], `samples` points being spent on finding the
/// branches of each sudden window.
///
/// ```
/// use basin_of_attraction::Refinement;
/// use hopper_basin::{Fates, hopper_basins};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(0.2)?)?;
/// let refinement = Refinement { shortest: 1e-6, ..Refinement::default() };
/// let found = hopper_basins(&fates, 1, 2, 200, refinement)?;
/// // On the first hump only the trap and its preimages go to α*_1: 4.6 % of it.
/// let share = found.basins.resolved_length(1) / found.basins.window().length();
/// assert!((share - 0.0463).abs() < 1e-4);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// [`Error::Window`] unless `from` < `to`, with labels for all fixed points; else as [`branches`].
pub fn hopper_basins(
    fates: &Fates,
    from: u64,
    to: u64,
    samples: usize,
    refinement: Refinement,
) -> Result<HopperBasins, Error> {
    let window = Interval::new(alpha_star(from), alpha_star(to));
    let largest = alpha_star(HopperFate::LARGEST_LABEL);
    let (bottom, top) = (alpha_star(from), alpha_star(to));
    let window = match window {
        Ok(window) if from < to && to <= HopperFate::LARGEST_LABEL => window,
        _ => return Err(Error::Window { bottom, top, largest }),
    };
    // Orbits fall below the window: all of the map under it takes part.
    let branches = branches(fates, 0, to, samples)?;
    let mut traps = grounded(fates, &branches, top);
    for n in 0..to {
        let trap = fates.trap(n)?;
        let right = trap.right().min(alpha_star(n + 1).next_down());
        // Where the map ends at the trap's edge, the two roundings of that edge meet.
        for (gap, _) in traps.iter_mut().filter(|(gap, _)| gap.contains(right)) {
            gap.left = right.next_up();
        }
        traps.push((Interval::new(trap.fixed_point.value(), right)?, n as u16));
    }
    let whole = Interval::new(0.0, top)?;
    let basins = interval_basins(fates, &traps, &branches, whole, refinement)?.within(window);
    let spacing = (0..to)
        .map(|n| alpha_star(n + 1) - (n + 1) as f64 * std::f64::consts::PI)
        .fold(0.0, f64::max)
        / (samples - 1) as f64;
    Ok(HopperBasins { basins, spacing })
}

/// The gaps between branches in which the hopper is grounded.
fn grounded(fates: &Fates, branches: &[Branch], top: f64) -> Vec<(Interval, u16)> {
    let starts = branches.iter().map(|branch| branch.domain.left).chain([top]);
    let ends = std::iter::once(0.0).chain(branches.iter().map(|branch| branch.domain.right));
    ends.zip(starts)
        .filter_map(|(left, right)| {
            let (left, right) = (left.next_up(), right.next_down());
            let stops = left < right && fates.image(0.5 * (left + right)) == Image::Stops;
            stops.then_some((Interval { left, right }, HopperFate::GROUNDED))
        })
        .collect()
}
