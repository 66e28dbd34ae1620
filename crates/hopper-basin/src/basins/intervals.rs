//! All basins at one mass ratio as intervals.

use crate::basins::branches::branches;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use basin_of_attraction::{
    Branch, Image, Interval, IntervalBasins, Label, Refinement, ScalarMap,
    interval_basins_from_known,
};
use passive_hopper::alpha_star;
use std::f64::consts::PI;

/// All basins between two fixed points, as intervals.
#[derive(Debug, Clone, PartialEq)]
pub struct HopperBasins {
    /// The intervals, with labels as in [`HopperFate::label`].
    pub basins: IntervalBasins,
    /// The spacing at which the sudden windows were searched. Branches of the map narrower than this may have been
    /// missed there. On the contact parts all branches are known.
    ///
    /// For M ≤ 0.905 the map is analytic inside a window and has few branches there. For larger M, count points with
    /// [`basin_fractions`](crate::basin_fractions), which needs no branches.
    pub spacing: f64,
}

/// The basins of all fates on [α*_`from`, α*_`to`]. Each sudden window is searched for branches with `samples` points.
///
/// ```
/// use basin_of_attraction::Refinement;
/// use hopper_basin::{Fates, hopper_basins};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(0.2)?)?;
/// let refinement = Refinement { shortest: 1e-6, ..Refinement::default() };
/// let found = hopper_basins(&fates, 1, 2, 200, refinement)?;
/// // The basin of α*_1 has 4.6 % of the first hump.
/// let fraction = found.basins.resolved_length(1.into()) / found.basins.window().length();
/// assert!((fraction - 0.0463).abs() < 1e-4);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// [`Error::Window`] unless `from` < `to` and all fixed points have labels; else as [`branches`].
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
    // Orbits fall below the window: all branches of the map down to zero are needed.
    let branches = branches(fates, 0, to, samples)?;
    let traps = traps_and_grounding(fates, &branches, to, top)?;
    let whole = Interval::new(0.0, top)?;
    let basins =
        interval_basins_from_known(fates, &traps, &branches, whole, refinement)?.within(window)?;
    // The widest of the windows ((n+1)π, α*_{n+1}).
    let spacing = (0..to).map(|n| alpha_star(n + 1) - (n + 1) as f64 * PI).fold(0.0, f64::max)
        / (samples - 1) as f64;
    Ok(HopperBasins { basins, spacing })
}

/// The traps of α*_0 … α*_`to`−1 and the gaps between `branches` below `top` in which the hopper is grounded, with labels.
pub(crate) fn traps_and_grounding(
    fates: &Fates,
    branches: &[Branch],
    to: u64,
    top: f64,
) -> Result<Vec<(Interval, Label)>, Error> {
    let mut traps = grounded(fates, branches, top);
    for n in 0..to {
        let trap = fates.trap(n)?;
        let right = trap.right().min(alpha_star(n + 1).next_down());
        // On hump 0 the trap ends where the gap of grounding begins, and both ends were computed. If rounding makes
        // the two overlap, the trap keeps the common speeds.
        for (gap, _) in traps.iter_mut().filter(|(gap, _)| gap.contains(right)) {
            gap.left = right.next_up();
        }
        traps.push((
            Interval::new(trap.fixed_point.value(), right)?,
            HopperFate::label_of_fixed_point(n),
        ));
    }
    Ok(traps)
}

/// The gaps between branches in which the hopper is grounded, with their label.
fn grounded(fates: &Fates, branches: &[Branch], top: f64) -> Vec<(Interval, Label)> {
    let starts = branches.iter().map(|branch| branch.domain.left).chain([top]);
    let ends = std::iter::once(0.0).chain(branches.iter().map(|branch| branch.domain.right));
    ends.zip(starts)
        .filter_map(|(left, right)| {
            // The gap without the ends of the branches. It is empty where two branches meet at a critical point.
            let (left, right) = (left.next_up(), right.next_down());
            let stops = left < right && fates.image(0.5 * (left + right)) == Image::Stops;
            stops.then_some((Interval { left, right }, HopperFate::GROUNDED))
        })
        .collect()
}
