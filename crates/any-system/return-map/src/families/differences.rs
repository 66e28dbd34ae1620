//! Derivatives of a map along a curve, by differences.

use super::derivatives::Pushed;
use super::family::Image;
use crate::error::Error;
use equations::{Jet, horner};

/// The distance of the values of a difference, on the scale of the point. With seven values an error of order h⁶ is left in the
/// first derivative, 2·10⁻¹³, as large as the rounding of the values over h. The third derivative has one of order h⁴. A smaller
/// number would spread the noise of integrated maps. It is no simple fraction: a periodic term would have the same phase at all values.
const REACH: f64 = 0.007_639_320_225;

/// Where some value lies beyond a border of the map, or the derivatives are not sure, the distance is made so much shorter, at most so
/// often: down to 10⁻¹⁰ of the point. So a map of small numbers, or of small features at large ones, has derivatives.
const SHORTER: f64 = 1.0 / 8.0;
const MOST_SHORTENINGS: usize = 9;

/// Derivatives at two distances, of which one is half of the other, agree to this where neither the terms left out nor noise count.
/// A larger number would accept distances that are too long for the map, a smaller one would look in vain for better ones.
const SURE: f64 = 1e-10;

/// With derivatives that agree to this a shorter distance that is worse ends the search: noise counts.
const USEFUL: f64 = 1e-6;

/// Derivatives that are less sure than this are refused: the map has none, or its noise hides them.
const USELESS: f64 = 1e-3;

/// Derivatives from values at distances up to some h, and how far they may be off.
struct Estimated {
    jets: Vec<Jet<4>>,
    /// By how much the first two change with the distance, over the slope of the values.
    change: f64,
    /// How far the first derivatives may be off: by that, and by the rounding of the values.
    errors: Vec<f64>,
}

impl Estimated {
    /// `fine` are the derivatives at half of the distance. `rounding` is that of the value at a distance h, in first derivatives.
    fn new(
        (jets, fine): (Vec<Jet<4>>, &[Jet<4>]),
        change: f64,
        slopes: &[f64],
        (h, rounding): (f64, f64),
    ) -> Estimated {
        let of = |((jet, fine), slope): ((&Jet<4>, &Jet<4>), &f64)| {
            let [value, first, ..] = jet.0.map(f64::abs);
            // Noise of some roundings does not count as a change of the derivative, but as an error of it.
            let apart = (jet.0[1] - fine.0[1]).abs();
            change * slope.max(first)
                + 2.0 * apart
                + rounding * f64::EPSILON * (value / h.abs() + first)
        };
        let errors = jets.iter().zip(fine).zip(slopes).map(of).collect();
        Estimated { jets, change, errors }
    }
}

/// So many roundings of a value are in a first derivative, of values on both sides and on one side: those of a simple map, times the weights
/// of its values.
const BOTH_SIDES: f64 = 4.0;
const ONE_SIDE: f64 = 16.0;

/// The image of a curve to third order, by differences of images of points.
pub(crate) fn differences(
    image: &impl Fn(&[f64], f64) -> Result<Image, Error>,
    curve: &[Jet<4>],
    parameter: Jet<4>,
) -> Result<Pushed, Error> {
    let jets = || curve.iter().chain([&parameter]);
    // In this unit of s no term of a component moves it by more than its own size, or 1.
    let unit = jets().fold(f64::INFINITY, |unit: f64, jet| {
        let [here, first, second, third] = jet.0.map(f64::abs);
        let size = here.max(1.0);
        unit.min(size / first).min((size / second).sqrt()).min(pxfm::f_cbrt(size / third))
    });
    let of = |s: f64| -> Result<Image, Error> {
        let point: Vec<f64> = curve.iter().map(|jet| horner(&jet.0, s)).collect();
        image(&point, horner(&parameter.0, s))
    };
    let here = of(0.0)?;
    if unit == f64::INFINITY {
        return Ok(Pushed::exact(here.point.into_iter().map(Jet::number).collect()));
    }
    let mut h = REACH * unit;
    let mut best: Option<Estimated> = None;
    for _ in 0..=MOST_SHORTENINGS {
        let found = difference(&of, &here, h)
            .or_else(|| one_sided(&of, &here, h))
            .or_else(|| one_sided(&of, &here, -h));
        if let Some(found) = found {
            let change = found.change;
            let before = best.as_ref().map_or(f64::INFINITY, |best| best.change);
            let is_better = change < before;
            if is_better {
                best = Some(found);
            }
            if change <= SURE || !is_better && before <= USEFUL {
                break;
            }
        }
        h *= SHORTER;
    }
    if let Some(best) = best.filter(|best| best.change < USELESS) {
        return Ok(Pushed { curve: best.jets, errors: best.errors });
    }
    let point: Vec<f64> = curve.iter().map(|jet| jet.0[0]).collect();
    Err(Error::Differences { point, parameter: parameter.0[0], distance: h / SHORTER })
}

