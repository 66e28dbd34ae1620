//! The bifurcations between two points of a branch.

use super::branch::{Bifurcation, BifurcationKind};
use super::curve::{Curve, OnCurve, corrected};
use super::follow::{point_of, predicted};
use super::normal_form::normal_form;
use super::orbit::Orbit;
use super::tests::{TESTS, Test};
use crate::families::MapFamily;
use crate::multipliers::eigenvalues;
use interval_arithmetic::bracketed_root;
use nalgebra::Complex;

/// Where a test is zero.
struct Located {
    /// The length along the tangent from the first point.
    place: f64,
    /// How far this may be off, at a crossing of branches.
    apart: f64,
    at: OnCurve,
}

/// The bifurcations between two neighbouring points of a branch, in order; `None` if the step passes to another branch.
/// `is_last` is true for a step to the end of the window: a bifurcation there belongs to it.
pub(super) fn between<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    (from, to): (&OnCurve, &OnCurve),
    is_last: bool,
    itinerary: &[String],
) -> Option<Vec<Bifurcation>> {
    let length = (&to.at - &from.at).component_div(&orbit.scales).dot(&from.tangent);
    // The place, whether the direction of the branch jumps there, and the bifurcation.
    let mut found: Vec<(f64, bool, Bifurcation)> = Vec::new();
    for test in TESTS {
        let [before, behind] = [from, to].map(|point| test.value(point, orbit));
        // Zero counts as a negative number, in each step: a zero at a point is found once, also at the first one.
        let ends_there = is_last && behind.abs() <= AT_END * before.abs();
        if (before > 0.0) == (behind > 0.0) && !ends_there {
            continue;
        }
        let located = match ends_there {
            true => Some(Located { place: length, apart: 0.0, at: to.clone() }),
            false => zero(orbit, ((from, before), (to, behind)), length, test),
        };
        let is_crossing = test == Test::Cross && !ends_there;
        if is_crossing && !located.as_ref().is_some_and(|found| is_solution(orbit, &found.at)) {
            return None;
        }
        let Some(Located { place, apart, at }) = located else { continue };
        let small = ZERO * before.abs().max(behind.abs());
        let jumps = test == Test::Turn && !(test.value(&at, orbit).abs() <= small);
        if let Some(bifurcation) = bifurcation(orbit, test, (from, to), (&at, apart), itinerary) {
            found.push((place, jumps, bifurcation));
        }
    }
    // On the branch that bends at a pitchfork it turns there: that is no fold. Beside a crossing a step may end on the other branch, and
    // then the direction jumps: a fold is where it is zero.
    let crossings: Vec<f64> = found
        .iter()
        .filter(|(_, _, located)| {
            use BifurcationKind::{Pitchfork, Transcritical};
            matches!(located.kind, Pitchfork | Transcritical)
        })
        .map(|(place, _, _)| *place)
        .collect();
    found.retain(|(place, jumps, located)| {
        let is_near = |crossing: &f64| (crossing - place).abs() <= BESIDE * length;
        let is_sure = crossings.is_empty() || !jumps && !crossings.iter().any(is_near);
        located.kind != BifurcationKind::Fold || is_sure
    });
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    Some(found.into_iter().map(|(_, _, located)| located).collect())
}

/// A test that is so small at the end of the window, beside its value before, is zero there.
const AT_END: f64 = 1e-12;

/// A test is so small where it is located, beside its values at both ends of the step: a number that jumps is not.
const ZERO: f64 = 1e-3;

/// So far the equations may be off where branches cross, in units of the scales: a cubic finds that point. Of two branches that pass each
/// other at a distance the point between is not on any. A larger number would take those for a crossing.
const OFF: f64 = 1e-9;

/// True if a crossing of branches is a point of the curve.
fn is_solution<M: MapFamily + ?Sized>(orbit: &Orbit<'_, M>, at: &OnCurve) -> bool {
    let Ok(values) = orbit.values(&at.at) else { return false };
    let off = values
        .iter()
        .zip(orbit.scales.iter())
        .fold(0.0, |off: f64, (value, scale)| off.max((value / scale).abs()));
    off <= OFF + 100.0 * at.error
}

/// Where a test is zero between two points with their values, up to a length along the tangent.
fn zero<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    ((from, before), (to, behind)): ((&OnCurve, f64), (&OnCurve, f64)),
    length: f64,
    test: Test,
) -> Option<Located> {
    let at = |along: f64| {
        corrected(orbit, &predicted(&orbit.scales, from, along), &from.tangent).ok().flatten()
    };
    // Where another branch crosses, the equations are singular: no point is found there, and it is the zero.
    let nothing = if test == Test::Cross { 0.0 } else { f64::NAN };
    let value = |along: f64| {
        if along == 0.0 {
            before
        } else if along == length {
            behind
        } else {
            at(along).map_or(nothing, |point| test.value(&point, orbit))
        }
    };
    let Ok(place) = bracketed_root(value, 0.0, length) else {
        // The nearer end, which is known.
        let (place, at) = match before.abs() < behind.abs() {
            true => (0.0, from.clone()),
            false => (length, to.clone()),
        };
        return Some(Located { place, apart: 0.0, at });
    };
    if test == Test::Cross {
        return crossing(orbit, test, &at, (place, length));
    }
    Some(Located { place, apart: 0.0, at: at(place).unwrap_or_else(|| to.clone()) })
}

