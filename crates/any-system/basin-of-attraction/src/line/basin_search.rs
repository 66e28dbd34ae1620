//! The search for the basins of a scalar map as intervals.

use crate::error::Error;
use crate::line::branches::Branch;
use crate::line::fate::TrapSet;
use crate::line::interval_basins::{IntervalBasins, LabelledInterval, total_length};
use crate::line::probes::{check_given, check_intervals};
use crate::line::refinement::{Refinement, StopReason};
use crate::line::scalar_map::ScalarMap;
use crate::space::interval::{Interval, IntervalSet};
use crate::space::label::Label;
use rayon::prelude::*;

/// The basins of `traps` in `window`: the traps, their preimages, the preimages of these, and so on.
///
/// A trap is an interval that no orbit leaves. An interval on which the map has no value may be given as a trap
/// too, with a label of its own. [`check_trap`](crate::check_trap) tests every trap: see
/// [`trap_grounds`](IntervalBasins::trap_grounds).
///
/// `branches` must contain all monotone branches of the map in the window outside the traps. Where orbits leave the
/// window and return, `branches` must also contain the branches outside it.
/// [`check_branches`](crate::check_branches) tests those in the window at 1000 random points. The caller guarantees
/// the rest. The ends of the intervals are located to one ulp of the computed map. An orbit enters a trap once, so
/// that intervals of different levels are disjoint.
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
/// [`Error::OverlappingTraps`] if two traps have a point in common; [`Error::BadRefinement`] for limits that are
/// negative or NaN; else as [`check_trap`](crate::check_trap) and [`check_branches`](crate::check_branches).
pub fn interval_basins(
    map: &(impl ScalarMap + Sync),
    traps: &[(Interval, Label)],
    branches: &[Branch],
    window: Interval,
    refinement: Refinement,
) -> Result<IntervalBasins, Error> {
    TrapSet::new(traps.to_vec())?;
    let intervals: Vec<Interval> = traps.iter().map(|&(trap, _)| trap).collect();
    let grounds = check_given(map, &intervals, branches, window)?;
    let found = interval_basins_from_known(map, traps, branches, window, refinement)?;
    Ok(IntervalBasins { grounds, ..found })
}