/// A change of derivatives of so many roundings of the values is none.
const NOISE: f64 = 32.0;

/// The largest change of the first two derivatives from a distance h to half of it, over the slope of the values. A second derivative counts by
/// what it does to the first one within h: at a kink, and at a feature that is narrower than all distances, it changes with the distance
/// though the first derivative may not.
fn change(coarse: &[Jet<4>], fine: &[Jet<4>], slopes: &[f64], h: f64) -> f64 {
    let of = |((a, b), slope): ((&Jet<4>, &Jet<4>), &f64)| {
        let noise = f64::EPSILON * a.0[0].abs() / h.abs();
        let off = (a.0[1] - b.0[1]).abs().max((h * (a.0[2] - b.0[2])).abs());
        // Values that do not differ but by rounding have no slope.
        if off <= NOISE * noise { 0.0 } else { off / slope.max(a.0[1].abs()) }
    };
    coarse.iter().zip(fine).zip(slopes).map(of).fold(0.0, f64::max)
}

/// The place of a value that no difference uses, in units of h: between two of them, in no simple ratio to any.
const ASIDE: f64 = 0.732_050_807_568_877_2;

/// How far a value at s is from that which the derivatives let expect, over s and the slope of the values.
fn off_expected(jets: &[Jet<4>], found: &[f64], slopes: &[f64], s: f64) -> f64 {
    let of = |((jet, found), slope): ((&Jet<4>, &f64), &f64)| {
        let off = (horner(&jet.0, s) - found).abs();
        let noise = f64::EPSILON * found.abs();
        if off <= NOISE * noise { 0.0 } else { off / (s.abs() * slope.max(jet.0[1].abs())) }
    };
    jets.iter().zip(found).zip(slopes).map(of).fold(0.0, f64::max)
}

/// The slope of the values, for each component: the largest difference from that here, over the distance `reach` of the farthest.
fn steepest<'v>(here: &[f64], values: impl Iterator<Item = &'v Vec<f64>>, reach: f64) -> Vec<f64> {
    let mut largest = vec![0.0f64; here.len()];
    for value in values {
        for ((largest, x), here) in largest.iter_mut().zip(value).zip(here) {
            *largest = largest.max((x - here).abs());
        }
    }
    largest.iter().map(|largest| largest / reach.abs()).collect()
}

/// The derivatives from values on one side, next to a border of the map.
fn one_sided(of: &impl Fn(f64) -> Result<Image, Error>, here: &Image, h: f64) -> Option<Estimated> {
    let (coarse, slopes) = seven_on_one_side(of, here, 0.5 * h)?;
    let (fine, _) = seven_on_one_side(of, here, 0.25 * h)?;
    let change = change(&coarse, &fine, &slopes, 0.5 * h);
    Some(Estimated::new((coarse, &fine), change, &slopes, (0.5 * h, ONE_SIDE)))
}

