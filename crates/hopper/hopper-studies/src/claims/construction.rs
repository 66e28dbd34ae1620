//! Claims of Sec. VI A about the construction of the basin, level by level.

use super::claim::{Check, Evidence, Ground, largest};
use crate::error::Error;
use crate::figures::fig_05_construction::{DEPTH, M, levels};
use crate::independent::followed_orbits::FollowedOrbits;
use crate::independent::map::{Map, printed};
use crate::independent::trap_edge::trap_edge;
use basin_of_attraction::{Interval, IntervalSet, SplitMix64};
use passive_hopper::{MassRatio, alpha_star};
use rayon::prelude::*;

pub(super) const CHECKS: &[Check] = &[
    Check {
        name: "two preimages on the next hump",
        place: "Sec. VI A, Fig. 5a",
        ground: Ground::Test {
            test: "a scan of the printed map for speeds that it maps into the trap",
            proof: None,
        },
        evidence: || two_preimages(&levels()?, &printed),
    },
    Check {
        name: "the construction, level by level",
        place: "Sec. VI A, Fig. 5b",
        ground: Ground::Test {
            test: "orbits of the printed Eqs. 6–8, from all intervals and from random speeds",
            proof: None,
        },
        evidence: || each_level(&levels()?, &printed, 20_000),
    },
];

/// Points at which the humps 1 and 2 are scanned. The preimages of the trap are wider than five of their spacings, and
/// changes of sign find narrower ones, too.
const SAMPLES: u32 = 20_001;
/// Largest distance between an end of an interval and the same end on the printed map. The printed map has an error of
/// 10⁻¹³, and its slope at these ends is at least a tenth.
const ENDS: f64 = 1e-11;

/// A speed that the map maps to an end of the trap.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    alpha: f64,
    /// Whether it is mapped to the right end.
    upper: bool,
}

/// The intervals right of the trap of α*_1, up to α*_3, that the map maps into this trap; each with whether the map
/// rises on it.
fn scanned_preimages(
    map: &impl Map,
    mass_ratio: MassRatio,
) -> Result<Vec<(Interval, bool)>, Error> {
    let star = alpha_star(1);
    let edge = trap_edge(map, 1, mass_ratio)?.map_or(alpha_star(2), |edge| edge.alpha);
    let ends = [(star, false), (edge, true)];
    let value = |alpha: f64| -> Result<f64, Error> { Ok(map(alpha, mass_ratio)?.unwrap_or(0.0)) };
    // Just right of the edge the image is below α*_1 by rounding only: the scan begins at the next sample.
    let at = |k: u32| edge + (alpha_star(3) - edge) * (f64::from(k) / f64::from(SAMPLES));
    let values: Vec<f64> =
        (1..SAMPLES).into_par_iter().map(|k| value(at(k))).collect::<Result<_, _>>()?;
    let mut crossings = Vec::new();
    for (k, pair) in (1..).zip(values.windows(2)) {
        for (end, upper) in ends {
            let above = pair[1] >= end;
            if (pair[0] >= end) == above {
                continue;
            }
            let (mut left, mut right) = (at(k), at(k + 1));
            loop {
                let middle = 0.5 * (left + right);
                if middle <= left || middle >= right {
                    break;
                }
                if (value(middle)? >= end) == above { right = middle } else { left = middle }
            }
            crossings.push(Crossing { alpha: right, upper });
        }
    }
    crossings.sort_by(|a, b| a.alpha.total_cmp(&b.alpha));
    // Between a crossing of one end and the next crossing, of the other end, images are in the trap.
    let inside =
        crossings.windows(2).filter(|pair| pair[0].upper != pair[1].upper).filter(|pair| {
            value(0.5 * (pair[0].alpha + pair[1].alpha))
                .is_ok_and(|image| star <= image && image <= edge)
        });
    inside.map(|pair| Ok((Interval::new(pair[0].alpha, pair[1].alpha)?, pair[1].upper))).collect()
}

