//! Tests of traps and branches that a caller gives: images of intervals where the branches are known, points elsewhere.

use crate::error::Error;
use crate::line::branches::Branch;
use crate::line::scalar_map::{Image, ScalarMap};
use crate::shares::sampling::check_window;
use crate::space::interval::{Interval, IntervalSet};
use crate::statistics::split_mix::SplitMix64;
use interval_arithmetic::INVERSE_GOLDEN_RATIO;

/// What shows that an interval is a trap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TrapGround {
    /// The branches cover the interval, and the image of each part lies in it. So it is a trap if the branches are
    /// monotone, up to some ulps at its ends.
    Image,
    /// Some of it lies in no branch. This number of points of it have images in it, or the map has a value at none
    /// of them. A part from which orbits leave, and that lies between the points, is not seen.
    Probes {
        /// The number of points.
        points: usize,
    },
}

/// The ends of traps and branches are computed numbers: they may be wrong by some ulps. An interval without these
/// ulps at its ends is tested. A larger number would let pass an interval that orbits leave only there.
const END_ULPS: f64 = 4.0;

/// Points at which a trap is tested where no branch covers it. A part of one hundredth of the trap from which
/// orbits leave is missed by a golden rotation of 128 points only if it lies between neighbours, at most 1/76 of
/// the trap apart. More points see narrower parts and take more values of the map.
const TRAP_POINTS: usize = 128;

/// Some ulps of the larger end of an interval.
fn rounding(of: &Interval) -> f64 {
    END_ULPS * f64::EPSILON * of.left.abs().max(of.right.abs())
}

/// Whether `trap` is a trap of the map: no orbit leaves it, or the map has no value in it.
///
/// ```
/// use basin_of_attraction::{Branch, Error, Interval, TrapGround, check_trap};
/// let halve = |x: f64| Some(0.5 * x);
/// let branch = Branch { domain: Interval::new(-1.0, 1.0)?, at_left: -0.5, at_right: 0.5 };
/// assert_eq!(check_trap(&halve, &[branch], Interval::new(-0.1, 0.2)?), Ok(TrapGround::Image));
/// assert!(matches!(check_trap(&halve, &[branch], Interval::new(0.2, 0.3)?), Err(Error::NotATrap { .. })));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// [`Error::NotATrap`] with a point whose image lies outside; [`Error::BadInterval`] as for [`Interval::new`].
pub fn check_trap(
    map: &impl ScalarMap,
    branches: &[Branch],
    trap: Interval,
) -> Result<TrapGround, Error> {
    let Interval { left, right } = Interval::new(trap.left, trap.right)?;
    let slack = rounding(&trap);
    let stays = |image: f64| left - slack <= image && image <= right + slack;
    let refused = |at, image| Err(Error::NotATrap { left, right, at, image });
    let inner = Interval { left: left + slack, right: right - slack };
    let mut covered = 0.0;
    for part in branches.iter().filter_map(|branch| branch.domain.intersection(&inner)) {
        covered += part.length();
        // A monotone branch has its extremes at the ends.
        for at in [part.left, part.right] {
            if let Image::Point(image) = map.image(at)
                && !stays(image)
            {
                return refused(at, Some(image));
            }
        }
    }
    // Neighbouring branches may leave out an ulp between them.
    if branches.len() as f64 * slack >= inner.length() - covered && covered > 0.0 {
        return Ok(TrapGround::Image);
    }
    let (mut stops, mut valued, mut tested) = (None, 0, 0);
    for k in 0..TRAP_POINTS {
        let turn = (k as f64 + 0.5) * INVERSE_GOLDEN_RATIO;
        let at = left + (right - left) * (turn - turn.floor());
        // A trap of a few ulps has no inside: any of its points is tested.
        if inner.left < inner.right && !inner.contains(at) {
            continue;
        }
        match map.image(at) {
            Image::Point(image) if !stays(image) => return refused(at, Some(image)),
            Image::Point(_) => valued += 1,
            Image::Stops => stops = Some(at),
            Image::Undecided => continue,
        }
        tested += 1;
    }
    match stops {
        // Some orbits stop in the interval, and others do not: it has no single fate.
        Some(at) if valued > 0 => refused(at, None),
        _ => Ok(TrapGround::Probes { points: tested }),
    }
}

