//! The basin of a trap by levels: level k enters the trap after exactly k steps.

use crate::branches::Branch;
use crate::interval::{Interval, IntervalSet};
use crate::scalar_map::ScalarMap;

/// The levels 0 to `depth` of the basin of a trap.
///
/// Level 0 is the trap. Level k contains the points of the branches' domains that enter the trap after exactly
/// k steps.
///
/// ```
/// use basin_of_attraction::{Branch, Interval, preimage_levels};
/// // The tent map of slope 3 maps the middle third of [0, 1] into the trap, and the rest onto [0, 1]. Level
/// // k ≥ 1 has 2^(k−1) intervals, of total length (2/3)^(k−1)/3.
/// let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
/// let left = Branch { domain: Interval::new(0.0, 0.5)?, at_left: 0.0, at_right: 1.5 };
/// let right = Branch { domain: Interval::new(0.5, 1.0)?, at_left: 1.5, at_right: 0.0 };
/// let hole = Interval::new(1.0 + 1e-12, 1.5)?;
/// let levels = preimage_levels(&tent, &[left, right], hole, 5);
/// for (k, level) in levels.iter().enumerate().skip(2) {
///     assert_eq!(level.intervals().len(), 1 << (k - 1));
///     assert!((level.measure() - (2.0f64 / 3.0).powi(k as i32 - 1) / 3.0).abs() < 1e-10);
/// }
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
pub fn preimage_levels(
    map: &impl ScalarMap,
    branches: &[Branch],
    trap: Interval,
    depth: usize,
) -> Vec<IntervalSet> {
    let trap = IntervalSet::union(vec![trap]);
    let mut levels = vec![trap.clone()];
    for _ in 0..depth {
        let Some(last) = levels.last() else { break };
        let preimages = last
            .intervals()
            .iter()
            .flat_map(|target| branches.iter().filter_map(|branch| branch.preimage(map, target)));
        let next = IntervalSet::union(preimages.collect()).minus(&trap);
        levels.push(next);
    }
    levels
}
