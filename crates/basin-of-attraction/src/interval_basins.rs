//! Basins of a scalar map as intervals, with all that is left undecided.

use crate::{Branch, Error, Estimate, Interval, IntervalSet, ScalarMap};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// An interval of a basin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LabelledInterval {
    /// Where.
    pub interval: Interval,
    /// The label of the trap that it enters.
    pub label: u16,
    /// After how many steps.
    pub level: usize,
}

/// When to stop refining. Long intervals come first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// Stop when less than this is undecided.
    pub undecided: f64,
    /// Preimages of intervals shorter than this are not looked for.
    pub shortest: f64,
    /// Most levels.
    pub levels: usize,
    /// Most intervals.
    pub intervals: usize,
}

/// Why refining stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopReason {
    /// Less is undecided than was asked for, or nothing is left to be followed.
    Resolved,
    /// Only intervals shorter than asked for were left.
    Shortest,
    /// Only intervals of the last level were left.
    Levels,
    /// The number of intervals was used up.
    Intervals,
}

impl Default for Refinement {
    /// Until a millionth of the unit is undecided, with a million intervals at most.
    fn default() -> Self {
        Refinement { undecided: 1e-6, shortest: 1e-12, levels: 1_000_000, intervals: 1_000_000 }
    }
}

/// The basins in a window.
#[derive(Debug, Clone, PartialEq)]
pub struct IntervalBasins {
    window: Interval,
    parts: Vec<LabelledInterval>,
    ended: StopReason,
}

/// The basins of labelled intervals in `window`, level by level of preimages.
///
/// `traps` are sets that orbits do not leave, and, with labels of their own, parts on which the map
/// has no value. `branches` must be all monotone branches of the map in the window, and outside it where
/// orbits go and come back: that they are is the caller's knowledge. Ends are located to one ulp of the map as it is computed; every point
/// enters at one level only, so that the parts are disjoint.
///
/// ```
/// use basin_of_attraction::{Branch, Interval, Refinement, interval_basins};
/// // x + x²: everything in (−1, 0) goes to 0, ever more slowly.
/// let map = |x: f64| Some(x + x * x);
/// let trap = (Interval::new(-0.1, 0.0)?, 1);
/// let left = Branch { domain: Interval::new(-1.0, -0.5)?, at_left: 0.0, at_right: -0.25 };
/// let right = Branch { domain: Interval::new(-0.5, 0.0)?, at_left: -0.25, at_right: 0.0 };
/// let window = Interval::new(-1.0, 0.0)?;
/// let basins = interval_basins(&map, &[trap], &[left, right], window, Refinement::default())?;
/// assert!(basins.undecided() < 1e-6 && basins.measure(1).covers(1.0));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::OverlappingTraps`] if two traps overlap.
pub fn interval_basins(
    map: &(impl ScalarMap + Sync),
    traps: &[(Interval, u16)],
    branches: &[Branch],
    window: Interval,
    refinement: Refinement,
) -> Result<IntervalBasins, Error> {
    /// Intervals followed at once, between looks at the limits.
    const TOGETHER: usize = 16_384;
    crate::TrapSet::new(traps.to_vec())?;
    let known = IntervalSet::union(traps.iter().map(|&(trap, _)| trap).collect());
    // Orbits may leave the window and come back: whole intervals are followed, their parts inside kept.
    let inside = |part: &LabelledInterval| {
        part.interval.intersection(&window).map(|interval| LabelledInterval { interval, ..*part })
    };
    let mut pending: Vec<LabelledInterval> = traps
        .iter()
        .map(|&(interval, label)| LabelledInterval { interval, label, level: 0 })
        .collect();
    let mut parts: Vec<LabelledInterval> = pending.iter().filter_map(inside).collect();
    let mut left = window.length() - length(&parts);
    let mut threshold = refinement.shortest.max(0.01 * window.length());
    let ended = loop {
        if left <= refinement.undecided || pending.is_empty() {
            break StopReason::Resolved;
        }
        if parts.len() >= refinement.intervals {
            break StopReason::Intervals;
        }
        let follow = |part: &LabelledInterval| {
            part.level < refinement.levels && part.interval.length() >= threshold
        };
        let (mut now, mut later): (Vec<LabelledInterval>, Vec<LabelledInterval>) =
            pending.drain(..).partition(follow);
        if now.is_empty() {
            pending = later;
            if threshold > refinement.shortest {
                threshold = refinement.shortest.max(threshold / 8.0);
                continue;
            }
            let last = pending.iter().all(|part| part.level >= refinement.levels);
            break if last { StopReason::Levels } else { StopReason::Shortest };
        }
        later.extend(now.split_off(now.len().min(TOGETHER)));
        let found: Vec<LabelledInterval> =
            now.par_iter().flat_map_iter(|part| preimages(map, branches, part, &known)).collect();
        let kept: Vec<LabelledInterval> = found.iter().filter_map(inside).collect();
        left -= length(&kept);
        parts.extend(kept);
        pending = later;
        pending.extend(found);
    };
    Ok(IntervalBasins { window, parts: apart(parts), ended })
}

