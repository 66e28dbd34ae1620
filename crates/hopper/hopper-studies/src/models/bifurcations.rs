//! Branches and bifurcations of maps in a frame: the parameter to the right, the first coordinate upwards.

use journal_figures::{Anchor, Frame, Marker, Svg};
use return_map::{BifurcationKind, Border, Branch, BranchEnd, BranchPoint};

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

/// A branch, and its bifurcations with their names.
pub(super) fn draw_branch(svg: &mut Svg, frame: Frame, branch: &Branch) {
    let points = branch.points.iter().map(|point| {
        let (x, y) = place(point);
        (x, y, point.is_stable)
    });
    frame.branch(svg, &points.collect::<Vec<_>>(), BRANCH);
    for found in &branch.bifurcations {
        let (name, marker) = mark(found.kind);
        // The doubling at which a branch begins is that of another one.
        let begins = branch.ends.contains(&BranchEnd::Doubling)
            && [branch.points.first(), branch.points.last()]
                .into_iter()
                .flatten()
                .any(|end| end.parameter == found.at.parameter);
        if !begins {
            let label = (Anchor::End, name);
            frame.labelled_point(svg, place(&found.at), (marker, MARKED), label);
        }
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