/// Tests branches against the map at random points: `points` of `window`, and four on every branch.
///
/// The value at each point must be taken on its branch at this point alone, up to rounding; so must be a point
/// without a branch, and outside `traps`, be without a value. A branch that a search with too few samples has
/// missed, or two that it took for one, is found with the probability that one of the points falls on it: n points
/// miss a part of 3/n of the window in 5 of 100 cases.
///
/// # Errors
/// [`Error::BadInterval`] for a window or a branch that is no interval; [`Error::BranchMissed`] with the point at
/// which a branch is wrong or is missing.
pub fn check_branches(
    map: &impl ScalarMap,
    branches: &[Branch],
    traps: &IntervalSet,
    window: Interval,
    points: usize,
    seed: u64,
) -> Result<(), Error> {
    /// Points on each branch: short branches get few of the points of the window.
    const ON_A_BRANCH: u64 = 4;
    check_intervals(&[window], branches)?;
    let mut sorted = branches.to_vec();
    sorted.sort_by(|a, b| a.domain.left.total_cmp(&b.domain.left));
    let random = SplitMix64::from_seed(seed);
    let in_window = (0..points as u64).map(|k| (window, k));
    let on_branches = (points as u64..)
        .zip(sorted.iter().flat_map(|branch| [branch.domain; ON_A_BRANCH as usize]))
        .map(|(k, domain)| (domain, k));
    for (range, k) in in_window.chain(on_branches) {
        let at = range.left + range.length() * random.uniform(k);
        let Image::Point(value) = map.image(at) else { continue };
        let own = sorted.partition_point(|branch| branch.domain.right < at);
        match sorted.get(own).filter(|branch| branch.domain.contains(at)) {
            Some(branch) if !agrees(map, branch, at, value) => {
                return Err(Error::BranchMissed { at, value });
            }
            None if !traps.contains(at) && !beside(&sorted, own, at) => {
                return Err(Error::BranchMissed { at, value });
            }
            _ => {}
        }
    }
    Ok(())
}

/// Tests what a caller gives for a search of preimages: the traps, and the branches in the window.
pub(crate) fn check_given(
    map: &impl ScalarMap,
    traps: &[Interval],
    branches: &[Branch],
    window: Interval,
) -> Result<Vec<TrapGround>, Error> {
    /// Random points at which the branches are tested. They miss a branch of 0.3 % of the window in 5 of 100 cases.
    /// More points see narrower branches; each takes some 30 values of the map.
    const POINTS: usize = 1000;
    /// Seed of the points. Another one tests other points.
    const SEED: u64 = 1;
    let grounds =
        traps.iter().map(|&trap| check_trap(map, branches, trap)).collect::<Result<_, Error>>()?;
    let trapped = IntervalSet::union(traps.to_vec());
    check_branches(map, branches, &trapped, window, POINTS, SEED)?;
    Ok(grounds)
}

/// Returns an error if an interval is reversed or not finite: of the list, of the domains of the branches or of
/// their values. Those of the list have a finite length too.
pub(crate) fn check_intervals(list: &[Interval], branches: &[Branch]) -> Result<(), Error> {
    list.iter().try_for_each(|&interval| check_window(interval))?;
    for branch in branches {
        Interval::new(branch.domain.left, branch.domain.right)?;
        Interval::new(branch.at_left.min(branch.at_right), branch.at_left.max(branch.at_right))?;
    }
    Ok(())
}

/// Whether a point in no branch is some ulps from an end of one: ends are known to some ulps only.
fn beside(sorted: &[Branch], next: usize, at: f64) -> bool {
    let near = |end: f64| (end - at).abs() <= END_ULPS * f64::EPSILON * at.abs();
    sorted.get(next).is_some_and(|branch| near(branch.domain.left))
        || next.checked_sub(1).is_some_and(|last| near(sorted[last].domain.right))
}

