//! All basins at one mass ratio as intervals.

use crate::basins::branches::{branches, branches_are_proved, contact_branches};
use crate::basins::inward_ends::with_inward_ends;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::{Fates, HOP_BUDGET};
use crate::fates::hopper_fate::HopperFate;
use crate::traps::trap::TrapEdge;
use basin_of_attraction::{
    Branch, Image, Interval, IntervalBasins, Label, Refinement, ScalarMap, SplitMix64, StopReason,
    interval_basins_from_known,
};
use passive_hopper::alpha_star;
use std::f64::consts::PI;

/// All basins between two fixed points, as intervals.
#[derive(Debug, Clone, PartialEq)]
pub struct HopperBasins {
    /// The intervals, with labels as in [`HopperFate::label`]. Their [`stop_reason`](IntervalBasins::stop_reason)
    /// is [`Contradiction`](StopReason::Contradiction) if a probe has another fate than its interval; that has not
    /// been seen.
    pub basins: IntervalBasins,
    /// What the labels of whole intervals stand on.
    pub ground: BranchGround,
    /// The fates of random speeds against their intervals.
    pub probes: Probes,
}

/// What the labels of whole intervals stand on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BranchGround {
    /// On branches of the map that are proved to be all: the critical points of the contact parts are known
    /// (docs/theory.md, Corollary 28), and the map rises in the sudden windows (docs/theory.md, Theorems 48 and
    /// 81). For M ≤ 0.905 with three windows, and for M ≤ 0.9 with up to ten.
    Proved,
    /// On the branches of the contact parts, which are known at every M. The sudden windows, where a hop may have
    /// several sudden lift-offs, stay undecided, and so does what maps into them.
    ContactParts,
    /// On images of whole intervals, enclosed with rounding outwards; no branch is followed. This is what the crate
    /// hopper-proof gives.
    Enclosures,
}

/// A comparison of intervals with the fates of random speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probes {
    /// Speeds whose fate and interval are both known.
    pub compared: usize,
    /// Speeds whose fate is not that of their interval.
    pub wrong: usize,
    /// One of these.
    pub first_wrong: Option<f64>,
}

/// Random speeds that test the basins. A thousand find wrong intervals of more than 0.3 % of the decided length in
/// 95 of 100 cases. More speeds take longer: a fate takes about a microsecond, and some that are close to an edge
/// take milliseconds.
const PROBES: usize = 1000;

/// Seed of these speeds.
const SEED: u64 = 1;

impl HopperBasins {
    /// Basins on this ground, tested by a thousand random speeds. One with another fate is a contradiction.
    ///
    /// # Errors
    /// As [`Fates::fate`].
    pub fn probed(
        basins: IntervalBasins,
        ground: BranchGround,
        fates: &Fates,
    ) -> Result<Self, Error> {
        let probes = Probes { compared: 0, wrong: 0, first_wrong: None };
        let mut found = HopperBasins { basins, ground, probes };
        found.probes = found.probe(fates, PROBES, SEED)?;
        if found.probes.wrong > 0 {
            found.basins = found.basins.with_stop_reason(StopReason::Contradiction);
        }
        Ok(found)
    }

    /// Compares the intervals with the fates of `points` random speeds of the window.
    ///
    /// The fate of a speed needs no branches ([`Fates::fate`]). Without a wrong one among n, the wrong intervals
    /// have less than 3/n of the decided length in 95 of 100 cases.
    ///
    /// # Errors
    /// As [`Fates::fate`].
    pub fn probe(&self, fates: &Fates, points: usize, seed: u64) -> Result<Probes, Error> {
        let (window, random) = (self.basins.window(), SplitMix64::from_seed(seed));
        let speed = |k: usize| window.left + window.length() * random.uniform(k as u64);
        // A speed in no interval has nothing to be compared with, and its fate may take long.
        let known = |speed: &f64| self.basins.label(*speed).is_some();
        let speeds: Vec<f64> = (0..points).map(speed).filter(known).collect();
        let mut probes = Probes { compared: 0, wrong: 0, first_wrong: None };
        for (&speed, (fate, _)) in speeds.iter().zip(fates.fates_within(&speeds, HOP_BUDGET)?) {
            let fate = fate.label();
            let Some(found) = self.basins.label(speed).filter(|_| fate.is_decided()) else {
                continue;
            };
            probes.compared += 1;
            if found != fate {
                probes.wrong += 1;
                probes.first_wrong.get_or_insert(speed);
            }
        }
        Ok(probes)
    }
}

