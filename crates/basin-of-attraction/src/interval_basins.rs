//! The basins of a scalar map as intervals, and the length left undecided.

use crate::bounds::Bounds;
use crate::branches::Branch;
use crate::error::Error;
use crate::fate::TrapSet;
use crate::interval::{Interval, IntervalSet};
use crate::label::Label;
use crate::refinement::{Refinement, StopReason};
use crate::scalar_map::ScalarMap;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// An interval whose points all have one fate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabelledInterval {
    /// The interval.
    pub interval: Interval,
    /// The label of the trap that its orbits enter.
    pub label: Label,
    /// The number of steps after which the orbits enter the trap.
    pub level: usize,
}

/// The basins in a window, as disjoint labelled intervals.
#[derive(Debug, Clone, PartialEq)]
pub struct IntervalBasins {
    window: Interval,
    /// Disjoint, from left to right, inside the window.
    parts: Vec<LabelledInterval>,
    stop_reason: StopReason,
}

/// The basins of `traps` in `window`: the traps, their preimages, the preimages of these, and so on.
///
/// A trap is an interval that no orbit leaves. An interval on which the map has no value may be given as a trap too,
/// with a label of its own. `branches` must contain all monotone branches of the map in the window. Where orbits leave
/// the window and return, `branches` must also contain the branches outside it. The caller guarantees both; this
/// function cannot check them. The ends of the intervals are located to one ulp of the computed map. An orbit enters a
/// trap once, so that intervals of different levels are disjoint.
///
/// ```
/// use basin_of_attraction::{Branch, Interval, Label, Refinement, interval_basins};
/// // x + x²: every orbit from (−1, 0) approaches 0, more and more slowly.
/// let map = |x: f64| Some(x + x * x);
/// let trap = (Interval::new(-0.1, 0.0)?, Label::from(1));
/// let left = Branch { domain: Interval::new(-1.0, -0.5)?, at_left: 0.0, at_right: -0.25 };
/// let right = Branch { domain: Interval::new(-0.5, 0.0)?, at_left: -0.25, at_right: 0.0 };
/// let window = Interval::new(-1.0, 0.0)?;
/// let basins = interval_basins(&map, &[trap], &[left, right], window, Refinement::default())?;
/// assert!(basins.undecided() < 1e-6 && basins.basin_length(Label::from(1)).covers(1.0));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::OverlappingTraps`] if two traps have a point in common.
pub fn interval_basins(
    map: &(impl ScalarMap + Sync),
    traps: &[(Interval, Label)],
    branches: &[Branch],
    window: Interval,
    refinement: Refinement,
) -> Result<IntervalBasins, Error> {
    /// Number of intervals followed in one parallel round. The limits are tested between rounds, so that the result
    /// does not depend on the number of threads. Smaller rounds give the threads too little work; larger rounds exceed
    /// the limit on intervals by more.
    const ROUND: usize = 16_384;
    /// Intervals longer than this fraction of the window are followed first: their preimages are the
    /// longest as a rule. A larger fraction would add rounds with few intervals.
    const FIRST_THRESHOLD: f64 = 0.01;
    /// Once no longer intervals are pending, the threshold is divided by this. A smaller divisor follows the intervals
    /// more nearly in the order of their length, in more rounds. The two numbers decide the order of the search only,
    /// and so the result only if a limit stops it.
    const THRESHOLD_STEP: f64 = 8.0;
    TrapSet::new(traps.to_vec())?;
    let trapped = IntervalSet::union(traps.iter().map(|&(trap, _)| trap).collect());
    // Orbits may leave the window and return. Whole intervals are followed; only their parts inside the window are
    // stored.
    let inside = |part: &LabelledInterval| {
        part.interval.intersection(&window).map(|interval| LabelledInterval { interval, ..*part })
    };
    let mut pending: Vec<LabelledInterval> = traps
        .iter()
        .map(|&(interval, label)| LabelledInterval { interval, label, level: 0 })
        .collect();
    let mut parts: Vec<LabelledInterval> = pending.iter().filter_map(inside).collect();
    let mut undecided = window.length() - total_length(&parts);
    let mut threshold = refinement.shortest.max(FIRST_THRESHOLD * window.length());
    let stop_reason = loop {
        if undecided <= refinement.undecided || pending.is_empty() {
            break StopReason::Resolved;
        }
        if parts.len() >= refinement.intervals {
            break StopReason::IntervalLimit;
        }
        let follow = |part: &LabelledInterval| {
            part.level < refinement.levels && part.interval.length() >= threshold
        };
        let (mut now, mut later): (Vec<LabelledInterval>, Vec<LabelledInterval>) =
            pending.drain(..).partition(follow);
        if now.is_empty() {
            pending = later;
            if threshold > refinement.shortest {
                threshold = refinement.shortest.max(threshold / THRESHOLD_STEP);
                continue;
            }
            let last_level = pending.iter().all(|part| part.level >= refinement.levels);
            break if last_level { StopReason::LevelLimit } else { StopReason::ShortestInterval };
        }
        later.extend(now.split_off(now.len().min(ROUND)));
        let found: Vec<LabelledInterval> =
            now.par_iter().flat_map_iter(|part| preimages(map, branches, part, &trapped)).collect();
        let kept: Vec<LabelledInterval> = found.iter().filter_map(inside).collect();
        undecided -= total_length(&kept);
        parts.extend(kept);
        pending = later;
        pending.extend(found);
    };
    Ok(IntervalBasins { window, parts: disjoint(parts), stop_reason })
}

