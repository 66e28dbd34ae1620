//! Fig. 3: the map around α*_1 cut into four segments, and a typical motion of each.

use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use hopper_basin::Trap;
use hopper_figures::graph_pieces;
use hybrid_system::{Execution, Limits};
use journal_figures::{Anchor, Frame, Pen, Svg, csv_file, ticks};
use passive_hopper::{Hopper, HopperState, LiftOffMap, MassRatio, Phase, alpha_star};
use std::f64::consts::PI;

/// The paper's mass ratio is illegible in our copy; at this one all four segments exist.
const M: f64 = 0.8;
const UPPER: Pen = Pen::solid("#10386e", 1.2);
const LOWER: Pen = Pen::solid("#d55e00", 1.4);
/// Time that is drawn, in units of 1/ω: a few hops of every segment.
const DURATION: f64 = 42.0;

struct MapSegment {
    name: &'static str,
    says: &'static str,
    alpha: f64,
}

/// Draws map and motions.
pub(super) fn build(_: &Progress) -> Result<Figure, Error> {
    let ratio = MassRatio::new(M)?;
    let map = LiftOffMap::new(ratio);
    let trap = Trap::new(1, ratio)?;
    let star = alpha_star(1);
    let segments = [
        MapSegment { name: "$α$_{L}", says: "sudden lift-off", alpha: 3.8 },
        MapSegment { name: "$α$_{S}", says: "incessant hopping", alpha: star + 0.6 * trap.delta },
        MapSegment { name: "$α$_{R}", says: "a few hops, then rest", alpha: 5.1 },
        MapSegment { name: "$α$_{G}", says: "no further hop", alpha: 5.95 },
    ];
    let mut svg = Svg::new(760.0, 430.0);
    let frame = Frame::linear(58.0, 18.0, 300.0, 350.0, (3.0, 6.45), (0.0, 5.2));
    let pieces = graph_pieces(&map, &[3.0, PI, star, 2.0 * PI, 6.45], 160);
    let gap = pieces
        .iter()
        .filter(|p| p[0].0 < 6.2)
        .filter_map(|p| p.last())
        .map(|p| p.0)
        .fold(0.0, f64::max);
    let gap_end = pieces.iter().map(|p| p[0].0).filter(|&left| left > gap).fold(2.0 * PI, f64::min);
    let bands = [
        ("#f6e3d7", PI, star),
        ("#bfe6d4", star, trap.right()),
        ("#e3eaf4", trap.right(), gap),
        ("#e0e0dc", gap, gap_end),
    ];
    for (color, left, right) in bands {
        let (x0, x1) = (frame.at((left, 0.0)).0, frame.at((right, 0.0)).0);
        svg.fill_rect(x0, frame.top, (x1 - x0).max(1.2), frame.height, color);
    }
    frame.clipped(&mut svg, |svg| {
        frame.polyline(svg, &[(0.0, 0.0), (9.0, 9.0)], Pen::dashed("#000", 0.7, "1.5 2.5"));
        for piece in &pieces {
            frame.curve(svg, piece, Pen::solid("#000", 1.6));
        }
    });
    for (k, segment) in segments.iter().enumerate() {
        let x = frame.at((segment.alpha, 0.0)).0;
        // Segment α_S is narrower than its name. Its name is above the peak; the other names are at the foot.
        let y = if k == 1 { frame.top + 20.0 } else { frame.top + frame.height - 16.0 };
        svg.text(x, y, Anchor::Middle, 12.5, segment.name);
        if let Some(next) = map.image(segment.alpha)? {
            let (px, py) = frame.at((segment.alpha, next));
            svg.dot(px, py, 3.0, "#b02418");
        } else {
            svg.dot(
                frame.at((segment.alpha, 0.0)).0,
                frame.top + frame.height - 3.0,
                3.0,
                "#b02418",
            );
        }
    }
    let (x, y) = frame.at((star, star));
    svg.text(x - 6.0, y - 3.0, Anchor::End, 11.5, "$α$^{∗}_{1}");
    frame.axes(
        &mut svg,
        &ticks((3.0, 6.45), 4),
        &ticks((0.0, 5.2), 5),
        "$α$_{n} (dimensionless)",
        "$α$_{n+1} (dimensionless)",
    );
    svg.text(
        frame.left,
        420.0,
        Anchor::Start,
        11.0,
        &format!("$M$ = {M}; shaded: the four segments"),
    );

    inset(&mut svg, &map, &trap)?;
    let mut rows = Vec::new();
    for (k, segment) in segments.iter().enumerate() {
        let (column, row) = ((k % 2) as f64, (k / 2) as f64);
        let panel = Frame::linear(
            432.0 + 172.0 * column,
            36.0 + 205.0 * row,
            142.0,
            128.0,
            (0.0, DURATION),
            (-14.0, 15.0),
        );
        let motion = motion(ratio, segment.alpha)?;
        draw_motion(&mut svg, &panel, segment, &motion);
        rows.extend(
            motion
                .iter()
                .flatten()
                .map(|&(t, y1, y2)| vec![Some(segment.alpha), Some(t), Some(y1), Some(y2)]),
        );
    }
    svg.line_key((444.0, 420.0), UPPER, "upper mass, $y$_{1}");
    svg.line_key((582.0, 420.0), LOWER, "lower mass, $y$_{2}");
    Figure::new(
        "fig_03_segments",
        svg,
        vec![
            csv_file(
                "fig_03_map.csv",
                &["alpha", "alpha_next"],
                pieces.iter().flatten().map(|&(x, y)| vec![Some(x), Some(y)]),
            )?,
            csv_file("fig_03_motions.csv", &["alpha", "time", "upper", "lower"], rows)?,
        ],
        &[
            ("m", M.to_string()),
            ("left", format!("{:.3}", segments[0].alpha)),
            ("basin", format!("{:.4}", segments[1].alpha)),
            ("right", format!("{:.2}", segments[2].alpha)),
            ("gap", format!("{:.2}", segments[3].alpha)),
        ],
    )
}

