//! Where a branch meets a border of the map.

use super::branch::{BranchEnd, BranchPoint};
use super::curve::{OnCurve, bordered, corrected, corrected_by};
use super::follow::{ASIDE, Follower, point_of, predicted};
use super::orbit::{Kind, Orbit, split};
use crate::error::Error;
use crate::families::{Border, BorderSite, Image, Linearized, MapFamily, first_difference};
use nalgebra::{DMatrix, DVector};
use std::ops::{AddAssign, ControlFlow};

/// Looks ahead of the last point for other pieces of the map, each twice as far as the one before: up to 10⁹ shortest steps. Up to 10⁶ of
/// them another piece is the end of the branch. Further on it is if its border is located: an event that vanishes at a grazing has a speed
/// that is the root of the distance, and derivatives are refused before.
const LOOKS_AHEAD: usize = 31;
const NEAR_LOOKS: usize = 20;

/// How far from the last point a border is looked for, in units of the scales. Beside a grazing a branch of orbits that meet the surface turns as
/// a root does, and its last point is far off. Pieces on both sides tell if the border is that of the branch.
const NEAR: f64 = 0.1;

/// Before so many halvings the border is tried to be located.
const TRIES: [usize; 4] = [1, 6, 18, 30];

/// Tries of a search for a border: some fifty halvings, and as many steps.
const MOST_TRIES: usize = 200;

/// The largest distance from a border of a point beside it, in parts of the size of the guard. A point that was found by halving alone
/// is beside its border to rounding; beside a grazing the speed of an event that vanishes is the root of that, and its square counts. A border
/// that is located afterwards may be further off.
pub(super) const BESIDE: f64 = 1e-6;
const AROUND: f64 = 0.1;

/// How far on both sides of a border the pieces of the map are compared, in parts of the longest step or of the parameter.
const BOTH_SIDES: f64 = 1e-7;

/// Newton steps at a border.
const MOST_STEPS: usize = 20;