/// Whether the branch takes `value` at `at`, and nowhere else, up to rounding.
fn agrees(map: &impl ScalarMap, branch: &Branch, at: f64, value: f64) -> bool {
    /// A map is rounded in each of its operations: computed values of a monotone branch may go back by some ulps of
    /// the point and of the value. A larger number would miss lower folds.
    const NOISE_ULPS: f64 = 64.0;
    /// A root beside its zero has far larger errors. They show themselves as scatter between neighbouring numbers,
    /// as many as these on each side. With fewer the scatter is found too small by chance.
    const NEIGHBOURS: usize = 4;
    /// The largest of eight differences is a half or more of the largest error as a rule. A larger factor would
    /// miss lower folds.
    const SCATTERS: f64 = 8.0;
    let scatter = |step: fn(f64) -> f64| {
        let near = std::iter::successors(Some(at), |&x| Some(step(x))).take(NEIGHBOURS + 1);
        let difference = |x: f64| match map.image(x) {
            Image::Point(image) if branch.domain.contains(x) => (image - value).abs(),
            _ => 0.0,
        };
        near.map(difference).fold(0.0, f64::max)
    };
    let rounding = NOISE_ULPS * f64::EPSILON * value.abs().max(at.abs());
    let noise = rounding.max(SCATTERS * scatter(f64::next_up).max(scatter(f64::next_down)));
    let near = |image: f64| (image - value).abs() <= noise;
    let (low, high) = (branch.at_left.min(branch.at_right), branch.at_left.max(branch.at_right));
    if value < low - noise || value > high + noise {
        return false;
    }
    let Some((first, last)) = branch.points_with(map, value.clamp(low, high)) else {
        return near(low) || near(high);
    };
    if (first..=last).contains(&at) {
        return true;
    }
    // Between two points at which a monotone branch takes equal values it is constant.
    let other = if at < first { first } else { last };
    if (other - at).abs() <= END_ULPS * f64::EPSILON * at.abs() {
        return true;
    }
    [0.25, 0.5, 0.75].into_iter().all(|part| match map.image(at + part * (other - at)) {
        Image::Point(image) => near(image),
        Image::Stops | Image::Undecided => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::line::branches::monotone_branches;

    const UNIT: Interval = Interval { left: 0.0, right: 1.0 };

    fn halving() -> Branch {
        Branch { domain: UNIT, at_left: 0.0, at_right: 0.5 }
    }

    #[test]
    fn an_interval_that_orbits_leave_is_no_trap() {
        let halve = |x: f64| Some(0.5 * x);
        let (none, trap) = (Interval { left: 0.2, right: 0.3 }, Interval { left: 0.0, right: 0.3 });
        for branches in [&[halving()][..], &[]] {
            let error = check_trap(&halve, branches, none).unwrap_err();
            assert!(
                matches!(error, Error::NotATrap { image: Some(image), .. } if image < 0.2),
                "{error}"
            );
        }
        assert_eq!(check_trap(&halve, &[halving()], trap), Ok(TrapGround::Image));
        assert_eq!(check_trap(&halve, &[], trap), Ok(TrapGround::Probes { points: TRAP_POINTS }));
        for (left, right) in [(0.3, 0.2), (f64::NAN, 0.2), (0.0, f64::INFINITY)] {
            let error = check_trap(&halve, &[], Interval { left, right });
            assert!(matches!(error, Err(Error::BadInterval { .. })));
        }
    }

    #[test]
    fn a_gap_of_the_map_is_a_trap_and_half_of_a_gap_is_none() {
        let map = |x: f64| (x < 0.4).then_some(0.5 * x);
        let gap = Interval { left: 0.4, right: 1.0 };
        assert!(matches!(check_trap(&map, &[], gap), Ok(TrapGround::Probes { .. })));
        assert!(matches!(check_trap(&map, &[], UNIT), Err(Error::NotATrap { image: None, .. })));
    }

    #[test]
    fn branches_that_sampling_missed_are_found() {
        // A fold of width 0.04 between the samples at 0.5 and 0.6.
        let fold = |x: f64| {
            let bump = 0.02 - (x - 0.55).abs();
            Some(0.5 * x + if bump > 0.0 { 3.0 * bump } else { 0.0 })
        };
        let coarse = monotone_branches(&fold, UNIT, 11).unwrap();
        assert_eq!(coarse.len(), 1);
        let none = IntervalSet::default();
        let error = check_branches(&fold, &coarse, &none, UNIT, 1000, 1).unwrap_err();
        assert!(
            matches!(error, Error::BranchMissed { at, .. } if (at - 0.55).abs() < 0.2),
            "{error}"
        );
        let fine = monotone_branches(&fold, UNIT, 1001).unwrap();
        assert_eq!(fine.len(), 3);
        assert_eq!(check_branches(&fold, &fine, &none, UNIT, 1000, 1), Ok(()));
        // A branch that is not given at all.
        let error = check_branches(&fold, &fine[..2], &none, UNIT, 1000, 1).unwrap_err();
        assert!(matches!(error, Error::BranchMissed { at, .. } if at >= fine[2].domain.left));
        let rest = IntervalSet::union(vec![fine[2].domain]);
        assert_eq!(check_branches(&fold, &fine[..2], &rest, UNIT, 1000, 1), Ok(()));
    }

    /// √((x − 0.6)² + 10⁻⁶), computed as the root of a difference of squares: near its minimum the rounding is a
    /// thousand times larger.
    #[test]
    fn rounding_beside_a_zero_of_a_root_is_no_missed_branch() {
        let root = |x: f64| Some((4.0 - (4.0 - (x - 0.6) * (x - 0.6) - 1e-6)).sqrt());
        let none = IntervalSet::default();
        let near = Interval { left: 0.5999, right: 0.6001 };
        let found = monotone_branches(&root, near, 65).unwrap();
        assert_eq!(check_branches(&root, &found, &none, near, 1000, 1), Ok(()));
    }

    #[test]
    fn branches_of_smooth_and_of_flat_maps_agree_with_them() {
        let none = IntervalSet::default();
        let wide = Interval { left: -2.0, right: 2.0 };
        let maps: [fn(f64) -> Option<f64>; 4] = [
            |x| Some(x * x * x - x),
            |x| Some(x + 1e10),
            |x| (x.abs() > 0.3).then(|| (5.0 * x).fract()),
            |x| Some((x * x - 1.0) * (x * x - 1.0)),
        ];
        for (k, map) in maps.into_iter().enumerate() {
            let found = monotone_branches(&map, wide, 401).unwrap();
            assert_eq!(check_branches(&map, &found, &none, wide, 4000, k as u64), Ok(()), "{k}");
        }
    }
}
