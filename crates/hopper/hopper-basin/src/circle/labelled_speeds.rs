//! The fundamental domain as intervals of speeds with one label, whose ends are certain.

use crate::basins::branches::branches;
use crate::basins::intervals::traps_and_grounding;
use crate::circle::circle_limits::{CircleLimits, Ground};
use crate::circle::fundamental_domain::DomainSpeeds;

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::traps::trap::ONE_SUDDEN;
use basin_of_attraction::{Interval, Label, Refinement, interval_basins_from_known};
use std::f64::consts::PI;

/// Up to this n the windows are known to have one branch each for most M (docs/theory.md, Theorem 48). For larger n
/// the intervals between the many traps below would also be too many: at n = 10 and M = 0.3, 2·10⁴ intervals leave
/// a tenth of the circle undecided.
const LARGEST_N: u64 = 8;

/// Intervals of fewer ulps than this are not followed: their ends could not be told apart.
const SHORTEST_ULPS: f64 = 16.0;

/// Most speeds whose fates are found: more than some minutes need.
const MOST_SAMPLES: usize = 10_000_000;

/// A gap of no more ulps is closed: it is one boundary point, or none, as the fates on both sides show. Ends are
/// found to an ulp in each of the levels, and later hops contract their errors.
const GAP_ULPS: f64 = 64.0;

/// A gap of so many ulps between intervals of one label comes from the rounding of their two ends, each found to an
/// ulp.
const ROUNDING_ULPS: f64 = 4.0;

/// A circle of one label is found with fewer intervals than this. A circle with more has several labels, or none is
/// known.
const MOST_INTERVALS_OF_ONE_LABEL: usize = 1000;

/// Ulps by which an end moves inwards until its fate is certain. The first value exceeds the error of nearly all
/// ends: a fate on the wrong side of the boundary point would cost as much as one on the right side, some
/// milliseconds. 16 ulps are less than a tenth of the error of a phase.
const END_ULPS: [f64; 5] = [16.0, 64.0, 256.0, 1024.0, 4096.0];

/// An interval of speeds that have one label. Both ends were followed with a bound on the error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LabelledSpeeds {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) label: Label,
}

/// The intervals of the domain from left to right, and how they were found.
pub(crate) fn labelled_speeds(
    fates: &Fates,
    domain: &DomainSpeeds,
    limits: &CircleLimits,
) -> Result<(Vec<LabelledSpeeds>, Ground), Error> {
    if !(limits.window_samples >= 3 && limits.fate_samples >= 3) {
        let samples = limits.window_samples.min(limits.fate_samples);
        return Err(basin_of_attraction::Error::TooFewSamples { samples }.into());
    }
    if fates.map().mass_ratio().value() > ONE_SUDDEN || domain.n > LARGEST_N {
        let parts = by_spacing(fates, domain, limits)?;
        return Ok((
            parts,
            Ground::Spacing { speeds: domain.width() / limits.fate_samples as f64 },
        ));
    }
    let sides = sides_of_one_label(fates, domain.n, limits)?;
    let parts = by_branches(fates, domain, &sides, limits)?;
    let widest = (1..=domain.n).map(|n| passive_hopper::alpha_star(n) - n as f64 * PI);
    let spacing = widest.fold(0.0, f64::max) / (limits.window_samples - 1) as f64;
    Ok((certain_ends(fates, joined(fates, parts)?)?, Ground::Branches { spacing }))
}

/// The intervals left of the fixed points below α*_n whose circles have one label, with this label.
///
/// Without them the domain would have infinitely many intervals of this label, one for each hop along the slow side.
fn sides_of_one_label(
    fates: &Fates,
    n: u64,
    limits: &CircleLimits,
) -> Result<Vec<(Interval, Label)>, Error> {
    let refinement = Refinement { intervals: MOST_INTERVALS_OF_ONE_LABEL, ..limits.refinement };
    let limits = CircleLimits { refinement, ..*limits };
    let mut sides = Vec::new();
    for m in 1..n {
        let speeds = DomainSpeeds::widest(fates, m)?;
        let parts = by_branches(fates, &speeds, &sides, &limits)?;
        let one_label = parts.windows(2).all(|pair| pair[0].label == pair[1].label);
        if !one_label {
            continue;
        }
        if let [all] = joined(fates, parts)?.as_slice()
            && all.left == speeds.bottom
            && all.right == speeds.top
        {
            let (left, right) = speeds.inner_side();
            sides.push((Interval::new(left, right)?, all.label));
        }
    }
    Ok(sides)
}

