//! Branches and bifurcations of maps in a frame: the parameter to the right, the first coordinate upwards.

use journal_figures::{Anchor, Frame, Marker, Svg};
use return_map::{Bifurcation, BifurcationKind, Border, Branch, BranchEnd, BranchPoint};

const BRANCH: &str = "#1f4e96";
const MARKED: &str = "#d03a2b";

/// The name of a bifurcation in a diagram, and its marker.
fn mark(kind: BifurcationKind) -> (&'static str, Marker) {
    match kind {
        BifurcationKind::Fold => ("fold", Marker::Disc),
        BifurcationKind::Doubling => ("doubling", Marker::Diamond),
        BifurcationKind::NeimarkSacker => ("circle", Marker::Ring),
        BifurcationKind::Hopf => ("Hopf", Marker::Ring),
        BifurcationKind::Transcritical => ("crossing", Marker::Cross),
        BifurcationKind::Pitchfork => ("pitchfork", Marker::Triangle),
    }
}

fn place(point: &BranchPoint) -> (f64, f64) {
    (point.parameter, point.point.first().copied().unwrap_or(f64::NAN))
}

/// The points of a branch.
pub(super) fn draw_points(svg: &mut Svg, frame: Frame, branch: &Branch) {
    let points = branch.points.iter().map(|point| {
        let (x, y) = place(point);
        (x, y, point.is_stable)
    });
    frame.branch(svg, &points.collect::<Vec<_>>(), BRANCH);
}

/// The points of a branch, and its bifurcations with their names. The doubling at which it begins has a name on the other branch.
pub(super) fn draw_branch(svg: &mut Svg, frame: Frame, branch: &Branch) {
    draw_points(svg, frame, branch);
    let begins = |found: &Bifurcation| {
        let ends = [branch.points.first(), branch.points.last()];
        let mut ends = branch.ends.iter().zip(ends);
        ends.any(|(end, point)| {
            *end == BranchEnd::Doubling
                && point.is_some_and(|point| point.parameter == found.at.parameter)
        })
    };
    for found in branch.bifurcations.iter().filter(|found| !begins(found)) {
        let (name, marker) = mark(found.kind);
        let at = place(&found.at);
        // There is room beside the middle of a diagram.
        let is_left = frame.at(at).0 < frame.left + 0.5 * frame.width;
        let side = if is_left { Anchor::Start } else { Anchor::End };
        frame.labelled_point(svg, at, (marker, MARKED), (side, name));
    }
}

/// The end of a branch at a border, with its name.
pub(super) fn draw_end(svg: &mut Svg, frame: Frame, end: &BranchEnd, side: Anchor) {
    let BranchEnd::Border { border, at, .. } = end else { return };
    let name = match border {
        Border::Grazing { .. } => "grazing",
        Border::Corner { .. } => "corner",
        Border::Sliding { .. } => "sliding",
        Border::Chattering { .. } => "chattering",
        _ => "border",
    };
    frame.labelled_point(svg, place(at), (Marker::Square, MARKED), (side, name));
}
