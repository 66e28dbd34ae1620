//! The preimages of a trap as a tree, and what the tree leaves over.

use crate::power_law::line;
use crate::{Branch, Interval, IntervalSet, ScalarMap};

/// An interval of the tree, mapped onto its parent by one branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Where.
    pub interval: Interval,
    /// After how many steps it enters the trap.
    pub level: usize,
    /// The node it is mapped into; none for the trap.
    pub parent: Option<usize>,
    /// The branch that maps it there, by its place in the list; 0 for the trap.
    pub branch: usize,
}

/// The trap, its preimages, theirs, …
#[derive(Debug, Clone, PartialEq)]
pub struct PreimageTree {
    window: Interval,
    nodes: Vec<Node>,
    /// Where each level begins among the nodes, and an end.
    starts: Vec<usize>,
    /// The first level from which a preimage may be missing, because its target has few ulps.
    incomplete: Option<usize>,
}

/// Intervals narrower than so many ulps have no reliable preimages.
const NARROW: f64 = 64.0;

/// What remains of the window outside all levels, as far as the growth of the counts tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ResidualSet {
    /// Counts grow exponentially, by this logarithm a level: orbits that never enter form a Cantor set.
    Cantor {
        /// ln of the factor from level to level.
        growth: f64,
    },
    /// Counts grow like a power of the level, so that boundaries are countable.
    Countable {
        /// The power.
        power: f64,
    },
    /// Too few levels, or neither fits better.
    Undecided,
}

