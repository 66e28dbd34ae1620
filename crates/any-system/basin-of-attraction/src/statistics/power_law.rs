//! The exponent of a power law, with an interval from replicates.
//!
//! A measured law value ∝ scale^exponent has three errors, and only one of them is random:
//!
//! ```text
//!   chance        where the boxes lie, which starts were drawn     the replicates show it
//!   oscillation   a self-similar set has a factor with the period   slopes of parts of the range differ
//!                 of its ratio in ln scale; no replicate removes it
//!   drift         the law holds in the limit of small scales        slopes of parts of the range differ
//! ```
//!
//! The exponent is the slope of the line through (ln scale, ln mean value) with weights that fall to 0 at both ends of
//! the range: an oscillation then has little effect on it. Its interval adds, as independent errors:
//!
//! h² = (t s)² + (√2 d)², in which
//!
//! - t s is Student's interval over replicates. A replicate v_j enters by its effect on the slope, Σ c_j v_j/m_j, where
//!   m_j is the mean at scale j. Values of one replicate may be correlated as they like, and may be 0.
//! - d is the largest difference between the slopes of five halves of the range, from the coarse half to the fine half.
//!
//! Why d bounds oscillation: over half the range the slope is wrong by more than over all of it, and the five halves
//! see different phases. Few scales sample this coarsely: 4 of 5574 intervals (random sets, 8 to 40 scales) missed it.
//!
//! Why √2 d bounds drift: let the distance of the slope from its limit at least halve over half the range, so that it
//! falls by a factor ρ ≤ 1/√2 over a quarter. The coarse, the middle and the fine half are wrong by δ/ρ, δ and δρ, and
//! the whole range by about δ. So d = δ/ρ − δρ ≥ δ/√2. A drift that falls more slowly, and that is larger than
//! [`STEADY`] and than chance, gives no interval.

use crate::error::Error;
use crate::statistics::confidence_interval::{ConfidenceInterval, student_quantile};
use crate::statistics::least_squares::slope_coefficients;
use std::f64::consts::{FRAC_1_SQRT_2, LN_10};
use thiserror::Error;

/// A fit of value ∝ scale^exponent.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerLaw {
    /// The exponent: the slope of ln value against ln scale, with weights that fall to 0 at both ends of the range.
    pub exponent: f64,
    /// The 95 % interval of the exponent, or why there is none.
    pub interval: Result<ConfidenceInterval, NoInterval>,
    /// The smallest and the largest scale.
    pub range: (f64, f64),
    /// Slopes between neighbouring scales, from fine to coarse. If they drift, there is no single exponent.
    pub local: Vec<f64>,
}

/// Why an exponent has no interval.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum NoInterval {
    /// Chance cannot be seen in so few replicates.
    #[error(
        "{replicates} replicates: at least {FEWEST_REPLICATES} are needed, each with other offsets or seeds"
    )]
    FewReplicates {
        /// The number of replicates.
        replicates: usize,
    },
    /// Too few scales in all, or in a half of the range.
    #[error(
        "{scales} scales, {in_half} in the poorest half of the range: at least {FEWEST_SCALES} and \
         {FEWEST_SCALES_IN_HALF} are needed"
    )]
    FewScales {
        /// The number of scales.
        scales: usize,
        /// The number of scales in the half of the range that has fewest.
        in_half: usize,
    },
    /// The scales extend over less than three decades.
    #[error("{decades:.2} decades of scales: at least {FEWEST_DECADES} are needed")]
    ShortRange {
        /// The number of decades.
        decades: f64,
    },
    /// The slope changes over the range, and does not settle towards small scales.
    #[error(
        "the slope drifts from {coarse:.3} over {middle:.3} to {fine:.3} and does not settle: smaller scales are needed"
    )]
    Drifts {
        /// Slope of the coarse half.
        coarse: f64,
        /// Slope of the middle half.
        middle: f64,
        /// Slope of the fine half.
        fine: f64,
    },
}

