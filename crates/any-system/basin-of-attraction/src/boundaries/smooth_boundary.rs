//! Is a boundary smooth at one scale? The mean entropy of random balls on it, compared with that of a smooth boundary.
//!
//! A. Puy, A. Daza, A. Wagemakers, M. A. F. Sanjuán (2021), "A test for fractal boundaries based on the basin
//! entropy". A smooth boundary cuts a small ball in two by a plane. A ball whose middle is uniform in space, if it
//! meets the plane, has it at a uniform distance t ∈ (−1, 1) radii from its middle. The part of a ball of D
//! dimensions beyond t is
//!
//! ```text
//!   p(t) = ∫ₜ¹ (1 − s²)^((D−1)/2) ds / ∫₋₁¹ (1 − s²)^((D−1)/2) ds,        S = ½ ∫₋₁¹ H(p(t)) dt,   H(p) = −p ln p − (1−p) ln (1−p)
//! ```
//!
//! so that S = 0.5, 0.4395, 0.3961 for D = 1, 2, 3. A boundary that is folded inside the balls has another mean.
//!
//! The fractions of a ball are measured by n random points. With them an entropy is too small, and a ball that the
//! plane barely touches looks undivided. Puy et al. allow for this by a fitted term. Here the reference itself is
//! that of n points:
//!
//! ```text
//!   Sₙ = ∫ Σ_{0<k<n} B(k; n, p(t)) H(k/n) dt / ∫ Σ_{0<k<n} B(k; n, p(t)) dt,        B: binomial
//! ```

use crate::boundaries::entropy::entropy;
use crate::boundaries::region_uncertainty::random_direction;
use crate::error::Error;
use crate::shares::sampling::check_count;
use crate::space::hyperrectangle::Hyperrectangle;
use crate::space::interval::Interval;
use crate::space::label::Label;
use crate::statistics::confidence_interval::{ConfidenceInterval, student_interval};
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Random balls at which a labelling is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RandomBalls {
    /// The radius, in the unit of the region.
    pub radius: f64,
    /// The number of balls.
    pub balls: usize,
    /// The number of random points in each ball.
    pub points: usize,
    /// The seed of the middles and of the points.
    pub seed: u64,
}

/// The entropies of random balls on a boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallEntropy {
    /// The mean entropy of the balls with more than one basin, with Student's 95 % interval.
    pub mean: ConfidenceInterval,
    /// The mean that a smooth boundary has with as many points in a ball.
    pub smooth: f64,
    /// Balls with more than one basin.
    pub mixed: usize,
    /// Balls that were left out, because a point of them is undecided or outside the region of interest.
    pub left_out: usize,
}

/// What random balls of one radius say about a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundaryShape {
    /// The mean entropy is that of a smooth boundary, within its interval. A fractal boundary may have nearly the
    /// same: the Cantor basin of two colours on the line has 0.510 ± 0.008 with 1600 mixed balls, where a smooth
    /// boundary has 0.505.
    LooksSmooth,
    /// The mean entropy differs from that of a smooth boundary. The boundary is folded, or several boundaries lie
    /// close together, at the scale of the balls. It is fractal only if this holds at every smaller radius too:
    /// smooth stripes that are thinner than a ball have this shape.
    NotSmooth,
}

impl BallEntropy {
    /// The shape of the boundary at the scale of the balls. A smooth boundary is called not smooth in 5 % of the
    /// samples.
    pub fn shape(&self) -> BoundaryShape {
        if self.mean.covers(self.smooth) {
            BoundaryShape::LooksSmooth
        } else {
            BoundaryShape::NotSmooth
        }
    }
}

/// Student's interval needs means that are nearly normal. Entropies lie between 0 and ln of the number of basins,
/// and are skewed; the mean of thirty is normal enough for 93 %.
const FEWEST_MIXED_BALLS: usize = 30;

