//! Claims of Sec. VI A: the construction of the basin, and its limit.

use super::claim::Claim;
use crate::error::Error;
use crate::figures::fig_05_construction::{DEPTH, M, levels};
use basin_of_attraction::IntervalSet;
use hopper_asymptotics::{Coefficients, Form, LEFT_FACTOR};
use hopper_basin::{Fates, HopperFate};
use passive_hopper::{FixedPointSpeed, LiftOffMap, MassRatio, alpha_star};
use repository_tools::Progress;

pub(super) fn check(_: &Progress) -> Result<Vec<Claim>, Error> {
    let levels = levels()?;
    Ok(vec![first_level(&levels), each_level(&levels)?, limit(&levels)?, accumulation()?])
}

fn first_level(levels: &[IntervalSet]) -> Claim {
    let hump = (alpha_star(2), alpha_star(3));
    let count = levels.get(1).map_or(0, |level| {
        level.intervals().iter().filter(|i| i.left > hump.0 && i.right < hump.1).count()
    });
    Claim::new("Sec. VI A, Fig. 5a", "two preimages on the next hump")
        .paper("two distinct intervals $A$_{1} and $A$_{2} of the next hump map into the local basin $A$")
        .ours(format!("{count} on hump 2 at $M$ = {M}, and one more on the rising part of hump 1"))
        .error("–")
        .how("preimages of the trap on all monotone branches, ends to one ulp")
        .holds(count == 2)
}

/// Every interval of level k, at its middle and both ends, enters the trap after exactly k hops.
fn each_level(levels: &[IntervalSet]) -> Result<Claim, Error> {
    let fates = Fates::new(MassRatio::new(M)?)?;
    let mut wrong = 0;
    let mut probed = 0;
    for (k, level) in levels.iter().enumerate() {
        for interval in level.intervals() {
            // An end is known to an ulp and may belong to either side: the probes lie a millionth inside.
            for part in [1e-6, 0.5, 1.0 - 1e-6] {
                let alpha = interval.left + part * interval.length();
                let found = fates.fate_within(alpha, 100)?;
                wrong += usize::from(found != (HopperFate::Incessant { n: 1 }, k));
                probed += 1;
            }
        }
    }
    let disjoint = levels.iter().enumerate().all(|(k, level)| {
        levels
            .iter()
            .take(k)
            .all(|earlier| (level.minus(earlier).measure() - level.measure()).abs() < 1e-12)
    });
    let table: Vec<String> = levels
        .iter()
        .map(|level| format!("{} ({:.5})", level.intervals().len(), level.measure()))
        .collect();
    Ok(Claim::new("Sec. VI A, Fig. 5b", "the construction, level by level")
        .paper("the basin is the union of $A$ and all its preimages: each level maps onto the one before")
        .ours(format!("intervals (total length) of levels 0 to {DEPTH} in [$α$^{{∗}}_{{1}}, $α$^{{∗}}_{{4}}]: {}", table.join(", ")))
        .error(format!("{wrong} wrong of {probed} points"))
        .how("both ends and the middle of every interval, followed until trapped; levels are disjoint")
        .holds(wrong == 0 && disjoint))
}

/// The limit of the levels, which is no Cantor set.
fn limit(levels: &[IntervalSet]) -> Result<Claim, Error> {
    // The proof needs f(α) ≤ α with equality at the fixed points only. The probes lie where f comes closest to α.
    let map = LiftOffMap::new(MassRatio::new(M)?);
    let mut rises = 0;
    for n in 1..=4 {
        let star = FixedPointSpeed::new(n);
        for exponent in 1..=12 {
            for side in [1.0, -1.0] {
                let alpha = star.value() + side * 10f64.powi(-exponent);
                rises += usize::from(!map.hop(alpha)?.loss.is_some_and(|loss| loss > 0.0));
            }
        }
    }
    let ends: usize = levels.iter().map(|level| 2 * level.intervals().len()).sum();
    Ok(Claim::new("Sec. VI A", "a Cantor set?")
        .paper("in the limit the segments form a Cantor set")
        .ours(format!("not in a bounded window: $f$($α$) < $α$ off the fixed points, so no orbit returns, each level has finitely many ends ({ends} up to level {DEPTH}), and the boundary is their countable closed union, of box dimension 1/4"))
        .error(format!("{rises} of 96 probes do not fall"))
        .how("proof in docs/model.md; the loss $α$ − $f$($α$) computed without cancellation at 10^{−1} … 10^{−12} on either side of the first four fixed points")
        .corrected(rises == 0))
}

/// An orbit that leaves α*₂ to the left takes 3/(10λ) (δ₀^{−1/3} − δ₁^{−1/3}) hops from δ₀ to δ₁.
fn accumulation() -> Result<Claim, Error> {
    let ratio = MassRatio::new(0.2)?;
    let map = LiftOffMap::new(ratio);
    let star = FixedPointSpeed::new(2);
    let lambda = Coefficients::new(2, ratio, Form::Corrected)?.lambda;
    let (from, to) = (1e-10, 1e-5);
    let mut alpha = star.value() - from;
    let mut hops = 0u32;
    while star.offset_of(alpha) > -to && hops < 1_000_000 {
        alpha = map.image(alpha)?.unwrap_or(0.0);
        hops += 1;
    }
    let predicted =
        3.0 / (LEFT_FACTOR * lambda) * (1.0 / pxfm::f_cbrt(from) - 1.0 / pxfm::f_cbrt(to));
    let ratio = f64::from(hops) / predicted;
    Ok(Claim::new("Sec. VI A", "where the pieces accumulate")
        .paper("nested pieces at every scale")
        .ours(format!("towards $α$^{{∗}}_{{n}} from the left, at distances (3/(10$λk$))^{{3}}: leaving $α$^{{∗}}_{{2}} from 10^{{−10}} to 10^{{−5}} takes {hops} hops, predicted {predicted:.0}"))
        .error(format!("{:.1} %", 100.0 * (ratio - 1.0)))
        .how("$M$ = 0.2, the exact map iterated; the exponent −3 makes the box dimension 1/(1 + 3) = 1/4")
        .holds((ratio - 1.0).abs() < 0.05))
}
