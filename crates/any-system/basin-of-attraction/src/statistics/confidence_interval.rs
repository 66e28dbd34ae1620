//! Estimates with 95 % confidence intervals.

use crate::error::Error;
use crate::space::vectors::check_point;

/// An estimate from a random sample, with an interval that is meant to contain the true number in 95 of 100 samples.
///
/// The constructor states the assumptions, and how often the interval contains the number: counts are whole
/// numbers, so that an interval of a proportion cannot do so in exactly 95 % of the samples. `docs/basins-measured.md` has
/// the measured share for every interval of this crate.
///
/// For bounds that need no probability see [`Bounds`](crate::Bounds).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConfidenceInterval {
    /// The estimate. It need not be the middle of the interval.
    pub value: f64,
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

impl ConfidenceInterval {
    /// Whether the interval contains `number`.
    pub fn covers(&self, number: f64) -> bool {
        self.lower <= number && number <= self.upper
    }

    /// Half the length of the interval.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.upper - self.lower)
    }
}

/// The two-sided 95 % quantile of the normal distribution: Φ(1.95996…) = 0.975.
pub(crate) const NORMAL_QUANTILE: f64 = 1.959_963_984_540_054;

/// The proportion p of successes in independent trials, with Wilson's interval (1927).
///
/// The interval stays inside [0, 1]. It contains p in about 95 % of the samples if about ten successes and ten
/// failures or more are expected. For rarer successes it does so less often, at worst in 84 %, near p = 0.18/n:
/// [`proportion_interval`] does not have this gap.
///
/// ```
/// let fraction = basin_of_attraction::wilson_interval(0, 100)?;
/// assert!(fraction.lower == 0.0 && (fraction.upper - 0.03699).abs() < 1e-5);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadTrials`] without trials, or with more successes than trials.
pub fn wilson_interval(successes: usize, trials: usize) -> Result<ConfidenceInterval, Error> {
    if trials == 0 || successes > trials {
        return Err(Error::BadTrials { successes, trials });
    }
    // With the quantile z and the estimate p̂ the ends solve (p − p̂)² = z² p (1 − p)/n:
    //   p = [p̂ + z²/(2n) ± √(z²/n · (p̂ (1 − p̂) + z²/(4n)))] / (1 + z²/n)
    let (n, fraction) = (trials as f64, successes as f64 / trials as f64);
    let square = NORMAL_QUANTILE * NORMAL_QUANTILE / n;
    let center = fraction + 0.5 * square;
    let half = (square * (fraction * (1.0 - fraction) + 0.25 * square)).sqrt();
    let end = |x: f64| (x / (1.0 + square)).clamp(0.0, 1.0);
    // Without successes, or without failures, one end is p̂ itself. The formula would differ from it by rounding.
    let lower = if successes == 0 { 0.0 } else { end(center - half) };
    let upper = if successes == trials { 1.0 } else { end(center + half) };
    Ok(ConfidenceInterval { value: fraction, lower, upper })
}

/// From this number of trials on [`proportion_interval`] is no longer than Wilson's, and still contains p in at
/// least 93 % of the samples, for every p. With fewer trials and that length it would be down to 92 %.
pub(crate) const ENOUGH_TRIALS: usize = 100;

/// The probability with which the number of successes may be at least the one found, if p is the lower end. 0.035
/// was chosen: from 0.025 to 0.05 the smallest coverage over p, for 100 to 800 trials, is largest with it.
const RARE: f64 = 0.035;

/// The proportion p of successes in independent trials, with an interval for rare successes too.
///
/// This is Wilson's interval, moved towards fewer successes where its lower end is too high. Wilson's lower end for
/// one success in n trials is 0.18/n; but for p just below it one success has the probability 0.16. Here the lower
/// end is at most the p for which as many successes, or more, have the probability 0.035. For few failures it is
/// the reverse. From 100 trials on the upper end moves as well, so that the interval is as long as Wilson's. For
/// every p and every number of trials that was tried the interval contains p in at least 93 % of the samples: the
/// tests sum the binomial distribution.
///
/// The interval holds too if the trials have different probabilities with the mean p, as those of stratified points
/// have (Hoeffding 1956: their number of successes lies farther from its mean less often).
///
/// ```
/// let fraction = basin_of_attraction::proportion_interval(1, 1000)?;
/// assert!(fraction.covers(5e-5) && !basin_of_attraction::wilson_interval(1, 1000)?.covers(5e-5));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadTrials`] without trials, or with more successes than trials.
pub fn proportion_interval(successes: usize, trials: usize) -> Result<ConfidenceInterval, Error> {
    let ConfidenceInterval { value, lower, upper } = wilson_interval(successes, trials)?;
    let failures = trials - successes;
    // Of both moves at most one is not 0, except for few trials.
    let down = lower - rare_end(successes, trials, lower);
    let up = 1.0 - upper - rare_end(failures, trials, 1.0 - upper);
    let shared = if trials >= ENOUGH_TRIALS { 1.0 } else { 0.0 };
    Ok(ConfidenceInterval {
        value,
        lower: lower - down + shared * up,
        upper: upper + up - shared * down,
    })
}