/// `levels` are the levels of the construction.
pub(super) fn two_preimages(levels: &[IntervalSet], map: &impl Map) -> Result<Evidence, Error> {
    let scanned = scanned_preimages(map, MassRatio::new(M)?)?;
    let hump = |n: u64, interval: &Interval| {
        interval.left > alpha_star(n) && interval.right < alpha_star(n + 1)
    };
    let on = |n: u64| scanned.iter().filter(move |part| hump(n, &part.0));
    let count = on(2).count();
    let (rising, falling) =
        (on(1).filter(|part| part.1).count(), on(1).filter(|part| !part.1).count());
    let claimed: Vec<&Interval> = levels.get(1).map_or(vec![], |level| {
        level.intervals().iter().filter(|part| part.right < alpha_star(3)).collect()
    });
    let distances = claimed.iter().zip(&scanned).flat_map(|(claimed, (found, _))| {
        [claimed.left - found.left, claimed.right - found.right].map(f64::abs)
    });
    let worst = largest(distances);
    Ok(Evidence::about("two distinct intervals $A$_{1} and $A$_{2} of the next hump map into the local basin $A$")
        .ours(format!("{count} on hump 2 at $M$ = {M}; beside them hump 1 has {rising} on its rising part and \
                       {falling} on its falling part"))
        .error(format!(
            "{} intervals of level 1 below $α$^{{∗}}_{{3}}, {} found by the scan; their ends differ by at most \
             {worst:.1e}",
            claimed.len(),
            scanned.len()
        ))
        .how(format!("preimages of the trap on all monotone branches, ends to one ulp; {SAMPLES} points of the printed \
                      map, changes of sign bisected"))
        .holds(count == 2 && claimed.len() == scanned.len() && worst < ENDS))
}

/// Largest length that two levels may have in common. The ends of the intervals are known to an ulp, 2·10⁻¹⁵, and a
/// level has up to 39 intervals: 78 ulps are 1.4·10⁻¹³.
const COMMON_LENGTH: f64 = 1e-12;

/// An end is known to an ulp and may belong to either side. The probes lie this part of the interval inside.
const INSIDE: f64 = 1e-6;

/// A fixed sequence of random numbers. The state is made of digits of e.
const RANDOM: SplitMix64 = SplitMix64::from_state(0xb7e1_5162_8aed_2a6a);

/// Every interval of level k, at its middle and both ends, enters the trap after exactly k hops; and so do those random
/// speeds that lie in level k, and no others.
pub(super) fn each_level(
    levels: &[IntervalSet],
    map: &impl Map,
    starts: u64,
) -> Result<Evidence, Error> {
    let orbits = FollowedOrbits::new(map, MassRatio::new(M)?, 4)?;
    let level_of = |alpha: f64| levels.iter().position(|level| level.contains(alpha));
    let mut probes = Vec::new();
    for (k, level) in levels.iter().enumerate() {
        for interval in level.intervals() {
            for part in [INSIDE, 0.5, 1.0 - INSIDE] {
                probes.push((interval.left + part * interval.length(), Some(k)));
            }
        }
    }
    let planted = probes.len();
    let (left, right) = (alpha_star(1), alpha_star(4));
    probes.extend((0..starts).map(|k| {
        let alpha = left + (right - left) * RANDOM.uniform(k);
        (alpha, level_of(alpha))
    }));
    let wrong: Vec<bool> = probes
        .into_par_iter()
        .map(|(alpha, level)| {
            let hops = orbits.end(alpha)?.filter(|&(_, n)| n == 1).map(|(hops, _)| hops);
            Ok(hops.filter(|&hops| hops < levels.len()) != level)
        })
        .collect::<Result<_, Error>>()?;
    let wrong = wrong.into_iter().filter(|&wrong| wrong).count();
    let common = levels.iter().enumerate().flat_map(|(k, level)| {
        levels
            .iter()
            .take(k)
            .map(move |earlier| (level.minus(earlier).measure() - level.measure()).abs())
    });
    let common = largest(common);
    let table: Vec<String> = levels
        .iter()
        .map(|level| format!("{} ({:.5})", level.intervals().len(), level.measure()))
        .collect();
    Ok(Evidence::about("the basin is the union of $A$ and all its preimages: each level maps onto the one before")
        .ours(format!("intervals (total length) of levels 0 to {} in [$α$^{{∗}}_{{1}}, $α$^{{∗}}_{{4}}]: {}", levels.len().saturating_sub(1), table.join(", ")))
        .error(format!("{wrong} wrong of {planted} points in the intervals and {starts} random speeds; the levels have \
                        {common:.0e} of length in common"))
        .how("orbits of the printed map, followed until trapped; a speed of level $k$ must be trapped after $k$ hops, \
              and a speed of no level after more or elsewhere")
        .holds(wrong == 0 && planted > 0 && levels.len() == DEPTH + 1 && common < COMMON_LENGTH))
}