/// The mean entropy of random balls that lie in a region of any dimension, and meet a boundary.
///
/// The middles are uniform in the part of the region that is a radius away from its sides. Radii should be much
/// smaller than the radius of curvature of the boundary, and than the distance between its parts. If they are, half
/// of the radius gives the same.
///
/// ```
/// use basin_of_attraction::{BoundaryShape, Hyperrectangle, Interval, Label, RandomBalls, ball_entropy};
/// // The unit circle is smooth, and looks smooth with balls of a hundredth.
/// let disc = |x: &[f64]| Label::from(x[0] * x[0] + x[1] * x[1] < 1.0);
/// let square = Hyperrectangle::new(vec![Interval::new(-2.0, 2.0)?; 2])?;
/// let balls = RandomBalls { radius: 0.01, balls: 20_000, points: 100, seed: 1 };
/// assert_eq!(ball_entropy(&square, balls, disc)?.shape(), BoundaryShape::LooksSmooth);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadBalls`] for a radius that is not positive or leaves no place for a ball, and fewer than two points in
/// a ball; [`Error::TooManySamples`] for more than a billion points in all; [`Error::TooFewMixedBalls`] if fewer
/// than 30 balls have more than one basin.
pub fn ball_entropy(
    region: &Hyperrectangle,
    balls: RandomBalls,
    label: impl Fn(&[f64]) -> Label + Sync,
) -> Result<BallEntropy, Error> {
    let RandomBalls { radius, balls: count, points, seed } = balls;
    let narrowest = region.sides().iter().map(Interval::length).fold(f64::INFINITY, f64::min);
    if points < 2 || !(radius > 0.0 && 2.0 * radius < narrowest) {
        return Err(Error::BadBalls { radius, narrowest, points });
    }
    check_count(count.saturating_mul(points))?;
    let inner = |side: &Interval| Interval::new(side.left + radius, side.right - radius);
    let middles = Hyperrectangle::new(region.sides().iter().map(inner).collect::<Result<_, _>>()?)?;
    let (places, seeds) = (SplitMix64::from_seed(seed), SplitMix64::from_seed(!seed));
    let of_ball = |ball: usize| {
        let middle = middles.random_point(&places, ball as u64);
        let own = SplitMix64::from_seed(seeds.bits(ball as u64));
        entropy_of_ball(&middle, radius, points, &own, &label)
    };
    let entropies: Vec<Option<f64>> = (0..count).into_par_iter().map(of_ball).collect();
    let left_out = entropies.iter().filter(|entropy| entropy.is_none()).count();
    let mixed: Vec<f64> =
        entropies.into_iter().flatten().filter(|entropy| *entropy > 0.0).collect();
    if mixed.len() < FEWEST_MIXED_BALLS {
        let fewest = FEWEST_MIXED_BALLS;
        return Err(Error::TooFewMixedBalls { mixed: mixed.len(), balls: count, fewest });
    }
    let smooth = smooth_entropy_of_points(region.dimension(), points);
    Ok(BallEntropy { mean: student_interval(&mixed)?, smooth, mixed: mixed.len(), left_out })
}

/// The entropy of the basins in one ball; `None` if a point is in no basin.
fn entropy_of_ball(
    middle: &[f64],
    radius: f64,
    points: usize,
    random: &SplitMix64,
    label: &impl Fn(&[f64]) -> Label,
) -> Option<f64> {
    let dimension = middle.len();
    let directions = SplitMix64::from_seed(random.bits(0));
    let mut counts: BTreeMap<Label, usize> = BTreeMap::new();
    for number in 1..=points as u64 {
        // The volume within a distance grows with its power D: that power is uniform.
        let distance = radius * pxfm::f_pow(random.uniform(number), 1.0 / dimension as f64);
        let mut at = random_direction(&directions, number, dimension);
        at.iter_mut().zip(middle).for_each(|(x, middle)| *x = middle + distance * *x);
        let label = label(&at);
        if !label.is_decided() {
            return None;
        }
        *counts.entry(label).or_insert(0) += 1;
    }
    Some(entropy(counts.values().map(|&found| found as f64 / points as f64)))
}

/// The boundary entropy of a ball that a smooth boundary cuts, in this number of dimensions: 1/2, 0.4395, 0.3961, …
/// (Puy et al. 2021). It is 0 for no dimensions.
///
/// ```
/// use basin_of_attraction::smooth_boundary_entropy;
/// assert!((smooth_boundary_entropy(2) - 0.439_509_330_638).abs() < 1e-10);
/// ```
pub fn smooth_boundary_entropy(dimensions: usize) -> f64 {
    if dimensions == 0 {
        return 0.0;
    }
    0.5 * cuts(dimensions)
        .into_iter()
        .map(|(part, weight)| weight * entropy([part, 1.0 - part]))
        .sum::<f64>()
}