/// From the monotone branches of the map below the top of the domain, and intervals whose label is known.
fn by_branches(
    fates: &Fates,
    domain: &DomainSpeeds,
    sides: &[(Interval, Label)],
    limits: &CircleLimits,
) -> Result<Vec<LabelledSpeeds>, Error> {
    let top = domain.top;
    let mut found = branches(fates, 0, domain.n, limits.window_samples)?;
    // An orbit only descends: speeds above the domain have no part in it.
    found.retain(|branch| branch.domain.left < top);
    if let (Some(last), Ok(Some(image))) = (found.last_mut(), fates.map().image(top))
        && last.domain.right > top
    {
        (last.domain.right, last.at_right) = (top, image);
    }
    let mut known = traps_and_grounding(fates, &found, domain.n, top)?;
    // A trap may reach up to the next fixed point, and then holds all of its left side.
    let meets =
        |side: &Interval, other: &Interval| side.left <= other.right && other.left <= side.right;
    for side in sides {
        if known.iter().all(|(other, _)| !meets(&side.0, other)) {
            known.push(*side);
        }
    }
    let window = Interval::new(domain.bottom, top)?;
    let per_turn = domain.width();
    let ulps = SHORTEST_ULPS * f64::EPSILON * top;
    let refinement = Refinement {
        undecided: limits.refinement.undecided * per_turn,
        shortest: (limits.refinement.shortest * per_turn).max(ulps),
        ..limits.refinement
    };
    let basins = interval_basins_from_known(fates, &known, &found, window, refinement)?;
    let parts = basins.intervals().iter().map(|part| LabelledSpeeds {
        left: part.interval.left,
        right: part.interval.right,
        label: part.label,
    });
    Ok(parts.collect())
}

/// From the fates of equally spaced speeds, with the changes of label between them bisected.
fn by_spacing(
    fates: &Fates,
    domain: &DomainSpeeds,
    limits: &CircleLimits,
) -> Result<Vec<LabelledSpeeds>, Error> {
    let count = limits.fate_samples;
    if count > MOST_SAMPLES {
        let remedy = "give fewer";
        let error = basin_of_attraction::Error::TooManySamples {
            samples: count,
            most: MOST_SAMPLES,
            remedy,
        };
        return Err(error.into());
    }
    let at = |k: usize| domain.bottom + domain.width() * (k as f64 / (count - 1) as f64);
    let speeds: Vec<f64> = (0..count).map(at).collect();
    let labels = fates.labels(&speeds)?;
    let mut parts: Vec<LabelledSpeeds> = Vec::new();
    // An undecided speed ends an interval.
    let mut decided = false;
    for (&speed, &label) in speeds.iter().zip(&labels) {
        if label.is_undecided() {
            decided = false;
            continue;
        }
        let part = LabelledSpeeds { left: speed, right: speed, label };
        match parts.last_mut().filter(|_| decided) {
            Some(last) if last.label == label => last.right = speed,
            Some(_) => changes(fates, &mut parts, part, count + limits.refinement.intervals)?,
            None => parts.push(part),
        }
        decided = true;
    }
    parts.retain(|part| part.left < part.right);
    Ok(parts)
}

