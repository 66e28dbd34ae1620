//! Claims of Sec. VI A about the limit of the construction: no Cantor set, but a countable boundary.

use super::claim::{Check, Evidence, Ground, largest};
use super::humps::scanned;
use crate::error::Error;
use crate::independent::map::{Map, printed, printed_rounding};
use crate::independent::trap_edge::trap_edge;
use basin_of_attraction::{Branch, Interval, PreimageTree, Refinement, ResidualSet};
use hopper_asymptotics::{Coefficients, Form, LEFT_FACTOR};
use hopper_basin::{Fates, ONE_SUDDEN, hopper_basins};
use passive_hopper::{FixedPointSpeed, MassRatio, alpha_star};

pub(super) const CHECKS: &[Check] = &[
    Check {
        name: "a Cantor set?",
        place: "Sec. VI A",
        ground: Ground::Test {
            test: "the growth of the preimage tree on a blind scan of the printed map",
            proof: Some("Corollary 42"),
        },
        evidence: || remainder(&printed_tree(&printed)?),
    },
    Check {
        name: "where the pieces accumulate",
        place: "Sec. VI A",
        ground: Ground::Test {
            test: "clusters of computed boundary points against preimages of $α$^{∗}_{2} on the printed map",
            proof: Some("Theorem 41"),
        },
        evidence: || accumulation(&printed, &boundary_points()?),
    },
    Check {
        name: "how fast the pieces shrink",
        place: "Sec. VI A",
        ground: Ground::Test {
            test: "an orbit of the printed Eqs. 6–8, hop by hop",
            proof: Some("Theorem 38"),
        },
        evidence: || leaving(&printed, LEFT_FACTOR),
    },
    Check {
        name: "the boundary is countable",
        place: "Sec. VI A",
        ground: Ground::Theorem { proof: "Theorem 41" },
        evidence: || countable(&printed, M),
    },
];

/// The mass ratio at which the paper measures 0.037. Most of the window falls through the traps, so that the boundary
/// has many points.
pub(super) const M: f64 = 0.2;

/// Levels of the tree. About 22 are complete on the first two humps; then intervals are as narrow as rounding.
const DEPTH: usize = 24;

/// The preimages of the trap of α*_1 on the humps 1 and 2.
pub(super) fn printed_tree(map: &impl Map) -> Result<PreimageTree, Error> {
    let mass_ratio = MassRatio::new(M)?;
    let edge = trap_edge(map, 1, mass_ratio)?.map_or(alpha_star(2), |edge| edge.alpha);
    let trap = Interval::new(alpha_star(1), edge)?;
    let window = Interval::new(alpha_star(1), alpha_star(3))?;
    let mut branches = scanned(map, mass_ratio, 1)?;
    branches.extend(scanned(map, mass_ratio, 2)?);
    // On the first branch the map rises from α*_1, falls through α*_1 at the edge of the trap, and its values in the
    // trap are the trap's own.
    let image = |alpha: f64| map(alpha, mass_ratio).ok().flatten();
    Ok(PreimageTree::grow_from_known(&image, &branches, trap, window, DEPTH)?)
}

/// Largest power of the level for which the growth counts as that of a countable rest on two humps. The number of
/// intervals is 2k − 1, of power 1; a third hump would give power 2.
const LARGEST_POWER: f64 = 1.5;

/// What the levels of the tree leave: a Cantor set if their number of intervals grows exponentially.
pub(super) fn remainder(tree: &PreimageTree) -> Result<Evidence, Error> {
    let last = tree.complete_levels().saturating_sub(1);
    let counts = tree.counts();
    let (found, countable) = match tree.residual_set() {
        ResidualSet::Countable { power } => {
            (format!("like $k$^{{{power:.2}}}"), power <= LARGEST_POWER)
        }
        ResidualSet::Cantor { growth } => {
            (format!("by the factor {:.3} in a level", pxfm::f_exp(growth)), false)
        }
        ResidualSet::Undecided => ("by no clear law".to_owned(), false),
    };
    let rest: f64 = tree.lengths().iter().skip(last).sum();
    Ok(Evidence::about("in the limit the segments form a Cantor set")
        .ours(format!(
            "not in a bounded window: on humps 1 and 2 at $M$ = {M} the number of intervals of level $k$ grows \
             {found}, \
             to {} at level {last}; two preimages of each interval, as in a Cantor set, would give 2^{{{last}}}",
            counts.get(last).copied().unwrap_or(0)
        ))
        .error(format!("the levels from {last} on have the total length {rest:.0e}"))
        .how("preimages of the trap on the monotone branches that a scan shows; power law against exponential over the \
              later half of the complete levels")
        .corrected(countable))
}

