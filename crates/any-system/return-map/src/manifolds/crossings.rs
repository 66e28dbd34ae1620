//! Where two manifolds meet: homoclinic and heteroclinic points.

use super::chords::meeting;
use super::curve::ManifoldCurve;
use super::manifold::UnstableManifold;
use crate::checks::check_dimension;
use crate::error::Error;
use crate::families::MapFamily;
use nalgebra::{Matrix2, Vector2};

/// A point on both of two manifolds in the plane: of a stable and an unstable one, a homoclinic or heteroclinic point.
#[derive(Debug, Clone, PartialEq)]
pub struct ManifoldCrossing {
    /// The point.
    pub point: [f64; 2],
    /// Its numbers t on both manifolds.
    pub numbers: [f64; 2],
    /// The angle between them, in radians, from 0 to π/2. Near a tangency it is small.
    pub angle: f64,
    /// How far the points of both manifolds with these numbers are apart.
    pub error: f64,
}

/// Newton steps from the crossing of two chords.
const MOST_STEPS: usize = 30;

/// A crossing is exact if both points are as close as this, on their scale.
const EXACT: f64 = 1e-11;

/// The points at which two manifolds in the plane cross, between points of their curves, in the order of the first. Each is solved
/// for on both manifolds. Two crossings between neighbouring points of a curve may be missed. Manifolds that coincide have none: at a
/// crossing the angle must be known, and tell where it is between the points.
///
/// The saddles themselves are no crossings: they are at the ends. Neither are points that are closer to a saddle than its first point.
///
/// # Errors
/// [`hybrid_system::Error::Dimension`] for manifolds that are not in the plane; [`Error::Stopped`].
pub fn manifold_crossings<A: MapFamily + ?Sized, B: MapFamily + ?Sized>(
    (first, curve): (&UnstableManifold<'_, A>, &ManifoldCurve),
    (second, other): (&UnstableManifold<'_, B>, &ManifoldCurve),
) -> Result<Vec<ManifoldCrossing>, Error> {
    for saddle in [first.saddle(), second.saddle()] {
        check_dimension("a saddle whose manifolds may cross", 2, saddle.point.len())?;
    }
    let mut found: Vec<ManifoldCrossing> = Vec::new();
    for (k, j) in meeting(&curve.chords(), &other.chords()) {
        let at = |curve: &ManifoldCurve, k: usize| {
            Some([plane(curve.points.get(k)?)?, plane(curve.points.get(k + 1)?)?])
        };
        let (Some([a, b]), Some([c, d])) = (at(curve, k), at(other, j)) else { continue };
        let Some((s, r)) = chords((a, b), (c, d)) else { continue };
        let between = |numbers: &[f64], k: usize, part: f64| {
            numbers[k] + part * (numbers[k + 1] - numbers[k])
        };
        let start = [between(&curve.numbers, k, s), between(&other.numbers, j, r)];
        let widths =
            [curve.numbers[k + 1] - curve.numbers[k], other.numbers[j + 1] - other.numbers[j]];
        let shorter = (b - a).norm().min((d - c).norm());
        let crossing = solved((first, second), start, widths, shorter);
        // Found from two pairs of chords it is one, at the same place of both curves.
        let is_known = |new: &ManifoldCrossing| {
            let same = |old: &ManifoldCrossing| {
                (0..2).all(|k| (old.numbers[k] - new.numbers[k]).abs() <= SAME * widths[k])
            };
            found.iter().any(same)
        };
        let is_new =
            |new: &ManifoldCrossing| !is_known(new) && passes((first, second), new, widths);
        found.extend(crossing.filter(is_new));
    }
    first.stopped().or_else(|| second.stopped()).map_or(Ok(found), Err)
}

/// Crossings at numbers that are so close, in parts of the distance of neighbouring points, are one.
const SAME: f64 = 1e-4;

/// So far from a crossing, in units of the error of both curves, the first one must be on two sides of the second one.
const APART: f64 = 100.0;

/// True if the first manifold passes from one side of the second one to the other: manifolds that coincide touch everywhere.
fn passes<A: MapFamily + ?Sized, B: MapFamily + ?Sized>(
    (first, second): (&UnstableManifold<'_, A>, &UnstableManifold<'_, B>),
    crossing: &ManifoldCrossing,
    widths: [f64; 2],
) -> bool {
    let exact = exactness(&crossing.point);
    let [t, r] = crossing.numbers;
    let side = |by: f64| {
        let (x, _) = moving(first, t + by)?;
        // The nearest point of the second one, by Newton's steps along it.
        let mut at = r;
        for _ in 0..MOST_STEPS {
            let (y, v) = moving(second, at)?;
            let step = (x - y).dot(&v) / v.norm_squared();
            at += step;
            if step.abs() <= f64::EPSILON * at.abs().max(1.0) || (at - r).abs() > widths[1] {
                break;
            }
        }
        let (y, v) = moving(second, at)?;
        Some(v.perp(&(x - y)) / v.norm())
    };
    let Some((_, u)) = moving(first, t) else { return false };
    let by = APART * exact / (u.norm() * pxfm::f_sin(crossing.angle));
    let by = by.min(0.5 * widths[0]);
    match (side(by), side(-by)) {
        (Some(a), Some(b)) => a * b < 0.0 && a.abs().min(b.abs()) > 0.1 * APART * exact,
        _ => false,
    }
}

/// How far both curves are known at a point.
fn exactness(point: &[f64; 2]) -> f64 {
    EXACT * point.iter().fold(1.0, |size: f64, x| size.max(x.abs()))
}

fn plane(point: &[f64]) -> Option<Vector2<f64>> {
    Some(Vector2::new(*point.first()?, *point.get(1)?))
}

/// Where two chords cross, as parts of them.
fn chords(
    (a, b): (Vector2<f64>, Vector2<f64>),
    (c, d): (Vector2<f64>, Vector2<f64>),
) -> Option<(f64, f64)> {
    let (u, v, w) = (b - a, d - c, c - a);
    let area = u.perp(&v);
    let (s, r) = (w.perp(&v) / area, w.perp(&u) / area);
    let inside = |part: &f64| (0.0..=1.0).contains(part);
    (inside(&s) && inside(&r)).then_some((s, r))
}

/// A point of a manifold in the plane, and its derivative by the number.
pub(super) fn moving<M: MapFamily + ?Sized>(
    manifold: &UnstableManifold<'_, M>,
    t: f64,
) -> Option<(Vector2<f64>, Vector2<f64>)> {
    let (point, tangent) = manifold.tangent_at(t).ok()?;
    Some((plane(&point)?, plane(&tangent)?))
}

/// The sine of the angle from one direction to another one.
pub(super) fn sine(u: &Vector2<f64>, v: &Vector2<f64>) -> f64 {
    u.perp(v) / (u.norm() * v.norm())
}

/// The crossing near two numbers, by Newton's method, between points of which two are as close as `shorter`.
fn solved<A: MapFamily + ?Sized, B: MapFamily + ?Sized>(
    (first, second): (&UnstableManifold<'_, A>, &UnstableManifold<'_, B>),
    start: [f64; 2],
    widths: [f64; 2],
    shorter: f64,
) -> Option<ManifoldCrossing> {
    let [mut t, mut r] = start;
    let mut best: Option<ManifoldCrossing> = None;
    for _ in 0..MOST_STEPS {
        let ((x, u), (y, v)) = (moving(first, t)?, moving(second, r)?);
        let error = (x - y).norm();
        let sine = sine(&u, &v).abs().min(1.0);
        if best.as_ref().is_none_or(|best| error < best.error) {
            let (point, angle) = ([x[0], x[1]], pxfm::f_asin(sine));
            best = Some(ManifoldCrossing { point, numbers: [t, r], angle, error });
        } else if best.as_ref().is_some_and(|best| error >= 0.5 * best.error) {
            break;
        }
        let step = Matrix2::from_columns(&[u, -v]).lu().solve(&(y - x))?;
        // A step beyond the two chords belongs to another crossing.
        if (t + step[0] - start[0]).abs() > widths[0] || (r + step[1] - start[1]).abs() > widths[1]
        {
            return None;
        }
        (t, r) = (t + step[0], r + step[1]);
    }
    best.filter(|best| {
        let exact = exactness(&best.point);
        // Both curves are known to this distance: at a smaller angle the crossing could be anywhere between the points.
        best.error <= exact && best.angle * shorter > exact
    })
}