/// From this number of successes on Wilson's lower end is below the other one, by a margin: the two meet at about
/// 20. Beyond it the sum of the binomial distribution is not needed.
const MANY_SUCCESSES: usize = 40;

/// The smaller one of `wilson` and of the p for which at least `successes` of the trials succeed with the
/// probability [`RARE`].
fn rare_end(successes: usize, trials: usize, wilson: f64) -> f64 {
    if successes == 0 || successes >= MANY_SUCCESSES || at_least(successes, trials, wilson) <= RARE
    {
        return wilson;
    }
    let (mut low, mut high) = (0.0, wilson);
    // The probability grows with p. The loop ends when no number lies between its ends, or they are equal to 10⁻¹².
    while high - low > 1e-12 * high {
        let middle = 0.5 * (low + high);
        if at_least(successes, trials, middle) > RARE { high = middle } else { low = middle }
    }
    low
}

/// The interval of a proportion of which some trials are open: they may be successes. Its lower end counts none of them, its upper end all; the value none.
///
/// # Errors
/// As [`proportion_interval`].
pub(crate) fn open_proportion(
    successes: usize,
    open: usize,
    trials: usize,
) -> Result<ConfidenceInterval, Error> {
    let ConfidenceInterval { value, lower, .. } = proportion_interval(successes, trials)?;
    let upper = proportion_interval(successes + open, trials)?.upper;
    Ok(ConfidenceInterval { value, lower, upper })
}

/// The probability of at least `successes` successes in independent trials with the probability p < 1 each.
fn at_least(successes: usize, trials: usize, p: f64) -> f64 {
    let mut term = pxfm::f_exp(trials as f64 * pxfm::f_log1p(-p));
    let mut fewer = term;
    for k in 1..successes {
        term *= p / (1.0 - p) * ((trials - k + 1) as f64 / k as f64);
        fewer += term;
    }
    1.0 - fewer
}

/// The mean of independent replicates, with Student's interval.
///
/// If the replicates are normal, the interval contains their mean in 95 % of the samples. Otherwise this holds for many
/// replicates only. An end that is beyond all `f64` is infinite.
///
/// # Errors
/// [`Error::TooFewReplicates`] for fewer than two; [`Error::BadPoint`] for one that is not finite.
pub fn student_interval(replicates: &[f64]) -> Result<ConfidenceInterval, Error> {
    let count = replicates.len();
    if count < 2 {
        return Err(Error::TooFewReplicates { replicates: count });
    }
    check_point(replicates)?;
    let n = count as f64;
    // In units of a power of two, so that no square that counts overflows or vanishes. The change of units rounds
    // subnormal numbers alone.
    let unit = power_of_two(replicates.iter().fold(0.0, |largest: f64, x| largest.max(x.abs())));
    let mean = replicates.iter().map(|x| x / unit).sum::<f64>() / n;
    let squares: f64 = replicates.iter().map(|x| (x / unit - mean) * (x / unit - mean)).sum();
    let half = student_quantile(count - 1) * (squares / (n - 1.0) / n).sqrt();
    let [value, lower, upper] = [mean, mean - half, mean + half].map(|x| x * unit);
    Ok(ConfidenceInterval { value, lower, upper })
}

/// The largest power of two that is not above a number, and the smallest normal number if it is below that.
fn power_of_two(number: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(number.to_bits() & EXPONENT).max(f64::MIN_POSITIVE)
}

