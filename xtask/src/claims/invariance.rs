//! Invariance under M → 1/M.

use super::Claim;
use crate::Error;
use crate::progress::Progress;
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
use rayon::prelude::*;
use std::f64::consts::PI;

const PAIRS: u64 = 1_000_000;
/// 1/M and both μ are rounded, and the two radicands: 8 ulps of α² at most.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The k-th of a fixed sequence of uniform numbers in [0, 1), SplitMix64.
fn uniform(k: u64) -> f64 {
    let mut z = k.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(0x243f_6a88_85a3_08d3);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 * f64::EPSILON / 2.0
}

struct Comparison {
    sudden: bool,
    /// |α'² − α'²| relative to α².
    difference: f64,
    verdicts_agree: bool,
}

/// A random M in [1e-3, 1e3] and α in (0, 60), with the maps at M and 1/M.
fn compare(k: u64) -> Result<Comparison, passive_hopper::Error> {
    let ratio = MassRatio::new(pxfm::f_exp10(6.0 * uniform(2 * k) - 3.0))?;
    let alpha = (60.0 * uniform(2 * k + 1)).max(1e-3);
    let here = LiftOffMap::new(ratio).hop(alpha)?;
    let there = LiftOffMap::new(ratio.inverted()).hop(alpha)?;
    // The first landing is sudden for both or for neither: it does not know M.
    let sudden = here.sudden > 0;
    let difference = (here.radicand - there.radicand).abs() / (alpha * alpha);
    // A radicand within rounding of zero may be called either way.
    let near = here.radicand.abs() <= ROUNDING * alpha * alpha;
    let verdicts_agree = near || here.next.is_some() == there.next.is_some();
    Ok(Comparison { sudden, difference, verdicts_agree })
}

pub(super) fn check(progress: &Progress) -> Result<Vec<Claim>, Error> {
    let bar = progress.bar("invariance", 10);
    let mut comparisons = Vec::with_capacity(PAIRS as usize);
    for part in 0..10 {
        let range = part * PAIRS / 10..(part + 1) * PAIRS / 10;
        let some: Result<Vec<_>, _> = range.into_par_iter().map(compare).collect();
        comparisons.extend(some?);
        bar.set(part + 1);
    }
    bar.finish();
    let (sudden, contact): (Vec<_>, Vec<_>) = comparisons.iter().partition(|c| c.sudden);
    let worst = contact.iter().map(|c| c.difference).fold(0.0, f64::max);
    let agree = contact.iter().all(|c| c.verdicts_agree);
    let differing =
        sudden.iter().filter(|c| c.difference > 1e-9).count() as f64 / sudden.len() as f64;
    Ok(vec![
        Claim::new("Sec. IV B, Eq. 23", "M → 1/M invariance")
            .paper("$f$($α$; $M$) = $f$($α$; 1/$M$) when no landing between is sudden")
            .ours(format!("holds for all {} of {PAIRS} random ($M$, $α$) whose first landing is not sudden", contact.len()))
            .error(format!("largest difference of $α$′^{{2}}: {worst:.1e} $α$^{{2}}"))
            .how("$M$ log-uniform in [10^{−3}, 10^{3}], $α$ uniform in (0, 60); it is exact, since $α$′^{2} = $α$^{2} − $μΓ$^{2} has no other $M$; bound: 8 ulps of $α$^{2}")
            .holds(agree && worst <= ROUNDING),
        Claim::new("Sec. IV B", "no invariance with sudden lift-offs")
            .paper("the entire map between two fixed points is not invariant")
            .ours(format!("on ($nπ$, $α$^{{∗}}_{{n}}) {:.1} % of {} random pairs differ by more than 10^{{−9}} $α$^{{2}}", 100.0 * differing, sudden.len()))
            .error("–")
            .how("the same sample")
            .holds(differing > 0.3),
        sudden_windows()?,
    ])
}

fn sudden_windows() -> Result<Claim, Error> {
    let mut wrong = 0;
    let mut probed = 0;
    for m in [0.01, 0.3, 1.0, 4.0, 100.0] {
        let map = LiftOffMap::new(MassRatio::new(m)?);
        for n in 1..=200u64 {
            let (turn, star) = (n as f64 * PI, alpha_star(n));
            let places = [
                (turn * (1.0 - 1e-12), false),
                (turn * (1.0 + 1e-12), true),
                (star.high.next_down(), true),
                (star.high.next_up(), false),
            ];
            for (alpha, expected) in places {
                let first = map.landings(alpha)?.next().transpose()?;
                wrong += usize::from(first.is_none_or(|landing| landing.sudden != expected));
                probed += 1;
            }
        }
    }
    Ok(Claim::new("Sec. III", "where landings are sudden")
        .paper("left of a fixed point $y$_{1} > 1 at impact, right of it $y$_{1} < 1")
        .ours("sudden exactly on ($nπ$, $α$^{∗}_{n}), whatever $M$")
        .error(format!("{wrong} wrong of {probed}"))
        .how("both ends of the first 200 windows, an ulp or 10^{−12} on either side, five mass ratios")
        .holds(wrong == 0))
}