/// Appends `next` to `parts`, whose last one has another label, with the change of label between the two found by
/// bisection. A third label on the way is an interval of its own, until there are `most` intervals.
fn changes(
    fates: &Fates,
    parts: &mut Vec<LabelledSpeeds>,
    next: LabelledSpeeds,
    most: usize,
) -> Result<(), Error> {
    // Speeds still to be reached, the nearest last.
    let mut ahead = vec![next];
    while let (Some(last), Some(&goal)) = (parts.last_mut(), ahead.last()) {
        let middle = last.right + 0.5 * (goal.left - last.right);
        if !(middle > last.right && middle < goal.left) {
            parts.push(goal);
            ahead.pop();
            continue;
        }
        let label = fates.fate(middle)?.label();
        if label == last.label {
            last.right = middle;
        } else if let Some(goal) = ahead.last_mut().filter(|goal| goal.label == label) {
            goal.left = middle;
        } else if label.is_undecided() || parts.len() + ahead.len() >= most {
            parts.push(goal);
            ahead.pop();
        } else {
            ahead.push(LabelledSpeeds { left: middle, right: middle, label });
        }
    }
    Ok(())
}

/// The intervals with ends moved inwards until their fates are certain. An interval without such ends is left out.
fn certain_ends(fates: &Fates, parts: Vec<LabelledSpeeds>) -> Result<Vec<LabelledSpeeds>, Error> {
    let mut found = vec![[None; 2]; parts.len()];
    for ulps in END_ULPS {
        let mut tried = Vec::new();
        for (at, part) in parts.iter().enumerate() {
            let step = ulps * f64::EPSILON * part.right;
            for (side, speed) in [part.left + step, part.right - step].into_iter().enumerate() {
                if found[at][side].is_none() && speed >= part.left && speed <= part.right {
                    tried.push((at, side, speed));
                }
            }
        }
        if tried.is_empty() {
            break;
        }
        let speeds: Vec<f64> = tried.iter().map(|&(_, _, speed)| speed).collect();
        for ((at, side, speed), label) in tried.into_iter().zip(fates.labels(&speeds)?) {
            if label == parts[at].label {
                found[at][side] = Some(speed);
            }
        }
    }
    let ends = parts.iter().zip(found).filter_map(|(part, ends)| match ends {
        [Some(left), Some(right)] if left < right => {
            Some(LabelledSpeeds { left, right, label: part.label })
        }
        _ => None,
    });
    Ok(ends.collect())
}

/// Neighbours with one label and a gap of some ulps joined. In a gap of more than [`ROUNDING_ULPS`] the fate is
/// found as well.
fn joined(fates: &Fates, parts: Vec<LabelledSpeeds>) -> Result<Vec<LabelledSpeeds>, Error> {
    let candidate = |pair: &[LabelledSpeeds]| {
        pair[0].label == pair[1].label && is_narrow(pair[0].right, pair[1].left)
    };
    let middle = |pair: &[LabelledSpeeds]| pair[0].right + 0.5 * (pair[1].left - pair[0].right);
    let wide = |pair: &&[LabelledSpeeds]| {
        pair[1].left - pair[0].right > ROUNDING_ULPS * f64::EPSILON * pair[1].left
    };
    let wide: Vec<&[LabelledSpeeds]> =
        parts.windows(2).filter(|pair| candidate(pair)).filter(wide).collect();
    let middles: Vec<f64> = wide.iter().map(|pair| middle(pair)).collect();
    let labels = fates.labels(&middles)?;
    let mut other = wide.iter().zip(labels).filter(|(pair, label)| pair[0].label != *label);
    let mut next_other = other.next().map(|(pair, _)| pair[1].left);
    let mut all: Vec<LabelledSpeeds> = Vec::with_capacity(parts.len());
    for (at, part) in parts.iter().enumerate() {
        let join = at > 0 && candidate(&parts[at - 1..=at]);
        if join && next_other == Some(part.left) {
            next_other = other.next().map(|(pair, _)| pair[1].left);
        } else if join && let Some(last) = all.last_mut() {
            last.right = part.right;
            continue;
        }
        all.push(*part);
    }
    Ok(all)
}

/// Whether the ends of two neighbours are one point before they are moved inwards.
fn is_narrow(left: f64, right: f64) -> bool {
    right - left <= GAP_ULPS * f64::EPSILON * right
}

/// Whether two certain ends are those of one boundary point: each may have moved by the first or the second of
/// [`END_ULPS`].
pub(crate) fn is_boundary_point(left: f64, right: f64) -> bool {
    right - left <= (GAP_ULPS + 2.0 * END_ULPS[1]) * f64::EPSILON * right
}
