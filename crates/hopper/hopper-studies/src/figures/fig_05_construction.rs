//! Fig. 5: the construction of the basin of α*_1, level by level, from the real map.

use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use basin_of_attraction::IntervalSet;
use hopper_basin::{Fates, basin_levels};
use hopper_figures::{cuts, graph_pieces};
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, ticks};
use passive_hopper::{LiftOffMap, MassRatio, alpha_star};

/// At this mass ratio hump 2 falls below the trap of α*₁ and rises again, as in the paper's sketch.
pub(crate) const M: f64 = 0.4;
/// The last level that is computed and drawn. Deeper levels are thinner than a line.
pub(crate) const DEPTH: usize = 4;
/// The colour of each level.
const COLORS: [&str; DEPTH + 1] = ["#1b7f5a", "#d55e00", "#2a62b8", "#7b3294", "#444444"];

/// The levels from the trap of α*_1, in the window [α*_1, α*_4].
pub(crate) fn levels() -> Result<Vec<IntervalSet>, Error> {
    Ok(basin_levels(&Fates::new(MassRatio::new(M)?)?, 1, 4, DEPTH, 4001)?)
}

/// Draws the map with the first preimages, and the levels below it.
pub(super) fn build(_: &Progress) -> Result<Figure, Error> {
    let levels = levels()?;
    let map = LiftOffMap::new(MassRatio::new(M)?);
    let window = (4.2, alpha_star(3));
    let mut svg = Svg::new(620.0, 630.0);
    let top = Frame::linear(62.0, 16.0, 530.0, 330.0, window, (0.0, alpha_star(3)));
    draw_map(&mut svg, &top, &map, &levels);
    top.axes(&mut svg, &ticks(window, 7), &ticks(top.y, 6), "$α$_{n} (dimensionless)", "$α$_{n+1}");
    svg.text(top.left + 8.0, top.top + 16.0, Anchor::Start, 13.0, &format!("(a)  $M$ = {M}"));

    let bars = Frame::linear(62.0, 420.0, 530.0, 180.0, window, (0.0, 5.0));
    svg.text(
        bars.left,
        bars.top - 15.0,
        Anchor::Start,
        13.0,
        "(b)  points that enter $A$ after $k$ hops (level $k$), with those before in grey",
    );
    for (k, level) in levels.iter().enumerate() {
        // One row for each level. Earlier levels are grey: they remain part of the basin.
        let y = bars.top + 36.0 * k as f64;
        for (j, part) in levels.iter().take(k + 1).enumerate() {
            let color = if j == k { COLORS[k] } else { "#c9c9c9" };
            for interval in part.intervals().iter().filter(|interval| interval.left < window.1) {
                let (x0, x1) = (
                    bars.at((interval.left, 0.0)).0,
                    bars.at((interval.right.min(window.1), 0.0)).0,
                );
                svg.fill_rect(x0, y + 6.0, (x1 - x0).max(0.5), 22.0, color);
            }
        }
        svg.line(
            (bars.left, y + 28.0),
            (bars.left + bars.width, y + 28.0),
            Pen::solid("#000", 0.5),
        );
        svg.text(bars.left - 8.0, y + 21.0, Anchor::End, 12.0, &format!("$k$ = {k}"));
        let shown = level.intervals().iter().filter(|i| i.left < window.1);
        let (count, length) = (shown.clone().count(), shown.map(|i| i.length()).sum::<f64>());
        let parts = if count == 1 { "interval" } else { "intervals" };
        svg.text(
            bars.left + 58.0,
            y + 3.0,
            Anchor::Start,
            9.5,
            &format!("{count} {parts}, length {length:.5}"),
        );
    }
    for n in 1..=3 {
        let x = bars.at((alpha_star(n), 0.0)).0;
        svg.line((x, bars.top + 4.0), (x, bars.top + 176.0), Pen::dashed("#000", 0.5, "2 2"));
        svg.text(x, bars.top + 190.0, Anchor::Middle, 12.0, &format!("$α$^{{∗}}_{{{n}}}"));
    }
    let rows = levels.iter().enumerate().flat_map(|(k, level)| {
        level.intervals().iter().map(move |i| vec![Some(k as f64), Some(i.left), Some(i.right)])
    });
    let counts: Vec<String> =
        levels.iter().map(|level| level.intervals().len().to_string()).collect();
    let first = levels[1].intervals();
    let own = first.iter().filter(|i| i.right < alpha_star(2)).count();
    let next = first.iter().filter(|i| i.left > alpha_star(2) && i.right < alpha_star(3)).count();
    Figure::new(
        "fig_05_construction",
        svg,
        vec![csv_file("fig_05_levels.csv", &["level", "left", "right"], rows)?],
        &[
            ("m", M.to_string()),
            ("next", next.to_string()),
            ("own", own.to_string()),
            ("depth", DEPTH.to_string()),
            ("counts", counts.join(", ")),
        ],
    )
}

fn draw_map(svg: &mut Svg, frame: &Frame, map: &LiftOffMap, levels: &[IntervalSet]) {
    let cuts: Vec<f64> = cuts(3).into_iter().filter(|&cut| cut > 4.2).collect();
    let cuts = [vec![4.2], cuts].concat();
    let trap = levels[0].intervals()[0];
    let band = (frame.at((0.0, trap.right)).1, frame.at((0.0, trap.left)).1);
    svg.fill_rect(frame.left, band.0, frame.width, (band.1 - band.0).max(1.0), "#bfe6d4");
    let first: Vec<_> = levels[1].intervals().iter().filter(|i| i.right < frame.x.1).collect();
    frame.clipped(svg, |svg| {
        for (k, level) in levels.iter().enumerate().take(3) {
            for part in level.intervals() {
                let (x0, x1) = (frame.at((part.left, 0.0)).0, frame.at((part.right, 0.0)).0);
                // Level 2 maps onto level 1: its bars reach up to the graph, not to the band of the trap.
                let y = if k < 2 {
                    band.0
                } else {
                    let middle = 0.5 * (part.left + part.right);
                    frame.at((0.0, map.image(middle).ok().flatten().unwrap_or(0.0))).1
                };
                let bottom = frame.top + frame.height;
                svg.fill_rect(
                    x0,
                    y,
                    (x1 - x0).max(if k < 2 { 1.0 } else { 0.5 }),
                    bottom - y,
                    COLORS[k],
                );
            }
        }
        frame.polyline(svg, &[(0.0, 0.0), (20.0, 20.0)], Pen::dashed("#000", 0.7, "1.5 2.5"));
        for piece in graph_pieces(map, &cuts, 160) {
            frame.curve(svg, &piece, Pen::solid("#000", 1.5));
        }
    });
    let bottom = frame.top + frame.height - 8.0;
    svg.text(frame.at((trap.right, 0.0)).0 + 3.0, bottom, Anchor::Start, 13.0, "$A$");
    for (k, part) in first.iter().enumerate() {
        svg.text(
            frame.at((part.right, 0.0)).0 + 4.0,
            bottom,
            Anchor::Start,
            13.0,
            &format!("$A$_{{{k}}}"),
        );
    }
}
