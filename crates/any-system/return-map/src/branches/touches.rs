//! Surfaces that are touched and left again between two points of a branch.

use super::branch::{BranchEnd, BranchPoint};
use super::curve::OnCurve;
use super::follow::Follower;
use super::orbit::{Kind, Orbit};
use crate::families::{Clearance, MapFamily};
use equations::Jet;
use std::ops::ControlFlow;

/// Where a cubic through two clearances with their slopes falls below this part of the smaller one, the clearance there is computed: the
/// cubic is wrong by the fourth power of the step. A smaller number would trust it more.
const TRUSTED: f64 = 0.25;

/// How often a step is halved at such places.
const MOST_HALVINGS: usize = 10;

impl<M: MapFamily + ?Sized> Orbit<'_, M> {
    /// How near the orbit of a point comes to surfaces that it does not meet, along the tangent. Where this cannot be computed there are
    /// none, and the pieces alone tell where the branch ends.
    pub(super) fn clearances(&self, of: &OnCurve) -> Vec<Clearance> {
        let Kind::Periodic(period) = self.kind else { return Vec::new() };
        let direction = of.tangent.component_mul(&self.scales);
        let (mut curve, parameter) = self.line(&of.at, &direction);
        let (mut all, mut before) = (Vec::new(), 0);
        for image in 0..period {
            let Ok(Some(found)) = self.map.clearances(&curve, parameter) else { return all };
            all.extend(found.into_iter().map(|one| Clearance { place: before + one.place, ..one }));
            if image + 1 < period {
                let point: Vec<f64> = curve.iter().map(Jet::value).collect();
                let Ok(here) = self.map.image(&point, parameter.value()) else { return all };
                let Ok(pushed) = self.map.pushed(&curve, parameter) else { return all };
                before += here.itinerary.len();
                curve = pushed.curve;
            }
        }
        all
    }
}

/// The place in a step, from 0 to 1, at which a surface may be touched.
fn suspicious(near: &Clearance, far: &Clearance, length: f64, turned: f64) -> Option<f64> {
    let [from, rate] = near.value.0;
    let [to, rate_there] = far.value.0;
    let (m0, m1) = (rate * length, rate_there * length / turned);
    let cubic = [from, m0, -3.0 * from + 3.0 * to - 2.0 * m0 - m1, 2.0 * from - 2.0 * to + m0 + m1];
    let [c, b, a] = [cubic[1], cubic[2], 3.0 * cubic[3]];
    // The root of c + 2 b t + a t² at which it rises.
    let root = (b * b - a * c).sqrt();
    let place = if b > 0.0 { -c / (b + root) } else { (root - b) / a };
    let value = cubic.iter().rev().fold(0.0, |sum, term| sum * place + term);
    (place > 0.0 && place < 1.0 && value < TRUSTED * from.min(to)).then_some(place)
}

impl<M: MapFamily + ?Sized, S: FnMut(&BranchPoint) -> ControlFlow<()>> Follower<'_, M, S> {
    /// The border that is met and left again between two points on the same pieces, if there is one.
    pub(super) fn touched(
        &self,
        near: (&OnCurve, &[Clearance]),
        far: (&OnCurve, &[Clearance]),
        itinerary: &[String],
    ) -> Option<BranchEnd> {
        self.touched_within(near, far, itinerary, MOST_HALVINGS)
    }

    fn touched_within(
        &self,
        (last, near): (&OnCurve, &[Clearance]),
        (next, far): (&OnCurve, &[Clearance]),
        itinerary: &[String],
        halvings: usize,
    ) -> Option<BranchEnd> {
        let off = (&next.at - &last.at).component_div(&self.orbit.scales);
        let (length, turned) = (off.dot(&last.tangent), next.tangent.dot(&last.tangent));
        let is_same = |a: &Clearance, b: &Clearance| {
            (a.place, &a.surface, a.side) == (b.place, &b.surface, b.side)
        };
        let places = near.iter().filter_map(|own| {
            let other = far.iter().find(|other| is_same(own, other))?;
            suspicious(own, other, length, turned)
        });
        let place = places.min_by(f64::total_cmp).filter(|_| halvings > 0)?;
        let between = self.step(last, place * length).ok().flatten()?;
        match self.orbit.itinerary(&between.at) {
            Ok(own) if own == itinerary => {
                let here = self.orbit.clearances(&between);
                let first =
                    self.touched_within((last, near), (&between, &here), itinerary, halvings - 1);
                first.or_else(|| {
                    self.touched_within((&between, &here), (next, far), itinerary, halvings - 1)
                })
            }
            Ok(other) => self.border(last, itinerary, other, place * length),
            Err(_) => None,
        }
    }
}
