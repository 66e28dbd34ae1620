//! Critical points of a map of one variable.

use crate::families::{MapFamily, image_of};
use equations::Jet;
use interval_arithmetic::{bracketed_root, golden_section_minimum};

/// A critical point at which the map turns.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extremum {
    /// Where: to the rounding of the derivative over the second derivative. At a kink that the map does not name, to the root of rounding.
    pub at: f64,
    /// The image there.
    pub value: f64,
    /// True for a maximum.
    pub is_maximum: bool,
}

/// Between two points at which the derivative may turn in between, so many further ones are looked at, in halves.
const DEEPEST: usize = 12;

/// A point with the derivative and its slope.
#[derive(Clone, Copy)]
struct Slope {
    at: f64,
    first: f64,
    second: f64,
}

/// The critical points of a piece that some of its points, in ascending order, reveal.
pub(super) fn extrema<M: MapFamily + ?Sized>(
    map: &M,
    parameter: f64,
    points: &[f64],
    itinerary: &[String],
) -> Vec<Extremum> {
    let slope = |at: f64| {
        let jet =
            map.pushed(&[Jet::moving(at, 1.0)], Jet::number(parameter)).ok()?.curve.first()?.0;
        let is_known = jet[1].is_finite() && jet[2].is_finite();
        is_known.then_some(Slope { at, first: jet[1], second: 2.0 * jet[2] })
    };
    let mut found = Vec::new();
    let mut before: Option<Slope> = None;
    // A piece of few points is looked at inside.
    let inner = |k: usize| points[0] + (points[points.len() - 1] - points[0]) * (k as f64 / 8.0);
    let mut places: Vec<f64> = points.to_vec();
    if points.len() < 8 {
        places.extend((1..8).map(inner));
        places.sort_by(f64::total_cmp);
        places.dedup();
    }
    for place in places {
        // At the border itself a derivative may be missing.
        let Some(here) = slope(place) else { continue };
        if let Some(before) = before {
            turns(&slope, (before, here), DEEPEST, &mut |(left, right)| {
                let value = |x: f64| slope(x).map_or(f64::NAN, |slope| slope.first);
                let is_maximum = left.first > 0.0 || right.first < 0.0;
                let at = bracketed_root(value, left.at, right.at).unwrap_or_else(|_| {
                    // At a kink, which the map does not name, the derivative has no zero.
                    let side = if is_maximum { -1.0 } else { 1.0 };
                    let value = |x: f64| {
                        image_of(map, &[x], parameter)
                            .map_or(f64::INFINITY, |at| side * at.point[0])
                    };
                    golden_section_minimum(value, left.at, right.at)
                });
                let Ok(image) = image_of(map, &[at], parameter) else { return };
                if image.itinerary == itinerary {
                    found.push(Extremum { at, value: image.point[0], is_maximum });
                }
            });
        }
        before = Some(here);
    }
    found.dedup_by(|a, b| a.at == b.at);
    found
}

/// Finds the pairs of points between which the derivative changes its sign.
fn turns(
    slope: &impl Fn(f64) -> Option<Slope>,
    (left, right): (Slope, Slope),
    depth: usize,
    found: &mut impl FnMut((Slope, Slope)),
) {
    if (left.first > 0.0) != (right.first > 0.0) {
        // A zero at the left end belongs to the interval before.
        if left.first != 0.0 {
            found((left, right));
        }
        return;
    }
    let width = right.at - left.at;
    let middle = left.at + 0.5 * width;
    if depth == 0 || !dips(left, right) || middle <= left.at || middle >= right.at {
        return;
    }
    if let Some(middle) = slope(middle) {
        turns(slope, (left, middle), depth - 1, found);
        turns(slope, (middle, right), depth - 1, found);
    }
}

/// True if the cubic with the same values and slopes has another sign in between.
fn dips(left: Slope, right: Slope) -> bool {
    let width = right.at - left.at;
    let (p, q) = (left.second * width, right.second * width);
    (1..8).any(|k| {
        let s = f64::from(k) / 8.0;
        let (r, d) = (1.0 - s, s * (1.0 - s));
        let value = left.first * r * r * (1.0 + 2.0 * s)
            + right.first * s * s * (1.0 + 2.0 * r)
            + d * (r * p - s * q);
        (value > 0.0) != (left.first > 0.0)
    })
}
