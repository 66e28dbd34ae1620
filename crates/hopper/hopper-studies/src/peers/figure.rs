//! Time against error of the compared programs, on the hops of the paper's window.

use super::peer::Peer;
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, decades};

/// Range of the vertical axis, relative: from below half an ulp to above the worst error of docs/performance.md,
/// 6e-8. Errors outside are drawn on the edge.
const ERRORS: (f64, f64) = (1e-17, 1e-6);
/// Range of the horizontal axis, in seconds: hops take from 2e-8 to 1e-2 s.
const TIMES: (f64, f64) = (1e-9, 1e-1);

/// Markers of other programs and of ours, in the order of their times, the slowest first.
const THEIRS: [Marker; 5] =
    [Marker::Square, Marker::Triangle, Marker::Diamond, Marker::Wedge, Marker::Ring];
const OURS: [Marker; 6] =
    [Marker::Ring, Marker::Cross, Marker::Disc, Marker::Square, Marker::Triangle, Marker::Diamond];

/// The drawing: a marker at the worst error, with a line down to the median error.
pub(crate) fn peers_figure(peers: &[Peer]) -> Svg {
    let mut svg = Svg::new(760.0, 420.0);
    let frame = Frame::linear(70.0, 24.0, 380.0, 340.0, TIMES, ERRORS).log_x().log_y();
    let mut legend = 60.0;
    let (mut theirs, mut ours) = (THEIRS.iter(), OURS.iter());
    let mut sorted: Vec<_> = peers.iter().filter(|peer| peer.errors.is_some()).collect();
    sorted.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    for peer in sorted {
        let Some((median, worst)) = peer.errors else { continue };
        let (marker, color) = if peer.ours {
            (ours.next().copied().unwrap_or(Marker::Disc), "#0072b2")
        } else {
            (theirs.next().copied().unwrap_or(Marker::Disc), "#d55e00")
        };
        let clip = |error: f64| error.clamp(ERRORS.0, ERRORS.1);
        let (top, bottom) = ((peer.seconds, clip(worst)), (peer.seconds, clip(median)));
        svg.line(frame.at(top), frame.at(bottom), Pen::solid(color, 0.9));
        let (x, y) = frame.at(bottom);
        svg.line((x - 3.5, y), (x + 3.5, y), Pen::solid(color, 1.2));
        svg.marker(frame.at(top), marker, 9.0, color);
        svg.marker((486.0, legend - 4.0), marker, 9.0, color);
        svg.text(500.0, legend, Anchor::Start, 11.5, &peer.name);
        legend += 22.0;
    }
    svg.text(
        480.0,
        legend + 14.0,
        Anchor::Start,
        11.0,
        "markers: worst error; ticks: median error",
    );
    let (x, y) = (decades(TIMES, 1), decades(ERRORS, 1));
    frame.axes(&mut svg, &x, &y, "time per hop (s)", "relative error of $α$′");
    svg
}