/// How far beside a crossing of branches points are found, as a part of the step.
///
/// At the crossing itself the equations are singular, and a point next to it is known to rounding over its distance. A cubic through
/// four points beside it is wrong by the fourth power of this distance.
const BESIDE: f64 = 0.05;

/// The place where a test is zero at a crossing of branches, near `place`, and the point there.
fn crossing<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    test: Test,
    at: &impl Fn(f64) -> Option<OnCurve>,
    (place, length): (f64, f64),
) -> Option<Located> {
    const OFFSETS: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
    let unit = BESIDE * length;
    let points = OFFSETS.map(|offset| at(place + offset * unit));
    let [Some(a), Some(b), Some(c), Some(d)] = points else { return None };
    let points = [a, b, c, d];
    let weights = |x: f64| {
        OFFSETS.map(|own| {
            let others = OFFSETS.iter().filter(|other| **other != own);
            others.fold(1.0, |product, other| product * (x - other) / (own - other))
        })
    };
    let values = [0, 1, 2, 3].map(|k| test.value(&points[k], orbit));
    let value = |x: f64| weights(x).iter().zip(values).map(|(w, v)| w * v).sum::<f64>();
    let zero = bracketed_root(value, -2.0, 2.0).ok()?;
    let mut found = points[1].clone();
    found.at *= 0.0;
    found.slopes *= 0.0;
    for point in &points {
        found.errors = found.errors.sup(&point.errors);
    }
    for (weight, point) in weights(zero).iter().zip(&points) {
        found.at += &point.at * *weight;
        found.slopes += &point.slopes * *weight;
    }
    // The parabola through three of them has its zero elsewhere. That of the cubic is nearer to the crossing by as much as the points are
    // near to each other.
    let three = |x: f64| {
        let [a, b, c, _] = OFFSETS;
        let [p, q, r, _] = values;
        p * (x - b) * (x - c) / ((a - b) * (a - c))
            + q * (x - a) * (x - c) / ((b - a) * (b - c))
            + r * (x - a) * (x - b) / ((c - a) * (c - b))
    };
    let apart = bracketed_root(three, -2.0, 2.0).map_or(1.0, |other| (other - zero).abs());
    found.error = points.iter().fold(0.0, |error: f64, point| error.max(point.error));
    Some(Located { place: place + zero * unit, apart: apart * BESIDE * unit, at: found })
}

/// How far the parameter of a bifurcation between two points may be off. `multipliers` are those there, with their errors.
fn parameter_error<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    test: Test,
    (from, to): (&OnCurve, &OnCurve),
    (at, apart): (&OnCurve, f64),
    (multipliers, errors): (&[Complex<f64>], &[f64]),
) -> f64 {
    let last = at.at.len() - 1;
    let width = orbit.scales[last];
    let rounding = f64::EPSILON * (at.at[last].abs() + SOLVED * width);
    if test == Test::Cross {
        return (apart + at.error) * width + rounding;
    }
    let length = (&to.at - &from.at).component_div(&orbit.scales).norm();
    let critical = test.nearest(orbit.kind, multipliers);
    let Some((value, error)) = critical.map(|k| (multipliers[k], errors[k])) else {
        return f64::INFINITY;
    };
    // The same multiplier at a distance from the bifurcation: as soon as it is surely another one there, the bifurcation is nearer.
    let mut distance = NEAREST * length;
    while distance < length {
        let beside = [distance, -distance].map(|along| {
            let expected = predicted(&orbit.scales, at, along);
            let point = corrected(orbit, &expected, &at.tangent).ok().flatten()?;
            let values = eigenvalues(&orbit.derivative(&point.slopes));
            let off =
                values.iter().map(|other| (other - value).norm()).fold(f64::INFINITY, f64::min);
            Some((off, (point.at[last] - at.at[last]).abs()))
        });
        if let [Some((one, moved)), Some((two, back))] = beside
            && one.min(two) > SURE * error
        {
            return moved.max(back) + at.error * width + rounding;
        }
        distance *= FURTHER;
    }
    (to.at[last] - from.at[last]).abs()
}

/// Beside a bifurcation its multiplier is looked at: from this part of the step on, each time so much further, until it differs by so many
/// errors.
const NEAREST: f64 = 1e-15;
const FURTHER: f64 = 4.0;
const SURE: f64 = 3.0;

/// So many roundings are in a point that Newton's method has found.
const SOLVED: f64 = 4.0;

fn bifurcation<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    test: Test,
    ends: (&OnCurve, &OnCurve),
    (at, apart): (&OnCurve, f64),
    itinerary: &[String],
) -> Option<Bifurcation> {
    let point = point_of(orbit, at, itinerary.to_vec());
    let kind = test.kind(orbit.kind, &point.multipliers)?;
    let form = normal_form(orbit, kind, at);
    let (direction, coefficient, is_symmetric) = match form {
        Some(form) => (form.direction, form.coefficient, form.is_symmetric),
        None => (Vec::new(), None, false),
    };
    let kind = match kind {
        BifurcationKind::Transcritical if is_symmetric => BifurcationKind::Pitchfork,
        kind => kind,
    };
    let multipliers = (&point.multipliers[..], &point.multiplier_errors[..]);
    let error = parameter_error(orbit, test, ends, (at, apart), multipliers);
    Some(Bifurcation { kind, at: point, error, direction, coefficient })
}
