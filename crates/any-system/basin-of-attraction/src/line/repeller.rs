//! The Cantor set that remains of an expanding map with several branches: its dimension, and how fast other points leave.

use crate::error::Error;
use crate::line::full_branches::{check, refused};
use crate::line::transfer_operator::{Numbers, Operator};
use crate::space::interval::Interval;

/// The invariant set of an expanding map of the line whose branches each lead onto a whole interval: the points that never leave the
/// branches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repeller {
    /// Its dimension: Hausdorff's and that of boxes are the same.
    pub dimension: f64,
    /// The rate γ at which points leave: of equally distributed ones e^(−γn) are left after n steps. 0 if none leaves.
    pub escape_rate: f64,
    /// How far both may be off: what more nodes change, and rounding. It is small for branches with smooth slopes.
    pub error: f64,
}

/// Numbers of nodes that are tried, one after the other: for analytic branches a dozen gives ten digits.
const NODES: [usize; 6] = [8, 12, 18, 27, 40, 60];

/// More nodes are not tried if they change the dimension less than this.
const SURE: f64 = 1e-14;

/// The invariant set of a map with `branches` branches onto an interval. `inverse` gives for a branch, by its number, and a point of
/// the interval the preimage on this branch and the size of its slope there, that of the inverse branch.
///
/// The dimension is the s at which the largest eigenvalue of (Lₛφ)(x) = Σ |gₖ′(x)|ˢ φ(gₖ(x)) is 1 (R. Bowen, 1979), and the escape rate is
/// −ln of the eigenvalue at s = 1. The operator is computed at Chebyshev nodes, until neither of two larger numbers of them changes both.
///
/// ```
/// use basin_of_attraction::{Interval, repeller};
/// // Numbers with the continued fraction digits 1 and 2: x = 1/(k + y).
/// let unit = Interval::new(0.0, 1.0)?;
/// let found = repeller(2, unit, |k, y| {
///     let x = 1.0 / (k as f64 + 1.0 + y);
///     (x, x * x)
/// })?;
/// assert!((found.dimension - 0.531_280_506_277_205_1).abs() < 1e-13);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadSearch`] for no branch, for preimages outside of the interval, for branches that overlap, and for slopes that are not positive or do
/// not contract.
pub fn repeller(
    branches: usize,
    interval: Interval,
    inverse: impl Fn(usize, f64) -> (f64, f64),
) -> Result<Repeller, Error> {
    let image = |k: usize| {
        let ends = [inverse(k, interval.left).0, inverse(k, interval.right).0];
        [ends[0].min(ends[1]), ends[0].max(ends[1])]
    };
    check(branches, interval, &image)?;
    let mut before: Option<Numbers> = None;
    let mut failed = None;
    // The last two changes: one alone may be small by chance.
    let mut changes = [f64::INFINITY; 2];
    for nodes in NODES {
        // Few nodes may give an operator without a positive function.
        let found = match Operator::new(branches, interval, &inverse, nodes)?.numbers() {
            Ok(found) => found,
            Err(error) => {
                failed = Some(error);
                continue;
            }
        };
        let change = before.map_or(f64::INFINITY, |before| {
            let of_dimension = (found.dimension - before.dimension).abs();
            of_dimension.max((found.escape_rate - before.escape_rate).abs())
        });
        changes = [changes[1], change];
        before = Some(found);
        if changes[0].max(changes[1]) <= found.error.max(SURE) {
            break;
        }
    }
    match (before, failed) {
        (Some(Numbers { dimension, escape_rate, error }), _) => {
            Ok(Repeller { dimension, escape_rate, error: error + changes[0].max(changes[1]) })
        }
        (None, Some(error)) => Err(error),
        (None, None) => Err(refused("a number of nodes", 0.0, "")),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::disallowed_methods)] // a test: bits do not matter

    use super::*;
    use interval_arithmetic::bracketed_root;
    use proptest::prelude::*;

    fn unit() -> Interval {
        Interval::new(0.0, 1.0).unwrap()
    }

    /// The tent map of slope 3, whose points above 1 leave.
    #[test]
    fn the_middle_thirds() {
        let found =
            repeller(2, unit(), |k, y| (if k == 0 { y / 3.0 } else { 1.0 - y / 3.0 }, 1.0 / 3.0))
                .unwrap();
        assert!((found.dimension - 2f64.ln() / 3f64.ln()).abs() <= found.error);
        assert!((found.escape_rate - 1.5f64.ln()).abs() <= found.error && found.error < 1e-13);
    }

    /// The logistic map at r = 5, against bounds from the slopes of all words of length n: Σ max|g′|ˢ ≥ 1 ≥ Σ min|g′|ˢ.
    #[test]
    fn the_logistic_map_that_leaves() {
        let r = 5.0f64;
        let inverse = |k: usize, y: f64| {
            let root = (1.0 - 4.0 * y / r).sqrt();
            (0.5 * (1.0 + if k == 0 { -root } else { root }), 1.0 / (r * root))
        };
        let found = repeller(2, unit(), inverse).unwrap();
        assert!(found.error < 1e-11, "{found:?}");
        // The slope of a word is monotone on the interval: its ends are its bounds, within the distortion.
        let n = 14;
        let sums = |s: f64| {
            let (mut low, mut high) = (0.0, 0.0);
            for word in 0..1usize << n {
                let along = |start: f64| {
                    (0..n).fold((start, 1.0), |(y, slope), bit| {
                        let (x, own) = inverse(word >> bit & 1, y);
                        (x, slope * own)
                    })
                };
                let slopes = [0.0, 0.25, 0.5, 0.75, 1.0].map(|y| along(y).1);
                low += slopes.iter().fold(f64::INFINITY, |a: f64, b| a.min(*b)).powf(s);
                high += slopes.iter().fold(0.0f64, |a, b| a.max(*b)).powf(s);
            }
            (low, high)
        };
        let (low, high) = sums(found.dimension);
        assert!(low < 1.0 && 1.0 < high && high / low < 3.0, "{low} {high} {found:?}");
        let (low, high) = sums(1.0);
        let rate = |sum: f64| -sum.ln() / n as f64;
        assert!(rate(high) < found.escape_rate && found.escape_rate < rate(low), "{found:?}");
    }

    proptest! {
        /// Affine branches: Moran's equation Σ rₖˢ = 1, and the escape rate −ln Σ rₖ.
        #[test]
        fn affine_branches(parts in proptest::collection::vec(0.05..1.0f64, 2..6), left in -5.0..5.0f64, width in 0.1..10.0f64) {
            let gaps = 1.3 * parts.iter().sum::<f64>();
            let ratios: Vec<f64> = parts.iter().map(|part| part / gaps).collect();
            let interval = Interval::new(left, left + width).unwrap();
            let step = (1.0 - ratios.iter().sum::<f64>()) / (ratios.len() - 1) as f64;
            let begin = |k: usize| ratios[..k].iter().sum::<f64>() + step * k as f64;
            let found = repeller(ratios.len(), interval, |k, y| {
                (left + width * begin(k) + ratios[k] * (y - left), ratios[k])
            }).unwrap();
            let sum: f64 = ratios.iter().map(|ratio| ratio.powf(found.dimension)).sum();
            prop_assert!((sum - 1.0).abs() < 1e-12, "{:?}", found);
            let rate = -ratios.iter().sum::<f64>().ln();
            prop_assert!((found.escape_rate - rate).abs() < 1e-12, "{:?} {}", found, rate);
        }
    }

    /// Slopes that vary with T₈T₁₂, which is 0 at the nodes of both numbers: two numbers of nodes may agree by chance.
    #[test]
    fn slopes_that_are_the_same_at_two_numbers_of_nodes() {
        let polynomial = |n: i32, x: f64| (f64::from(n) * x.clamp(-1.0, 1.0).acos()).cos();
        let integral = |n: i32, x: f64| {
            let by = |n: i32| polynomial(n, x) / f64::from(n);
            0.5 * (by(n + 1) - by(n - 1))
        };
        let both = |x: f64| 0.5 * (integral(20, x) + integral(4, x));
        let slope = |y: f64| {
            let x = 2.0 * y - 1.0;
            0.3 + 0.25 * polynomial(8, x) * polynomial(12, x)
        };
        let branch = |y: f64| 0.3 * y + 0.125 * (both(2.0 * y - 1.0) - both(-1.0));
        let found = repeller(2, unit(), |k, y| {
            (if k == 0 { branch(y) } else { 1.0 - branch(y) }, slope(y))
        });
        // By bounds with enclosures of 15 letters.
        let found = found.unwrap();
        assert!((found.dimension - 0.4802).abs() < 0.0005 + found.error, "{found:?}");
        assert!((found.escape_rate - 0.558).abs() < 0.001 + found.error, "{found:?}");
    }

    /// Affine branches beside a slope near 1, also in coordinates in which they are no more affine: rounding moves the root far.
    #[test]
    fn slopes_near_one() {
        for (ratios, c) in [
            ([1.0 / 1.0001, 5e-5], 0.0),
            ([1.0 / 1.001, 5e-4], 0.3),
            ([1e-4, 1e-4], 20.0),
            ([1e-5, 1e-5], 100.0),
        ] {
            let found = repeller(2, unit(), |k, y| {
                let below = 1.0 + c - c * y;
                let u = y / below;
                let v = if k == 0 { ratios[0] * u } else { 1.0 - ratios[1] * (1.0 - u) };
                let above = 1.0 + c * v;
                let slope = ratios[k] * (1.0 + c) / (below * below) * (1.0 + c) / (above * above);
                ((1.0 + c) * v / above, slope)
            });
            let found = found.unwrap();
            let sum = |s: f64| ratios.iter().map(|ratio| ratio.powf(s)).sum::<f64>() - 1.0;
            let dimension = bracketed_root(sum, 0.0, 1.0).unwrap();
            assert!(
                (found.dimension - dimension).abs() <= found.error,
                "{c} {found:?} {dimension}"
            );
            let rate = -ratios.iter().sum::<f64>().ln();
            assert!((found.escape_rate - rate).abs() <= found.error, "{c} {found:?} {rate}");
            assert!(found.error < 1e-9 || c > 1.0, "{found:?}");
        }
    }

    #[test]
    fn the_ends_of_dimensions_and_bad_input() {
        let point = repeller(1, unit(), |_, y| (0.25 + 0.5 * y, 0.5)).unwrap();
        assert_eq!(point.dimension, 0.0);
        let full = repeller(2, unit(), |k, y| (0.5 * (k as f64 + y), 0.5)).unwrap();
        assert!((full.dimension - 1.0).abs() < 1e-13 && full.escape_rate < 1e-13, "{full:?}");
        let bad = |found: Result<Repeller, Error>| matches!(found, Err(Error::BadSearch { .. }));
        assert!(bad(repeller(0, unit(), |_, y| (y, 0.5))));
        assert!(bad(repeller(2, unit(), |_, y| (0.5 * y, 0.5))));
        assert!(bad(repeller(1, unit(), |_, y| (2.0 * y, 2.0))));
        assert!(bad(repeller(1, unit(), |_, y| (y, 1.0))));
        assert!(bad(repeller(1, unit(), |_, y| (0.5 * y, f64::NAN))));
        assert!(bad(repeller(1, unit(), |_, _| (f64::NAN, 0.5))));
    }
}
