//! Fig. 4: the exact map and the approximate map near α*_1, as printed and corrected.

use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use hopper_asymptotics::{Coefficients, Form};
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, ticks};
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};

/// The window of the paper's figure.
const WINDOW: (f64, f64) = (4.490, 4.515);
const EXACT: Pen = Pen::solid("#000", 1.7);
const PRINTED: Pen = Pen::dashed("#d55e00", 1.6, "1.6 2.6");
const CORRECTED: Pen = Pen::dashed("#0072b2", 1.6, "7 3");

/// Draws the three maps.
pub(super) fn build(_: &Progress) -> Result<Figure, Error> {
    let map = LiftOffMap::new(MassRatio::ONE);
    let printed = Coefficients::new(1, MassRatio::ONE, Form::Printed)?;
    let corrected = Coefficients::new(1, MassRatio::ONE, Form::Corrected)?;
    let star = alpha_star(1);
    // f has a term δ^{4/3} at α*. Squares of equal steps give dense points there, and the curve is smooth.
    let side =
        |end: f64| (0..=80).map(move |k| star + (end - star) * (f64::from(k) / 80.0).powi(2));
    let sides: [Vec<f64>; 2] = [side(WINDOW.0).collect(), side(WINDOW.1).collect()];
    let mut svg = Svg::new(540.0, 430.0);
    let frame = Frame::linear(78.0, 16.0, 440.0, 360.0, WINDOW, (4.470, 4.500));
    let mut rows = Vec::new();
    frame.clipped(&mut svg, |svg| {
        frame.polyline(svg, &[(4.4, 4.4), (4.6, 4.6)], Pen::solid("#999", 0.7));
        for alphas in &sides {
            let exact: Vec<_> =
                alphas.iter().filter_map(|&a| Some((a, map.image(a).ok()??))).collect();
            frame.curve(svg, &exact, EXACT);
            for (local, pen) in [(&printed, PRINTED), (&corrected, CORRECTED)] {
                if pen == PRINTED && alphas.iter().any(|&a| a < star) {
                    continue; // the paper prints the right side only
                }
                let curve: Vec<_> = alphas.iter().map(|&a| (a, local.image(a))).collect();
                frame.curve(svg, &curve, pen);
            }
            rows.extend(exact.iter().map(|&(a, f)| {
                let printed = (a >= star).then(|| printed.image(a));
                vec![Some(a), Some(f), printed, Some(corrected.image(a))]
            }));
        }
    });
    let (x, y) = frame.at((star, star));
    svg.dot(x, y, 3.2, "#000");
    svg.text(x - 4.0, y - 10.0, Anchor::Middle, 12.0, "$α$^{∗}_{1}");
    let keys = [
        (EXACT, "exact"),
        (CORRECTED, "approximate, $λ$ = ¾$βμ$(2$α$^{∗} − sin 2$α$^{∗})"),
        (PRINTED, "approximate, $λ$ as printed (without ¾)"),
    ];
    for (k, (pen, name)) in keys.into_iter().enumerate() {
        let y = 310.0 + 18.0 * k as f64;
        svg.line_key((267.0, y), pen, name);
    }
    frame.axes(
        &mut svg,
        &ticks(WINDOW, 5),
        &ticks((4.470, 4.500), 6),
        "$α$_{n} (dimensionless)",
        "$α$_{n+1} (dimensionless)",
    );
    Figure::new(
        "fig_04_local_map",
        svg,
        vec![csv_file("fig_04_local_map.csv", &["alpha", "exact", "printed", "corrected"], rows)?],
        &[],
    )
}