/// The two-sided 95 % quantile of Student's distribution.
///
/// One to ten degrees of freedom come from a table. More come from the Cornish–Fisher expansion in
/// 1/degrees up to the third power, which is right to four digits there and worse for fewer degrees.
pub(crate) fn student_quantile(degrees: usize) -> f64 {
    const TABLE: [f64; 10] = [
        12.706_2, 4.302_65, 3.182_45, 2.776_45, 2.570_58, 2.446_91, 2.364_62, 2.306_0, 2.262_16,
        2.228_14,
    ];
    if let Some(&quantile) = degrees.checked_sub(1).and_then(|at| TABLE.get(at)) {
        return quantile;
    }
    // With the normal quantile z and v degrees of freedom (Abramowitz and Stegun, 26.7.5):
    //   t = z + (z³ + z)/(4v) + (5z⁵ + 16z³ + 3z)/(96v²) + (3z⁷ + 19z⁵ + 17z³ − 15z)/(384v³) + …
    let (z, v) = (NORMAL_QUANTILE, degrees as f64);
    let square = z * z;
    let first = z * (square + 1.0) / 4.0;
    let second = z * ((5.0 * square + 16.0) * square + 3.0) / 96.0;
    let third = z * (((3.0 * square + 19.0) * square + 17.0) * square - 15.0) / 384.0;
    z + (first + (second + third / v) / v) / v
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn student_quantiles_agree_with_tables() {
        for (degrees, quantile) in
            [(1, 12.7062), (5, 2.57058), (15, 2.13145), (30, 2.04227), (120, 1.97993)]
        {
            assert!((student_quantile(degrees) - quantile).abs() < 2e-4, "{degrees}");
        }
    }

    #[test]
    fn student_intervals_have_no_scale() {
        let sample = [1.0, 2.5, -0.75, 1.5];
        let ConfidenceInterval { value, lower, upper } = student_interval(&sample).unwrap();
        // Squares of these numbers would overflow, or vanish.
        for scale in [2f64.powi(1000), 2f64.powi(-1000)] {
            let scaled = student_interval(&sample.map(|x| x * scale)).unwrap();
            let same = [value, lower, upper].map(|x| x * scale);
            assert_eq!([scaled.value, scaled.lower, scaled.upper], same);
        }
        let largest = student_interval(&[f64::MAX; 2]).unwrap();
        assert_eq!([largest.value, largest.lower, largest.upper], [f64::MAX; 3]);
        let zero = student_interval(&[0.0; 3]).unwrap();
        assert_eq!([zero.value, zero.lower, zero.upper], [0.0; 3]);
        let opposite = student_interval(&[f64::MAX, -f64::MAX]).unwrap();
        assert_eq!((opposite.lower, opposite.upper), (f64::NEG_INFINITY, f64::INFINITY));
    }

    /// The smallest probability with which the interval contains p, over all p: it changes at the ends of intervals
    /// only, so that both sides of each end are tried.
    fn smallest_coverage(
        interval: &dyn Fn(usize, usize) -> ConfidenceInterval,
        trials: usize,
    ) -> f64 {
        let all: Vec<ConfidenceInterval> = (0..=trials).map(|k| interval(k, trials)).collect();
        let log_factorial = |n: usize| (2..=n).map(|k| pxfm::f_log(k as f64)).sum::<f64>();
        let choose: Vec<f64> = (0..=trials)
            .map(|k| log_factorial(trials) - log_factorial(k) - log_factorial(trials - k))
            .collect();
        let coverage = |p: f64| -> f64 {
            let (yes, no) = (pxfm::f_log(p), pxfm::f_log1p(-p));
            let probability =
                |k: usize| pxfm::f_exp(choose[k] + k as f64 * yes + (trials - k) as f64 * no);
            (0..=trials).filter(|k| all[*k].covers(p)).map(probability).sum()
        };
        all.iter()
            .flat_map(|interval| [interval.lower, interval.upper])
            .flat_map(|end| [end * (1.0 - 1e-9), end * (1.0 + 1e-9)])
            .filter(|p| (1e-9..0.999_999).contains(p))
            .map(coverage)
            .fold(1.0, f64::min)
    }

    #[test]
    fn a_proportion_is_in_its_interval_in_93_of_100_samples_for_every_proportion() {
        let ours = |k: usize, n: usize| proportion_interval(k, n).unwrap();
        let wilson = |k: usize, n: usize| wilson_interval(k, n).unwrap();
        for trials in [100, 128, 200, 350] {
            let smallest = smallest_coverage(&ours, trials);
            assert!(smallest > 0.93, "{trials}: {smallest}");
            let gap = smallest_coverage(&wilson, trials);
            assert!((0.837..0.839).contains(&gap), "{trials}: {gap}");
            for k in 0..=trials {
                let (one, other) = (ours(k, trials), wilson(k, trials));
                assert!(one.half_width() <= other.half_width() + 1e-15, "{k} of {trials}");
                assert!(one.covers(one.value) && one.lower >= 0.0 && one.upper <= 1.0);
            }
        }
        for trials in 1..60 {
            let smallest = smallest_coverage(&ours, trials);
            assert!(smallest > 0.93, "{trials}: {smallest}");
        }
    }

    #[test]
    fn wilson_intervals_stay_inside_zero_to_one() {
        for (k, n) in [(0, 1), (1, 1), (3, 7), (1000, 1000)] {
            let fraction = wilson_interval(k, n).unwrap();
            assert!(0.0 <= fraction.lower && fraction.lower <= fraction.value);
            assert!(fraction.value <= fraction.upper && fraction.upper <= 1.0);
        }
        assert!(
            proportion_interval(1, 0).is_err()
                && proportion_interval(3, 2).is_err()
                && wilson_interval(1, 0).is_err()
                && wilson_interval(2, 1).is_err()
                && student_interval(&[1.0]).is_err()
                && student_interval(&[1.0, f64::NAN]).is_err()
        );
    }
}