/// The peak, enlarged: α_S is a hundredth wide, too narrow for the main frame.
fn inset(svg: &mut Svg, map: &LiftOffMap, trap: &Trap) -> Result<(), Error> {
    let star = trap.fixed_point.value();
    let range = (star - 0.012, trap.right() + 0.012);
    let frame = Frame::linear(166.0, 226.0, 92.0, 92.0, range, (star - 0.016, star + 0.006));
    svg.fill_rect(frame.left, frame.top, frame.width, frame.height, "#ffffff");
    let (x0, x1) = (frame.at((star, star)).0, frame.at((trap.right(), star)).0);
    svg.fill_rect(x0, frame.top, x1 - x0, frame.height, "#bfe6d4");
    frame.clipped(svg, |svg| {
        frame.polyline(svg, &[(4.0, 4.0), (5.0, 5.0)], Pen::dashed("#000", 0.7, "1.5 2.5"));
        for piece in graph_pieces(map, &[range.0, star, range.1], 60) {
            frame.curve(svg, &piece, Pen::solid("#000", 1.4));
        }
    });
    svg.rect(frame.left, frame.top, frame.width, frame.height, Pen::solid("#000", 0.8));
    svg.text(0.5 * (x0 + x1), frame.top + frame.height - 8.0, Anchor::Middle, 12.0, "$α$_{S}");
    svg.text(x0, frame.top + frame.height + 11.0, Anchor::Middle, 9.5, "$α$^{∗}_{1}");
    svg.text(x1 + 6.0, frame.top + frame.height + 11.0, Anchor::Middle, 9.5, "$α$^{∗}_{1} + $Δ$");
    Ok(())
}

/// (τ, y₁, y₂) along an arc.
type Motion = Vec<(f64, f64, f64)>;

/// The arcs of the execution from a lift-off.
fn motion(ratio: MassRatio, alpha: f64) -> Result<Vec<Motion>, Error> {
    let hopper = Hopper::new(ratio);
    let start = HopperState::lift_off(alpha);
    let mut pieces = Vec::new();
    for arc in Execution::new(&hopper, Phase::Flight, start.into(), Limits::new(DURATION, 1000)) {
        let arc = arc?;
        let samples = (arc.duration / 0.12).ceil().max(4.0) as usize;
        let piece = (0..=samples).map(|k| {
            let elapsed = arc.duration * (k as f64 / samples as f64);
            let state = arc.state(&hopper, elapsed)?;
            Ok((arc.time + elapsed, state[0], state[2]))
        });
        pieces.push(piece.collect::<Result<_, Error>>()?);
    }
    Ok(pieces)
}

fn draw_motion(svg: &mut Svg, panel: &Frame, segment: &MapSegment, motion: &[Motion]) {
    panel.polyline(svg, &[(0.0, 0.0), (DURATION, 0.0)], Pen::solid("#999", 0.6));
    panel.clipped(svg, |svg| {
        for piece in motion {
            let upper: Vec<_> = piece.iter().map(|&(t, y1, _)| (t, y1)).collect();
            let lower: Vec<_> = piece.iter().map(|&(t, _, y2)| (t, y2)).collect();
            panel.curve(svg, &upper, UPPER);
            panel.curve(svg, &lower, LOWER);
        }
    });
    let title = format!("{}: {}", segment.name, segment.says);
    svg.text(panel.left + panel.width / 2.0, panel.top - 6.0, Anchor::Middle, 11.5, &title);
    let y_label = if panel.left < 500.0 { "$y$_{1}, $y$_{2}  ($m$_{2}$g$/$k$)" } else { "" };
    panel.axes(
        svg,
        &ticks((0.0, DURATION), 4),
        &ticks((-14.0, 15.0), 3),
        "time $τ$ (units of 1/$ω$)",
        y_label,
    );
}
