//! The claim about the dimension of the boundary: its box count left of α*_2 against the law of docs/theory.md,
//! Theorem 45.

use super::boundary::M;
use super::claim::{Check, Evidence, Ground};
use crate::error::Error;
use basin_of_attraction::{Interval, IntervalBasins, Refinement, occupied_boxes};
use hopper_asymptotics::{Coefficients, Form, LEFT_FACTOR};
use hopper_basin::{Fates, hopper_basins};
use interval_arithmetic::bracketed_root;
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};

pub(super) const CHECKS: &[Check] = &[Check {
    name: "the dimension of the boundary",
    place: "Sec. VI A",
    ground: Ground::Test {
        test: "box counts of computed preimages of boundary points, against the constant of the law",
        proof: Some("Theorem 45"),
    },
    evidence: || {
        let map = LiftOffMap::new(MassRatio::new(M)?);
        let hop = |distance: f64| {
            let next = map.hop_near_fixed_point(N, -distance)?.next;
            Ok(next.map_or(f64::INFINITY, |next| -next))
        };
        boundary_boxes(&hop, LEFT_FACTOR, &humps(1, 4)?)
    },
}];

/// The fixed point at which boxes are counted.
const N: u64 = 2;
/// Box sizes. At the finer one the law must hold to [`LAW_ERROR`].
const SIZES: [f64; 2] = [1e-12, 1e-16];
/// Generations of preimages. A copy of number k has gaps of 1.7·10⁻³k⁻⁴: from number 2000 on they are shorter than the
/// finest box.
const GENERATIONS: usize = 4000;
/// Largest relative difference from the law at the finer size. The k-th copy is at (3/(10λ(k + O(ln k))))³, and k ≈
/// 2000 counts: 3 ln k/k is about 1 %.
const LAW_ERROR: f64 = 0.02;
/// Boundary points nearer than this are the two ends of the gap around one point.
const SAME_POINT: f64 = 1e-9;
/// The largest distance from α*_2 of the boundary points whose preimages are followed. It is a part of hump 1 on which
/// the map rises.
const FIRST: f64 = 0.3;

/// The basins on the humps `from` to `to` − 1, to a hundred ulps.
fn humps(from: u64, to: u64) -> Result<IntervalBasins, Error> {
    let refinement =
        Refinement { shortest: 1e-13, undecided: 1e-12, levels: 1_000_000, intervals: 4_000_000 };
    Ok(hopper_basins(&Fates::new(MassRatio::new(M)?)?, from, to, 400, refinement)?.basins)
}

/// The basins on hump 1 alone.
#[cfg(test)]
pub(super) fn first_hump() -> Result<IntervalBasins, Error> {
    humps(1, 2)
}

fn hump(basins: &IntervalBasins, n: u64) -> Result<Vec<f64>, Error> {
    // Gaps of ten of the shortest parts are rounding.
    Ok(basins.within(Interval::new(alpha_star(n), alpha_star(n + 1))?)?.boundary(1e-12))
}

/// A point and its preimages on the left of α*_2, as distances from it.
fn backward_orbit(hop: &impl Fn(f64) -> Result<f64, Error>, first: f64) -> Result<Vec<f64>, Error> {
    let mut orbit = vec![first];
    let mut distance = first;
    for _ in 0..GENERATIONS {
        // A hop leads away from α*_2. So the preimage is nearer, and not nearer than a hundredth of the distance:
        // the loss at a distance δ < 0.3 is less than 100 δ.
        let excess = |near: f64| hop(near).unwrap_or(f64::NAN) - distance;
        distance = bracketed_root(excess, 0.01 * distance, distance)?;
        orbit.push(distance);
    }
    Ok(orbit)
}

/// The mean number of boxes of this size that meet the points and α*_2, over all positions of the grid
/// (docs/theory.md, Lemma 44). `distances` run towards α*_2. The gaps nearer than the last are shorter than the box.
fn mean_boxes(distances: &[f64], size: f64) -> f64 {
    let gaps = distances.windows(2).map(|pair| ((pair[0] - pair[1]) / size).min(1.0));
    let rest = distances.last().map_or(0.0, |last| last / size);
    1.0 + gaps.sum::<f64>() + rest
}