/// Fits a power law to replicates, each a list of (scale, value).
///
/// A replicate is one complete measurement: the box counts at all scales for one random offset of the boxes, or the
/// uncertain fractions at all scales for one seed. The scales are the same in all replicates. Values of single
/// replicates may be 0. An exponent without an interval can be had from one replicate.
///
/// ```
/// // Ten measurements of a law with exponent 2. Each value is wrong by up to 5 %.
/// let random = basin_of_attraction::SplitMix64::from_seed(3);
/// let value = |r: u64, k: u64| 0.1f64.powi(2 * k as i32) * (0.95 + 0.1 * random.uniform(8 * r + k));
/// let replicate = |r| (0..8).map(|k| (0.1f64.powi(k as i32), value(r, k))).collect();
/// let replicates: Vec<Vec<(f64, f64)>> = (0..10).map(replicate).collect();
/// let law = basin_of_attraction::power_law(&replicates)?;
/// assert!(law.interval.is_ok_and(|interval| interval.covers(2.0) && interval.half_width() < 0.03));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadFit`] for fewer than three points in a replicate, scales that are not positive or whose logarithms are equal, and values
/// that are negative or not finite; [`Error::UnlikeReplicates`] for replicates with different scales;
/// [`Error::NothingFound`] if the value is 0 in all replicates at some scale.
pub fn power_law<R: AsRef<[(f64, f64)]>>(replicates: &[R]) -> Result<PowerLaw, Error> {
    let measured = Measured::new(replicates)?;
    let places = &measured.places;
    let whole = measured.slope(measured.window(0.0, 1.0));
    let local = places
        .windows(2)
        .zip(measured.heights.windows(2))
        .map(|(x, y)| (y[1] - y[0]) / (x[1] - x[0]))
        .collect();
    Ok(PowerLaw {
        exponent: whole.value,
        interval: measured.interval(&whole),
        range: measured.range,
        local,
    })
}

/// A smaller change of the slope is no drift: the interval contains it. A smaller number would refuse exact data for an
/// oscillation of a Cantor set over few scales (0.02). A larger one would give wide intervals instead of a reason.
const STEADY: f64 = 0.05;

/// With fewer scales a half of the range has fewer than four, and its slope depends on two of them.
const FEWEST_SCALES: usize = 8;

/// A half of an uneven range may have fewer scales than half of them. With two the slope would be that of a pair.
const FEWEST_SCALES_IN_HALF: usize = 3;

/// Over fewer decades a half of the range is shorter than two periods of a set with the ratio 1/5, and the five halves
/// do not bound its oscillation.
const FEWEST_DECADES: f64 = 3.0;

/// The number of decades may be too small by rounding, some ulps of it.
const ROUNDING_OF_DECADES: f64 = 1e-9;

/// Student's quantile for fewer replicates is above 3, and the spread of so few is too uncertain to weigh scales.
const FEWEST_REPLICATES: usize = 5;

/// Halves of the range whose slopes are compared. With three, the phases of an oscillation could agree.
const HALVES: usize = 5;

/// Replicates, sorted by scale.
struct Measured {
    /// ln scale, from fine to coarse.
    places: Vec<f64>,
    /// ln of the mean value.
    heights: Vec<f64>,
    /// Every value over the mean at its scale, less 1: the first-order error of ln value.
    errors: Vec<Vec<f64>>,
    /// The variance of each height.
    variances: Vec<f64>,
    range: (f64, f64),
}

/// The slope of a part of the range, and its coefficients of the heights.
struct Slope {
    value: f64,
    coefficients: Vec<f64>,
}

