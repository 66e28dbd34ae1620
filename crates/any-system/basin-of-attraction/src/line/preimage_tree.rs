//! The preimages of a trap as a tree, and the set of points that never enter the trap.

use crate::error::Error;
use crate::line::branches::Branch;
use crate::line::probes::{check_given, check_intervals};
use crate::line::scalar_map::ScalarMap;
use crate::space::interval::{Interval, IntervalSet};
use crate::statistics::least_squares::fit_line;

/// An interval of the tree, mapped onto its parent by one branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TreeNode {
    /// The interval.
    pub interval: Interval,
    /// The number of steps after which its points enter the trap.
    pub level: usize,
    /// The index of the parent node; `None` for the trap.
    pub parent: Option<usize>,
    /// The index of the branch that maps the interval onto its parent; 0 for the trap.
    pub branch: usize,
}

/// A trap, its preimages, the preimages of these, and so on.
#[derive(Debug, Clone, PartialEq)]
pub struct PreimageTree {
    pub(super) window: Interval,
    nodes: Vec<TreeNode>,
    /// Level k has the nodes from starts[k] to starts[k + 1], without the last one.
    starts: Vec<usize>,
    /// The first level that may lack a preimage, because some target is a few ulps wide.
    incomplete: Option<usize>,
}

/// Intervals narrower than this number of ulps have no reliable preimages. Their ends are wrong by an ulp or two,
/// which is up to 6 % of 64 ulps. A smaller number would count intervals that rounding makes or loses. A larger one
/// would end the complete levels earlier.
const NARROW_ULPS: f64 = 64.0;

/// The points of the window that no level contains. The growth of the number of intervals with the level decides their
/// kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ResidualSet {
    /// The number of intervals grows exponentially with the level. The points that never enter the trap contain a
    /// Cantor set.
    Cantor {
        /// ln of the factor by which the number grows in a level.
        growth: f64,
    },
    /// The number of intervals grows like a power of the level. The boundaries of the basin are countably many
    /// points.
    Countable {
        /// The exponent of that power.
        power: f64,
    },
    /// There are too few levels, or neither law fits better than the other.
    Undecided,
}

