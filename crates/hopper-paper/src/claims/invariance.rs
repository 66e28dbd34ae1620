//! Claims about the invariance under M → 1/M.

use super::claim::{Claim, largest};
use crate::error::Error;
use basin_of_attraction::SplitMix64;
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
use rayon::prelude::*;
use repository_tools::Progress;
use std::f64::consts::PI;

/// Number of random pairs (M, α): some fifty thousand on each hump.
const PAIRS: u64 = 1_000_000;
/// Largest difference of α′² between M and 1/M, relative to α². It is zero for exact numbers; the roundings of 1/M, of
/// both μ and of both α′² add up to 8 ulps at most.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Distance of the random speeds from the ends of their interval, as a part of its length. At the ends a landing
/// changes its kind, and rounding would decide which one is computed.
const FROM_ENDS: f64 = 1e-6;
/// Differences of α′² above this part of α² count as real: half a million times [`ROUNDING`].
const REAL_DIFFERENCE: f64 = 1e-9;
/// The fraction of pairs that must differ where the map is not invariant. It need not be 1: at M near 1 the two maps
/// are nearly the same.
const MOST: f64 = 0.9;
/// Relative distance from nπ of the probes beside it. The product n · π is rounded by up to 2·10⁻¹⁶ of itself, so
/// that the neighbouring doubles may lie on the wrong side; this is 5000 times as far.
const BESIDE_N_PI: f64 = 1e-12;

/// A fixed sequence of random numbers. The state is made of digits of π.
const RANDOM: SplitMix64 = SplitMix64::from_state(0x243f_6a88_85a3_08d3);

struct InversionComparison {
    sudden: bool,
    /// The difference of α′² between M and 1/M, relative to α².
    difference: f64,
    /// The difference of α′ between M and 1/M, relative to α²/α′, the change of α′ that a relative change of α² causes.
    image_difference: f64,
    verdicts_agree: bool,
}

/// Compares the maps at a random M in [10⁻³, 10³] and at 1/M, at a random α on one of the humps 0 to 18: on its contact
/// part (α*_n, (n+1)π), or in the sudden window ((n+1)π, α*_{n+1}).
fn compare(k: u64, contact: bool) -> Result<InversionComparison, passive_hopper::Error> {
    let ratio = MassRatio::new(pxfm::f_exp10(6.0 * RANDOM.uniform(3 * k) - 3.0))?;
    let n = (19.0 * RANDOM.uniform(3 * k + 1)) as u64;
    let contact_end = (n + 1) as f64 * PI;
    let (left, right) =
        if contact { (alpha_star(n), contact_end) } else { (contact_end, alpha_star(n + 1)) };
    let alpha =
        left + (right - left) * (FROM_ENDS + (1.0 - 2.0 * FROM_ENDS) * RANDOM.uniform(3 * k + 2));
    let here = LiftOffMap::new(ratio).hop(alpha)?;
    let there = LiftOffMap::new(ratio.inverted()).hop(alpha)?;
    // Whether the first landing is sudden does not depend on M.
    let sudden = here.sudden > 0;
    let difference = (here.next_speed_squared - there.next_speed_squared).abs() / (alpha * alpha);
    // α′² is within rounding of zero: the hopper may be grounded at M and not at 1/M, and both results are right.
    let near = here.next_speed_squared.abs() <= ROUNDING * alpha * alpha;
    let verdicts_agree = near || here.next.is_some() == there.next.is_some();
    let image_difference = match (here.next, there.next) {
        (Some(a), Some(b)) => (a - b).abs() * a.max(b) / (alpha * alpha),
        _ => 0.0,
    };
    Ok(InversionComparison { sudden, difference, image_difference, verdicts_agree })
}

fn sample(
    progress: &Progress,
    pairs: u64,
    contact: bool,
) -> Result<Vec<InversionComparison>, Error> {
    let bar = progress.bar(if contact { "invariance" } else { "no invariance" }, 10);
    let mut comparisons = Vec::with_capacity(pairs as usize);
    for part in 0..10 {
        let range = part * pairs / 10..(part + 1) * pairs / 10;
        let some: Result<Vec<_>, _> = range.into_par_iter().map(|k| compare(k, contact)).collect();
        comparisons.extend(some?);
        bar.set(part + 1);
    }
    bar.finish();
    Ok(comparisons)
}

pub(super) fn check(progress: &Progress) -> Result<Vec<Claim>, Error> {
    let contact = sample(progress, PAIRS, true)?;
    let sudden = sample(progress, PAIRS / 10, false)?;
    let worst = largest(contact.iter().map(|c| c.difference));
    let worst_image = largest(contact.iter().map(|c| c.image_difference));
    let agree = contact.iter().all(|c| c.verdicts_agree && !c.sudden);
    let differing = sudden.iter().filter(|c| c.difference > REAL_DIFFERENCE).count() as f64
        / sudden.len() as f64;
    Ok(vec![
        Claim::new("Sec. IV B, Eq. 23", "$M$ → 1/$M$ invariance")
            .paper("$f$($α$; $M$) = $f$($α$; 1/$M$) when no landing between is sudden")
            .ours(format!("holds for all {PAIRS} random ($M$, $α$) on the contact intervals"))
            .error(format!("largest difference of $α$′^{{2}}: {worst:.1e} $α$^{{2}}; of $f$: {worst_image:.1e} $α$^{{2}}/$f$"))
            .how("$M$ log-uniform in [10^{−3}, 10^{3}], $α$ uniform on the contact part of one of the first 19 humps; it is exact, since $α$′^{2} = $α$^{2} − $μΓ$^{2} contains $M$ only in $μ$; bound: 8 ulps of $α$^{2}, for the rounding of 1/$M$ and of both $μ$")
            .holds(agree && worst <= ROUNDING && worst_image <= ROUNDING),
        Claim::new("Sec. IV B", "no invariance with sudden lift-offs")
            .paper("the entire map between two fixed points is not invariant")
            .ours(format!("on ($nπ$, $α$^{{∗}}_{{n}}) {:.1} % of {} random pairs differ by more than 10^{{−9}} $α$^{{2}}", 100.0 * differing, sudden.len()))
            .error("–")
            .how("the same distribution on the sudden windows")
            .holds(differing > MOST),
        sudden_windows()?,
    ])
}

fn sudden_windows() -> Result<Claim, Error> {
    let mut wrong = 0;
    let mut probed = 0;
    for m in [0.01, 0.3, 1.0, 4.0, 100.0] {
        let map = LiftOffMap::new(MassRatio::new(m)?);
        for n in 1..=200u64 {
            let (n_pi, star) = (n as f64 * PI, alpha_star(n));
            let places = [
                (n_pi * (1.0 - BESIDE_N_PI), false),
                (n_pi * (1.0 + BESIDE_N_PI), true),
                (star.next_down(), true),
                (star.next_up(), false),
            ];
            for (alpha, expected) in places {
                let landings = map.landings(alpha)?;
                wrong +=
                    usize::from(landings.first().is_none_or(|landing| landing.sudden != expected));
                probed += 1;
            }
        }
    }
    Ok(Claim::new("Sec. III", "where landings are sudden")
        .paper("left of a fixed point $y$_{1} > 1 at impact, right of it $y$_{1} < 1")
        .ours("sudden exactly on ($nπ$, $α$^{∗}_{n}), for every $M$")
        .error(format!("{wrong} wrong of {probed}"))
        .how("both ends of the first 200 windows, an ulp or 10^{−12} on either side, five mass ratios")
        .holds(wrong == 0))
}
