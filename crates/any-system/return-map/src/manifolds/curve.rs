//! Points along a manifold.

use super::manifold::UnstableManifold;
use crate::checks::{check_dimension, check_positive};
use crate::error::Error;
use crate::families::{MapFamily, first_difference};
use std::ops::ControlFlow;

/// How the points of a manifold are chosen. Lengths are those of the section's coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct ManifoldSteps {
    /// The length of the curve: of its parts in the region.
    pub length: f64,
    /// The region of interest: for each coordinate the two ends; empty for the whole space. Outside of it, where a manifold may go far away
    /// and come back, points are further apart the further they are from it.
    pub region: Vec<(f64, f64)>,
    /// The largest distance of neighbouring points.
    pub longest: f64,
    /// The largest angle between neighbouring pieces of the curve, in radians. Where it turns faster, points are closer, down to a
    /// thousandth of `longest`.
    pub angle: f64,
    /// The most points.
    pub points: usize,
}

impl Default for ManifoldSteps {
    /// A length of 10 anywhere, points at distances of up to 0.02, angles of 0.2 and a hundred thousand points.
    fn default() -> Self {
        ManifoldSteps {
            length: 10.0,
            region: Vec::new(),
            longest: 0.02,
            angle: 0.2,
            points: 100_000,
        }
    }
}

/// A piece of a manifold from its saddle on.
#[derive(Debug, Clone, PartialEq)]
pub struct ManifoldCurve {
    /// The points, the saddle first.
    pub points: Vec<Vec<f64>>,
    /// Their numbers t; −∞ for the saddle.
    pub numbers: Vec<f64>,
    /// Where the curve jumps.
    pub cuts: Vec<ManifoldCut>,
    /// Its length, without the jumps.
    pub length: f64,
    /// Why it ends.
    pub end: ManifoldEnd,
}

/// A jump of a manifold: the map has a discontinuity there.
#[derive(Debug, Clone, PartialEq)]
pub struct ManifoldCut {
    /// The number of the last point before it, among the points of the curve.
    pub after: usize,
    /// The pieces of the map before and behind it, from the first one that differs: of a return map mode and surface of an event.
    pub pieces: [Option<String>; 2],
}

/// Why a curve ends.
#[derive(Debug, Clone, PartialEq)]
pub enum ManifoldEnd {
    /// It has its length.
    Length,
    /// The limit on the number of points.
    PointLimit,
    /// It was stopped.
    Stopped,
    /// The next point has no image, by this error.
    NoImage(Error),
}

/// The longest step of t.
const FIRST: f64 = 0.25;

/// The shortest distance of points, as a part of the longest, below which angles do not count: a fold is sharper than any step.
const SHARPEST: f64 = 1e-3;

/// Outside of the region points are apart by this part of their distance from it: a chord between them does not meet the region.
const AWAY: f64 = 0.25;

impl ManifoldSteps {
    fn check(&self, dimension: usize) -> Result<(), Error> {
        let lengths = [
            ("the length of a manifold", self.length),
            ("the longest distance of points", self.longest),
            ("the angle of a manifold", self.angle),
        ];
        for (what, value) in lengths {
            check_positive(what, value)?;
        }
        if let Some((low, _)) = self.region.iter().find(|(low, high)| !(low < high)) {
            let what = "the left end of a side of a region, beside its right end,";
            return Err(Error::BadArgument { what, value: *low });
        }
        match self.region.len() {
            0 => Ok(()),
            sides => check_dimension("a region", dimension, sides),
        }
    }

    /// How far a point is from the region: the largest distance of a coordinate.
    fn away(&self, point: &[f64]) -> f64 {
        let of = |(x, (low, high)): (&f64, &(f64, f64))| (low - x).max(x - high);
        point.iter().zip(&self.region).map(of).fold(0.0, f64::max)
    }
}

/// Two numbers t that are so close are neighbours: a distance between their points is a jump.
const NEIGHBOURS: f64 = 1e-13;

