//! Final-state uncertainty in a region of any dimension: pairs of points at a distance ε, and the exponent of their
//! fraction.

use crate::boundaries::uncertainty_fit::{ExponentFit, ScaleCount, fit_exponent};
use crate::error::Error;
use crate::shares::sampling::check_count;
use crate::space::hyperrectangle::Hyperrectangle;
use crate::space::label::Label;
use crate::statistics::confidence_interval::{ConfidenceInterval, open_proportion};
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;

/// Pairs of points at a distance ε, counted by their labels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairCount {
    /// The distance of the two points of a pair.
    pub epsilon: f64,
    /// Pairs of which both points are inside the region of interest.
    pub pairs: usize,
    /// Pairs whose points belong to different basins.
    pub uncertain: usize,
    /// Pairs with an undecided point: they may be uncertain.
    pub open: usize,
}

impl PairCount {
    /// The fraction of uncertain pairs, with a 95 % interval: from the lower end of [`proportion_interval`](crate::proportion_interval) without
    /// the open pairs to the upper end with all of them.
    ///
    /// # Errors
    /// [`Error::BadTrials`] without pairs.
    pub fn fraction(&self) -> Result<ConfidenceInterval, Error> {
        open_proportion(self.uncertain, self.open, self.pairs)
    }
}

