//! Estimates with 95 % intervals.

use crate::Error;

/// A value with an interval that holds the truth: always, or in 95 of 100 cases, as its source says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

impl Estimate {
    /// Whether the interval holds `truth`.
    pub fn covers(&self, truth: f64) -> bool {
        self.lower <= truth && truth <= self.upper
    }

    /// Half the length of the interval.
    pub fn half_width(&self) -> f64 {
        0.5 * (self.upper - self.lower)
    }
}

/// The two-sided 95 % quantile of the normal distribution.
const NORMAL: f64 = 1.959_963_984_540_054;

/// A proportion from independent trials, with Wilson's 95 % interval (1927), which stays inside
/// [0, 1] and keeps its coverage for shares near the ends.
///
/// ```
/// let share = basin_of_attraction::wilson_interval(0, 100)?;
/// assert!(share.lower == 0.0 && (share.upper - 0.03699).abs() < 1e-5);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadTrials`] without trials, or with more successes than trials.
pub fn wilson_interval(successes: usize, trials: usize) -> Result<Estimate, Error> {
    if trials == 0 || successes > trials {
        return Err(Error::BadTrials { successes, trials });
    }
    let (n, share) = (trials as f64, successes as f64 / trials as f64);
    let square = NORMAL * NORMAL / n;
    let center = share + 0.5 * square;
    let half = (square * (share * (1.0 - share) + 0.25 * square)).sqrt();
    let bound = |x: f64| (x / (1.0 + square)).clamp(0.0, 1.0);
    // At the ends the exact bound is the share itself.
    let lower = if successes == 0 { 0.0 } else { bound(center - half) };
    let upper = if successes == trials { 1.0 } else { bound(center + half) };
    Ok(Estimate { value: share, lower, upper })
}

/// The mean of independent replicates with Student's 95 % interval.
///
/// # Errors
/// [`Error::TooFewReplicates`] for fewer than two.
pub fn student_interval(replicates: &[f64]) -> Result<Estimate, Error> {
    let count = replicates.len();
    if count < 2 {
        return Err(Error::TooFewReplicates { replicates: count });
    }
    let n = count as f64;
    let mean = replicates.iter().sum::<f64>() / n;
    let squares: f64 = replicates.iter().map(|x| (x - mean) * (x - mean)).sum();
    let half = student_quantile(count - 1) * (squares / (n - 1.0) / n).sqrt();
    Ok(Estimate { value: mean, lower: mean - half, upper: mean + half })
}

/// The two-sided 95 % quantile of Student's distribution.
///
/// The first from tables; beyond, by the Cornish–Fisher expansion, right to four digits.
pub(crate) fn student_quantile(degrees: usize) -> f64 {
    const TABLE: [f64; 10] = [
        12.706_2, 4.302_65, 3.182_45, 2.776_45, 2.570_58, 2.446_91, 2.364_62, 2.306_0, 2.262_16,
        2.228_14,
    ];
    if let Some(&quantile) = degrees.checked_sub(1).and_then(|at| TABLE.get(at)) {
        return quantile;
    }
    let (z, v) = (NORMAL, degrees as f64);
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
    fn student_quantiles_are_those_of_the_tables() {
        for (degrees, quantile) in
            [(1, 12.7062), (5, 2.57058), (15, 2.13145), (30, 2.04227), (120, 1.97993)]
        {
            assert!((student_quantile(degrees) - quantile).abs() < 2e-4, "{degrees}");
        }
    }

    #[test]
    fn wilson_stays_inside() {
        for (k, n) in [(0, 1), (1, 1), (3, 7), (1000, 1000)] {
            let share = wilson_interval(k, n).unwrap();
            assert!(0.0 <= share.lower && share.lower <= share.value);
            assert!(share.value <= share.upper && share.upper <= 1.0);
        }
        assert!(
            wilson_interval(1, 0).is_err()
                && wilson_interval(2, 1).is_err()
                && student_interval(&[1.0]).is_err()
        );
    }
}