impl Measured {
    fn new<R: AsRef<[(f64, f64)]>>(replicates: &[R]) -> Result<Self, Error> {
        let sorted: Vec<Vec<(f64, f64)>> = replicates
            .iter()
            .map(|replicate| {
                let mut points = replicate.as_ref().to_vec();
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
                points
            })
            .collect();
        let first = sorted.first().ok_or(Error::TooFewReplicates { replicates: 0 })?;
        for (number, points) in sorted.iter().enumerate() {
            let good = |&(scale, value): &(f64, f64)| {
                scale > 0.0 && scale.is_finite() && value >= 0.0 && value.is_finite()
            };
            let distinct = points.windows(2).all(|p| pxfm::f_log(p[0].0) < pxfm::f_log(p[1].0));
            if points.len() < 3 || !distinct || !points.iter().all(good) {
                return Err(Error::BadFit { points: points.len() });
            }
            if !points.iter().map(|p| p.0).eq(first.iter().map(|p| p.0)) {
                return Err(Error::UnlikeReplicates { replicate: number });
            }
        }
        let count = sorted.len() as f64;
        let scales: Vec<f64> = first.iter().map(|point| point.0).collect();
        let mean = |at: usize| sorted.iter().map(|points| points[at].1 / count).sum::<f64>();
        let means: Vec<f64> = (0..scales.len()).map(mean).collect();
        if let Some(at) = means.iter().position(|mean| *mean <= 0.0) {
            return Err(Error::NothingFound { scale: scales[at] });
        }
        let relative = |points: &Vec<(f64, f64)>| {
            points.iter().zip(&means).map(|(point, mean)| point.1 / mean - 1.0).collect()
        };
        let errors: Vec<Vec<f64>> = sorted.iter().map(relative).collect();
        let variance = |at: usize| {
            let squares: f64 = errors.iter().map(|own| own[at] * own[at]).sum();
            squares / (count - 1.0).max(1.0) / count
        };
        Ok(Measured {
            variances: (0..scales.len()).map(variance).collect(),
            errors,
            heights: means.into_iter().map(pxfm::f_log).collect(),
            places: scales.iter().map(|scale| pxfm::f_log(*scale)).collect(),
            range: (scales[0], scales[scales.len() - 1]),
        })
    }

    /// The part of the range from `start` to `end`, in units of the range, in ln scale. The range extends beyond its
    /// first and last scale by half a spacing, so that these have a weight.
    fn window(&self, start: f64, end: f64) -> (f64, f64) {
        let (first, last) = (self.places[0], self.places[self.places.len() - 1]);
        let half = 0.5 * (last - first) / (self.places.len() - 1) as f64;
        let at = |part: f64| (first - half) + part * (last - first + 2.0 * half);
        (at(start), at(end))
    }

    /// The halves of the range, from fine to coarse.
    fn halves(&self) -> Vec<(f64, f64)> {
        let start = |number: usize| 0.5 * number as f64 / (HALVES - 1) as f64;
        (0..HALVES).map(start).map(|start| self.window(start, start + 0.5)).collect()
    }

    /// The slope over a window.
    ///
    /// The weight of a scale is sin² of its place in the window, over the variance of its height. sin² and its slope
    /// vanish at the ends: an oscillation with m periods in the window changes the slope by 1/m³ of its amplitude, not
    /// by 1/m as with equal weights. A variance from few replicates may be small by chance, so that the median of
    /// those above 0 is added.
    fn slope(&self, (start, end): (f64, f64)) -> Slope {
        let mut variances: Vec<f64> =
            self.variances.iter().copied().filter(|variance| *variance > 0.0).collect();
        variances.sort_by(f64::total_cmp);
        // Without any variance, as with one replicate or exact counts, all scales have the same.
        let floor = variances.get(variances.len() / 2).copied().unwrap_or(1.0);
        let weight = |(place, variance): (&f64, &f64)| {
            let part = (place - start) / (end - start);
            let sine = pxfm::f_sin(std::f64::consts::PI * part.clamp(0.0, 1.0));
            sine * sine * floor / (variance + floor)
        };
        let weights: Vec<f64> = self.places.iter().zip(&self.variances).map(weight).collect();
        let coefficients = slope_coefficients(&self.places, &weights);
        let value = coefficients.iter().zip(&self.heights).map(|(c, y)| c * y).sum();
        Slope { value, coefficients }
    }