/// Sorted, with the ulp or two cut off that neighbours share where the map has equal values.
fn apart(mut parts: Vec<LabelledInterval>) -> Vec<LabelledInterval> {
    parts.sort_by(|a, b| a.interval.left.total_cmp(&b.interval.left));
    let mut end = f64::NEG_INFINITY;
    for part in &mut parts {
        part.interval.left = part.interval.left.max(end);
        end = end.max(part.interval.right);
    }
    parts.retain(|part| part.interval.left < part.interval.right);
    parts
}

fn length(parts: &[LabelledInterval]) -> f64 {
    parts.iter().map(|part| part.interval.length()).sum()
}

/// The preimages of a part outside the traps.
fn preimages(
    map: &impl ScalarMap,
    branches: &[Branch],
    part: &LabelledInterval,
    known: &IntervalSet,
) -> Vec<LabelledInterval> {
    let found = branches.iter().filter_map(|branch| branch.preimage(map, &part.interval)).collect();
    let fresh = IntervalSet::union(found).minus(known);
    let (label, level) = (part.label, part.level + 1);
    fresh.intervals().iter().map(|&interval| LabelledInterval { interval, label, level }).collect()
}

impl IntervalBasins {
    /// The window.
    pub fn window(&self) -> Interval {
        self.window
    }

    /// The same basins, seen in a smaller window.
    #[must_use]
    pub fn within(&self, window: Interval) -> IntervalBasins {
        let cut = |part: &LabelledInterval| {
            part.interval
                .intersection(&window)
                .map(|interval| LabelledInterval { interval, ..*part })
        };
        let parts = self.parts.iter().filter_map(cut).collect();
        IntervalBasins { window, parts, ended: self.ended }
    }

    /// Why refining stopped.
    pub fn stop_reason(&self) -> StopReason {
        self.ended
    }

    /// All parts, from left to right.
    pub fn intervals(&self) -> &[LabelledInterval] {
        &self.parts
    }

    /// The labels that occur.
    pub fn labels(&self) -> Vec<u16> {
        let mut labels: Vec<u16> = self.parts.iter().map(|part| part.label).collect();
        labels.sort_unstable();
        labels.dedup();
        labels
    }

    /// The basin with a label, as a set.
    pub fn set(&self, label: u16) -> IntervalSet {
        let own = self.parts.iter().filter(|part| part.label == label);
        IntervalSet::union(own.map(|part| part.interval).collect())
    }

    /// The label of a point, if it is decided.
    pub fn label(&self, x: f64) -> Option<u16> {
        let at = self.parts.partition_point(|part| part.interval.right < x);
        self.parts.get(at).filter(|part| part.interval.contains(x)).map(|part| part.label)
    }

    /// The length that is left undecided.
    pub fn undecided(&self) -> f64 {
        let rest = self.window.length() - length(&self.parts);
        rest.max(0.0)
    }

    /// The length of the basin with a label: what is resolved, and bounds that hold whatever the
    /// undecided rest is, given that the branches are all there are and each end is right to an ulp or so of
    /// its place. (Where the map is flat, its rounding shifts ends by more.)
    pub fn measure(&self, label: u16) -> Estimate {
        self.measure_of(|other| other == label)
    }