/// The derivatives from seven values on one side, at multiples of h, and the slopes of the values.
fn seven_on_one_side(
    of: &impl Fn(f64) -> Result<Image, Error>,
    here: &Image,
    h: f64,
) -> Option<(Vec<Jet<4>>, Vec<f64>)> {
    let mut values = vec![here.point.clone()];
    for k in 1..=6 {
        let image = of(f64::from(k) * h).ok().filter(|image| image.itinerary == here.itinerary)?;
        values.push(image.point);
    }
    let of_component = |axis: usize| {
        let mut row: Vec<f64> = values.iter().map(|value| value[axis]).collect();
        let mut d = [0.0; 7];
        for place in &mut d {
            *place = row[0];
            row = row.windows(2).map(|pair| pair[1] - pair[0]).collect();
            row.push(0.0);
        }
        let first = d[1] - d[2] / 2.0 + d[3] / 3.0 - d[4] / 4.0 + d[5] / 5.0 - d[6] / 6.0;
        let second = d[2] - d[3] + 11.0 / 12.0 * d[4] - 5.0 / 6.0 * d[5] + 137.0 / 180.0 * d[6];
        let third = d[3] - 1.5 * d[4] + 1.75 * d[5] - 1.875 * d[6];
        Jet([here.point[axis], first / h, second / (2.0 * h * h), third / (6.0 * h * h * h)])
    };
    let jets = (0..here.point.len()).map(of_component).collect();
    Some((jets, steepest(&here.point, values.iter(), 6.0 * h)))
}

/// The derivatives from values on both sides; `None` if one of them is missing, or is on another piece of the map.
fn difference(
    of: &impl Fn(f64) -> Result<Image, Error>,
    here: &Image,
    h: f64,
) -> Option<Estimated> {
    let value = |s: f64| of(s).ok().filter(|image| image.itinerary == here.itinerary);
    let mut pairs = Vec::with_capacity(4);
    for j in [4.0, 2.0, 1.0, 0.5] {
        pairs.push([value(j * h)?.point, value(-j * h)?.point]);
    }
    let coarse = seven_on_both_sides(&here.point, &pairs[..3], h);
    let fine = seven_on_both_sides(&here.point, &pairs[1..], 0.5 * h);
    let slopes = steepest(&here.point, pairs.iter().flatten(), 4.0 * h);
    let change = change(&coarse, &fine, &slopes, h);
    // A term whose period divides the distance is seen at no pair: another one is asked.
    let sides = [ASIDE, -ASIDE].map(|j| (j * h, value(j * h)));
    let off = sides.into_iter().try_fold(0.0, |off: f64, (s, found)| {
        Some(off.max(off_expected(&fine, &found?.point, &slopes, s)))
    })?;
    Some(Estimated::new((coarse, &fine), change.max(off), &slopes, (h, BOTH_SIDES)))
}

/// The derivatives from the value and the pairs of values at ±4h, ±2h and ±h.
fn seven_on_both_sides(here: &[f64], pairs: &[[Vec<f64>; 2]], h: f64) -> Vec<Jet<4>> {
    let of_component = |(k, &value): (usize, &f64)| {
        let [odd4, odd2, odd1] = [0, 1, 2].map(|j| 0.5 * (pairs[j][0][k] - pairs[j][1][k]));
        let [even4, even2, even1] =
            [0, 1, 2].map(|j| 0.5 * ((pairs[j][0][k] - value) + (pairs[j][1][k] - value)));
        // odd_j = j a + j³ b + j⁵ c, with a = h f′, b = h³ f‴/6.
        let c = ((odd4 - 2.0 * odd2) - 8.0 * (odd2 - 2.0 * odd1)) / 720.0;
        let b = (odd2 - 2.0 * odd1 - 30.0 * c) / 6.0;
        let a = odd1 - b - c;
        // even_j = j² p + j⁴ q + j⁶ r, with p = h² f″/2.
        let r = ((even4 - 4.0 * even2) - 16.0 * (even2 - 4.0 * even1)) / 2880.0;
        let q = (even2 - 4.0 * even1 - 60.0 * r) / 12.0;
        let p = even1 - q - r;
        Jet([value, a / h, p / (h * h), b / (h * h * h)])
    };
    here.iter().enumerate().map(of_component).collect()
}