impl PreimageTree {
    /// Grows `depth` levels. It stops earlier at an empty level, or at a level that ends beyond a million nodes.
    ///
    /// `branches` must contain all monotone branches of the map in the window. The trap and the branches are tested
    /// as in [`interval_basins`](crate::interval_basins).
    ///
    /// ```
    /// use basin_of_attraction::{Branch, Interval, PreimageTree, ResidualSet};
    /// // Under x + x² the orbits of (−1, 0) approach 0, and every level has two intervals.
    /// let map = |x: f64| Some(x + x * x);
    /// let left = Branch { domain: Interval::new(-1.0, -0.5)?, at_left: 0.0, at_right: -0.25 };
    /// let right = Branch { domain: Interval::new(-0.5, 0.0)?, at_left: -0.25, at_right: 0.0 };
    /// let (window, trap) = (Interval::new(-1.0, 0.0)?, Interval::new(-0.01, 0.0)?);
    /// let tree = PreimageTree::grow(&map, &[left, right], trap, window, 60)?;
    /// assert_eq!(tree.residual_set(), ResidualSet::Countable { power: 0.0 });
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`check_trap`](crate::check_trap) and [`check_branches`](crate::check_branches).
    pub fn grow(
        map: &impl ScalarMap,
        branches: &[Branch],
        trap: Interval,
        window: Interval,
        depth: usize,
    ) -> Result<Self, Error> {
        check_given(map, &[trap], branches, window)?;
        Self::grow_from_known(map, branches, trap, window, depth)
    }

    /// The tree of an interval that the caller knows, such as a hole from which orbits escape, as
    /// [`grow`](Self::grow) finds it, without any test. The caller knows that the branches are complete.
    ///
    /// ```
    /// use basin_of_attraction::{Branch, Interval, PreimageTree, ResidualSet};
    /// // Under the tent map of slope 3 the points that never leave [0, 1] are Cantor's set.
    /// let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
    /// let left = Branch { domain: Interval::new(0.0, 0.5)?, at_left: 0.0, at_right: 1.5 };
    /// let right = Branch { domain: Interval::new(0.5, 1.0)?, at_left: 1.5, at_right: 0.0 };
    /// let (window, above) = (Interval::new(0.0, 1.0)?, Interval::new(1.0 + 1e-12, 1.5)?);
    /// let tree = PreimageTree::grow_from_known(&tent, &[left, right], above, window, 12)?;
    /// let ResidualSet::Cantor { growth } = tree.residual_set() else { panic!() };
    /// assert!((growth - 2f64.ln()).abs() < 1e-12);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadInterval`] for an interval, a window or a branch that is reversed or not finite.
    pub fn grow_from_known(
        map: &impl ScalarMap,
        branches: &[Branch],
        trap: Interval,
        window: Interval,
        depth: usize,
    ) -> Result<Self, Error> {
        /// Bounds the memory: a node takes 48 bytes, and a level may have several times the nodes of the last.
        const MOST_NODES: usize = 1_000_000;
        check_intervals(&[trap, window], branches)?;
        let trapped = IntervalSet::union(vec![trap]);
        let root = TreeNode { interval: trap, level: 0, parent: None, branch: 0 };
        let mut tree =
            PreimageTree { window, nodes: vec![root], starts: vec![0, 1], incomplete: None };
        for level in 1..=depth {
            let last = tree.starts[level - 1]..tree.starts[level];
            if last.is_empty() || tree.nodes.len() > MOST_NODES {
                break;
            }
            for parent in last {
                let target = tree.nodes[parent].interval;
                for (branch, piece) in branches.iter().enumerate() {
                    let Some(found) = piece.preimage(map, &target) else { continue };
                    let ulps = |x: &Interval| x.length() / (f64::EPSILON * x.right.abs());
                    let mut outside =
                        IntervalSet::union(vec![found]).minus(&trapped).intervals().to_vec();
                    // At a fixed point on the trap's end, the end and its computed preimage differ by rounding. The
                    // interval of some ulps between them is no preimage.
                    outside.retain(|x| {
                        let beside = x.left == trap.right || x.right == trap.left;
                        !(beside && ulps(x) < NARROW_ULPS)
                    });
                    // The preimages of a target of a few ulps may be lost to rounding. They belong to the next level.
                    if outside.iter().any(|x| ulps(x) < NARROW_ULPS) {
                        tree.incomplete.get_or_insert(level + 1);
                    }
                    let node =
                        |&interval| TreeNode { interval, level, parent: Some(parent), branch };
                    tree.nodes.extend(outside.iter().map(node));
                }
            }
            tree.starts.push(tree.nodes.len());
        }
        Ok(tree)
    }

    /// All nodes, level by level.
    pub fn nodes(&self) -> &[TreeNode] {
        &self.nodes
    }

    /// The nodes of one level.
    pub fn level(&self, level: usize) -> &[TreeNode] {
        match (self.starts.get(level), self.starts.get(level.saturating_add(1))) {
            (Some(&from), Some(&to)) => &self.nodes[from..to],
            _ => &[],
        }
    }

    /// Number of levels, the trap included.
    pub fn levels(&self) -> usize {
        self.starts.len() - 1
    }

    /// The number of levels that are complete, if the branches are: no preimage of their intervals is missing.
    /// Later levels are preimages of intervals a few ulps wide.
    pub fn complete_levels(&self) -> usize {
        self.incomplete.map_or(self.levels(), |level| level.min(self.levels()))
    }

    /// The ends of all intervals. Their box counts give the dimension of the set at which the ends accumulate: see
    /// [`occupied_boxes`](crate::occupied_boxes).
    pub fn ends(&self) -> Vec<f64> {
        self.nodes.iter().flat_map(|node| [node.interval.left, node.interval.right]).collect()
    }

    /// The number of intervals of each level.
    pub fn counts(&self) -> Vec<usize> {
        (0..self.levels()).map(|level| self.level(level).len()).collect()
    }

    /// The length of each level inside the window.
    pub fn lengths(&self) -> Vec<f64> {
        let inside =
            |node: &TreeNode| node.interval.intersection(&self.window).map_or(0.0, |i| i.length());
        (0..self.levels()).map(|level| self.level(level).iter().map(inside).sum()).collect()
    }

    /// The part of the window that the levels up to `level` leave uncovered.
    pub fn gaps(&self, level: usize) -> IntervalSet {
        let end = self.starts.get(level.saturating_add(1)).copied().unwrap_or(self.nodes.len());
        let covered = IntervalSet::union(self.nodes[..end].iter().map(|n| n.interval).collect());
        IntervalSet::union(vec![self.window]).minus(&covered)
    }

    /// Fits an exponential and a power law to the number of intervals of the later half of the complete levels.
    ///
    /// The earlier half is left out because it follows neither law yet. If one law has less than a quarter of the
    /// other's squared residuals, it is the result.
    pub fn residual_set(&self) -> ResidualSet {
        /// Two parameters leave two degrees of freedom to compare the fits by. With three levels one degree is left,
        /// and chance decides between the fits; more levels would leave short trees undecided.
        const FEWEST_LEVELS: usize = 4;
        /// A fit is better if its squared residuals are less than this part of the other's, its residuals less than a
        /// half of the other's. A larger part would decide between fits that are about equally good. A smaller one
        /// would leave more trees undecided.
        const BETTER: f64 = 0.25;
        /// Exact laws have residuals of rounding size for one law, or 0 for both. If both are 0, this makes the result
        /// undecided.
        const ROUNDING: f64 = 1e-12;
        let mut counts = self.counts();
        counts.truncate(self.complete_levels());
        let late: Vec<(f64, f64)> = counts
            .iter()
            .enumerate()
            .skip(counts.len() / 2)
            .filter(|(_, count)| **count > 0)
            .map(|(level, &count)| (level as f64, pxfm::f_log(count as f64)))
            .collect();
        if late.len() < FEWEST_LEVELS {
            return ResidualSet::Undecided;
        }
        // A constant number fits both laws exactly. It is the power law with exponent 0.
        if late.iter().all(|point| point.1 == late[0].1) {
            return ResidualSet::Countable { power: 0.0 };
        }
        // ln(count) is linear in the level for an exponential, and in ln(level) for a power.
        let exponential = fit_line(&late);
        let logarithmic: Vec<_> = late.iter().map(|&(k, n)| (pxfm::f_log(k), n)).collect();
        let power = fit_line(&logarithmic);
        if exponential.squared_residuals + ROUNDING < BETTER * power.squared_residuals {
            ResidualSet::Cantor { growth: exponential.slope }
        } else if power.squared_residuals + ROUNDING < BETTER * exponential.squared_residuals {
            ResidualSet::Countable { power: power.slope }
        } else {
            ResidualSet::Undecided
        }
    }
}

