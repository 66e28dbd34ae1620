//! The basin of a trap by levels: level k enters the trap after exactly k steps.

use crate::error::Error;
use crate::line::branches::Branch;
use crate::line::probes::{check_given, check_intervals};
use crate::line::scalar_map::ScalarMap;
use crate::space::interval::{Interval, IntervalSet};

/// Levels with more intervals than this in all are not followed further: their number may double with every level.
const MOST_INTERVALS: usize = 1_000_000;

/// The levels 0 to `depth` of the basin of a trap.
///
/// Level 0 is the trap. Level k contains the points of the branches' domains that enter the trap after exactly
/// k steps. The last level is an earlier one if it is empty, or if there are more than a million intervals.
///
/// The trap and the branches are tested as in [`interval_basins`](crate::interval_basins), from the left end of the
/// first branch to the right end of the last one.
///
/// ```
/// use basin_of_attraction::{Branch, Interval, preimage_levels};
/// // x² takes [0, 1/2] into itself, and the others below 1 come there after some squarings.
/// let square = |x: f64| Some(x * x);
/// let branch = Branch { domain: Interval::new(0.0, 1.0)?, at_left: 0.0, at_right: 1.0 };
/// let levels = preimage_levels(&square, &[branch], Interval::new(0.0, 0.5)?, 3)?;
/// assert!((levels[2].intervals()[0].right - 0.5f64.sqrt().sqrt()).abs() < 1e-15);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// As [`check_trap`](crate::check_trap) and [`check_branches`](crate::check_branches).
pub fn preimage_levels(
    map: &impl ScalarMap,
    branches: &[Branch],
    trap: Interval,
    depth: usize,
) -> Result<Vec<IntervalSet>, Error> {
    let end = |of: fn(&Branch) -> f64, pick: fn(f64, f64) -> f64, first: f64| {
        branches.iter().map(of).fold(first, pick)
    };
    let window = Interval {
        left: end(|branch| branch.domain.left, f64::min, trap.left),
        right: end(|branch| branch.domain.right, f64::max, trap.right),
    };
    check_given(map, &[trap], branches, window)?;
    preimage_levels_from_known(map, branches, trap, depth)
}

/// The points that enter a known interval after 0 to `depth` steps and not before, as [`preimage_levels`] finds
/// them, without any test.
///
/// The caller knows that the branches are complete. The interval may be one that orbits leave.
///
/// ```
/// use basin_of_attraction::{Branch, Interval, preimage_levels_from_known};
/// // The tent map of slope 3 maps the middle third of [0, 1] above 1, from where orbits escape, and the rest onto [0, 1]. Level
/// // k ≥ 1 has 2^(k−1) intervals, of total length (2/3)^(k−1)/3.
/// let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
/// let left = Branch { domain: Interval::new(0.0, 0.5)?, at_left: 0.0, at_right: 1.5 };
/// let right = Branch { domain: Interval::new(0.5, 1.0)?, at_left: 1.5, at_right: 0.0 };
/// let above = Interval::new(1.0 + 1e-12, 1.5)?;
/// let levels = preimage_levels_from_known(&tent, &[left, right], above, 5)?;
/// for (k, level) in levels.iter().enumerate().skip(2) {
///     assert_eq!(level.intervals().len(), 1 << (k - 1));
///     assert!((level.measure() - (2.0f64 / 3.0).powi(k as i32 - 1) / 3.0).abs() < 1e-10);
/// }
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadInterval`] for an interval or a branch that is reversed or not finite.
pub fn preimage_levels_from_known(
    map: &impl ScalarMap,
    branches: &[Branch],
    known: Interval,
    depth: usize,
) -> Result<Vec<IntervalSet>, Error> {
    check_intervals(&[known], branches)?;
    let known = IntervalSet::union(vec![known]);
    let mut levels = vec![known.clone()];
    let mut all = 0;
    for _ in 0..depth {
        let Some(last) = levels.last() else { break };
        all += last.intervals().len();
        if last.intervals().is_empty() || all > MOST_INTERVALS {
            break;
        }
        let preimages = last
            .intervals()
            .iter()
            .flat_map(|target| branches.iter().filter_map(|branch| branch.preimage(map, target)));
        let next = IntervalSet::union(preimages.collect()).minus(&known);
        levels.push(next);
    }
    Ok(levels)
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Interval = Interval { left: 0.0, right: 1.0 };

    fn tent(x: f64) -> Option<f64> {
        Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) })
    }

    fn branch(left: f64, right: f64) -> Branch {
        let at = |x: f64| tent(x).unwrap_or(f64::NAN);
        Branch { domain: Interval { left, right }, at_left: at(left), at_right: at(right) }
    }

    #[test]
    fn traps_that_are_none_missing_branches_and_reversed_intervals_are_refused() {
        let all = [branch(0.0, 0.5), branch(0.5, 1.0)];
        let hole = Interval { left: 1.0 + 1e-12, right: 1.5 };
        assert!(matches!(preimage_levels(&tent, &all, hole, 3), Err(Error::NotATrap { .. })));
        let halve = |x: f64| Some(0.5 * x);
        let half =
            Branch { domain: Interval { left: 0.0, right: 0.4 }, at_left: 0.0, at_right: 0.2 };
        let rest =
            Branch { domain: Interval { left: 0.6, right: 1.0 }, at_left: 0.3, at_right: 0.5 };
        let trap = Interval { left: 0.0, right: 0.1 };
        let missed = preimage_levels(&halve, &[half, rest], trap, 3);
        assert!(matches!(missed, Err(Error::BranchMissed { at: 0.4..0.6, .. })), "{missed:?}");
        for (left, right) in [(0.3, 0.2), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            let bad = Interval { left, right };
            for found in [
                preimage_levels(&halve, &[half], bad, 3),
                preimage_levels_from_known(&halve, &[half], bad, 3),
                preimage_levels_from_known(&halve, &[Branch { domain: bad, ..half }], UNIT, 3),
            ] {
                assert!(matches!(found, Err(Error::BadInterval { .. })), "{found:?}");
            }
        }
    }

    #[test]
    fn levels_end_where_they_are_empty_or_too_many() {
        let all = [branch(0.0, 0.5), branch(0.5, 1.0)];
        let hole = Interval { left: 1.0 + 1e-12, right: 1.5 };
        let deep = preimage_levels_from_known(&tent, &all, hole, usize::MAX).unwrap();
        assert!((18..22).contains(&deep.len()), "{}", deep.len());
        let square = |x: f64| Some(x * x);
        let one = Branch { domain: UNIT, at_left: 0.0, at_right: 1.0 };
        let levels = preimage_levels(&square, &[one], UNIT, usize::MAX).unwrap();
        assert!(levels.len() == 2 && levels[1].intervals().is_empty());
    }
}
