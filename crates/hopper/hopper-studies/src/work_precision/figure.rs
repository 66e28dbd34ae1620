//! Time against error of every way to compute a hop, class by class.

use super::methods::{ALL as METHODS, Method};
use super::score::Score;
use journal_figures::{Anchor, Frame, Marker, Pen, Svg, decades};
use std::time::Duration;

/// Range of the vertical axis. Errors outside are drawn on its ends: exact results at 1e-17, below half an ulp,
/// and results without a right digit at 1e2.
const ERRORS: (f64, f64) = (1e-17, 1e2);
/// Range of the horizontal axis, in seconds a hop: from a single formula to an integration at 1e-12.
const TIMES: (f64, f64) = (1e-9, 1e-1);

/// The marker, the colour and the name of a method.
fn look(method: Method) -> (Marker, &'static str, &'static str) {
    match method {
        Method::Stable => (Marker::Disc, "#000000", "stable form"),
        Method::AtOnce => (Marker::OpenSquare, "#000000", "stable form, at once"),
        Method::Local => (Marker::Square, "#0072b2", "($n$, $δ$) form"),
        Method::Asymptotics => (Marker::Triangle, "#e69f00", "asymptotics, inside their range"),
        Method::Printed => (Marker::Diamond, "#d55e00", "printed form, Brent’s method"),
        Method::HybridExact => (Marker::Wedge, "#009e73", "hybrid system, own landings"),
        Method::HybridSearched => (Marker::Cross, "#9b4f80", "hybrid system, guard search"),
        Method::Integrated(_) => {
            (Marker::Ring, "#666666", "ODE flows, tolerances 10^{−3} … 10^{−12}")
        }
    }
}

/// The title of a class.
fn title(class: &str) -> &str {
    match class {
        "window" => "the paper’s window",
        "random" => "random",
        "sudden_boundary" => "sudden or not: 2^{−10} … 2^{−48} away",
        "grounding_boundary" => "grounded or not",
        "grazing" => "next to a grazing",
        "tiny_M" => "$M$ down to 10^{−15}",
        "huge_M" => "$M$ up to 3·10^{4}",
        "huge_alpha" => "$α$ up to 10^{7}",
        "near_fixed_point" => "near a fixed point: error of $δ$′",
        "tiny_alpha" => "$α$ down to 10^{−12}: error of the loss",
        other => other,
    }
}

/// The drawing: the paper's window in a large panel, the hard classes in small ones. `unit` is the time of one
/// `sin_cos`.
pub(crate) fn work_precision_figure(scores: &[Score], unit: Duration) -> Svg {
    let mut svg = Svg::new(980.0, 660.0);
    let mut hard: Vec<&str> = Vec::new();
    for score in scores {
        if score.class != "window" && !hard.contains(&score.class.as_str()) {
            hard.push(&score.class);
        }
    }
    let main = frame(62.0, 34.0, 300.0, 400.0);
    panel(&mut svg, &main, "window", scores, 9.0);
    axes(&mut svg, &main, true, true);
    unit_line(&mut svg, &main, unit, true);
    for (k, class) in hard.iter().enumerate() {
        let (column, row) = (k % 3, k / 3);
        let small = frame(428.0 + 186.0 * column as f64, 34.0 + 208.0 * row as f64, 166.0, 164.0);
        panel(&mut svg, &small, class, scores, 6.5);
        axes(&mut svg, &small, column == 0, row == 2 || k + 3 >= hard.len());
        unit_line(&mut svg, &small, unit, false);
    }
    legend(&mut svg, 66.0, 500.0);
    svg
}

fn frame(left: f64, top: f64, width: f64, height: f64) -> Frame {
    Frame::linear(left, top, width, height, TIMES, ERRORS).log_x().log_y()
}