impl<M: MapFamily + ?Sized, S: FnMut(&BranchPoint) -> ControlFlow<()>> Follower<'_, M, S> {
    /// The end of a branch of which no further point was found: a border of the map, if other pieces are ahead.
    pub(super) fn lost(&self, last: &OnCurve, itinerary: &[String], reason: String) -> BranchEnd {
        let mut ahead = self.steps.shortest;
        for look in 0..LOOKS_AHEAD {
            if let Ok(other) = self.orbit.itinerary(&predicted(&self.orbit.scales, last, ahead))
                && other != itinerary
            {
                let located = self.border_beside(last, (itinerary, &other), AROUND);
                if let Some((end, true)) = located {
                    return end;
                }
                if look < NEAR_LOOKS {
                    let found = self.border(last, itinerary, other.clone(), ahead);
                    // Where derivatives end before it, its place is that of the last point.
                    return found.unwrap_or_else(|| self.unlocated(last, itinerary, other));
                }
            }
            ahead *= 2.0;
        }
        BranchEnd::Lost { reason }
    }

    /// The border of the map within a step: by halving, and to rounding where the map goes on beyond it. `None` if the branch meets none: a
    /// prediction has passed to other pieces beside it.
    pub(super) fn border(
        &self,
        last: &OnCurve,
        itinerary: &[String],
        mut beyond: Vec<String>,
        length: f64,
    ) -> Option<BranchEnd> {
        // Each try begins at the last point before the border: a prediction from further away could lie beyond it. The slopes are those of
        // the last point that has them. A try that leads nowhere is halved as well, and one that succeeds is made again: where slopes are
        // steep the border may be further than all halves together.
        let (mut at, mut known, mut ahead) = (last.at.clone(), last.clone(), 0.5 * length);
        let (mut halving, mut tries) = (1, 0);
        loop {
            let is_last = ahead <= f64::EPSILON * self.steps.longest || tries == MOST_TRIES;
            if is_last || TRIES.contains(&halving) {
                let here = corrected(&self.orbit, &at, &known.tangent).ok().flatten();
                known = here.unwrap_or(OnCurve { at: at.clone(), ..known });
                let within = if is_last { BESIDE } else { AROUND };
                match self.border_beside(&known, (itinerary, &beyond), within) {
                    Some((end, true)) => return Some(end),
                    Some((end, false)) if is_last && self.is_beside(&known, itinerary) => {
                        return Some(end);
                    }
                    _ => {}
                }
            }
            if is_last {
                break;
            }
            tries += 1;
            let from = OnCurve { at: at.clone(), ..known.clone() };
            let expected = predicted(&self.orbit.scales, &from, ahead);
            let found = match self.orbit.itinerary(&expected) {
                // Nearer to the border less is expected beyond it.
                Ok(other) if other != itinerary => Some(Err(other)),
                _ => self.near_step(&from, &expected, ahead).and_then(|found| {
                    let own = self.orbit.itinerary(&found).ok()?;
                    Some(if own == itinerary { Ok(found) } else { Err(own) })
                }),
            };
            match found {
                Some(Ok(found)) => at = found,
                other => {
                    if let Some(Err(pieces)) = other {
                        beyond = pieces;
                    }
                    ahead *= 0.5;
                    halving += 1;
                }
            }
        }
        let is_beside = self.is_beside(&known, itinerary);
        is_beside.then(|| self.unlocated(&known, itinerary, beyond))
    }

    /// The end at the last point before a border of which no more is known.
    fn unlocated(&self, last: &OnCurve, itinerary: &[String], beyond: Vec<String>) -> BranchEnd {
        let place = first_difference(itinerary, &beyond);
        let at = point_of(&self.orbit, last, itinerary.to_vec());
        BranchEnd::Border { border: Border::Piece, at, beyond, place }
    }

    /// True if other pieces, or none, lie next to a point along the branch.
    fn is_beside(&self, at: &OnCurve, itinerary: &[String]) -> bool {
        let ahead = BOTH_SIDES * self.steps.longest;
        let next = self.orbit.itinerary(&predicted(&self.orbit.scales, at, ahead));
        next.map_or(true, |next| next != itinerary)
    }

    /// A short step to a point near the expected one: by the slopes of a point nearby, or, where these are others, by the own ones.
    fn near_step(
        &self,
        from: &OnCurve,
        expected: &DVector<f64>,
        length: f64,
    ) -> Option<DVector<f64>> {
        let matrix = bordered(&from.slopes, &from.tangent).lu();
        let found = corrected_by(&self.orbit, &matrix, expected, &from.tangent);
        let found = found.filter(|at| {
            let aside = (at - expected).component_div(&self.orbit.scales).norm();
            aside <= ASIDE * length + f64::EPSILON * at.component_div(&self.orbit.scales).norm()
        });
        found.or_else(|| self.step(from, length).ok().flatten().map(|found| found.at))
    }

    /// The border next to a point, and true if it is located on both sides of which the map has the two sequences of pieces.
    fn border_beside(
        &self,
        at: &OnCurve,
        (own, beyond): (&[String], &[String]),
        within: f64,
    ) -> Option<(BranchEnd, bool)> {
        let place = first_difference(own, beyond);
        let site = OrbitBorder::new(&self.orbit, &at.at, (own, beyond), place, within)?;
        let mut point = point_of(&self.orbit, at, own.to_vec());
        // Beside the point along the branch, which goes on smoothly where the map of the first sequence does.
        let exact = site.located(&self.orbit, &at.at).filter(|(exact, _)| {
            let by =
                (BOTH_SIDES * self.steps.longest * &at.tangent).component_mul(&self.orbit.scales);
            let is_own =
                |at: DVector<f64>| self.orbit.itinerary(&at).is_ok_and(|found| found == own);
            is_own(exact - &by) && !is_own(exact + &by)
        });
        let is_located = exact.is_some();
        if let Some((exact, error)) = exact {
            (point.point, point.parameter) = split(&exact);
            point.error = error;
        }
        let (border, beyond) = (site.site.border, beyond.to_vec());
        Some((BranchEnd::Border { border, at: point, beyond, place }, is_located))
    }
}

/// The image of a point, with the point and its parameter. On a border the map may refuse to say on which side a point is: then a point
/// beside it, at another parameter or with another component, on the pieces `own`.
fn beside<M: MapFamily + ?Sized>(
    map: &M,
    point: &[f64],
    parameter: f64,
    own: &[String],
) -> Option<(Image, Vec<f64>, f64)> {
    if let Ok(image) = map.image(point, parameter) {
        return Some((image, point.to_vec(), parameter));
    }
    (0..2 * (point.len() + 1)).find_map(|k| {
        let (mut point, mut parameter) = (point.to_vec(), parameter);
        // The parameter comes first.
        let moved = if k < 2 { &mut parameter } else { &mut point[k / 2 - 1] };
        *moved += if k % 2 == 0 { -BOTH_SIDES } else { BOTH_SIDES } * moved.abs().max(1.0);
        let image = map.image(&point, parameter).ok()?;
        own.starts_with(&image.itinerary).then_some((image, point, parameter))
    })
}

/// A border that the orbit of a periodic point meets.
#[derive(Debug, Clone)]
pub(super) struct OrbitBorder {
    /// The pieces of each image, which go on beyond the border.
    pieces: Vec<Vec<String>>,
    /// The image on whose way the border is met, and the border.
    image: usize,
    pub(super) site: BorderSite,
}

