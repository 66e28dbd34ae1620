//! The Cantor set that remains of an expanding map with several branches: its dimension, and how fast other points leave.

use crate::error::Error;
use crate::space::interval::Interval;
use interval_arithmetic::bracketed_root;

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

/// Steps of the power method. The second eigenvalue is smaller by the contraction of the branches: a hundred are usual.
const MOST_STEPS: usize = 20_000;

/// An eigenvalue that changes less than this in a step is found: the sums of sixty values round so much.
const SAME: f64 = 4.0 * f64::EPSILON;

/// Images may overlap by this part of the interval: branches that touch do so to rounding.
const TOUCH: f64 = 1e-12;

/// The invariant set of a map with `branches` branches onto an interval. `inverse` gives for a branch, by its number, and a point of
/// the interval the preimage on this branch and the size of its slope there, that of the inverse branch.
///
/// The dimension is the s at which the largest eigenvalue of (Lₛφ)(x) = Σ |gₖ′(x)|ˢ φ(gₖ(x)) is 1 (R. Bowen, 1979), and the escape rate is
/// −ln of the eigenvalue at s = 1. The operator is computed at Chebyshev nodes.
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
    check(branches, interval, &inverse)?;
    let mut before: Option<[f64; 2]> = None;
    let mut error = f64::INFINITY;
    for nodes in NODES {
        let operator = Operator::new(branches, interval, &inverse, nodes)?;
        let dimension = operator.dimension()?;
        let found = [dimension, -pxfm::f_log(operator.eigenvalue(1.0)?)];
        if let Some(before) = before {
            error = (found[0] - before[0]).abs().max((found[1] - before[1]).abs());
        }
        before = Some(found);
        if error <= SURE {
            break;
        }
    }
    let [dimension, escape_rate] = before.unwrap_or([f64::NAN; 2]);
    // The eigenvalue of branches that fill the interval is 1 to rounding.
    let escape_rate = escape_rate.max(0.0);
    Ok(Repeller { dimension, escape_rate, error: error + 8.0 * f64::EPSILON })
}

pub(crate) fn refused(name: &'static str, value: f64, remedy: &'static str) -> Error {
    Error::BadSearch { name, value, remedy }
}

/// Tests the ends of the images, in any order of the branches.
pub(crate) fn check(
    branches: usize,
    interval: Interval,
    inverse: &impl Fn(usize, f64) -> (f64, f64),
) -> Result<(), Error> {
    if branches == 0 {
        return Err(refused("a number of branches", 0.0, ""));
    }
    let (left, right) = (interval.left, interval.right);
    let width = right - left;
    if !(width > 0.0) {
        return Err(refused("the width of an interval", width, ""));
    }
    let mut images: Vec<[f64; 2]> = (0..branches)
        .map(|k| {
            let ends = [inverse(k, left).0, inverse(k, right).0];
            [ends[0].min(ends[1]), ends[0].max(ends[1])]
        })
        .collect();
    images.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let slack = TOUCH * width;
    for image in &images {
        let outside = (left - image[0]).max(image[1] - right);
        if !(outside <= slack) {
            let remedy = ": a preimage is so far outside of the interval";
            return Err(refused("a distance", outside, remedy));
        }
    }
    for pair in images.windows(2) {
        let overlap = pair[0][1] - pair[1][0];
        if !(overlap <= slack) {
            return Err(refused("the overlap of two branches", overlap, ": they must be disjoint"));
        }
    }
    Ok(())
}

/// The transfer operator at some nodes.
struct Operator {
    /// For each node and branch the slope there.
    slopes: Vec<Vec<f64>>,
    /// For each node and branch the weights of the nodes at the preimage.
    weights: Vec<Vec<Vec<f64>>>,
}

