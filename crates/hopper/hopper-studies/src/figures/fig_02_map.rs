//! Fig. 2: the map for several mass ratios, up to the fifth fixed point.

use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use hopper_figures::{cuts, graph_pieces};
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, ticks};
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};

/// Mass ratios with their pens. The paper's mass ratios are illegible in our copy; these show the range of shapes.
const CURVES: [(f64, Pen); 4] = [
    (0.05, Pen::solid("#8a8a8a", 1.5)),
    (0.1, Pen::dashed("#009e73", 1.7, "6 2.5")),
    (0.2, Pen::solid("#d55e00", 1.3)),
    (1.0, Pen::solid("#10386e", 1.5)),
];

/// Draws the graphs.
pub(super) fn build(_: &Progress) -> Result<Figure, Error> {
    let top = alpha_star(5);
    let mut svg = Svg::new(560.0, 540.0);
    let frame = Frame::linear(62.0, 16.0, 480.0, 470.0, (0.0, 17.8), (0.0, 17.8));
    let mut rows = Vec::new();
    let mut drawings = Vec::new();
    for (m, pen) in CURVES {
        let map = LiftOffMap::new(MassRatio::new(m)?);
        for piece in graph_pieces(&map, &cuts(5), 120) {
            rows.extend(piece.iter().map(|&(x, y)| vec![Some(m), Some(x), Some(y)]));
            drawings.push((piece, pen));
        }
    }
    frame.clipped(&mut svg, |svg| {
        frame.polyline(svg, &[(0.0, 0.0), (17.8, 17.8)], Pen::dashed("#000", 0.7, "1.5 2.5"));
        for (piece, pen) in &drawings {
            frame.curve(svg, piece, *pen);
        }
    });
    for n in 1..=5 {
        let star = alpha_star(n);
        let (x, y) = frame.at((star, star));
        svg.dot(x, y, 3.2, "#000");
        svg.text(x - 8.0, y - 6.0, Anchor::End, 11.5, &format!("$α$^{{∗}}_{{{n}}}"));
    }
    for (k, (m, pen)) in CURVES.iter().enumerate() {
        let y = 40.0 + 18.0 * k as f64;
        svg.line_key((96.0, y), *pen, &format!("$M$ = {m}"));
    }
    let axis = ticks((0.0, 17.8), 9);
    frame.axes(
        &mut svg,
        &axis,
        &axis,
        "lift-off speed $α$_{n} (dimensionless)",
        "next lift-off speed $α$_{n+1} = $f$($α$_{n})",
    );
    Figure::new(
        "fig_02_map",
        svg,
        vec![csv_file("fig_02_map.csv", &["mass_ratio", "alpha", "alpha_next"], rows)?],
        &[("top", format!("{top:.3}"))],
    )
}