/// The same as the mean over balls with `points` random points, of which two have different labels.
fn smooth_entropy_of_points(dimensions: usize, points: usize) -> f64 {
    let n = points as f64;
    let (mut sum, mut mixed) = (0.0, 0.0);
    let entropies: Vec<f64> =
        (0..=points).map(|k| entropy([k as f64 / n, 1.0 - k as f64 / n])).collect();
    let mut log_choose = vec![0.0; points + 1];
    for k in 1..=points {
        log_choose[k] = log_choose[k - 1] + pxfm::f_log((points - k + 1) as f64 / k as f64);
    }
    for (part, weight) in cuts(dimensions) {
        let (yes, no) = (pxfm::f_log(part), pxfm::f_log1p(-part));
        for k in 1..points {
            let probability =
                pxfm::f_exp(log_choose[k] + k as f64 * yes + (points - k) as f64 * no);
            sum += weight * probability * entropies[k];
            mixed += weight * probability;
        }
    }
    sum / mixed
}

/// Steps of the quadratures over the angle. The integrands are smooth in it but for p ln p at the ends; with 2000
/// steps S is right to 10⁻¹¹. More steps would cost time in proportion.
const STEPS: usize = 2000;

/// The parts of a ball beyond cuts t = sin θ, with weights that integrate over t from −1 to 1. Parts of 0 and 1 are
/// left out: they have no entropy.
fn cuts(dimensions: usize) -> Vec<(f64, f64)> {
    let step = PI / STEPS as f64;
    // ∫ (1 − s²)^((D−1)/2) ds = ∫ cos^D θ dθ, by Simpson's rule over each step.
    let power = |theta: f64| pxfm::f_pow(pxfm::f_cos(theta).max(0.0), dimensions as f64);
    let angle = |k: f64| -0.5 * PI + step * k;
    let over = |k: usize| {
        let (left, middle, right) = (k as f64, k as f64 + 0.5, k as f64 + 1.0);
        (power(angle(left)) + 4.0 * power(angle(middle)) + power(angle(right))) / 6.0
    };
    let parts: Vec<f64> = (0..STEPS).map(over).collect();
    let total: f64 = parts.iter().sum();
    let mut below = 0.0;
    let mut found = Vec::with_capacity(STEPS);
    for (k, part) in parts.iter().enumerate().take(STEPS - 1) {
        below += part / total;
        // The trapezoidal rule for ∫ … cos θ dθ at θ = (k + 1) steps; the integrand is 0 at both ends.
        found.push((below, step * pxfm::f_cos(angle(k as f64 + 1.0))));
    }
    found.into_iter().filter(|(below, _)| *below > 0.0 && *below < 1.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entropies_of_smooth_boundaries_are_the_published_ones() {
        let known = [
            (1, 0.5),
            (2, 0.439_509_330_638),
            (3, 0.396_091_762_873),
            (4, 0.363_194_28),
            (5, 0.337_225_72),
        ];
        for ((dimensions, exact), error) in known.into_iter().zip([1e-11, 1e-11, 1e-11, 1e-8, 1e-8])
        {
            let found = smooth_boundary_entropy(dimensions);
            assert!((found - exact).abs() < error, "{dimensions}: {found}");
        }
    }

    /// In one dimension p is uniform, and so is the number of points beyond the cut.
    #[test]
    fn the_entropy_of_two_points_and_of_many_is_exact() {
        assert!((smooth_entropy_of_points(1, 2) - std::f64::consts::LN_2).abs() < 1e-9);
        let mean =
            (1..10).map(|k| entropy([f64::from(k) / 10.0, 1.0 - f64::from(k) / 10.0])).sum::<f64>()
                / 9.0;
        assert!((smooth_entropy_of_points(1, 10) - mean).abs() < 1e-6, "{mean}");
        // The share of balls that are touched without being seen falls like n^(−2/(D+1)).
        for dimensions in 1..=3 {
            let many = smooth_entropy_of_points(dimensions, 3000);
            let unseen = pxfm::f_pow(3000.0, -2.0 / (dimensions as f64 + 1.0));
            let above = many / smooth_boundary_entropy(dimensions) - 1.0;
            assert!((0.0..2.0 * unseen).contains(&above), "{dimensions}: {above} {unseen}");
        }
    }
}
