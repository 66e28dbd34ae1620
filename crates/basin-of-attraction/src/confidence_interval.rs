//! Estimates with 95 % confidence intervals.

use crate::error::Error;

/// An estimate from a random sample, with an interval that is meant to contain the true number in 95 of 100 samples.
///
/// The constructor states the assumptions. Wilson's interval contains the number in about 95 % of the samples: the share
/// varies with the proportion, because counts are whole numbers. Student's interval does so for normal replicates.
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
const NORMAL_QUANTILE: f64 = 1.959_963_984_540_054;

/// The proportion p of successes in independent trials, with Wilson's interval (1927).
///
/// The interval stays inside [0, 1]. Its coverage is near 95 % for p near 0 or 1 too.
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

/// The mean of independent replicates, with Student's interval.
///
/// If the replicates are normal, the interval contains their mean in 95 % of the samples. Otherwise this holds for many
/// replicates only.
///
/// # Errors
/// [`Error::TooFewReplicates`] for fewer than two.
pub fn student_interval(replicates: &[f64]) -> Result<ConfidenceInterval, Error> {
    let count = replicates.len();
    if count < 2 {
        return Err(Error::TooFewReplicates { replicates: count });
    }
    let n = count as f64;
    let mean = replicates.iter().sum::<f64>() / n;
    let squares: f64 = replicates.iter().map(|x| (x - mean) * (x - mean)).sum();
    let half = student_quantile(count - 1) * (squares / (n - 1.0) / n).sqrt();
    Ok(ConfidenceInterval { value: mean, lower: mean - half, upper: mean + half })
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
    fn wilson_intervals_stay_inside_zero_to_one() {
        for (k, n) in [(0, 1), (1, 1), (3, 7), (1000, 1000)] {
            let fraction = wilson_interval(k, n).unwrap();
            assert!(0.0 <= fraction.lower && fraction.lower <= fraction.value);
            assert!(fraction.value <= fraction.upper && fraction.upper <= 1.0);
        }
        assert!(
            wilson_interval(1, 0).is_err()
                && wilson_interval(2, 1).is_err()
                && student_interval(&[1.0]).is_err()
        );
    }
}