    /// Half of Student's interval over replicates, of Σ c ln value.
    fn chance(&self, coefficients: &[f64]) -> f64 {
        let count = self.errors.len() as f64;
        let effect = |own: &Vec<f64>| coefficients.iter().zip(own).map(|(c, e)| c * e).sum::<f64>();
        let squares: f64 = self.errors.iter().map(|own| effect(own) * effect(own)).sum();
        student_quantile(self.errors.len() - 1) * (squares / (count - 1.0) / count).sqrt()
    }

    fn interval(&self, whole: &Slope) -> Result<ConfidenceInterval, NoInterval> {
        let (replicates, scales) = (self.errors.len(), self.places.len());
        if replicates < FEWEST_REPLICATES {
            return Err(NoInterval::FewReplicates { replicates });
        }
        let decades = (self.places[scales - 1] - self.places[0]) / LN_10;
        if decades < FEWEST_DECADES * (1.0 - ROUNDING_OF_DECADES) {
            return Err(NoInterval::ShortRange { decades });
        }
        let inside = |(start, end): (f64, f64)| {
            self.places.iter().filter(|place| start < **place && **place < end).count()
        };
        let in_half = self.halves().into_iter().map(inside).min().unwrap_or(0);
        if scales < FEWEST_SCALES || in_half < FEWEST_SCALES_IN_HALF {
            return Err(NoInterval::FewScales { scales, in_half });
        }
        let halves: Vec<Slope> = self.halves().into_iter().map(|half| self.slope(half)).collect();
        let (fine, middle, coarse) = (&halves[0], &halves[HALVES / 2], &halves[HALVES - 1]);
        let difference: Vec<f64> =
            coarse.coefficients.iter().zip(&fine.coefficients).map(|(a, b)| a - b).collect();
        let (late, early) = (middle.value - fine.value, coarse.value - middle.value);
        let large = (late + early).abs() > STEADY.max(self.chance(&difference));
        // A drift settles if its second part is at most 1/√2 of its first, or goes the other way.
        if large && late * early.signum() > FRAC_1_SQRT_2 * early.abs() {
            return Err(NoInterval::Drifts {
                coarse: coarse.value,
                middle: middle.value,
                fine: fine.value,
            });
        }
        let slopes = || halves.iter().map(|slope| slope.value);
        let spread =
            slopes().fold(f64::NEG_INFINITY, f64::max) - slopes().fold(f64::INFINITY, f64::min);
        let chance = self.chance(&whole.coefficients);
        let half = (chance * chance + 2.0 * spread * spread).sqrt();
        let value = whole.value;
        Ok(ConfidenceInterval { value, lower: value - half, upper: value + half })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::split_mix::SplitMix64;

    /// Ten copies of a law at `scales`, each value wrong by up to one part in a thousand.
    fn measured(law: impl Fn(f64) -> f64, scales: &[f64]) -> Vec<Vec<(f64, f64)>> {
        let random = SplitMix64::from_seed(5);
        let value = |r: usize, k: usize| {
            let error = 1e-3 * (2.0 * random.uniform((100 * r + k) as u64) - 1.0);
            (scales[k], law(scales[k]) * (1.0 + error))
        };
        (0..10).map(|r| (0..scales.len()).map(|k| value(r, k)).collect()).collect()
    }

    fn scales(count: i32, per_decade: i32) -> Vec<f64> {
        (0..count).map(|k| pxfm::f_exp10(-f64::from(k) / f64::from(per_decade))).collect()
    }

    #[test]
    fn an_exponent_without_an_interval_has_the_reason() {
        let law = |x: f64| x * x;
        let reason = |replicates: &[Vec<(f64, f64)>]| {
            let law = power_law(replicates).unwrap();
            assert!((law.exponent - 2.0).abs() < 1e-2, "{law:?}");
            law.interval.unwrap_err()
        };
        let good = measured(law, &scales(13, 4));
        assert_eq!(reason(&good[..4]), NoInterval::FewReplicates { replicates: 4 });
        assert_eq!(
            reason(&measured(law, &scales(7, 2))),
            NoInterval::FewScales { scales: 7, in_half: 3 }
        );
        assert!(
            matches!(reason(&measured(law, &scales(12, 4))), NoInterval::ShortRange { decades } if decades < 2.76)
        );
        // Seven scales in the first decade, and two far away.
        let mut uneven = scales(7, 10);
        uneven.extend([1e-4, 1e-5]);
        assert!(matches!(
            reason(&measured(law, &uneven)),
            NoInterval::FewScales { scales: 9, in_half: 0..3 }
        ));
        let text = reason(&good[..1]).to_string();
        assert!(text.contains("1 replicates") && text.contains("at least 5"), "{text}");
    }

    #[test]
    fn a_drift_that_does_not_settle_has_no_interval() {
        // The slope of x + 1000x² changes from 2 to 1 in the middle of the range.
        let bend = power_law(&measured(|x| x + 1e3 * x * x, &scales(25, 4))).unwrap();
        let Err(NoInterval::Drifts { coarse, middle, fine }) = bend.interval else {
            panic!("{bend:?}")
        };
        assert!(coarse > 1.8 && fine < 1.2 && (middle - 1.5).abs() < 0.1);
        // With the corner at the coarse end the slope settles, and its limit is inside.
        let settled = power_law(&measured(|x| x + x * x, &scales(25, 4))).unwrap();
        assert!(settled.interval.is_ok_and(|i| i.covers(1.0)), "{settled:?}");
    }

    #[test]
    fn the_interval_contains_an_oscillation_that_no_replicate_removes() {
        // A factor with three periods in a decade: replicates agree on a slope that is wrong by more than their spread.
        let law =
            |x: f64| pxfm::f_pow(x, 0.6) * (1.0 + 0.1 * pxfm::f_sin(6.0 * pxfm::f_log(x) + 1.0));
        let fit = power_law(&measured(law, &scales(25, 7))).unwrap();
        let interval = fit.interval.unwrap();
        assert!((fit.exponent - 0.6).abs() > 1e-3, "{fit:?}");
        assert!(interval.covers(0.6) && interval.half_width() < 0.1, "{fit:?}");
    }

    #[test]
    fn a_value_of_few_counts_weighs_less() {
        // At the three finest scales half of the replicates find nothing, the others twice as much as the law.
        let mut replicates = measured(|x| x, &scales(16, 5));
        for (number, points) in replicates.iter_mut().enumerate() {
            let factor = if number % 2 == 0 { 0.0 } else { 2.1 };
            points[13..].iter_mut().for_each(|point| point.1 *= factor);
        }
        let law = power_law(&replicates).unwrap();
        // Five per cent at the finest scales: with the weight of the others the exponent would be wrong by 0.004.
        assert!((law.exponent - 1.0).abs() < 1e-3, "{law:?}");
    }

    #[test]
    fn bad_points_are_errors() {
        let fit = |points: &[(f64, f64)]| power_law(&[points]).unwrap_err();
        let next = 1e9f64.next_up();
        assert_eq!(fit(&[(1e9, 1.0), (next, 2.0), (2e9, 2.0)]), Error::BadFit { points: 3 });
        assert_eq!(fit(&[(1.0, 1.0), (2.0, -1.0), (3.0, 2.0)]), Error::BadFit { points: 3 });
        assert_eq!(fit(&[(1.0, 1.0), (2.0, f64::NAN), (3.0, 2.0)]), Error::BadFit { points: 3 });
        assert_eq!(fit(&[(1.0, 1.0), (2.0, 0.0), (3.0, 2.0)]), Error::NothingFound { scale: 2.0 });
        let none: [&[(f64, f64)]; 0] = [];
        assert_eq!(power_law(&none).unwrap_err(), Error::TooFewReplicates { replicates: 0 });
        let two = [3.0, 4.0].map(|last| [(1.0, 1.0), (2.0, 2.0), (last, 3.0)]);
        assert_eq!(power_law(&two).unwrap_err(), Error::UnlikeReplicates { replicate: 1 });
    }
}
