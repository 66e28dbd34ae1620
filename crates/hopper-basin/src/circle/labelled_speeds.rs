//! The fundamental domain as intervals of speeds with one label, whose ends are certain.

use crate::basins::branches::branches;
use crate::basins::intervals::traps_and_grounding;
use crate::circle::fundamental_domain::FundamentalDomain;
use crate::circle::phase_basins::{CircleLimits, Ground};
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use basin_of_attraction::{Interval, Refinement, interval_basins};

/// (α*_1² − 1)/(α*_1² + 1): for M up to this a hop has at most one sudden lift-off (docs/theory.md, Theorem 20).
const ONE_SUDDEN: f64 = 0.905_619_101_548_377_4;

/// Intervals of fewer ulps than this are not followed: their ends could not be told apart.
const SHORTEST_ULPS: f64 = 16.0;

/// A gap of no more ulps is closed: it is one boundary point, or none, as the fates on both sides show. Ends are found to an ulp
/// in each of the levels, and later hops contract their errors.
const GAP_ULPS: f64 = 64.0;

/// Most ulps that an end moves inwards until its fate is certain.
const MOST_ULPS: f64 = 4096.0;

/// An interval of speeds that have one label. Both ends were followed with a bound on the error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LabelledSpeeds {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) label: u16,
}

/// The intervals of the domain from left to right, and how they were found.
pub(crate) fn labelled_speeds(
    fates: &Fates,
    domain: &FundamentalDomain,
    limits: &CircleLimits,
) -> Result<(Vec<LabelledSpeeds>, Ground), Error> {
    if fates.map().mass_ratio().value() <= ONE_SUDDEN {
        let (parts, spacing) = by_branches(fates, domain, limits)?;
        Ok((joined(fates, certain_ends(fates, parts)?)?, Ground::Branches { spacing }))
    } else {
        let parts = by_spacing(fates, domain, limits)?;
        Ok((parts, Ground::Spacing { speeds: domain.width() / limits.fate_samples as f64 }))
    }
}

/// From the monotone branches of the map below the top of the domain.
fn by_branches(
    fates: &Fates,
    domain: &FundamentalDomain,
    limits: &CircleLimits,
) -> Result<(Vec<LabelledSpeeds>, f64), Error> {
    let top = domain.top;
    let mut found = branches(fates, 0, domain.n, limits.window_samples)?;
    // An orbit only descends: speeds above the domain have no part in it.
    found.retain(|branch| branch.domain.left < top);
    if let (Some(last), Ok(Some(image))) = (found.last_mut(), fates.map().image(top))
        && last.domain.right > top
    {
        (last.domain.right, last.at_right) = (top, image);
    }
    let traps = traps_and_grounding(fates, &found, domain.n, top)?;
    let window = Interval::new(domain.bottom, top)?;
    let per_turn = domain.width();
    let ulps = SHORTEST_ULPS * f64::EPSILON * top;
    let refinement = Refinement {
        undecided: limits.refinement.undecided * per_turn,
        shortest: (limits.refinement.shortest * per_turn).max(ulps),
        ..limits.refinement
    };
    let basins = interval_basins(fates, &traps, &found, window, refinement)?;
    let parts = basins.intervals().iter().map(|part| LabelledSpeeds {
        left: part.interval.left,
        right: part.interval.right,
        label: part.label,
    });
    let widest = (0..domain.n).map(|n| {
        let (end, next) = ((n + 1) as f64 * std::f64::consts::PI, passive_hopper::alpha_star(n + 1));
        (next - end) / (limits.window_samples - 1) as f64
    });
    Ok((parts.collect(), widest.fold(0.0, f64::max)))
}

/// From the fates of equally spaced speeds, with the changes of label between them bisected.
fn by_spacing(
    fates: &Fates,
    domain: &FundamentalDomain,
    limits: &CircleLimits,
) -> Result<Vec<LabelledSpeeds>, Error> {
    let count = limits.fate_samples;
    let at = |k: usize| domain.bottom + domain.width() * (k as f64 / (count - 1) as f64);
    let speeds: Vec<f64> = (0..count).map(at).collect();
    let labels = fates.labels(&speeds)?;
    let mut parts: Vec<LabelledSpeeds> = Vec::new();
    for (&speed, &label) in speeds.iter().zip(&labels) {
        if HopperFate::is_undecided(label) {
            continue;
        }
        let previous = parts.last().copied();
        match previous {
            Some(last) if last.label == label => {
                if let Some(last) = parts.last_mut() {
                    last.right = speed;
                }
            }
            Some(last) => {
                let (end, start) = bisect(fates, (last.right, last.label), (speed, label))?;
                if let Some(last) = parts.last_mut() {
                    last.right = end;
                }
                parts.push(LabelledSpeeds { left: start, right: speed, label });
            }
            None => parts.push(LabelledSpeeds { left: speed, right: speed, label }),
        }
    }
    Ok(parts)
}

/// Two speeds as near as `f64` and the fates permit, with the given labels and no third one seen between them. A third label ends
/// the search.
fn bisect(
    fates: &Fates,
    (mut left, at_left): (f64, u16),
    (mut right, at_right): (f64, u16),
) -> Result<(f64, f64), Error> {
    loop {
        let middle = left + 0.5 * (right - left);
        if !(middle > left && middle < right) {
            return Ok((left, right));
        }
        match fates.fate(middle)?.label() {
            label if label == at_left => left = middle,
            label if label == at_right => right = middle,
            _ => return Ok((left, right)),
        }
    }
}

/// The intervals with ends moved inwards until their fates are certain. An interval without such ends is left out.
fn certain_ends(
    fates: &Fates,
    parts: Vec<LabelledSpeeds>,
) -> Result<Vec<LabelledSpeeds>, Error> {
    let mut certain = Vec::with_capacity(parts.len());
    for LabelledSpeeds { left, right, label } in parts {
        let ulp = f64::EPSILON * right;
        let end = |start: f64, sign: f64| -> Result<Option<f64>, Error> {
            let mut ulps = 0.0;
            while ulps <= MOST_ULPS {
                let speed = start + sign * ulps * ulp;
                if !(speed >= left && speed <= right) {
                    return Ok(None);
                }
                if fates.fate(speed)?.label() == label {
                    return Ok(Some(speed));
                }
                ulps = f64::max(1.0, 2.0 * ulps);
            }
            Ok(None)
        };
        if let (Some(left), Some(right)) = (end(left, 1.0)?, end(right, -1.0)?)
            && left < right
        {
            certain.push(LabelledSpeeds { left, right, label });
        }
    }
    Ok(certain)
}

/// Neighbours with one label and a gap of some ulps joined, if the fate inside the gap is theirs as well.
fn joined(fates: &Fates, parts: Vec<LabelledSpeeds>) -> Result<Vec<LabelledSpeeds>, Error> {
    let mut all: Vec<LabelledSpeeds> = Vec::with_capacity(parts.len());
    for part in parts {
        if let Some(last) = all.last_mut()
            && last.label == part.label
            && is_narrow(last.right, part.left)
            && fates.fate(last.right + 0.5 * (part.left - last.right))?.label() == part.label
        {
            last.right = part.right;
            continue;
        }
        all.push(part);
    }
    Ok(all)
}

/// Whether no more than one boundary point is expected between two speeds.
pub(crate) fn is_narrow(left: f64, right: f64) -> bool {
    right - left <= GAP_ULPS * f64::EPSILON * right
}