/// The boundary points on the humps 1 and 2.
pub(super) fn boundary_points() -> Result<[Vec<f64>; 2], Error> {
    // The shortest part is a hundred ulps of α. Gaps shorter than ten of them are rounding.
    let refinement =
        Refinement { shortest: 1e-13, undecided: 1e-12, levels: 1_000_000, intervals: 4_000_000 };
    let fates = Fates::new(MassRatio::new(M)?)?;
    let basins = hopper_basins(&fates, 1, 3, 400, refinement)?.basins;
    let hump = |n: u64| -> Result<Vec<f64>, Error> {
        Ok(basins.within(Interval::new(alpha_star(n), alpha_star(n + 1))?)?.boundary(1e-12))
    };
    Ok([hump(1)?, hump(2)?])
}

/// Scales at which clusters are counted: neighbours in a cluster are nearer than this.
const SCALES: [f64; 4] = [1e-4, 1e-5, 1e-6, 1e-7];
/// Fewest points of a cluster. An isolated boundary point is seen as two, the ends of the gap around it; two isolated
/// points may be near each other by chance.
const FEWEST: usize = 5;
/// Generations of preimages of α*_2 on hump 2. Generation k is (3/(10λk))³ left of α*_3: 7·10⁻⁹ for the last one, which
/// is far below the finest scale.
const GENERATIONS: usize = 30;

/// The clusters of points at a scale: first and last point.
fn clusters(points: &[f64], scale: f64) -> Vec<(f64, f64)> {
    let mut found: Vec<(f64, f64, usize)> = Vec::new();
    for &point in points {
        match found.last_mut() {
            Some(last) if point - last.1 < scale => *last = (last.0, point, last.2 + 1),
            _ => found.push((point, point, 1)),
        }
    }
    found.into_iter().filter(|part| part.2 >= FEWEST).map(|part| (part.0, part.1)).collect()
}

/// α*_2 and its preimages on hump 2, generation by generation.
fn preimages(map: &impl Map) -> Result<Vec<f64>, Error> {
    let mass_ratio = MassRatio::new(M)?;
    let branches = scanned(map, mass_ratio, 2)?;
    let value = |alpha: f64| -> Result<f64, Error> { Ok(map(alpha, mass_ratio)?.unwrap_or(0.0)) };
    let on = |branch: &Branch, target: f64| -> Result<Option<f64>, Error> {
        let (mut left, mut right) = (branch.domain.left, branch.domain.right);
        let rises = branch.increases();
        if (branch.at_left >= target) == (branch.at_right >= target) {
            return Ok(None);
        }
        loop {
            let middle = 0.5 * (left + right);
            if middle <= left || middle >= right {
                return Ok(Some(right));
            }
            if (value(middle)? >= target) == rises { right = middle } else { left = middle }
        }
    };
    let star = alpha_star(2);
    let (mut all, mut last) = (vec![star], vec![star]);
    for _ in 0..GENERATIONS {
        let mut next = Vec::new();
        for &target in &last {
            for branch in &branches {
                // The branch that begins at α*_2 maps it to itself.
                next.extend(on(branch, target)?.filter(|&alpha| alpha > star + SCALES[3]));
            }
        }
        all.extend(&next);
        last = next;
    }
    Ok(all)
}

/// `points` are the boundary points on the humps 1 and 2.
pub(super) fn accumulation(map: &impl Map, points: &[Vec<f64>; 2]) -> Result<Evidence, Error> {
    let mut expected = preimages(map)?;
    expected.push(alpha_star(3));
    let (mut numbers, mut strays) = ([Vec::new(), Vec::new()], 0);
    for scale in SCALES {
        for (points, numbers) in points.iter().zip(&mut numbers) {
            let found = clusters(points, scale);
            let explained = |part: &&(f64, f64)| {
                expected.iter().any(|&alpha| part.0 - scale <= alpha && alpha <= part.1 + scale)
            };
            strays += found.len() - found.iter().filter(explained).count();
            numbers.push(found.len());
        }
    }
    let [first, second] = numbers;
    let list =
        |numbers: &[usize]| numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    // One cluster at every scale is one accumulation point, of order 1. Ever more clusters at ever finer scales, all on
    // one hump, are accumulation points that accumulate themselves: order 2.
    let order_1 = first.iter().all(|&count| count == 1);
    let order_2 = second.windows(2).all(|pair| pair[0] < pair[1]);
    Ok(Evidence::about("nested pieces at every scale")
        .ours(format!(
            "the boundary at $M$ = {M} accumulates at fixed points from the left and at their preimages: clusters of \
             boundary points at the scales 10^{{−4}} … 10^{{−7}} number {} on hump 1 (towards $α$^{{∗}}_{{2}}, order \
             1) and {} on hump 2 (preimages of $α$^{{∗}}_{{2}}, which accumulate at $α$^{{∗}}_{{3}}, order 2)",
            list(&first),
            list(&second)
        ))
        .error(format!("{strays} of {} clusters are away from these points", first.iter().chain(&second).sum::<usize>()))
        .how(format!("{} and {} boundary points to 10^{{−12}}; a cluster has {FEWEST} points or more; {} preimages by \
                      bisection on the printed map", points[0].len(), points[1].len(), expected.len() - 2))
        .corrected(order_1 && order_2 && strays == 0))
}