impl PreimageTree {
    /// Grows `depth` levels in `window`, or until one is empty or there are a million nodes.
    ///
    /// `branches` must be all monotone branches of the map there.
    ///
    /// ```
    /// use basin_of_attraction::{Branch, Interval, PreimageTree, ResidualSet};
    /// // The tent map of slope 3: what never leaves [0, 1] is Cantor's set.
    /// let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
    /// let left = Branch { domain: Interval::new(0.0, 0.5)?, at_left: 0.0, at_right: 1.5 };
    /// let right = Branch { domain: Interval::new(0.5, 1.0)?, at_left: 1.5, at_right: 0.0 };
    /// let (window, hole) = (Interval::new(0.0, 1.0)?, Interval::new(1.0 + 1e-12, 1.5)?);
    /// let tree = PreimageTree::grow(&tent, &[left, right], hole, window, 12);
    /// let ResidualSet::Cantor { growth } = tree.residual_set() else { panic!() };
    /// assert!((growth - 2f64.ln()).abs() < 1e-12);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    pub fn grow(
        map: &impl ScalarMap,
        branches: &[Branch],
        trap: Interval,
        window: Interval,
        depth: usize,
    ) -> Self {
        const MOST: usize = 1_000_000;
        let known = IntervalSet::union(vec![trap]);
        let root = Node { interval: trap, level: 0, parent: None, branch: 0 };
        let mut tree =
            PreimageTree { window, nodes: vec![root], starts: vec![0, 1], incomplete: None };
        for level in 1..=depth {
            let last = tree.starts[level - 1]..tree.starts[level];
            if last.is_empty() || tree.nodes.len() > MOST {
                break;
            }
            for parent in last {
                let target = tree.nodes[parent].interval;
                for (branch, piece) in branches.iter().enumerate() {
                    let Some(found) = piece.preimage(map, &target) else { continue };
                    let ulps = |x: &Interval| x.length() / (f64::EPSILON * x.right.abs());
                    let mut fresh =
                        IntervalSet::union(vec![found]).minus(&known).intervals().to_vec();
                    // What the two roundings of the trap's end leave between them is no preimage.
                    fresh.retain(|x| {
                        let beside = x.left == trap.right || x.right == trap.left;
                        !(beside && ulps(x) < NARROW)
                    });
                    // A target of a few ulps may lose its own preimages to rounding.
                    if fresh.iter().any(|x| ulps(x) < NARROW) {
                        tree.incomplete.get_or_insert(level + 1);
                    }
                    let node = |&interval| Node { interval, level, parent: Some(parent), branch };
                    tree.nodes.extend(fresh.iter().map(node));
                }
            }
            tree.starts.push(tree.nodes.len());
        }
        tree
    }

    /// All nodes, level by level.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The nodes of one level.
    pub fn level(&self, level: usize) -> &[Node] {
        match (self.starts.get(level), self.starts.get(level + 1)) {
            (Some(&from), Some(&to)) => &self.nodes[from..to],
            _ => &[],
        }
    }

    /// Number of levels, the trap included.
    pub fn levels(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of levels from which nothing can be missing: later ones have targets of a few ulps.
    pub fn complete_levels(&self) -> usize {
        self.incomplete.map_or(self.levels(), |level| level.min(self.levels()))
    }

    /// The ends of all intervals: for box counts, whose slope is the dimension of what they accumulate at
    /// (see [`occupied_boxes`](crate::occupied_boxes)).
    pub fn ends(&self) -> Vec<f64> {
        self.nodes.iter().flat_map(|node| [node.interval.left, node.interval.right]).collect()
    }

    /// How many intervals each level has.
    pub fn counts(&self) -> Vec<usize> {
        (0..self.levels()).map(|level| self.level(level).len()).collect()
    }

    /// The length of each level inside the window.
    pub fn lengths(&self) -> Vec<f64> {
        let inside =
            |node: &Node| node.interval.intersection(&self.window).map_or(0.0, |i| i.length());
        (0..self.levels()).map(|level| self.level(level).iter().map(inside).sum()).collect()
    }

    /// What of the window no level up to `level` covers.
    pub fn gaps(&self, level: usize) -> IntervalSet {
        let end = self.starts.get(level + 1).copied().unwrap_or(self.nodes.len());
        let covered = IntervalSet::union(self.nodes[..end].iter().map(|n| n.interval).collect());
        IntervalSet::union(vec![self.window]).minus(&covered)
    }

    /// How the counts grow over the later half of the complete levels: exponentially, which leaves a
    /// Cantor set, or like a power of the level, which leaves a countable one.
    pub fn residual_set(&self) -> ResidualSet {
        let mut counts = self.counts();
        counts.truncate(self.complete_levels());
        let late: Vec<(f64, f64)> = counts
            .iter()
            .enumerate()
            .skip(counts.len() / 2)
            .filter(|(_, count)| **count > 0)
            .map(|(level, &count)| (level as f64, pxfm::f_log(count as f64)))
            .collect();
        if late.len() < 4 {
            return ResidualSet::Undecided;
        }
        if late.iter().all(|point| point.1 == late[0].1) {
            return ResidualSet::Countable { power: 0.0 };
        }
        let exponential = line(&late);
        let logarithmic: Vec<_> = late.iter().map(|&(k, n)| (pxfm::f_log(k), n)).collect();
        let power = line(&logarithmic);
        // An exact fit may have no residual at all.
        let tiny = 1e-12;
        if exponential.residual + tiny < 0.25 * power.residual {
            ResidualSet::Cantor { growth: exponential.slope }
        } else if power.residual + tiny < 0.25 * exponential.residual {
            ResidualSet::Countable { power: power.slope }
        } else {
            ResidualSet::Undecided
        }
    }
}

/// The limit of a sum whose terms fall geometrically in the end, by Aitken's extrapolation, with its
/// change under one more term as error; nothing for fewer than four terms or if they do not fall.
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
    Some((value, (value - before).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Two linear branches with a gap between them: every level doubles, nodes are disjoint, and each is
        /// mapped onto its parent by its branch.
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
            let tree = PreimageTree::grow(&map, &branches, gap, Interval { left: 0.0, right: 1.0 }, 8);
            prop_assert_eq!(tree.counts(), (0..=8).map(|k| 1 << k).collect::<Vec<usize>>());
            let share = left + (1.0 - right);
            for (level, length) in tree.lengths().into_iter().enumerate() {
                prop_assert!((length - (right - left) * share.powi(level as i32)).abs() < 1e-12);
                prop_assert!((tree.gaps(level).measure() - share.powi(level as i32 + 1)).abs() < 1e-12);
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
    fn limits_of_geometric_sums() {
        assert_eq!(geometric_limit(&[1.0, 0.5, 0.25]), None);
        assert_eq!(geometric_limit(&[1.0, 2.0, 4.0, 8.0]), None);
    }
}