impl Operator {
    fn new(
        branches: usize,
        interval: Interval,
        inverse: &impl Fn(usize, f64) -> (f64, f64),
        nodes: usize,
    ) -> Result<Operator, Error> {
        let middle = 0.5 * (interval.left + interval.right);
        let half = 0.5 * (interval.right - interval.left);
        let place = |j: usize| pxfm::f_cospi((j as f64 + 0.5) / nodes as f64);
        let (mut slopes, mut weights) = (Vec::new(), Vec::new());
        for j in 0..nodes {
            let x = middle + half * place(j);
            let (mut own_slopes, mut own_weights) = (Vec::new(), Vec::new());
            for k in 0..branches {
                let (preimage, slope) = inverse(k, x);
                if !(slope > 0.0 && slope.is_finite() && preimage.is_finite()) {
                    return Err(refused("the slope of an inverse branch", slope, ""));
                }
                own_slopes.push(slope);
                own_weights.push(interpolation((preimage - middle) / half, nodes));
            }
            slopes.push(own_slopes);
            weights.push(own_weights);
        }
        Ok(Operator { slopes, weights })
    }

    /// The largest eigenvalue at s, by the power method from the constant function.
    fn eigenvalue(&self, s: f64) -> Result<f64, Error> {
        let count = self.slopes.len();
        let rows: Vec<Vec<f64>> = (0..count)
            .map(|j| {
                let mut row = vec![0.0; count];
                for (slope, weights) in self.slopes[j].iter().zip(&self.weights[j]) {
                    let factor = pxfm::f_pow(*slope, s);
                    row.iter_mut().zip(weights).for_each(|(sum, w)| *sum += factor * w);
                }
                row
            })
            .collect();
        let mut function = vec![1.0; count];
        let mut before = f64::NAN;
        for _ in 0..MOST_STEPS {
            let image: Vec<f64> = rows
                .iter()
                .map(|row| row.iter().zip(&function).map(|(a, b)| a * b).sum::<f64>())
                .collect();
            // The functions are positive: the sum of the values grows as the eigenvalue.
            let value = image.iter().sum::<f64>() / function.iter().sum::<f64>();
            if (value - before).abs() <= SAME * value.abs() {
                return Ok(value);
            }
            let largest = image.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            function = image.into_iter().map(|x| x / largest).collect();
            before = value;
        }
        let remedy = ": the power method does not end; the branches do not contract";
        Err(refused("an eigenvalue", before, remedy))
    }

    /// The s at which the eigenvalue is 1.
    fn dimension(&self) -> Result<f64, Error> {
        let largest = self.slopes.iter().flatten().fold(0.0, |most: f64, slope| most.max(*slope));
        if !(largest < 1.0) && !(self.eigenvalue(1.0)? < 1.0) {
            let remedy = ": inverse branches must contract";
            return Err(refused("the largest slope of inverse branches", largest, remedy));
        }
        let failed = std::cell::RefCell::new(None);
        let off = |s: f64| match self.eigenvalue(s) {
            Ok(value) => pxfm::f_log(value),
            Err(error) => {
                *failed.borrow_mut() = Some(error);
                f64::NAN
            }
        };
        let (at_zero, at_one) = (off(0.0), off(1.0));
        if let Some(error) = failed.borrow_mut().take() {
            return Err(error);
        }
        // One branch has one point; branches that fill the interval leave nothing out.
        if at_zero <= 0.0 {
            return Ok(0.0);
        }
        if at_one >= 0.0 {
            return Ok(1.0);
        }
        let root = bracketed_root(off, 0.0, 1.0);
        let none = || refused("an eigenvalue", at_one, ": it is 1 nowhere");
        failed.into_inner().map_or_else(|| root.map_err(|_| none()), Err)
    }
}

/// The weights of the values at Chebyshev nodes at a place in [−1, 1].
fn interpolation(place: f64, nodes: usize) -> Vec<f64> {
    // Of the barycentric formula.
    let node = |j: usize| pxfm::f_cospi((j as f64 + 0.5) / nodes as f64);
    let sign = |j: usize| if j.is_multiple_of(2) { 1.0 } else { -1.0 };
    let own = (0..nodes).find(|&j| place == node(j));
    let mut weights: Vec<f64> = (0..nodes)
        .map(|j| match own {
            Some(own) => f64::from(own == j),
            None => sign(j) * pxfm::f_sinpi((j as f64 + 0.5) / nodes as f64) / (place - node(j)),
        })
        .collect();
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= sum);
    weights
}

#[cfg(test)]
mod tests {
    #![allow(clippy::disallowed_methods)] // a test: bits do not matter

    use super::*;
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
