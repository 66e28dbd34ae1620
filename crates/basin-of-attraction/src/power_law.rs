//! Power laws fitted to measurements, with what speaks against them.

use crate::statistics::student_quantile;
use crate::{Error, Estimate};

/// A fit of value ∝ scale^exponent.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerLaw {
    /// The exponent with the 95 % interval of its least-squares fit. The interval takes the law for
    /// granted: see `warning` and `local`.
    pub exponent: Estimate,
    /// The smallest and the largest scale.
    pub range: (f64, f64),
    /// Slopes between neighbouring scales, from fine to coarse. Look at them: a slope that drifts is
    /// no exponent.
    pub local: Vec<f64>,
    /// Why the fit is not to be trusted.
    pub warning: Option<Warning>,
}

/// What speaks against a power law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Warning {
    /// Fewer than four scales.
    FewScales {
        /// How many.
        scales: usize,
    },
    /// Less than one and a half decades.
    ShortRange {
        /// Decades.
        decades: f64,
    },
    /// Local slopes change from the finest to the coarsest third by more than their scatter.
    Drifts {
        /// Mean slope of the finest third.
        fine: f64,
        /// Mean slope of the coarsest third.
        coarse: f64,
    },
}

/// A least-squares line.
pub(crate) struct Line {
    pub(crate) slope: f64,
    /// Sum of squared residuals.
    pub(crate) residual: f64,
    /// Σ (x − mean)².
    spread: f64,
}

pub(crate) fn line(points: &[(f64, f64)]) -> Line {
    let n = points.len() as f64;
    let (mean_x, mean_y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let spread: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.0 - mean_x)).sum();
    let slope = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum::<f64>() / spread;
    let off = |p: &(f64, f64)| (p.1 - mean_y) - slope * (p.0 - mean_x);
    Line { slope, residual: points.iter().map(|p| off(p) * off(p)).sum(), spread }
}

/// Fits a power law to (scale, value), both positive.
///
/// ```
/// let points: Vec<_> = (0..8).map(|k| (0.1f64.powi(k), 0.1f64.powi(2 * k))).collect();
/// let law = basin_of_attraction::power_law(&points)?;
/// assert!((law.exponent.value - 2.0).abs() < 1e-12 && law.warning.is_none());
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadFit`] for fewer than three points, equal scales, or numbers that are not positive.
pub fn power_law(points: &[(f64, f64)]) -> Result<PowerLaw, Error> {
    let positive = |&(scale, value): &(f64, f64)| {
        scale > 0.0 && scale.is_finite() && value > 0.0 && value.is_finite()
    };
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let distinct = sorted.windows(2).all(|pair| pair[0].0 < pair[1].0);
    if sorted.len() < 3 || !distinct || !sorted.iter().all(positive) {
        return Err(Error::BadFit { points: points.len() });
    }
    let logarithms: Vec<_> =
        sorted.iter().map(|&(x, y)| (pxfm::f_log(x), pxfm::f_log(y))).collect();
    let fit = line(&logarithms);
    let degrees = logarithms.len() - 2;
    let half = student_quantile(degrees) * (fit.residual / degrees as f64 / fit.spread).sqrt();
    let local: Vec<f64> =
        logarithms.windows(2).map(|p| (p[1].1 - p[0].1) / (p[1].0 - p[0].0)).collect();
    let range = (sorted[0].0, sorted[sorted.len() - 1].0);
    let exponent = Estimate { value: fit.slope, lower: fit.slope - half, upper: fit.slope + half };
    let warning = warning(&sorted, &local);
    Ok(PowerLaw { exponent, range, local, warning })
}

/// Slopes that change by less than this are called constant.
const STEADY: f64 = 0.05;

fn warning(points: &[(f64, f64)], local: &[f64]) -> Option<Warning> {
    let scales = points.len();
    if scales < 4 {
        return Some(Warning::FewScales { scales });
    }
    let decades = pxfm::f_log10(points[scales - 1].0 / points[0].0);
    if decades < 1.5 {
        return Some(Warning::ShortRange { decades });
    }
    let third = (local.len() / 3).max(1);
    let mean = |slopes: &[f64]| slopes.iter().sum::<f64>() / slopes.len() as f64;
    let (fine, coarse) = (mean(&local[..third]), mean(&local[local.len() - third..]));
    // Scatter about a trend: half the mean squared second difference.
    let jumps: Vec<f64> = local.windows(2).map(|p| (p[1] - p[0]) * (p[1] - p[0])).collect();
    let scatter = (0.5 * mean(&jumps)).sqrt();
    let drifts = (fine - coarse).abs() > STEADY.max(3.0 * scatter / (third as f64).sqrt());
    drifts.then_some(Warning::Drifts { fine, coarse })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_are_given_for_what_is_no_law() {
        let few: Vec<_> = (1..4).map(|k| (10f64.powi(k), 1.0 + f64::from(k))).collect();
        assert!(matches!(power_law(&few).unwrap().warning, Some(Warning::FewScales { scales: 3 })));
        let short: Vec<_> = (10..20).map(|k| (f64::from(k), f64::from(k))).collect();
        assert!(matches!(power_law(&short).unwrap().warning, Some(Warning::ShortRange { .. })));
        // x + x²: the slope goes from 1 to 2.
        let bend: Vec<_> =
            (-6..=6).map(|k| pxfm::f_exp10(0.5 * f64::from(k))).map(|x| (x, x + x * x)).collect();
        let law = power_law(&bend).unwrap();
        let Some(Warning::Drifts { fine, coarse }) = law.warning else { panic!("{law:?}") };
        assert!(fine < 1.1 && coarse > 1.9);
        assert!(power_law(&[(1.0, 1.0), (1.0, 2.0), (2.0, 2.0)]).is_err());
        assert!(power_law(&[(1.0, 1.0), (2.0, 0.0), (3.0, 2.0)]).is_err());
    }

    #[test]
    fn the_interval_is_that_of_the_slope() {
        // Slope 1 with residuals ±0.1: the textbook interval.
        let points: Vec<_> = (0..6)
            .map(|k| (f64::from(k), f64::from(k) + if k % 2 == 0 { 0.1 } else { -0.1 }))
            .map(|(x, y)| (pxfm::f_exp(x), pxfm::f_exp(y)))
            .collect();
        let law = power_law(&points).unwrap();
        assert!(law.exponent.covers(1.0));
        assert!((law.exponent.half_width() - 0.07772).abs() < 1e-5, "{:?}", law.exponent);
    }
}