/// The parts from left to right, made disjoint.
///
/// Preimages of neighbouring intervals overlap by an ulp or two where the map takes equal values at neighbouring
/// points. The overlap is given to the left one of two parts.
fn disjoint(mut parts: Vec<LabelledInterval>) -> Vec<LabelledInterval> {
    parts.sort_by(|a, b| a.interval.left.total_cmp(&b.interval.left));
    let mut end = f64::NEG_INFINITY;
    for part in &mut parts {
        part.interval.left = part.interval.left.max(end);
        end = end.max(part.interval.right);
    }
    parts.retain(|part| part.interval.left < part.interval.right);
    parts
}

fn total_length(parts: &[LabelledInterval]) -> f64 {
    parts.iter().map(|part| part.interval.length()).sum()
}

/// The preimages of a part, without the traps: a point of a trap has level 0.
fn preimages(
    map: &impl ScalarMap,
    branches: &[Branch],
    part: &LabelledInterval,
    trapped: &IntervalSet,
) -> Vec<LabelledInterval> {
    let found = branches.iter().filter_map(|branch| branch.preimage(map, &part.interval)).collect();
    let outside = IntervalSet::union(found).minus(trapped);
    let (label, level) = (part.label, part.level + 1);
    outside
        .intervals()
        .iter()
        .map(|&interval| LabelledInterval { interval, label, level })
        .collect()
}

impl IntervalBasins {
    /// The window.
    pub fn window(&self) -> Interval {
        self.window
    }

    /// The same basins in a smaller window.
    #[must_use]
    pub fn within(&self, window: Interval) -> IntervalBasins {
        let cut = |part: &LabelledInterval| {
            part.interval
                .intersection(&window)
                .map(|interval| LabelledInterval { interval, ..*part })
        };
        let parts = self.parts.iter().filter_map(cut).collect();
        IntervalBasins { window, parts, stop_reason: self.stop_reason }
    }

    /// Which limit stopped the search.
    pub fn stop_reason(&self) -> StopReason {
        self.stop_reason
    }

    /// All intervals, disjoint and from left to right.
    pub fn intervals(&self) -> &[LabelledInterval] {
        &self.parts
    }

    /// The labels that occur.
    pub fn labels(&self) -> Vec<Label> {
        let mut labels: Vec<Label> = self.parts.iter().map(|part| part.label).collect();
        labels.sort_unstable();
        labels.dedup();
        labels
    }