impl<M: MapFamily + ?Sized> UnstableManifold<'_, M> {
    /// Points along the manifold, from the saddle on. `see` receives each one; if it breaks, the curve ends there.
    ///
    /// # Errors
    /// [`Error::BadArgument`] for lengths that are not positive and finite, and for a region without an inside;
    /// [`hybrid_system::Error::Dimension`] for one that has not one side for each coordinate.
    pub fn curve(
        &self,
        steps: &ManifoldSteps,
        mut see: impl FnMut(&[f64]) -> ControlFlow<()>,
    ) -> Result<ManifoldCurve, Error> {
        steps.check(self.saddle().point.len())?;
        let mut curve = ManifoldCurve {
            points: vec![self.saddle().point.clone()],
            numbers: vec![f64::NEG_INFINITY],
            cuts: Vec::new(),
            length: 0.0,
            end: ManifoldEnd::PointLimit,
        };
        // The first chord is short, also where the cubic reaches far.
        let first = self.number(pxfm::f_log(SHARPEST * steps.longest)).min(0.0);
        let (mut t, mut step) = (f64::NEG_INFINITY, FIRST);
        while curve.points.len() < steps.points {
            if curve.length >= steps.length {
                curve.end = ManifoldEnd::Length;
                break;
            }
            let next = if t == f64::NEG_INFINITY { first } else { t + step };
            let images = self.images(next);
            let is_shortest = step <= NEIGHBOURS * next.abs().max(1.0);
            let (point, pieces) = match self.image(next, images) {
                Ok(found) => found,
                Err(Error::Stopped { .. }) => {
                    curve.end = ManifoldEnd::Stopped;
                    break;
                }
                Err(_) if !is_shortest && t.is_finite() => {
                    step *= 0.5;
                    continue;
                }
                Err(error) => {
                    curve.end = ManifoldEnd::NoImage(error);
                    break;
                }
            };
            let last = &curve.points[curve.points.len() - 1];
            let distance = distance(last, &point);
            let away = steps.away(last).min(steps.away(&point));
            let longest = steps.longest.max(AWAY * away);
            let is_near = distance <= longest
                && (distance <= SHARPEST * longest || self.turns(&curve, &point) <= steps.angle);
            let is_jump = !is_near && is_shortest;
            if t.is_finite() && !is_near && !is_jump {
                step *= 0.5;
                continue;
            }
            if is_jump && distance > longest {
                let before = self.image(t, images).map_or(Vec::new(), |(_, pieces)| pieces);
                let place = first_difference(&before, &pieces);
                let pieces = [before.get(place).cloned(), pieces.get(place).cloned()];
                curve.cuts.push(ManifoldCut { after: curve.points.len() - 1, pieces });
            } else if away == 0.0 {
                curve.length += distance;
            }
            let stopped = see(&point).is_break();
            curve.points.push(point);
            curve.numbers.push(next);
            if stopped {
                curve.end = ManifoldEnd::Stopped;
                break;
            }
            // Behind a jump steps begin anew.
            step = if is_jump { FIRST } else { (1.5 * step).min(FIRST) };
            t = next;
        }
        Ok(curve)
    }

    /// The angle by which a curve turns at its last point towards the next one.
    fn turns(&self, curve: &ManifoldCurve, next: &[f64]) -> f64 {
        let count = curve.points.len();
        let is_cut = curve.cuts.last().is_some_and(|cut| cut.after + 2 == count);
        let Some([before, last]) = curve.points.last_chunk::<2>().filter(|_| !is_cut) else {
            return 0.0;
        };
        let (mut dot, mut one, mut two) = (0.0, 0.0, 0.0);
        for ((a, b), c) in before.iter().zip(last).zip(next) {
            let (u, v) = (b - a, c - b);
            dot += u * v;
            one += u * u;
            two += v * v;
        }
        pxfm::f_acos((dot / (one * two).sqrt()).clamp(-1.0, 1.0))
    }
}

pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + (a - b) * (a - b)).sqrt()
}