impl OrbitBorder {
    /// The border at a place of the orbit's sequence of pieces, where another sequence differs from it.
    pub(super) fn new<M: MapFamily + ?Sized>(
        orbit: &Orbit<'_, M>,
        at: &DVector<f64>,
        (own, beyond): (&[String], &[String]),
        place: usize,
        within: f64,
    ) -> Option<OrbitBorder> {
        let Kind::Periodic(period) = orbit.kind else { return None };
        let (mut point, parameter) = split(at);
        let (mut pieces, mut found, mut before) = (Vec::new(), None, 0);
        for image in 0..period {
            let rest = own.get(before..)?;
            let (next, point_beside, parameter) = beside(orbit.map, &point, parameter, rest)?;
            // On the border itself the map does not tell which pieces it meets.
            let is_behind = place >= before + next.itinerary.len().max(1);
            if found.is_some() || is_behind && rest.starts_with(&next.itinerary) {
                pieces.push(next.itinerary.clone());
            } else {
                let sides = (rest, beyond.get(before..)?);
                let at = (&point_beside[..], parameter);
                let site = orbit.map.border(at, sides, place - before, within);
                pieces.push(site.itinerary.clone());
                found = Some((image, site));
            }
            before += next.itinerary.len();
            point = next.point;
        }
        let (image, site) = found?;
        Some(OrbitBorder { pieces, image, site })
    }

    /// The maps of the images.
    fn maps<'m, M: MapFamily + ?Sized>(
        &self,
        map: &'m M,
    ) -> Result<Vec<Box<dyn MapFamily + 'm>>, Error> {
        let of = |(image, pieces): (usize, &Vec<String>)| {
            map.along(pieces, (image == self.image).then_some(&self.site))
        };
        self.pieces.iter().enumerate().map(of).collect()
    }

    /// fⁿ(x) − x, and the number that is zero on the border.
    pub(super) fn values<M: MapFamily + ?Sized>(
        &self,
        map: &M,
        at: &DVector<f64>,
    ) -> Result<DVector<f64>, Error> {
        let (start, parameter) = split(at);
        let (mut point, mut number) = (start.clone(), f64::NAN);
        for (image, map) in self.maps(map)?.iter().enumerate() {
            point = map.image(&point, parameter)?.point;
            if image == self.image {
                number = point.pop().unwrap_or(f64::NAN);
            }
        }
        let off = point.iter().zip(&start).map(|(f, x)| f - x).chain([number]);
        Ok(DVector::from_iterator(start.len() + 1, off))
    }

    /// The derivatives of these values.
    fn slopes<M: MapFamily + ?Sized>(
        &self,
        orbit: &Orbit<'_, M>,
        at: &DVector<f64>,
    ) -> Result<DMatrix<f64>, Error> {
        let n = at.len();
        let (mut point, parameter) = split(at);
        let mut slopes = DMatrix::zeros(n - 1, n);
        slopes.fill_diagonal(1.0);
        let mut number = DMatrix::zeros(1, n);
        for (image, map) in self.maps(orbit.map)?.iter().enumerate() {
            let Linearized { image: found, slopes: own, .. } = map.linearized(&point, parameter)?;
            slopes = own.columns(0, n - 1) * slopes;
            slopes.column_mut(n - 1).add_assign(&own.column(n - 1));
            point = found.point;
            if image == self.image {
                point.pop();
                number = slopes.rows(n - 1, 1).into_owned();
                slopes = slopes.remove_row(n - 1);
            }
        }
        for axis in 0..n - 1 {
            slopes[(axis, axis)] -= 1.0;
        }
        slopes = slopes.insert_row(n - 1, 0.0);
        slopes.row_mut(n - 1).copy_from(&number);
        Ok(slopes)
    }

    /// The point on the border by Newton's method, and its last step in units of the scales; `None` if there is none near.
    fn located<M: MapFamily + ?Sized>(
        &self,
        orbit: &Orbit<'_, M>,
        near: &DVector<f64>,
    ) -> Option<(DVector<f64>, f64)> {
        let (mut at, mut before) = (near.clone(), f64::INFINITY);
        for _ in 0..MOST_STEPS {
            let values = self.values(orbit.map, &at).ok()?;
            let step = self.slopes(orbit, &at).ok()?.lu().solve(&-values)?;
            at += &step;
            let length = step.component_div(&orbit.scales).amax();
            let off = (&at - near).component_div(&orbit.scales).amax();
            if !(off < NEAR) {
                return None;
            }
            // It ends where rounding lets it become no shorter.
            if length >= 0.5 * before || length == 0.0 {
                return Some((at, length));
            }
            before = length;
        }
        None
    }
}