/// The basins of all fates on [α*_`from`, α*_`to`]. Each sudden window is searched for branches with `samples`
/// points, where it is proved which there are; elsewhere the windows stay undecided. The crate hopper-proof has the
/// basins at every M.
///
/// Every speed between the ends of an interval has its fate: the ends are rounded inwards, and confirmed by bounded
/// hops.
///
/// The result states what it rests on ([`HopperBasins::ground`]), and compares itself with the fates of a thousand
/// speeds ([`HopperBasins::probes`]).
///
/// ```
/// use basin_of_attraction::Refinement;
/// use hopper_basin::{BranchGround, Fates, hopper_basins};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(0.2)?)?;
/// let refinement = Refinement { shortest: 1e-6, ..Refinement::default() };
/// let found = hopper_basins(&fates, 1, 2, 200, refinement)?;
/// assert_eq!((found.ground, found.probes.wrong), (BranchGround::Proved, 0));
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
    let mass_ratio = fates.map().mass_ratio();
    // Orbits fall below the window: all branches of the map down to zero are needed.
    let (branches, traps, ground) =
        if has_whole_humps(fates, to)? {
            (Vec::new(), traps_and_gaps(fates, Vec::new(), to)?, BranchGround::Proved)
        } else if branches_are_proved(mass_ratio, to) {
            let branches = branches(fates, 0, to, samples)?;
            let traps = traps_and_grounding(fates, &branches, to, top)?;
            (branches, traps, BranchGround::Proved)
        } else {
            let (mut branches, mut gaps) = (Vec::new(), Vec::new());
            for n in 0..to {
                let found = contact_branches(fates, n)?;
                let starts = found.iter().skip(1).map(|branch| branch.domain.left);
                let between = found.iter().zip(starts.chain([(n + 1) as f64 * PI]));
                gaps.extend(between.filter_map(|(branch, right)| {
                    grounded_between(fates, branch.domain.right, right)
                }));
                branches.extend(found);
            }
            (branches, traps_and_gaps(fates, gaps, to)?, BranchGround::ContactParts)
        };
    let whole = Interval::new(0.0, top)?;
    let basins = interval_basins_from_known(fates, &traps, &branches, whole, refinement)?;
    let basins = with_inward_ends(fates, basins)?.within(window)?;
    HopperBasins::probed(basins, ground, fates)
}

/// The traps of α*_0 … α*_`to`−1 and the gaps between `branches` below `top` in which the hopper is grounded, with
/// labels.
pub(crate) fn traps_and_grounding(
    fates: &Fates,
    branches: &[Branch],
    to: u64,
    top: f64,
) -> Result<Vec<(Interval, Label)>, Error> {
    traps_and_gaps(fates, grounded(fates, branches, top), to)
}

/// Whether the trap of each of α*_0 … α*_`to`−1 is its whole hump. Then the traps are the basins, and no branch is
/// followed.
fn has_whole_humps(fates: &Fates, to: u64) -> Result<bool, Error> {
    for n in 0..to {
        if fates.trap(n)?.edge != TrapEdge::NextFixedPoint {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The traps of α*_0 … α*_`to`−1, and these gaps of grounding beside them.
fn traps_and_gaps(
    fates: &Fates,
    gaps: Vec<(Interval, Label)>,
    to: u64,
) -> Result<Vec<(Interval, Label)>, Error> {
    let mut traps = gaps;
    for n in 0..to {
        let trap = fates.trap(n)?;
        let right = trap.right().min(alpha_star(n + 1).next_down());
        // On hump 0 the trap ends where the gap of grounding begins, and both ends were computed. If rounding makes
        // the two overlap, the trap keeps the common speeds.
        for (gap, _) in traps.iter_mut().filter(|(gap, _)| gap.contains(right)) {
            gap.left = right.next_up();
        }
        // Some ulps below the onset of grounding the rounding of the map opens a gap inside the trap, of the width
        // of the root of an ulp. Its speeds belong to the trap, as they do for `Fates::fate`.
        let inside = Interval::new(trap.fixed_point.value(), right)?;
        traps.retain(|(gap, _)| !(inside.contains(gap.left) && inside.contains(gap.right)));
        traps.push((inside, HopperFate::label_of_fixed_point(n)));
    }
    Ok(traps)
}

/// The gaps between branches in which the hopper is grounded, with their label.
fn grounded(fates: &Fates, branches: &[Branch], top: f64) -> Vec<(Interval, Label)> {
    let starts = branches.iter().map(|branch| branch.domain.left).chain([top]);
    let ends = std::iter::once(0.0).chain(branches.iter().map(|branch| branch.domain.right));
    ends.zip(starts).filter_map(|(left, right)| grounded_between(fates, left, right)).collect()
}

/// The gap between the ends of two branches, with its label, if the hopper is grounded in it.
fn grounded_between(fates: &Fates, left: f64, right: f64) -> Option<(Interval, Label)> {
    // The gap without the ends of the branches. It is empty where two branches meet at a critical point.
    let (left, right) = (left.next_up(), right.next_down());
    let stops = left < right && fates.image(0.5 * (left + right)) == Image::Stops;
    stops.then_some((Interval { left, right }, HopperFate::GROUNDED))
}
