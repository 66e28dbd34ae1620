//! Stability of a fixed point, from one side at a time.

/// A side of a fixed point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// x < x*.
    Left,
    /// x > x*.
    Right,
}

/// The stability of a fixed point on one side of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stability {
    /// Every probed point stays on its side and moves closer.
    Attracting,
    /// Every probed point stays on its side and moves away.
    Repelling,
    /// Some points move closer and others away; or a point changes sides, does not move, or has no image; or no
    /// point was probed.
    Undecided,
}

/// The behaviour of a map on one side of a fixed point, probed at a geometric sequence of distances.
#[derive(Debug, Clone, PartialEq)]
pub struct OneSidedStability {
    /// The side.
    pub side: Side,
    /// The stability over all distances.
    pub stability: Stability,
    /// Pairs (δ, δ − δ′) of a distance and its decrease in one step; the decrease is negative if the distance grows.
    /// The pairs run from the largest δ to the smallest. Points that change sides or have no image are left out. At
    /// most 2098 distances exist.
    pub approach: Vec<(f64, f64)>,
}

impl OneSidedStability {
    /// p and c of |δ − δ′| ≈ c δ^p, from the two smallest distances; `None` unless both shrink or both grow.
    ///
    /// p = 1 means a geometric approach (or departure), p > 1 an algebraic one.
    pub fn power_law(&self) -> Option<(f64, f64)> {
        let [.., (far, far_step), (near, near_step)] = self.approach[..] else { return None };
        let ratio = far_step / near_step;
        if !(ratio > 0.0) || !ratio.is_finite() {
            return None;
        }
        let exponent = pxfm::f_log2(ratio) / pxfm::f_log2(far / near);
        Some((exponent, near_step.abs() / pxfm::f_pow(near, exponent)))
    }
}

/// Probes one side of a fixed point.
///
/// `displacement` is the map in the coordinate δ = |x − x*|. It maps a distance to the distance of the image on the
/// same side. The result is negative if the image is on the other side, and `None` if there is no image. A model
/// that knows its map near the fixed point can compute it without cancellation. `count` distances are probed:
/// `largest`, its half, its quarter and so on. The sequence ends at the smallest positive number, after 2098
/// halvings at most: a larger `count` probes no more. If `largest` is not positive and finite, no distance is
/// probed.
///
/// ```
/// use return_map::{Side, Stability, one_sided_stability};
/// // The fixed point 0 of x + x² attracts from the left and repels to the right.
/// let left = one_sided_stability(|d| Some(d - d * d), Side::Left, 0.1, 10);
/// assert_eq!(left.stability, Stability::Attracting);
/// let (exponent, coefficient) = left.power_law().unwrap();
/// assert!((exponent - 2.0).abs() < 1e-9 && (coefficient - 1.0).abs() < 1e-9);
/// let right = one_sided_stability(|d| Some(d + d * d), Side::Right, 0.1, 10);
/// assert_eq!(right.stability, Stability::Repelling);
/// ```
pub fn one_sided_stability(
    displacement: impl Fn(f64) -> Option<f64>,
    side: Side,
    largest: f64,
    count: usize,
) -> OneSidedStability {
    let mut approach = Vec::new();
    let (mut nearer, mut farther, mut other) = (0, 0, 0);
    let mut distance = largest;
    for _ in 0..count {
        // Half of the smallest positive number rounds to 0, which is the fixed point itself.
        if !(distance > 0.0 && distance.is_finite()) {
            break;
        }
        match displacement(distance) {
            Some(image) if image >= 0.0 => {
                approach.push((distance, distance - image));
                match image.total_cmp(&distance) {
                    std::cmp::Ordering::Less => nearer += 1,
                    std::cmp::Ordering::Greater => farther += 1,
                    std::cmp::Ordering::Equal => other += 1,
                }
            }
            _ => other += 1,
        }
        distance *= 0.5;
    }
    let stability = match (nearer, farther, other) {
        (1.., 0, 0) => Stability::Attracting,
        (0, 1.., 0) => Stability::Repelling,
        _ => Stability::Undecided,
    };
    OneSidedStability { side, stability, approach }
}