fn axes(svg: &mut Svg, frame: &Frame, named_y: bool, named_x: bool) {
    let large = frame.width > 200.0;
    let every = if large { 1 } else { 2 };
    let mut x_ticks = decades(TIMES, every);
    let mut y_ticks = decades(ERRORS, if large { 2 } else { 4 });
    if !named_y {
        y_ticks.iter_mut().for_each(|(_, label)| label.clear());
    }
    if !named_x {
        x_ticks.iter_mut().for_each(|(_, label)| label.clear());
    }
    let x_label = if named_x { "time per hop (s)" } else { "" };
    let y_label = if named_y { "relative error" } else { "" };
    frame.axes(svg, &x_ticks, &y_ticks, x_label, y_label);
}

/// A line at the time of one sine and cosine.
fn unit_line(svg: &mut Svg, frame: &Frame, unit: Duration, named: bool) {
    let seconds = unit.as_secs_f64();
    if seconds < TIMES.0 {
        // The line would lie to the left of the frame.
        return;
    }
    let x = frame.at((seconds, 1.0)).0;
    svg.line((x, frame.top), (x, frame.top + frame.height), Pen::dashed("#999", 0.7, "2 2"));
    if named {
        svg.text(x + 3.0, frame.top + 12.0, Anchor::Start, 9.5, "one sin_cos");
    }
}

fn panel(svg: &mut Svg, frame: &Frame, class: &str, scores: &[Score], size: f64) {
    let middle = frame.left + frame.width / 2.0;
    svg.text(
        middle,
        frame.top - 8.0,
        Anchor::Middle,
        if size > 8.0 { 13.0 } else { 10.5 },
        title(class),
    );
    let points: Vec<_> = scores
        .iter()
        .filter(|score| score.class == class)
        .filter_map(|score| {
            let ((median, worst), time) = (score.errors?, score.time?.as_secs_f64());
            let clip = |error: f64| error.clamp(ERRORS.0, ERRORS.1);
            Some((score, (time, clip(median)), (time, clip(worst))))
        })
        .collect();
    frame.clipped(svg, |svg| {
        let mut integrated: Vec<_> = points
            .iter()
            .filter(|(score, ..)| matches!(score.method, Method::Integrated(_)))
            .map(|&(_, _, worst)| worst)
            .collect();
        integrated.sort_by(|a, b| b.1.total_cmp(&a.1));
        frame.polyline(svg, &integrated, Pen::solid("#bbb", 0.8));
        for (score, median, worst) in &points {
            let (_, color, _) = look(score.method);
            svg.line(frame.at(*median), frame.at(*worst), Pen::solid(color, 0.9));
            let (x, y) = frame.at(*median);
            svg.line((x - 0.35 * size, y), (x + 0.35 * size, y), Pen::solid(color, 1.1));
        }
    });
    for (score, _, worst) in &points {
        let (marker, color, _) = look(score.method);
        svg.marker(frame.at(*worst), marker, size, color);
    }
}

fn legend(svg: &mut Svg, left: f64, top: f64) {
    let mut y = top;
    let mut drawn: Vec<&str> = Vec::new();
    for &method in METHODS {
        let (marker, color, name) = look(method);
        if drawn.contains(&name) {
            continue;
        }
        drawn.push(name);
        svg.marker((left, y - 4.0), marker, 8.0, color);
        svg.text(left + 12.0, y, Anchor::Start, 11.5, name);
        y += 17.0;
    }
    let x = left + 200.0;
    svg.line((x, top - 8.0), (x, top + 12.0), Pen::solid("#000", 0.9));
    svg.line((x - 3.0, top + 12.0), (x + 3.0, top + 12.0), Pen::solid("#000", 1.1));
    svg.marker((x, top - 8.0), Marker::Disc, 8.0, "#000000");
    svg.text(x + 8.0, top - 4.0, Anchor::Start, 10.5, "worst error");
    svg.text(x + 8.0, top + 15.0, Anchor::Start, 10.5, "median error");
    svg.text(x - 4.0, top + 38.0, Anchor::Start, 10.5, "errors beyond the frame");
    svg.text(x - 4.0, top + 52.0, Anchor::Start, 10.5, "are drawn on it");
}
