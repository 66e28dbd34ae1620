//! Fixed points of scalar maps: where the graph crosses the diagonal, and where it only touches.

use crate::Error;
use hybrid_system::bracketed_root;

/// How the graph meets the diagonal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Intersection {
    /// f(x) − x changes sign.
    Transverse,
    /// f(x) − x has an extremum of value zero, to rounding: stable from one side at most.
    Tangent,
}

/// A fixed point of a scalar map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedPoint {
    /// Where.
    pub location: f64,
    /// f(x) − x there.
    pub residual: f64,
    /// How the graph meets the diagonal there.
    pub intersection: Intersection,
}

/// Residuals up to this many ulps of x count as zero at a touch.
const TOUCH_ULPS: f64 = 8.0;

/// The fixed points of `map` that `samples` equally spaced points of [left, right] reveal.
///
/// Sign changes of f(x) − x between neighbours are refined to full precision; extrema of it are
/// refined by golden-section search and kept if they reach zero to rounding. Fixed points closer
/// than a sample interval may be missed, so may one beside a gap in the map's domain; a jump through
/// the diagonal is not a fixed point.
///
/// ```
/// use return_map::{Intersection, fixed_points};
/// // x + x² touches the diagonal at 0; 2x(1 − x) crosses it at 0 and ½.
/// let touch = fixed_points(|x| Some(x + x * x), -0.5, 0.4, 101)?;
/// assert_eq!(touch[0].intersection, Intersection::Tangent);
/// assert!(touch[0].location.abs() < 1e-8);
/// let crossings = fixed_points(|x| Some(2.0 * x * (1.0 - x)), -0.25, 1.1, 100)?;
/// assert!((crossings[1].location - 0.5).abs() < 1e-15);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadWindow`] for an empty window or fewer than three samples.
pub fn fixed_points(
    map: impl Fn(f64) -> Option<f64>,
    left: f64,
    right: f64,
    samples: usize,
) -> Result<Vec<FixedPoint>, Error> {
    if !(left < right) || !(right - left).is_finite() || samples < 3 {
        return Err(Error::BadWindow { left, right, samples });
    }
    let gap = |x: f64| map(x).map(|image| image - x);
    let at = |k: usize| left + (right - left) * (k as f64 / (samples - 1) as f64);
    let values: Vec<Option<f64>> = (0..samples).map(|k| gap(at(k))).collect();
    let mut found = Vec::new();
    for k in 0..samples {
        if values[k] == Some(0.0) {
            found.push(on_sample(&values, k, at(k)));
        }
        if let Some(&[Some(a), Some(b)]) = values.get(k..k + 2)
            && (a < 0.0) != (b < 0.0)
            && a != 0.0
            && b != 0.0
        {
            found.extend(crossing(gap, at(k), at(k + 1)));
        }
        if let Some(&[Some(a), Some(b), Some(c)]) = values.get(k..k + 3) {
            let side = b.signum();
            let one_sided = b != 0.0 && a * side > 0.0 && c * side > 0.0;
            if one_sided && b.abs() <= a.abs() && b.abs() < c.abs() {
                found.extend(touching(|x| gap(x).map(|g| g * side), at(k), at(k + 2)));
            }
        }
    }
    found.sort_by(|a, b| a.location.total_cmp(&b.location));
    found.dedup_by(|a, b| a.location == b.location);
    Ok(found)
}

/// A sample that hit a fixed point exactly: told apart by the neighbours' signs.
fn on_sample(values: &[Option<f64>], k: usize, location: f64) -> FixedPoint {
    let neighbour =
        |k: Option<usize>| k.and_then(|k| values.get(k).copied().flatten()).unwrap_or(0.0);
    let (before, after) = (neighbour(k.checked_sub(1)), neighbour(Some(k + 1)));
    let touches = before != 0.0 && after != 0.0 && before.signum() == after.signum();
    let intersection = if touches { Intersection::Tangent } else { Intersection::Transverse };
    FixedPoint { location, residual: 0.0, intersection }
}

fn crossing(gap: impl Fn(f64) -> Option<f64>, left: f64, right: f64) -> Option<FixedPoint> {
    let location = bracketed_root(|x| gap(x).unwrap_or(f64::NAN), left, right).ok()?;
    let residual = gap(location)?;
    // At a jump through the diagonal the residual stays large on both sides.
    let scale = left.abs().max(right.abs()).max(right - left);
    (residual.abs() <= 1e-8 * scale).then_some(FixedPoint {
        location,
        residual,
        intersection: Intersection::Transverse,
    })
}

/// Golden-section search for a minimum of `height` ≥ 0 that is zero to rounding.
fn touching(
    height: impl Fn(f64) -> Option<f64>,
    mut left: f64,
    mut right: f64,
) -> Option<FixedPoint> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let mut inner = [right - GOLDEN * (right - left), left + GOLDEN * (right - left)];
    let mut heights = [height(inner[0])?, height(inner[1])?];
    for _ in 0..120 {
        if heights[0] < heights[1] {
            right = inner[1];
            inner = [right - GOLDEN * (right - left), inner[0]];
            heights = [height(inner[0])?, heights[0]];
        } else {
            left = inner[0];
            inner = [inner[1], left + GOLDEN * (right - left)];
            heights = [heights[1], height(inner[1])?];
        }
    }
    let best = if heights[0] < heights[1] { 0 } else { 1 };
    let (location, residual) = (inner[best], heights[best]);
    let rounding = TOUCH_ULPS * f64::EPSILON * location.abs().max(right - left);
    (residual.abs() <= rounding).then_some(FixedPoint {
        location,
        residual,
        intersection: Intersection::Tangent,
    })
}