    /// The basin with a label, as a set of intervals.
    pub fn set(&self, label: Label) -> IntervalSet {
        let own = self.parts.iter().filter(|part| part.label == label);
        IntervalSet::union(own.map(|part| part.interval).collect())
    }

    /// The label of a point; `None` if it is undecided or outside the window.
    pub fn label(&self, x: f64) -> Option<Label> {
        let at = self.parts.partition_point(|part| part.interval.right < x);
        self.parts.get(at).filter(|part| part.interval.contains(x)).map(|part| part.label)
    }

    /// The undecided length of the window.
    pub fn undecided(&self) -> f64 {
        let rest = self.window.length() - total_length(&self.parts);
        // All parts together may be longer than the window by rounding.
        rest.max(0.0)
    }

    /// The length of the intervals found so far with this label.
    pub fn resolved_length(&self, label: Label) -> f64 {
        self.resolved_length_of(|other| other == label)
    }

    /// The length of the intervals found so far whose label fulfils a condition.
    pub fn resolved_length_of(&self, condition: impl Fn(Label) -> bool) -> f64 {
        let own = self.parts.iter().filter(|part| condition(part.label));
        own.map(|part| part.interval.length()).sum()
    }

    /// Bounds on the length of the basin with this label inside the window.
    ///
    /// The lower bound is the [resolved length](Self::resolved_length), less the rounding of the ends. The upper
    /// bound adds all of the undecided length. The bounds hold if the branches are complete and each end is
    /// right to an ulp of the window's larger end. (Where the map is flat, its rounding moves ends by more.)
    pub fn basin_length(&self, label: Label) -> Bounds {
        self.basin_length_of(|other| other == label)
    }

    /// Bounds on the total length of the basins whose label fulfils a condition.
    pub fn basin_length_of(&self, condition: impl Fn(Label) -> bool) -> Bounds {
        let resolved = self.resolved_length_of(condition);
        // For every part of any label: one ulp for each of its two ends, and one ulp for the rounding of the sum.
        let ulp = f64::EPSILON * self.window.left.abs().max(self.window.right.abs());
        let rounding = 3.0 * self.parts.len() as f64 * ulp;
        let upper = (resolved + self.undecided() + rounding).min(self.window.length());
        Bounds { lower: (resolved - rounding).max(0.0), upper }
    }

    /// The number and the total length of the intervals with a label, by level.
    pub fn levels(&self, label: Label) -> BTreeMap<usize, (usize, f64)> {
        let mut levels = BTreeMap::new();
        for part in self.parts.iter().filter(|part| part.label == label) {
            let (count, length) = levels.entry(part.level).or_insert((0, 0.0));
            *count += 1;
            *length += part.interval.length();
        }
        levels
    }

