//! Derivatives of a map along a curve, by differences.

use super::family::{Image, MapFamily};
use crate::error::Error;
use equations::{Jet, horner};

/// The distance of the values of a difference, on the scale of the point. With seven values an error of order h⁶ is left in the
/// first derivative, 2·10⁻¹³, as large as the rounding of the values over h. The third derivative has one of order h⁴. A smaller
/// number would spread the noise of integrated maps.
const REACH: f64 = 1.0 / 128.0;

/// Where some value lies beyond a border of the map, or the first derivative is not sure, the distance is made so much shorter, at
/// most so often.
const SHORTER: f64 = 1.0 / 8.0;
const MOST_SHORTENINGS: usize = 4;

/// Two derivatives, of which one has half the distance of the other, agree to this where neither the terms left out nor noise count.
/// A larger number would accept distances that are too long for the map, a smaller one would look in vain for better ones.
const SURE: f64 = 1e-10;

/// A first derivative that is less sure than this is refused: the map has none, or its noise hides it.
const USELESS: f64 = 1e-3;

/// Derivatives, and by how much a first one changes with the distance of the values, on the scale of the image.
type Estimated = (Vec<Jet<4>>, f64);

/// The image of a curve to third order, by differences.
pub(super) fn pushed<M: MapFamily + ?Sized>(
    map: &M,
    curve: &[Jet<4>],
    parameter: Jet<4>,
) -> Result<Vec<Jet<4>>, Error> {
    let jets = || curve.iter().chain([&parameter]);
    // In this unit of s no term of a component moves it by more than its own size, or 1.
    let unit = jets().fold(f64::INFINITY, |unit: f64, jet| {
        let [here, first, second, third] = jet.0.map(f64::abs);
        let size = here.max(1.0);
        unit.min(size / first).min((size / second).sqrt()).min(pxfm::f_cbrt(size / third))
    });
    let of = |s: f64| -> Result<Image, Error> {
        let point: Vec<f64> = curve.iter().map(|jet| horner(&jet.0, s)).collect();
        map.image(&point, horner(&parameter.0, s))
    };
    let here = of(0.0)?;
    if unit == f64::INFINITY {
        return Ok(here.point.into_iter().map(|value| Jet([value, 0.0, 0.0, 0.0])).collect());
    }
    let mut h = REACH * unit;
    let mut best: Option<Estimated> = None;
    for _ in 0..=MOST_SHORTENINGS {
        let found = difference(&of, &here, h)
            .or_else(|| one_sided(&of, &here, h))
            .or_else(|| one_sided(&of, &here, -h));
        if let Some((jets, change)) = found {
            // In units of s that move the point by its own size.
            let change = change * unit;
            let is_better = best.as_ref().is_none_or(|(_, before)| change < *before);
            if is_better {
                best = Some((jets, change));
            }
            // From here on shorter distances add noise.
            if change <= SURE
                || !is_better && best.as_ref().is_some_and(|(_, before)| *before < USELESS)
            {
                break;
            }
        }
        h *= SHORTER;
    }
    if let Some((jets, _)) = best.filter(|(_, change)| *change < USELESS) {
        return Ok(jets);
    }
    let point: Vec<f64> = curve.iter().map(|jet| jet.0[0]).collect();
    Err(Error::Differences { point, parameter: parameter.0[0], distance: h / SHORTER })
}

/// The largest change of a first derivative between two distances, over the size of the component.
fn change(coarse: &[Jet<4>], fine: &[Jet<4>]) -> f64 {
    let of = |(a, b): (&Jet<4>, &Jet<4>)| {
        let size = a.0[0].abs().max(1.0).max(a.0[1].abs());
        (a.0[1] - b.0[1]).abs() / size
    };
    coarse.iter().zip(fine).map(of).fold(0.0, f64::max)
}

/// The derivatives from values on one side, next to a border of the map.
fn one_sided(of: &impl Fn(f64) -> Result<Image, Error>, here: &Image, h: f64) -> Option<Estimated> {
    let coarse = seven_on_one_side(of, here, 0.5 * h)?;
    let fine = seven_on_one_side(of, here, 0.25 * h)?;
    let change = change(&coarse, &fine);
    Some((coarse, change))
}

/// The derivatives from seven values on one side, at multiples of h.
fn seven_on_one_side(
    of: &impl Fn(f64) -> Result<Image, Error>,
    here: &Image,
    h: f64,
) -> Option<Vec<Jet<4>>> {
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
    Some((0..here.point.len()).map(of_component).collect())
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
    let change = change(&coarse, &fine);
    Some((coarse, change))
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
