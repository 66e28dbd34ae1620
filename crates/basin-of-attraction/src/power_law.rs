//! Power laws fitted to measurements, with warnings about poor fits.

use crate::confidence_interval::{ConfidenceInterval, student_quantile};
use crate::error::Error;
use crate::least_squares::{fit_curvature, fit_line};

/// A fit of value ∝ scale^exponent.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerLaw {
    /// The exponent, with the 95 % interval of its least-squares fit. The interval assumes that the law holds and that the
    /// errors of ln value are independent and normal, with one variance: see `warning` and `local`.
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
    /// The slope changes over the range: a parabola fits better than a line, by a test that noise alone fails in 5 % of
    /// the fits, and the mean slopes of the finest third and of the coarsest third differ by more than 0.05.
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
    let warning = warning(&logarithms, &local);
    Ok(PowerLaw { exponent, range, local, warning })
}

/// A change of the slope by less than this gives no warning, however small the scatter is. Without this limit
/// exact data would be warned about for their rounding. With a drift below it the exponent
/// is uncertain in its second decimal only. A larger limit would miss larger drifts.
const STEADY: f64 = 0.05;

/// A fit over fewer scales gives a warning. With three scales a parabola fits exactly: a drift could not be told from
/// noise. With four, one degree of freedom is left, and only a curvature of more than 12.7 standard errors is a drift.
const FEWEST_SCALES: usize = 4;

/// A fit over fewer decades gives a warning. Over 1.5 decades a factor of 1.4 between the errors of the values at the
/// two ends changes the exponent by about 0.1; over fewer decades it changes it by more. A larger number would warn
/// about more measurements.
const FEWEST_DECADES: f64 = 1.5;

/// The warning of a fit to (ln scale, ln value), from fine to coarse.
///
/// Under a power law with independent normal errors of ln value, all of one variance, the curvature of a fitted parabola
/// over its standard error has Student's distribution with n − 3 degrees of freedom. Its 95 % quantile is exceeded by
/// noise in 5 % of the fits, for every number of scales from four on.
fn warning(logarithms: &[(f64, f64)], local: &[f64]) -> Option<Warning> {
    let scales = logarithms.len();
    if scales < FEWEST_SCALES {
        return Some(Warning::FewScales { scales });
    }
    let decades = (logarithms[scales - 1].0 - logarithms[0].0) / std::f64::consts::LN_10;
    if decades < FEWEST_DECADES {
        return Some(Warning::ShortRange { decades });
    }
    let third = (local.len() / 3).max(1);
    let mean = |slopes: &[f64]| slopes.iter().sum::<f64>() / slopes.len() as f64;
    let (fine, coarse) = (mean(&local[..third]), mean(&local[local.len() - third..]));
    let fit = fit_curvature(logarithms);
    let curved = fit.curvature.abs() > student_quantile(scales - 3) * fit.standard_error;
    (curved && (fine - coarse).abs() > STEADY).then_some(Warning::Drifts { fine, coarse })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::split_mix::SplitMix64;

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

    /// Points of these local slopes, one scale a decade.
    fn with_slopes(slopes: &[f64]) -> Vec<(f64, f64)> {
        let mut exponent = 0.0;
        let value = |slope: &f64| {
            exponent += slope;
            exponent
        };
        let exponents: Vec<f64> = std::iter::once(0.0).chain(slopes.iter().map(value)).collect();
        (0..).zip(exponents).map(|(k, e)| (pxfm::f_exp10(f64::from(k)), pxfm::f_exp10(e))).collect()
    }

    #[test]
    fn four_scales_are_enough_to_see_a_drift() {
        let law = power_law(&with_slopes(&[1.0, 1.5, 2.0])).unwrap();
        assert!(matches!(law.warning, Some(Warning::Drifts { .. })), "{law:?}");
        // One degree of freedom does not tell this from noise.
        assert_eq!(power_law(&with_slopes(&[1.0, 1.0, 2.0])).unwrap().warning, None);
        // Below 0.05 a drift is no warning, however regular it is.
        assert_eq!(power_law(&with_slopes(&[1.0, 1.02, 1.04])).unwrap().warning, None);
    }

    /// 5 % of 4000 fits are 200, with a standard deviation of 14.
    #[test]
    fn noise_alone_gives_the_stated_number_of_warnings() {
        const FITS: u64 = 4000;
        /// Standard deviation of ln value: with it, chance alone makes nearly every drift exceed 0.05.
        const NOISE: f64 = 1.0;
        for scales in [4, 5, 8, 13] {
            let fit = |seed: u64| {
                let random = SplitMix64::from_seed(seed);
                // Twelve uniform numbers have a sum of variance 1, nearly normal.
                let normal =
                    |k: u64| (0..12).map(|i| random.uniform(12 * k + i)).sum::<f64>() - 6.0;
                let point = |k: u64| {
                    let x = k as f64 * std::f64::consts::LN_10;
                    (pxfm::f_exp(x), pxfm::f_exp(2.0 * x + NOISE * normal(k)))
                };
                power_law(&(0..scales).map(point).collect::<Vec<_>>()).unwrap()
            };
            let warned = (0..FITS).filter(|seed| fit(*seed).warning.is_some()).count();
            assert!((150..=250).contains(&warned), "{scales} scales: {warned}");
        }
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
