//! Basin fractions by the paper's protocol: points counted by their fate.

use crate::basins::branches::check_fixed_points;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use basin_of_attraction::{Interval, Label, equally_spaced_counts};
use passive_hopper::{MassRatio, alpha_star};
use std::collections::BTreeMap;

/// Points counted by their fate.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BasinFractions {
    /// The number of points with each [label](HopperFate::label).
    pub counts: BTreeMap<Label, usize>,
    /// The number of all points.
    pub points: usize,
}

impl BasinFractions {
    /// The fraction of the points that have `label`.
    pub fn of(&self, label: Label) -> f64 {
        self.counts.get(&label).copied().unwrap_or(0) as f64 / self.points as f64
    }

    /// The fraction of incessant hopping: the labels of all fixed points n ≥ 1 together.
    pub fn incessant(&self) -> f64 {
        let own = self.counts.iter().filter(|(label, _)| HopperFate::is_incessant(**label));
        own.map(|(_, count)| count).sum::<usize>() as f64 / self.points as f64
    }
}

/// Most points of all intervals together: they take a quarter of an hour. More are a mistake, and would seem never
/// to end.
const MOST_POINTS: usize = 1_000_000_000;

/// The basin fractions on [α*_from, α*_to] by the paper's protocol (Sec. VI).
///
/// Each interval between neighbouring fixed points has `points` equally spaced points. So the fractions of the
/// intervals are averaged with equal weights, although the intervals differ in length.
///
/// # Errors
/// As [`Fates::new`]; [`Error::NoPoints`] if `points` is zero or `from` is not below `to`; [`Error::Window`] if
/// fixed points have no labels; [`basin_of_attraction::Error::TooManySamples`] for more than 10⁹ points on all
/// intervals together.
pub fn basin_fractions(
    mass_ratio: MassRatio,
    from: u64,
    to: u64,
    points: usize,
) -> Result<BasinFractions, Error> {
    if points == 0 || from >= to {
        return Err(Error::NoPoints { from, to, points });
    }
    check_fixed_points(from, to)?;
    let all = usize::try_from(to - from).unwrap_or(usize::MAX).saturating_mul(points);
    if all > MOST_POINTS {
        let remedy = "take fewer humps, or fewer points on each";
        let error =
            basin_of_attraction::Error::TooManySamples { samples: all, most: MOST_POINTS, remedy };
        return Err(error.into());
    }
    let fates = Fates::new(mass_ratio)?;
    // A speed is valid here unless it exceeds the largest lift-off speed: then no hop can be decided.
    let label = |alpha: f64| fates.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label);
    let mut counts = BTreeMap::new();
    for n in from..to {
        let hump = Interval::new(alpha_star(n), alpha_star(n + 1))?;
        for (label, count) in equally_spaced_counts(hump, points, label)? {
            *counts.entry(label).or_insert(0) += count;
        }
    }
    Ok(BasinFractions { counts, points: all })
}