/// `hop` maps a distance left of α*_2 to the next one; `left_factor` is the 10 of 10λ; `basins` begin with hump 1.
pub(super) fn boundary_boxes(
    hop: &impl Fn(f64) -> Result<f64, Error>,
    left_factor: f64,
    basins: &IntervalBasins,
) -> Result<Evidence, Error> {
    let lambda = Coefficients::new(N, MassRatio::new(M)?, Form::Corrected)?.lambda;
    // 4 (10λ)^{−3/4}: the constant of one backward orbit.
    let constant = 4.0 * pxfm::f_pow(left_factor * lambda, -0.75);
    // The boundary points in one fundamental domain: from the farthest one up to its preimage.
    let mut starts: Vec<f64> = hump(basins, 1)?.iter().map(|point| alpha_star(N) - point).collect();
    starts.retain(|&distance| distance < FIRST);
    starts.dedup_by(|a, b| (*a - *b).abs() < SAME_POINT);
    let orbit = backward_orbit(hop, starts.first().copied().unwrap_or(FIRST))?;
    starts.retain(|&distance| distance > orbit[1] + SAME_POINT);
    let mut all = Vec::new();
    for &start in &starts {
        all.push(backward_orbit(hop, start)?);
    }
    // The parts θ_j of the gaps in the last copy of the domain.
    let mut last: Vec<f64> = all.iter().map(|orbit| orbit[GENERATIONS - 1]).collect();
    last.push(all.first().map_or(f64::NAN, |orbit| orbit[GENERATIONS]));
    let length = last[0] - last[last.len() - 1];
    let weight: f64 =
        last.windows(2).map(|pair| pxfm::f_pow((pair[0] - pair[1]) / length, 0.25)).sum();
    let mut points = all.concat();
    points.sort_by(|a, b| b.total_cmp(a));
    let scaled =
        |points: &[f64]| SIZES.map(|size| mean_boxes(points, size) * pxfm::f_pow(size, 0.25));
    let (single, whole) = (scaled(&orbit), scaled(&points));
    let errors = |found: [f64; 2], law: f64| found.map(|found| (found / law - 1.0).abs());
    let (single_errors, whole_errors) =
        (errors(single, constant), errors(whole, constant * weight));
    let converges = |errors: [f64; 2]| errors[1] < LAW_ERROR && errors[1] < errors[0];
    Ok(Evidence::about("the basin is a Cantor-like set, nested and finer at every scale")
        .ours(format!(
            "left of $α$^{{∗}}_{{2}} at $M$ = {M} the boxes of size $ε$ = 10^{{−16}} number {:.5} $ε$^{{−1/4}} for one \
             backward orbit (law: 4 ({left_factor}$λ$)^{{−3/4}} = {constant:.5}) and {:.5} $ε$^{{−1/4}} for the whole \
             boundary, which is {} such orbits (law: {:.5}): dimension 1/4. Whole humps have the local slopes {} at \
             10^{{−9.5}}; they tend to 1/4 by Corollary 90, on the condition of Theorem 46",
            single[1],
            whole[1],
            starts.len(),
            constant * weight,
            slopes(basins)?
        ))
        .error(format!(
            "one orbit {:.2} % ({:.1} % at $ε$ = 10^{{−12}}), the whole boundary {:.2} % ({:.1} %)",
            100.0 * single_errors[1],
            100.0 * single_errors[0],
            100.0 * whole_errors[1],
            100.0 * whole_errors[0]
        ))
        .how(format!("{GENERATIONS} preimages of each boundary point of a fundamental domain, by root search; mean \
                      number of boxes over all positions of the grid; $θ$_{{j}} from the gaps of the last copy"))
        .corrected(!starts.is_empty() && converges(single_errors) && converges(whole_errors)))
}

/// The local slopes of the box counts of whole humps between 10⁻¹⁰ and 10⁻⁹.
fn slopes(basins: &IntervalBasins) -> Result<String, Error> {
    let mut list = Vec::new();
    for n in 1.. {
        if alpha_star(n + 1) > basins.window().right {
            break;
        }
        let points = hump(basins, n)?;
        let boxes = |size: f64| -> Result<f64, Error> {
            Ok(occupied_boxes(&points, alpha_star(n), size)? as f64)
        };
        list.push(format!("{:.3} (hump {n})", pxfm::f_log10(boxes(1e-10)? / boxes(1e-9)?)));
    }
    Ok(list.join(", "))
}
