//! The invariance under M → 1/M, and the windows where it fails.

use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use hopper_figures::{cuts, graph_pieces};
use journal_figures::{Frame, Pen, Scale, Svg, csv_file, decades, ticks};
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
use std::f64::consts::PI;

/// The smaller of the two mass ratios.
const M: f64 = 0.3;
const LIGHT: Pen = Pen::solid("#7fb4dd", 3.4);
const HEAVY: Pen = Pen::dashed("#a3260f", 1.5, "5 2.5");

/// Draws f(α; M) and f(α; 1/M), and their difference.
pub(super) fn build(_: &Progress) -> Result<Figure, Error> {
    let ratio = MassRatio::new(M)?;
    let maps = [LiftOffMap::new(ratio), LiftOffMap::new(ratio.inverted())];
    let window = (PI, 4.0 * PI);
    let mut svg = Svg::new(620.0, 560.0);
    let top = Frame::linear(66.0, 16.0, 530.0, 290.0, window, (0.0, 12.8));
    for n in 1..4 {
        let (x0, x1) = (top.at((f64::from(n) * PI, 0.0)).0, top.at((alpha_star(n as u64), 0.0)).0);
        svg.fill_rect(x0, top.top, x1 - x0, top.height, "#eeeeec");
    }
    let mut cuts: Vec<f64> = cuts(3).into_iter().filter(|&c| c >= PI).collect();
    cuts.push(window.1);
    top.clipped(&mut svg, |svg| {
        top.polyline(svg, &[(0.0, 0.0), (20.0, 20.0)], Pen::dashed("#000", 0.7, "1.5 2.5"));
        for (map, pen) in maps.iter().zip([LIGHT, HEAVY]) {
            // Above M = 0.9 the sudden windows have jumps and kinks, where a smooth curve would overshoot. Here the
            // points are joined by straight lines, and not across a jump.
            for piece in graph_pieces(map, &cuts, 600) {
                for run in piece.chunk_by(|a, b| (a.1 - b.1).abs() < 0.5) {
                    top.polyline(svg, run, pen);
                }
            }
        }
    });
    top.axes(&mut svg, &ticks(window, 9), &ticks((0.0, 12.8), 6), "", "$α$_{n+1} (dimensionless)");
    for (k, (pen, name)) in [(LIGHT, "$M$ = 0.3"), (HEAVY, "$M$ = 1/0.3")].into_iter().enumerate() {
        let y = 36.0 + 18.0 * k as f64;
        svg.line_key((96.0, y), pen, name);
    }

    let bottom = Frame {
        y_scale: Scale::Log,
        ..Frame::linear(66.0, 340.0, 530.0, 166.0, window, (1e-18, 1e2))
    };
    let mut rows = Vec::new();
    let samples = 3000;
    for k in 0..samples {
        let alpha = window.0 + (window.1 - window.0) * ((f64::from(k) + 0.5) / f64::from(samples));
        let images = [maps[0].image(alpha)?, maps[1].image(alpha)?];
        rows.push(vec![Some(alpha), images[0], images[1]]);
        if let [Some(a), Some(b)] = images {
            // The logarithm of a difference of exactly zero does not exist: such a difference is drawn at the foot of
            // the axis.
            let (x, y) = bottom.at((alpha, (a - b).abs().max(2e-18)));
            svg.fill_rect(x - 0.5, y - 0.5, 1.0, 1.0, "#10386e");
        }
    }
    let mut y_ticks = decades((1e-17, 1e2), 4);
    y_ticks.push((2e-18, "0".into()));
    bottom.axes(
        &mut svg,
        &ticks(window, 9),
        &y_ticks,
        "$α$_{n} (dimensionless)",
        "|$f$($α$; $M$) − $f$($α$; 1/$M$)|",
    );
    Figure::new(
        "invariance",
        svg,
        vec![csv_file("invariance.csv", &["alpha", "next_light", "next_heavy"], rows)?],
        &[],
    )
}