/// The points that reach intervals of known label, as [`interval_basins`] finds them, without any test.
///
/// The caller knows that all points of a `known` interval have its label, whatever their orbits do later, and that
/// the branches are complete. A point has the label of the first known interval that its orbit enters.
///
/// ```
/// use basin_of_attraction::{Branch, Interval, Label, Refinement, interval_basins_from_known};
/// // The logistic map 4.5 x (1 − x) takes the interval in the middle above 1, from where orbits escape. It is no trap.
/// let map = |x: f64| Some(4.5 * x * (1.0 - x));
/// let half = 0.5 * (1.0f64 / 9.0).sqrt();
/// let escape = (Interval::new(0.5 - half, 0.5 + half)?, Label::from(0));
/// let left = Branch { domain: Interval::new(0.0, 0.5)?, at_left: 0.0, at_right: 1.125 };
/// let right = Branch { domain: Interval::new(0.5, 1.0)?, at_left: 1.125, at_right: 0.0 };
/// let refinement = Refinement { undecided: 0.01, ..Refinement::default() };
/// let window = Interval::new(0.0, 1.0)?;
/// let found = interval_basins_from_known(&map, &[escape], &[left, right], window, refinement)?;
/// // Almost all points escape. The others are a Cantor set, which lies in the undecided rest.
/// assert!(found.undecided() <= 0.01 && found.labels() == [Label::from(0)]);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::OverlappingTraps`] if two intervals have a point in common; [`Error::BadInterval`] for a window or a
/// branch that is reversed or not finite, and for a window of infinite length; [`Error::BadRefinement`] for limits
/// that are negative or NaN.
pub fn interval_basins_from_known(
    map: &(impl ScalarMap + Sync),
    known: &[(Interval, Label)],
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
    check_intervals(&[window], branches)?;
    refinement.check()?;
    TrapSet::new(known.to_vec())?;
    let trapped = IntervalSet::union(known.iter().map(|&(part, _)| part).collect());
    // Orbits may leave the window and return. Whole intervals are followed; only their parts inside the window are
    // stored.
    let inside = |part: &LabelledInterval| {
        part.interval.intersection(&window).map(|interval| LabelledInterval { interval, ..*part })
    };
    let mut pending: Vec<LabelledInterval> = known
        .iter()
        .map(|&(interval, label)| LabelledInterval { interval, label, level: Some(0) })
        .collect();
    let mut parts: Vec<LabelledInterval> = pending.iter().filter_map(inside).collect();
    let mut undecided = window.length() - total_length(&parts);
    let mut threshold = refinement.shortest.max(FIRST_THRESHOLD * window.length());
    let stop_reason = loop {
        if undecided <= refinement.undecided {
            break StopReason::Resolved;
        }
        if pending.is_empty() {
            break StopReason::AllFollowed;
        }
        if parts.len() >= refinement.intervals {
            break StopReason::IntervalLimit;
        }
        let follow = |part: &LabelledInterval| {
            part.level < Some(refinement.levels) && part.interval.length() >= threshold
        };
        let (mut now, mut later): (Vec<LabelledInterval>, Vec<LabelledInterval>) =
            pending.drain(..).partition(follow);
        if now.is_empty() {
            pending = later;
            if threshold > refinement.shortest {
                threshold = refinement.shortest.max(threshold / THRESHOLD_STEP);
                continue;
            }
            let last_level = pending.iter().all(|part| part.level >= Some(refinement.levels));
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
    let found_length = total_length(&parts);
    let parts = disjoint(parts);
    // For every part an ulp or two at its ends, and the rounding of the sums.
    let ulp = f64::EPSILON * window.left.abs().max(window.right.abs());
    let twice = found_length - total_length(&parts) - END_ULPS * ulp * parts.len() as f64;
    let stop_reason = if stop_reason == StopReason::Resolved && twice > refinement.undecided {
        StopReason::Contradiction
    } else {
        stop_reason
    };
    Ok(IntervalBasins { window, parts, stop_reason, grounds: Vec::new() }.without_undecided())
}

/// Ulps of the window by which an end of a part may be wrong, with the rounding of sums of lengths: four ends of
/// two neighbours, and as many sums. With fewer ulps long lists of parts could contradict one another by rounding.
const END_ULPS: f64 = 8.0;

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

/// The preimages of a part, without the traps: a point of a trap has level 0.
fn preimages(
    map: &impl ScalarMap,
    branches: &[Branch],
    part: &LabelledInterval,
    trapped: &IntervalSet,
) -> Vec<LabelledInterval> {
    let found = branches.iter().filter_map(|branch| branch.preimage(map, &part.interval)).collect();
    let outside = IntervalSet::union(found).minus(trapped);
    let (label, level) = (part.label, part.level.map(|level| level + 1));
    outside
        .intervals()
        .iter()
        .map(|&interval| LabelledInterval { interval, label, level })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::line::fate::{Fate, classify};

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
        // The second interval is no trap: orbits pass through it into the first. Its label is that of the orbits
        // that enter it.
        let limits = Refinement::default();
        assert!(matches!(
            interval_basins(&map, &traps, &branches, window, limits),
            Err(Error::NotATrap { left: 0.25.., .. })
        ));
        let basins = interval_basins_from_known(&map, &traps, &branches, window, limits).unwrap();
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
    fn limits_and_windows_that_no_search_can_reach_are_refused() {
        let (branches, traps) = branches_and_traps();
        let window = Interval { left: -2.2, right: 2.2 };
        let found = |window, refinement| {
            interval_basins(&cubic, &traps, &branches, window, refinement).map(|_| ())
        };
        for bad in [-1e-9, f64::NAN] {
            for refinement in [
                Refinement { shortest: bad, ..Refinement::default() },
                Refinement { undecided: bad, ..Refinement::default() },
            ] {
                assert!(matches!(found(window, refinement), Err(Error::BadRefinement { .. })));
            }
        }
        let limits = Refinement::default();
        for (left, right) in [(1.0, -1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            let bad = Interval { left, right };
            assert!(matches!(found(bad, limits), Err(Error::BadInterval { .. })));
            let basins = interval_basins(&cubic, &traps, &branches, window, limits).unwrap();
            assert!(matches!(basins.within(bad), Err(Error::BadInterval { .. })));
        }
        // A length of 0 can be asked for: the search follows all intervals, or reaches another limit.
        let all = Refinement { shortest: 0.0, undecided: 0.0, levels: 30, intervals: 5000 };
        assert_eq!(found(window, all), Ok(()));
    }

    /// With two branches of three the search ends with the rest undecided, and does not call it resolved.
    #[test]
    fn missing_branches_are_refused_or_leave_the_basins_unresolved() {
        let (branches, traps) = branches_and_traps();
        let window = Interval { left: -2.2, right: 2.2 };
        let limits = Refinement::default();
        assert!(matches!(
            interval_basins(&cubic, &traps, &branches[1..], window, limits),
            Err(Error::BranchMissed { at: ..-1.0, .. })
        ));
        let found =
            interval_basins_from_known(&cubic, &traps, &branches[1..], window, limits).unwrap();
        assert_ne!(found.stop_reason(), StopReason::Resolved);
        assert!(found.undecided() > 0.5);
        // One branch in place of three is not monotone.
        let at = |x: f64| cubic(x).unwrap();
        let one = Branch { domain: window, at_left: at(-2.2), at_right: at(2.2) };
        assert!(matches!(
            interval_basins(&cubic, &traps, &[one], window, limits),
            Err(Error::BranchMissed { .. })
        ));
    }

    #[test]
    fn undecided_intervals_are_gaps_and_no_basins() {
        let (branches, mut traps) = branches_and_traps();
        let window = Interval { left: -2.2, right: 2.2 };
        let limits = Refinement::default();
        let known = interval_basins(&cubic, &traps, &branches, window, limits).unwrap();
        traps[1].1 = Label::UNDECIDED;
        let found = interval_basins(&cubic, &traps, &branches, window, limits).unwrap();
        let same = known.relabelled(|part| match part.label {
            two if two == Label::from(2) => Label::UNDECIDED_PRECISION,
            label => label,
        });
        for basins in [&found, &same] {
            assert_eq!(basins.labels(), [Label::from(1)]);
            assert_eq!(basins.stop_reason(), StopReason::AllFollowed);
            assert!((basins.undecided() - 2.2).abs() < 1e-5);
            let count = basins.boxes(0.1, 1e-9).unwrap();
            assert!(count.mixed == 0 && count.open > 20 && count.half_open > 0, "{count:?}");
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
            assert_eq!(
                part.map(|p| (Fate::Trapped(p.label), p.level.unwrap())),
                Some((fate, steps))
            );
        }
    }
}
