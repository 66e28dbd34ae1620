//! What a drawing of a branch shows.

use super::branch::{Bifurcation, BifurcationKind, Branch, BranchEnd, BranchPoint};
use crate::families::Border;
use std::fmt;

impl fmt::Display for BifurcationKind {
    /// One word.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            BifurcationKind::Fold => "fold",
            BifurcationKind::Doubling => "doubling",
            BifurcationKind::NeimarkSacker => "Neimark–Sacker",
            BifurcationKind::Hopf => "Hopf",
            BifurcationKind::Transcritical => "transcritical",
            BifurcationKind::Pitchfork => "pitchfork",
        })
    }
}

impl fmt::Display for Border {
    /// One word.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Border::Piece => "border",
            Border::Grazing { .. } => "grazing",
            Border::Corner { .. } => "corner",
            Border::Sliding { .. } => "sliding",
            Border::Chattering { .. } => "chattering",
        })
    }
}

impl Branch {
    /// The branch in the plane of the parameter and one component: both, and whether the point attracts.
    pub fn line(&self, component: usize) -> Vec<(f64, f64, bool)> {
        let points = self.points.iter();
        points.map(|point| (point.parameter, at(point, component), point.is_stable)).collect()
    }

    /// What has a name in this plane: each bifurcation and each end at a border, in order. The doubling at which the branch begins has its
    /// name on the other branch.
    pub fn marks(&self, component: usize) -> Vec<(f64, f64, String)> {
        let border = |end: &BranchEnd| match end {
            BranchEnd::Border { border, at: place, .. } => {
                Some((place.parameter, at(place, component), border.to_string()))
            }
            _ => None,
        };
        let ends = [self.points.first(), self.points.last()];
        let begins = |found: &Bifurcation| {
            self.ends.iter().zip(ends).any(|(end, point)| {
                *end == BranchEnd::Doubling
                    && point.is_some_and(|point| point.parameter == found.at.parameter)
            })
        };
        let name = |found: &Bifurcation| {
            (found.at.parameter, at(&found.at, component), found.kind.to_string())
        };
        let inside = self.bifurcations.iter().filter(|found| !begins(found)).map(name);
        border(&self.ends[0]).into_iter().chain(inside).chain(border(&self.ends[1])).collect()
    }
}

/// A component of a point; NaN, which is not drawn, for one that there is not.
fn at(point: &BranchPoint, component: usize) -> f64 {
    point.point.get(component).copied().unwrap_or(f64::NAN)
}
