//! Fixed points of scalar maps: where the graph crosses the diagonal, and where it touches it.

use super::samples::samples_of;
use crate::error::Error;
use interval_arithmetic::{bracketed_root, golden_section_minimum};
use std::cell::Cell;

/// How the graph of f meets the diagonal at a fixed point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Intersection {
    /// The graph crosses the diagonal: f(x) − x changes sign. The fixed point persists under small changes of f.
    Transverse,
    /// The graph touches the diagonal: f(x) − x has an extremum that is zero to rounding. The fixed point attracts
    /// from one side at most, and small changes of f split or remove it.
    Tangent,
}

/// A fixed point of a scalar map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedPoint {
    /// The fixed point x.
    pub location: f64,
    /// f(x) − x as computed.
    pub residual: f64,
    /// How the graph meets the diagonal there.
    pub intersection: Intersection,
}

/// The extremum of f(x) − x counts as zero if it is at most this number of ulps of x. The rounding of f and of the
/// difference makes a few ulps; the value was chosen with a margin. A larger number would report near misses as tangent
/// points.
const TANGENT_ULPS: f64 = 8.0;

/// A sign change is a crossing if the residual is at most this part of the point's size. At a jump through the diagonal
/// the residual keeps the size of the jump; smaller jumps than this are taken for crossings. The root is found to an
/// ulp of x, and so the residual of a continuous map is about its slope times an ulp: crossings at slopes up to about
/// 10⁷ are found. A smaller number would lose steep crossings, and those of integrated maps, whose noise is far above
/// an ulp.
const CROSSING_RESIDUAL: f64 = 1e-8;

/// Most samples. Ten million evaluations of a return map take some minutes. A count far above this is a mistake,
/// such as a count of pixels that overflowed, and the search would not end in a usable time.
const MOST_SAMPLES: usize = 10_000_000;

/// The fixed points of `map` that `samples` equally spaced points of [left, right] reveal, from left to right.
///
/// A sign change of f(x) − x between neighbouring samples is refined to full precision. An extremum of f(x) − x is
/// refined by golden-section search and is a fixed point if it is zero to rounding. Two fixed points between
/// neighbouring samples may be missed. A fixed point beside a gap in the domain of the map, where `map` gives `None`,
/// may be missed too. A jump through the diagonal is not a fixed point.
///
/// ```
/// use return_map::{Intersection, fixed_points};
/// // x + x² touches the diagonal at 0. 2x(1 − x) crosses it at 0 and ½.
/// let tangent = fixed_points(|x| Some(x + x * x), -0.5, 0.4, 101)?;
/// assert_eq!(tangent[0].intersection, Intersection::Tangent);
/// assert!(tangent[0].location.abs() < 1e-8);
/// let transverse = fixed_points(|x| Some(2.0 * x * (1.0 - x)), -0.25, 1.1, 100)?;
/// assert!((transverse[1].location - 0.5).abs() < 1e-15);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadWindow`] for an empty or infinite window, for fewer than three samples, and for more than ten million.
pub fn fixed_points(
    map: impl Fn(f64) -> Option<f64>,
    left: f64,
    right: f64,
    samples: usize,
) -> Result<Vec<FixedPoint>, Error> {
    let at = samples_of((left, right), samples, MOST_SAMPLES)?;
    let gap = |x: f64| map(x).map(|image| image - x);
    let last = samples - 1;
    let mut found = Vec::new();
    // Three neighbouring samples are kept, so that the memory does not depend on their number.
    let (mut before, mut here) = (None, gap(left));
    for k in 0..samples {
        let after = if k < last { gap(at(k + 1)) } else { None };
        if here == Some(0.0) {
            found.push(fixed_sample(before, after, at(k)));
        }
        if let (Some(a), Some(b)) = (here, after)
            && (a < 0.0) != (b < 0.0)
            // A sample on the diagonal is reported by itself.
            && a != 0.0
            && b != 0.0
        {
            found.extend(transverse_point(gap, at(k), at(k + 1)));
        }
        if let (Some(a), Some(b), Some(c)) = (before, here, after) {
            // The middle sample is the nearest to the diagonal, and all three are on one side of it. The factor
            // `side` turns a maximum below the diagonal into a minimum.
            let side = b.signum();
            let one_sided = b != 0.0 && a * side > 0.0 && c * side > 0.0;
            if one_sided && b.abs() <= a.abs() && b.abs() < c.abs() {
                found.extend(tangent_point(|x| gap(x).map(|g| g * side), at(k - 1), at(k + 1)));
            }
        }
        (before, here) = (here, after);
    }
    found.sort_by(|a, b| a.location.total_cmp(&b.location));
    found.dedup_by(|a, b| a.location == b.location);
    Ok(found)
}

/// The fixed point at a sample with f(x) = x exactly, given f(x) − x at the neighbouring samples. It is tangent if both
/// are on one side of the diagonal. A neighbour without a value, or on the diagonal too, makes it transverse.
fn fixed_sample(before: Option<f64>, after: Option<f64>, location: f64) -> FixedPoint {
    let (before, after) = (before.unwrap_or(0.0), after.unwrap_or(0.0));
    let one_sided = before != 0.0 && after != 0.0 && before.signum() == after.signum();
    let intersection = if one_sided { Intersection::Tangent } else { Intersection::Transverse };
    FixedPoint { location, residual: 0.0, intersection }
}

/// The transverse fixed point between two samples on different sides; `None` at a jump or a gap.
fn transverse_point(gap: impl Fn(f64) -> Option<f64>, left: f64, right: f64) -> Option<FixedPoint> {
    let location = bracketed_root(|x| gap(x).unwrap_or(f64::NAN), left, right).ok()?;
    let residual = gap(location)?;
    // For a point near 0 the scale is the sample interval: relative to x itself no residual would be small.
    let scale = left.abs().max(right.abs()).max(right - left);
    (residual.abs() <= CROSSING_RESIDUAL * scale).then_some(FixedPoint {
        location,
        residual,
        intersection: Intersection::Transverse,
    })
}

/// The tangent fixed point at the minimum of `height` ≥ 0, by golden-section search; `None` if the minimum is not zero
/// to rounding, or if the map has a gap there.
fn tangent_point(height: impl Fn(f64) -> Option<f64>, left: f64, right: f64) -> Option<FixedPoint> {
    let gap = Cell::new(false);
    let location = golden_section_minimum(
        |x| {
            height(x).unwrap_or_else(|| {
                gap.set(true);
                f64::INFINITY
            })
        },
        left,
        right,
    );
    let residual = height(location).filter(|_| !gap.get())?;
    let rounding = TANGENT_ULPS * f64::EPSILON * location.abs().max(right - left);
    (residual.abs() <= rounding).then_some(FixedPoint {
        location,
        residual,
        intersection: Intersection::Tangent,
    })
}