/// The limit of a sum whose terms fall geometrically in the end, and an estimate of its error.
///
/// Aitken's extrapolation: the missing terms are assumed to fall by the ratio of the last two. The error is the change
/// that the last term made. `None` for fewer than four terms, if the terms do not fall, and if the sum is
/// not finite.
///
/// ```
/// let terms: Vec<f64> = (0..12).map(|k| 0.5f64.powi(k)).collect();
/// let (limit, error) = basin_of_attraction::geometric_limit(&terms).unwrap();
/// assert!((limit - 2.0).abs() < 1e-14 && error < 1e-14);
/// ```
pub fn geometric_limit(terms: &[f64]) -> Option<(f64, f64)> {
    let limit = |terms: &[f64]| {
        let [.., before, last] = *terms else { return None };
        let ratio = last / before;
        let sum: f64 = terms.iter().sum();
        (ratio.abs() < 1.0).then(|| sum + last * ratio / (1.0 - ratio))
    };
    if terms.len() < 4 {
        return None;
    }
    let (value, before) = (limit(terms)?, limit(&terms[..terms.len() - 1])?);
    let error = (value - before).abs();
    (value.is_finite() && error.is_finite()).then_some((value, error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn terms_that_are_not_finite_have_no_limit() {
        assert_eq!(geometric_limit(&[f64::NAN, 1.0, 0.5, 0.25]), None);
        assert_eq!(geometric_limit(&[f64::INFINITY, 1.0, 0.5, 0.25]), None);
    }

    proptest! {
        /// Two linear branches with a gap between them. The number of nodes doubles in every level, nodes are
        /// disjoint, and each is mapped onto its parent by its branch.
        #[test]
        fn trees_of_two_linear_branches(left in 0.15..0.45f64, right in 0.55..0.85f64, flip: bool) {
            let map = move |x: f64| {
                Some(if x < 0.5 {
                    x / left
                } else if flip {
                    (1.0 - x) / (1.0 - right)
                } else {
                    (x - right) / (1.0 - right)
                })
            };
            let ends = if flip { (1.0, 0.0) } else { (0.0, 1.0) };
            let branches = [
                Branch { domain: Interval { left: 0.0, right: left }, at_left: 0.0, at_right: 1.0 },
                Branch { domain: Interval { left: right, right: 1.0 }, at_left: ends.0, at_right: ends.1 },
            ];
            let gap = Interval { left, right };
            let unit = Interval { left: 0.0, right: 1.0 };
            let tree = PreimageTree::grow_from_known(&map, &branches, gap, unit, 8).unwrap();
            prop_assert_eq!(tree.counts(), (0..=8).map(|k| 1 << k).collect::<Vec<usize>>());
            let fraction = left + (1.0 - right);
            for (level, length) in tree.lengths().into_iter().enumerate() {
                prop_assert!((length - (right - left) * fraction.powi(level as i32)).abs() < 1e-12);
                prop_assert!((tree.gaps(level).measure() - fraction.powi(level as i32 + 1)).abs() < 1e-12);
            }
            for node in tree.nodes().iter().skip(1) {
                let Some(parent) = node.parent.map(|at| tree.nodes()[at]) else { panic!() };
                let middle = 0.5 * (node.interval.left + node.interval.right);
                let image = map(middle).unwrap_or(f64::NAN);
                let wanted = 0.5 * (parent.interval.left + parent.interval.right);
                prop_assert!((image - wanted).abs() < 1e-9 && branches[node.branch].domain.contains(middle));
            }
            let mut sorted: Vec<Interval> = tree.nodes().iter().map(|node| node.interval).collect();
            sorted.sort_by(|a, b| a.left.total_cmp(&b.left));
            prop_assert!(sorted.windows(2).all(|pair| pair[0].right <= pair[1].left + 1e-15));
            let cantor = matches!(tree.residual_set(), ResidualSet::Cantor { .. });
            prop_assert!(cantor);
        }
    }

    #[test]
    fn traps_that_are_none_missing_branches_and_reversed_windows_are_refused() {
        let halve = |x: f64| Some(0.5 * x);
        let unit = Interval { left: 0.0, right: 1.0 };
        let whole = Branch { domain: unit, at_left: 0.0, at_right: 0.5 };
        let half =
            Branch { domain: Interval { left: 0.0, right: 0.5 }, at_left: 0.0, at_right: 0.25 };
        let (trap, none) = (Interval { left: 0.0, right: 0.1 }, Interval { left: 0.2, right: 0.3 });
        let grown = |branch: Branch, trap, window| {
            PreimageTree::grow(&halve, &[branch], trap, window, 5).map(|tree| tree.levels())
        };
        assert_eq!(grown(whole, trap, unit), Ok(6));
        assert!(matches!(grown(whole, none, unit), Err(Error::NotATrap { .. })));
        assert!(matches!(grown(half, trap, unit), Err(Error::BranchMissed { at: 0.5.., .. })));
        let reversed = Interval { left: 1.0, right: f64::NAN };
        assert!(matches!(grown(whole, trap, reversed), Err(Error::BadInterval { .. })));
        assert!(matches!(grown(whole, reversed, unit), Err(Error::BadInterval { .. })));
        let known = PreimageTree::grow_from_known(&halve, &[whole], trap, reversed, 5);
        assert!(matches!(known, Err(Error::BadInterval { .. })));
    }

    #[test]
    fn limits_of_geometric_sums() {
        assert_eq!(geometric_limit(&[1.0, 0.5, 0.25]), None);
        assert_eq!(geometric_limit(&[1.0, 2.0, 4.0, 8.0]), None);
    }
}