/// Counts the pairs x, x + ε u whose labels differ (Grebogi, McDonald, Ott, Yorke 1983).
///
/// x is uniform in the region, and the direction u is uniform on the unit sphere. `count` independent pairs are
/// tried, the same for the same seed with any number of threads. x + ε u may lie outside the region: the labelling
/// must be defined there.
///
/// ```
/// use basin_of_attraction::{Hyperrectangle, Interval, Label, uncertain_pairs};
/// let square = Hyperrectangle::new(vec![Interval::new(0.0, 1.0)?; 2])?;
/// let right = |x: &[f64]| Label::from(x[0] > 0.5);
/// let found = uncertain_pairs(&square, 0.01, 100_000, 1, right)?.fraction()?;
/// // A line is crossed by 2ε/π of the pairs.
/// assert!(found.covers(0.02 / std::f64::consts::PI));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadPerturbation`] unless `epsilon` is positive and finite; [`Error::TooManySamples`] for more than a
/// billion pairs; [`Error::NothingInside`] if no pair is inside the region of interest.
pub fn uncertain_pairs(
    region: &Hyperrectangle,
    epsilon: f64,
    count: usize,
    seed: u64,
    label: impl Fn(&[f64]) -> Label + Sync,
) -> Result<PairCount, Error> {
    check_perturbation(epsilon)?;
    check_count(count)?;
    let points = SplitMix64::from_seed(seed);
    let directions = SplitMix64::from_seed(points.bits(0));
    let pair = |k: usize| {
        let mut point = region.random_point(&points, k as u64 + 1);
        let here = label(&point);
        let direction = random_direction(&directions, k as u64, point.len());
        point.iter_mut().zip(direction).for_each(|(x, u)| *x += epsilon * u);
        (here, label(&point))
    };
    let tally = |found: (Label, Label)| match found {
        (Label::OUTSIDE, _) | (_, Label::OUTSIDE) => [0, 0, 0],
        (here, there) if here.is_undecided() || there.is_undecided() => [1, 0, 1],
        (here, there) => [1, usize::from(here != there), 0],
    };
    let add = |a: [usize; 3], b: [usize; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let [pairs, uncertain, open] =
        (0..count).into_par_iter().map(|k| tally(pair(k))).reduce(|| [0; 3], add);
    if pairs == 0 {
        return Err(Error::NothingInside { points: count });
    }
    Ok(PairCount { epsilon, pairs, uncertain, open })
}

/// An error for a perturbation that is not positive and finite.
pub(crate) fn check_perturbation(epsilon: f64) -> Result<(), Error> {
    if epsilon > 0.0 && epsilon.is_finite() {
        Ok(())
    } else {
        Err(Error::BadPerturbation { epsilon })
    }
}

/// Direction `number` of a generator, uniform on the unit sphere: a vector of independent normal numbers, divided
/// by its length.
pub(crate) fn random_direction(random: &SplitMix64, number: u64, dimension: usize) -> Vec<f64> {
    // Box and Muller: √(−2 ln u) cos 2πv is normal. 1 − u is in (0, 1].
    let normal = |k: u64| {
        let (u, v) = (random.uniform(2 * k), random.uniform(2 * k + 1));
        (-2.0 * pxfm::f_log(1.0 - u)).sqrt() * pxfm::f_cos(std::f64::consts::TAU * v)
    };
    let first = number.wrapping_mul(dimension as u64);
    let mut direction: Vec<f64> =
        (0..dimension as u64).map(|k| normal(first.wrapping_add(k))).collect();
    let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 {
        direction.iter_mut().for_each(|x| *x /= length);
    } else {
        // All normal numbers are 0 with a probability of 2⁻⁵³ for one coordinate, and less for more.
        direction.iter_mut().take(1).for_each(|x| *x = 1.0);
    }
    direction
}

/// The uncertainty exponent α of a region: the fraction of uncertain pairs is ∝ ε^α.
#[derive(Debug, Clone, PartialEq)]
pub struct UncertaintyExponent {
    /// The exponent, with a 95 % interval that follows from the numbers of pairs. It holds if the power law does: see
    /// `chi_squared`. The dimension of the boundary is that of the space less the exponent, unless a basin is riddled.
    pub exponent: ConfidenceInterval,
    /// The sum of the squared deviations from the law, each over its variance.
    pub chi_squared: f64,
    /// The degrees of freedom: the number of ε less 2. If the law holds, `chi_squared` has this mean, and twice
    /// this variance.
    pub degrees: usize,
    /// The pairs, in increasing order of ε.
    pub counts: Vec<PairCount>,
}

impl UncertaintyExponent {
    /// Whether chance explains the deviations from the power law: `chi_squared` exceeds its mean by no more than
    /// three standard deviations. If not, the slope drifts over these ε and its interval means nothing.
    pub fn follows_a_power_law(&self) -> bool {
        /// For few degrees the distribution of χ² has a long tail: of true laws some 1 % exceed this.
        const DEVIATIONS: f64 = 3.0;
        let degrees = self.degrees as f64;
        self.chi_squared <= degrees + DEVIATIONS * (2.0 * degrees).sqrt()
    }
}

/// The uncertainty exponent from independent pairs at several distances.
///
/// The interval contains all exponents at which the score of the binomial likelihood is within 1.96 of its standard
/// deviations. It allows for chance, and no assumption about the scatter is made. Open pairs are counted in the
/// worst way for each end.
///
/// ```
/// use basin_of_attraction::{Hyperrectangle, Interval, Label, uncertainty_exponent};
/// let square = Hyperrectangle::new(vec![Interval::new(0.0, 1.0)?; 2])?;
/// let disc = |x: &[f64]| Label::from(x[0] * x[0] + x[1] * x[1] < 0.5);
/// // The boundary is smooth, of dimension 1 in the plane.
/// let found = uncertainty_exponent(&square, &[0.001, 0.01, 0.1], 20_000, 1, disc)?;
/// assert!(found.exponent.covers(1.0) && found.exponent.half_width() < 0.1);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadFit`] for fewer than three different distances; [`Error::TooFewUncertainPairs`] for fewer than thirty
/// uncertain pairs at all distances together, and if their numbers give no bound on the exponent: take more pairs or
/// larger distances. [`Error::TooManyOpenPairs`] if open pairs are more than a tenth of the uncertain ones at all
/// distances together. Else as [`uncertain_pairs`].
pub fn uncertainty_exponent(
    region: &Hyperrectangle,
    epsilons: &[f64],
    count: usize,
    seed: u64,
    label: impl Fn(&[f64]) -> Label + Sync,
) -> Result<UncertaintyExponent, Error> {
    /// With fewer uncertain pairs the score is not nearly normal. The sum of all numbers says next to nothing about
    /// the exponent, so that this condition selects no samples of a certain slope; a condition on the number at
    /// each distance would.
    const FEWEST: usize = 30;
    /// With more open pairs the ends of the interval say what the budget of the labelling was.
    const MOST_OPEN: f64 = 0.1;
    let mut epsilons = epsilons.to_vec();
    epsilons.sort_by(f64::total_cmp);
    epsilons.dedup();
    if epsilons.len() < 3 {
        return Err(Error::BadFit { points: epsilons.len() });
    }
    let seeds = SplitMix64::from_seed(seed);
    let pairs =
        |(k, &epsilon): (u64, &f64)| uncertain_pairs(region, epsilon, count, seeds.bits(k), &label);
    let counts: Vec<PairCount> = (0..).zip(&epsilons).map(pairs).collect::<Result<_, Error>>()?;
    let [uncertain, open] = [|found: &PairCount| found.uncertain, |found: &PairCount| found.open]
        .map(|of| counts.iter().map(of).sum::<usize>());
    if open as f64 > MOST_OPEN * uncertain as f64 {
        return Err(Error::TooManyOpenPairs { open, uncertain });
    }
    let scales: Vec<ScaleCount> = counts.iter().map(scale_count).collect();
    let fit = fit_exponent(&scales).filter(|_| uncertain >= FEWEST);
    let Some(ExponentFit { exponent, chi_squared }) = fit else {
        return Err(Error::TooFewUncertainPairs { uncertain, fewest: FEWEST });
    };
    Ok(UncertaintyExponent { exponent, chi_squared, degrees: counts.len() - 2, counts })
}

fn scale_count(found: &PairCount) -> ScaleCount {
    ScaleCount {
        log_scale: pxfm::f_log(found.epsilon),
        pairs: found.pairs as f64,
        uncertain: found.uncertain as f64,
        open: found.open as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::interval::Interval;

    fn cube(dimension: usize) -> Hyperrectangle {
        Hyperrectangle::new(vec![Interval { left: 0.0, right: 1.0 }; dimension]).unwrap()
    }

    /// The colour of the gap of the Cantor set in which the first coordinate falls.
    fn cantor(x: &[f64]) -> Label {
        let mut x = x[0];
        for step in 0..60u8 {
            if !(0.0..=1.0).contains(&x) {
                return Label::OUTSIDE;
            }
            if x > 1.0 / 3.0 && x < 2.0 / 3.0 {
                return Label::from(step % 2);
            }
            x = if x <= 1.0 / 3.0 { 3.0 * x } else { 3.0 * x - 2.0 };
        }
        Label::UNDECIDED
    }

    #[test]
    fn directions_are_uniform_on_the_sphere() {
        let random = SplitMix64::from_seed(1);
        for dimension in 1..5 {
            let mut squares = vec![0.0; dimension];
            for k in 0..20_000 {
                let direction = random_direction(&random, k, dimension);
                let length: f64 = direction.iter().map(|u| u * u).sum();
                assert!((length - 1.0).abs() < 1e-12);
                squares.iter_mut().zip(&direction).for_each(|(sum, u)| *sum += u * u / 2e4);
            }
            assert!(squares.iter().all(|mean| (mean - 1.0 / dimension as f64).abs() < 0.02));
        }
    }

    /// In the plane a Cantor set of lines is crossed with the exponent of the Cantor set on the line: 1 − ln 2/ln
    /// 3. A smooth boundary has the exponent 1 in each dimension.
    #[test]
    fn exponents_of_known_boundaries_lie_in_their_intervals() {
        let epsilons: Vec<f64> = (2..=5).map(|k| 3f64.powi(-k)).collect();
        for dimension in 1..4 {
            let smooth = |x: &[f64]| Label::from(x[0] + 0.1 * x[dimension - 1] > 0.45);
            let mut covered = 0;
            for seed in 0..20 {
                let found = uncertainty_exponent(&cube(dimension), &epsilons, 20_000, seed, smooth)
                    .unwrap();
                covered += usize::from(found.exponent.covers(1.0));
            }
            // Of 20 intervals of 95 % fewer than 16 cover in one of 300 cases.
            assert!(covered >= 16, "{dimension}: {covered}");
            // Near single ends of gaps the fraction is ∝ ε: a correction of ε^0.63, which leaves 0.02 in the
            // exponent here.
            let fine: Vec<f64> = (5..=9).map(|k| 3f64.powi(-k)).collect();
            let found = uncertainty_exponent(&cube(dimension), &fine, 100_000, 5, cantor).unwrap();
            let (value, truth) = (found.exponent.value, 0.369_070_246_428_543);
            assert!((value - truth).abs() < 0.02, "{dimension}: {value} {truth}");
            assert!(found.follows_a_power_law(), "{found:?}");
        }
    }

    #[test]
    fn undecided_points_open_their_pairs() {
        let label = |x: &[f64]| match x[0] {
            ..0.25 => Label::UNDECIDED,
            _ => Label::from(x[0] > 0.5),
        };
        let found = uncertain_pairs(&cube(2), 0.01, 10_000, 1, label).unwrap();
        assert!((2300..2700).contains(&found.open) && found.pairs == 10_000);
        let fraction = found.fraction().unwrap();
        assert!(fraction.lower < 0.01 && fraction.upper > 0.24);
        assert!(matches!(
            uncertainty_exponent(&cube(2), &[0.1, 0.01, 0.001], 10_000, 1, label),
            Err(Error::TooManyOpenPairs { .. })
        ));
        let one = |_: &[f64]| Label::from(0);
        let error = uncertainty_exponent(&cube(1), &[0.1, 0.01, 0.001], 1000, 1, one);
        assert_eq!(error, Err(Error::TooFewUncertainPairs { uncertain: 0, fewest: 30 }));
        assert!(uncertain_pairs(&cube(1), f64::NAN, 10, 1, one).is_err());
        assert!(uncertain_pairs(&cube(1), 0.1, usize::MAX, 1, one).is_err());
    }
}