    /// The same for all labels that fulfil a condition, together.
    pub fn measure_of(&self, condition: impl Fn(u16) -> bool) -> Estimate {
        let own = self.parts.iter().filter(|part| condition(part.label));
        let value: f64 = own.map(|part| part.interval.length()).sum();
        // Two ends an ulp off for every part of any label, and the rounding of the sum.
        let ulp = f64::EPSILON * self.window.left.abs().max(self.window.right.abs());
        let ends = 3.0 * self.parts.len() as f64 * ulp;
        let upper = (value + self.undecided() + ends).min(self.window.length());
        Estimate { value, lower: (value - ends).max(0.0), upper }
    }

    /// Counts and lengths of the parts of a label, by level.
    pub fn levels(&self, label: u16) -> BTreeMap<usize, (usize, f64)> {
        let mut levels = BTreeMap::new();
        for part in self.parts.iter().filter(|part| part.label == label) {
            let (count, length) = levels.entry(part.level).or_insert((0, 0.0));
            *count += 1;
            *length += part.interval.length();
        }
        levels
    }

    /// The places where a label ends: between neighbours of different labels the common end, beside
    /// an undecided gap longer than `resolution` both of its ends.
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
    use crate::{Fate, TrapSet, classify};

    /// Two attractors, the fixed points ±1 of a cubic.
    fn cubic(x: f64) -> Option<f64> {
        Some(1.5 * x - 0.5 * x * x * x)
    }

    fn branches_and_traps() -> (Vec<Branch>, Vec<(Interval, u16)>) {
        let at = |x: f64| 1.5 * x - 0.5 * x * x * x;
        let branch = |left: f64, right: f64| Branch {
            domain: Interval { left, right },
            at_left: at(left),
            at_right: at(right),
        };
        let branches = vec![branch(-2.2, -1.0), branch(-1.0, 1.0), branch(1.0, 2.2)];
        let traps = vec![
            (Interval { left: -1.2, right: -0.8 }, 1),
            (Interval { left: 0.8, right: 1.2 }, 2),
        ];
        (branches, traps)
    }

    /// x → x/2 on the right, x + 10 on the left: orbits leave the window [−1, 1] and come back.
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
            (Interval { left: 0.0, right: 0.25 }, 1),
            (Interval { left: 0.25f64.next_up(), right: 0.3 }, 2),
        ];
        let window = Interval { left: -1.0, right: 1.0 };
        let basins =
            interval_basins(&map, &traps, &branches, window, Refinement::default()).unwrap();
        assert_eq!(basins.stop_reason(), StopReason::Resolved);
        let all = basins.measure_of(|_| true);
        assert!(all.value <= 2.0 && all.covers(2.0) && basins.undecided() < 1e-6, "{all:?}");
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

    /// Every limit ends the search, and is named; the undecided rest is under what was asked for or not.
    #[test]
    fn why_it_ended() {
        let (branches, traps) = branches_and_traps();
        let window = Interval { left: -2.2, right: 2.2 };
        let found =
            |refinement| interval_basins(&cubic, &traps, &branches, window, refinement).unwrap();
        let fine = Refinement { undecided: 1e-9, ..Refinement::default() };
        let resolved = found(fine);
        assert!(resolved.stop_reason() == StopReason::Resolved && resolved.undecided() <= 1e-9);
        for (refinement, ended) in [
            (Refinement { shortest: 1e-2, ..fine }, StopReason::Shortest),
            (Refinement { levels: 3, ..fine }, StopReason::Levels),
            (Refinement { intervals: 8, ..fine }, StopReason::Intervals),
        ] {
            let basins = found(refinement);
            assert_eq!(basins.stop_reason(), ended);
            assert!(basins.undecided() > 1e-9);
            assert!(basins.measure(1).covers(resolved.measure(1).value));
        }
    }

    #[test]
    fn parts_are_disjoint_symmetric_and_right() {
        let (branches, traps) = branches_and_traps();
        let window = Interval { left: -2.2, right: 2.2 };
        let basins =
            interval_basins(&cubic, &traps, &branches, window, Refinement::default()).unwrap();
        for pair in basins.intervals().windows(2) {
            assert!(pair[0].interval.right <= pair[1].interval.left);
        }
        assert!((basins.measure(1).value - basins.measure(2).value).abs() < 1e-12);
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
