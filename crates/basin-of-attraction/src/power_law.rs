//! Power laws fitted to measurements, with warnings about poor fits.

use crate::confidence_interval::{ConfidenceInterval, student_quantile};
use crate::error::Error;
use crate::least_squares::fit_line;

/// A fit of value ∝ scale^exponent.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerLaw {
    /// The exponent, with the 95 % interval of its least-squares fit. The interval assumes that the law holds:
    /// see `warning` and `local`.
    pub exponent: ConfidenceInterval,
    /// The smallest and the largest scale.
    pub range: (f64, f64),
    /// Slopes between neighbouring scales, from fine to coarse. If they drift, there is no single exponent.
    pub local: Vec<f64>,
    /// Why the fit is not reliable; `None` if no test failed.
    pub warning: Option<Warning>,
}

/// Why the fit of a power law is not reliable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Warning {
    /// There are fewer than four scales.
    FewScales {
        /// The number of scales.
        scales: usize,
    },
    /// The scales extend over less than one and a half decades.
    ShortRange {
        /// The number of decades.
        decades: f64,
    },
    /// The local slopes of the finest third of the scales and of the coarsest third differ by more than their scatter.
    Drifts {
        /// Mean slope of the finest third.
        fine: f64,
        /// Mean slope of the coarsest third.
        coarse: f64,
    },
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
    let fit = fit_line(&logarithms);
    // A line through n points has n − 2 degrees of freedom left, and a slope of variance s²/Σ(x − mean)².
    let degrees = logarithms.len() - 2;
    let half =
        student_quantile(degrees) * (fit.squared_residuals / degrees as f64 / fit.spread).sqrt();
    let local: Vec<f64> =
        logarithms.windows(2).map(|p| (p[1].1 - p[0].1) / (p[1].0 - p[0].0)).collect();
    let range = (sorted[0].0, sorted[sorted.len() - 1].0);
    let (lower, upper) = (fit.slope - half, fit.slope + half);
    let exponent = ConfidenceInterval { value: fit.slope, lower, upper };
    let warning = warning(&sorted, &local);
    Ok(PowerLaw { exponent, range, local, warning })
}

/// A change of the slope by less than this gives no warning, however small the scatter is. Without this limit the
/// rounding of exact data would give a warning. The value was chosen.
const STEADY: f64 = 0.05;

/// A fit over fewer scales gives a warning. Chosen.
const FEWEST_SCALES: usize = 4;

/// A fit over fewer decades gives a warning. Chosen.
const FEWEST_DECADES: f64 = 1.5;

/// A drift is a difference of more than this number of standard errors of a third's mean. Chosen: a smaller number
/// would warn about noise, a larger one would miss slow drifts.
const STANDARD_ERRORS: f64 = 3.0;

fn warning(points: &[(f64, f64)], local: &[f64]) -> Option<Warning> {
    let scales = points.len();
    if scales < FEWEST_SCALES {
        return Some(Warning::FewScales { scales });
    }
    let decades = pxfm::f_log10(points[scales - 1].0 / points[0].0);
    if decades < FEWEST_DECADES {
        return Some(Warning::ShortRange { decades });
    }
    let third = (local.len() / 3).max(1);
    let mean = |slopes: &[f64]| slopes.iter().sum::<f64>() / slopes.len() as f64;
    let (fine, coarse) = (mean(&local[..third]), mean(&local[local.len() - third..]));
    // The standard deviation about a smooth trend: neighbouring slopes differ by twice its square in the mean.
    let jumps: Vec<f64> = local.windows(2).map(|p| (p[1] - p[0]) * (p[1] - p[0])).collect();
    let scatter = (0.5 * mean(&jumps)).sqrt();
    let drifts =
        (fine - coarse).abs() > STEADY.max(STANDARD_ERRORS * scatter / (third as f64).sqrt());
    drifts.then_some(Warning::Drifts { fine, coarse })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poor_fits_have_warnings() {
        let few: Vec<_> = (1..4).map(|k| (10f64.powi(k), 1.0 + f64::from(k))).collect();
        assert!(matches!(power_law(&few).unwrap().warning, Some(Warning::FewScales { scales: 3 })));
        let short: Vec<_> = (10..20).map(|k| (f64::from(k), f64::from(k))).collect();
        assert!(matches!(power_law(&short).unwrap().warning, Some(Warning::ShortRange { .. })));
        // The slope of x + x² changes from 1 to 2.
        let bend: Vec<_> =
            (-6..=6).map(|k| pxfm::f_exp10(0.5 * f64::from(k))).map(|x| (x, x + x * x)).collect();
        let law = power_law(&bend).unwrap();
        let Some(Warning::Drifts { fine, coarse }) = law.warning else { panic!("{law:?}") };
        assert!(fine < 1.1 && coarse > 1.9);
        assert!(power_law(&[(1.0, 1.0), (1.0, 2.0), (2.0, 2.0)]).is_err());
        assert!(power_law(&[(1.0, 1.0), (2.0, 0.0), (3.0, 2.0)]).is_err());
    }

    #[test]
    fn the_exponent_has_the_interval_of_the_slope() {
        // A line of slope 1 with residuals ±0.1 has this textbook interval.
        let points: Vec<_> = (0..6)
            .map(|k| (f64::from(k), f64::from(k) + if k % 2 == 0 { 0.1 } else { -0.1 }))
            .map(|(x, y)| (pxfm::f_exp(x), pxfm::f_exp(y)))
            .collect();
        let law = power_law(&points).unwrap();
        assert!(law.exponent.covers(1.0));
        assert!((law.exponent.half_width() - 0.07772).abs() < 1e-5, "{:?}", law.exponent);
    }
}