/// Distances from α*₂ between which hops are counted. The first hop, 1.7·10⁻¹², is a hundred times the rounding of the
/// printed map; at the last distance a hop is almost as long as the distance, and the law for small steps ends.
const LEAVING: (f64, f64) = (1e-10, 1e-5);
/// Budget of hops; the law predicts 175.
const MOST_HOPS: u32 = 1_000_000;
/// Largest relative difference from the law. The law integrates 1/(10λδ^{4/3}) over δ, and the hops are a sum: they are
/// more by half the logarithm of the last step over the first, (2/3) ln 10⁵ = 7.7 of 175 hops, or 4.4 %.
const LAW_ERROR: f64 = 0.05;

/// An orbit that leaves α*₂ to the left takes 3/(10λ) (δ₀^{−1/3} − δ₁^{−1/3}) hops from δ₀ to δ₁.
pub(super) fn leaving(map: &impl Map, left_factor: f64) -> Result<Evidence, Error> {
    let mass_ratio = MassRatio::new(M)?;
    let star = FixedPointSpeed::new(2);
    let lambda = Coefficients::new(2, mass_ratio, Form::Corrected)?.lambda;
    let (from, to) = LEAVING;
    let mut alpha = star.value() - from;
    let mut hops = 0u32;
    while star.offset_of(alpha) > -to && hops < MOST_HOPS {
        alpha = map(alpha, mass_ratio)?.unwrap_or(0.0);
        hops += 1;
    }
    let predicted =
        3.0 / (left_factor * lambda) * (1.0 / pxfm::f_cbrt(from) - 1.0 / pxfm::f_cbrt(to));
    let ratio = f64::from(hops) / predicted;
    Ok(Evidence::about("nested pieces at every scale")
        .ours(format!("the $k$-th piece left of $α$^{{∗}}_{{n}} is at the distance (3/({left_factor}$λk$))^{{3}}: \
                       leaving $α$^{{∗}}_{{2}} from 10^{{−10}} to 10^{{−5}} takes {hops} hops, predicted \
                       {predicted:.0}"))
        .error(format!("{:.1} %; the law for small steps allows {:.0} %", 100.0 * (ratio - 1.0), 100.0 * LAW_ERROR))
        .how(format!("$M$ = {M}, the printed map iterated"))
        .corrected((ratio - 1.0).abs() < LAW_ERROR))
}

/// The hypotheses of the theorem, at one mass ratio: f(α) ≤ α with equality at fixed points only, and M ≤ M₁.
pub(super) fn countable(map: &impl Map, m: f64) -> Result<Evidence, Error> {
    let mass_ratio = MassRatio::new(m)?;
    let (mut probes, mut rising, mut margins) = (0, 0, Vec::new());
    for n in 1..=4 {
        let star = FixedPointSpeed::new(n);
        for exponent in 1..=8 {
            for side in [1.0, -1.0] {
                let alpha = star.value() + side * pxfm::f_exp10(-f64::from(exponent));
                // A grounded hopper has no next speed: it does not rise.
                let loss = alpha - map(alpha, mass_ratio)?.unwrap_or(0.0);
                let rounding = 0.5 * printed_rounding(alpha) * alpha;
                margins.push(rounding / loss);
                probes += 1;
                rising += usize::from(!(loss > rounding));
            }
        }
    }
    Ok(Evidence::about("in the limit the segments form a Cantor set")
        .ours("a theorem for $M$ ≤ 0.9056: $f$($α$) < $α$ except at the fixed points, so that no other orbit returns; \
               each level has finitely many ends in a bounded window, and the boundary is their countable closed \
               union. A countable set contains no Cantor set")
        .error(format!("{rising} of {probes} probes of $f$($α$) < $α$ fail; rounding is at most {:.0e} of the loss", largest(margins)))
        .how(format!("the theorem's conditions at $M$ = {m}: the printed map at 10^{{−1}} … 10^{{−8}} on either side \
                      of the first four fixed points. A computation cannot show more"))
        .holds(rising == 0 && m <= ONE_SUDDEN))
}