    /// The points at which basins end, from left to right.
    ///
    /// Between neighbouring intervals with different labels this is their common end. Beside an undecided gap
    /// longer than `resolution` both ends of the gap are given.
    pub fn boundary(&self, resolution: f64) -> Vec<f64> {
        let mut points = Vec::new();
        for pair in self.parts.windows(2) {
            let (before, after) = (pair[0].interval.right, pair[1].interval.left);
            if after - before > resolution {
                points.extend([before, after]);
            } else if pair[0].label != pair[1].label {
                points.push(after);
            }
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fate::{Fate, classify};

    /// A cubic map with two attractors, its fixed points ±1.
    fn cubic(x: f64) -> Option<f64> {
        Some(1.5 * x - 0.5 * x * x * x)
    }

    fn branches_and_traps() -> (Vec<Branch>, Vec<(Interval, Label)>) {
        let at = |x: f64| 1.5 * x - 0.5 * x * x * x;
        let branch = |left: f64, right: f64| Branch {
            domain: Interval { left, right },
            at_left: at(left),
            at_right: at(right),
        };
        let branches = vec![branch(-2.2, -1.0), branch(-1.0, 1.0), branch(1.0, 2.2)];
        let traps = vec![
            (Interval { left: -1.2, right: -0.8 }, Label::from(1)),
            (Interval { left: 0.8, right: 1.2 }, Label::from(2)),
        ];
        (branches, traps)
    }

    /// The map is x/2 for x ≥ 0 and x + 10 for x < 0. Orbits leave the window [−1, 1] and return.
    #[test]
    fn orbits_may_leave_the_window() {
        let map = |x: f64| Some(if x < 0.0 { x + 10.0 } else { 0.5 * x });
        let branch = |left: f64, right: f64, at_left: f64, at_right: f64| Branch {
            domain: Interval { left, right },
            at_left,
            at_right,
        };
        let branches = [branch(-1.0, -1e-300, 9.0, 10.0), branch(0.0, 16.0, 0.0, 8.0)];
        let traps = [
            (Interval { left: 0.0, right: 0.25 }, Label::from(1)),
            (Interval { left: 0.25f64.next_up(), right: 0.3 }, Label::from(2)),
        ];
        let window = Interval { left: -1.0, right: 1.0 };
        let basins =
            interval_basins(&map, &traps, &branches, window, Refinement::default()).unwrap();
        assert_eq!(basins.stop_reason(), StopReason::Resolved);
        let all = basins.basin_length_of(|_| true);
        assert!(basins.resolved_length_of(|_| true) <= 2.0);
        assert!(all.covers(2.0) && basins.undecided() < 1e-6, "{all:?}");
        assert!(
            basins
                .intervals()
                .iter()
                .all(|part| part.interval.left >= -1.0 && part.interval.right <= 1.0)
        );
        let set = TrapSet::new(traps.to_vec()).unwrap();
        for k in 0..200 {
            let x = -0.9971 + 0.01 * f64::from(k);
            let (fate, _) = classify(&map, &set, x, 100);
            assert_eq!(basins.label(x).map(Fate::Trapped), Some(fate), "{x}");
        }
    }

    /// Each limit stops the search with its own reason, and with more undecided length than requested.
    #[test]
    fn the_stop_reason_names_the_limit() {
        let (branches, traps) = branches_and_traps();
        let window = Interval { left: -2.2, right: 2.2 };
        let found =
            |refinement| interval_basins(&cubic, &traps, &branches, window, refinement).unwrap();
        let fine = Refinement { undecided: 1e-9, ..Refinement::default() };
        let resolved = found(fine);
        assert!(resolved.stop_reason() == StopReason::Resolved && resolved.undecided() <= 1e-9);
        for (refinement, reason) in [
            (Refinement { shortest: 1e-2, ..fine }, StopReason::ShortestInterval),
            (Refinement { levels: 3, ..fine }, StopReason::LevelLimit),
            (Refinement { intervals: 8, ..fine }, StopReason::IntervalLimit),
        ] {
            let basins = found(refinement);
            assert_eq!(basins.stop_reason(), reason);
            assert!(basins.undecided() > 1e-9);
            assert!(
                basins
                    .basin_length(Label::from(1))
                    .covers(resolved.resolved_length(Label::from(1)))
            );
        }
    }

    #[test]
    fn intervals_are_disjoint_symmetric_and_agree_with_fates() {
        let (branches, traps) = branches_and_traps();
        let window = Interval { left: -2.2, right: 2.2 };
        let basins =
            interval_basins(&cubic, &traps, &branches, window, Refinement::default()).unwrap();
        for pair in basins.intervals().windows(2) {
            assert!(pair[0].interval.right <= pair[1].interval.left);
        }
        let [one, two] = [1, 2].map(|n| basins.resolved_length(Label::from(n)));
        assert!((one - two).abs() < 1e-12);
        assert!(basins.undecided() < 1e-6);
        let set = TrapSet::new(traps).unwrap();
        for k in 0..1000 {
            let x = -2.19 + 4.38 * (f64::from(k) + 0.37) / 1000.0;
            let (fate, steps) = classify(&cubic, &set, x, 1000);
            let part = basins.intervals().iter().find(|part| part.interval.contains(x));
            assert_eq!(part.map(|p| (Fate::Trapped(p.label), p.level)), Some((fate, steps)));
        }
    }
}
