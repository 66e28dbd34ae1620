//! Curves of cubic pieces, smooth at any magnification, and graphs of functions.

use crate::path::{Path, Segment};

/// A path of cubic Bézier pieces through points.
///
/// The points must follow a smooth curve in equal steps of a parameter t. The tangent at each point is the central
/// difference of its neighbours. A piece from p to q with the tangents s and t has the control points p + s/3 and
/// q − t/3. An empty slice gives an empty path.
pub fn smooth(points: &[(f64, f64)]) -> Path {
    let mut path = Path::default();
    let Some(&(x, y)) = points.first() else { return path };
    path.push(Segment::Move((x, y)));
    let last = points.len() - 1;
    let tangent = |k: usize| {
        // At the ends the difference is one-sided and of second order, −3/2, 2, −1/2: a parabola is drawn exactly.
        // Two points have no second neighbour: the piece is straight.
        let (a, b, c) = match k {
            _ if last < 2 => return ((points[last].0 - x) / 1.0, (points[last].1 - y) / 1.0),
            0 => (points[0], points[1], points[2]),
            k if k == last => (points[last], points[last - 1], points[last - 2]),
            k => {
                let (p, q) = (points[k - 1], points[k + 1]);
                return ((q.0 - p.0) / 2.0, (q.1 - p.1) / 2.0);
            }
        };
        let sign = if k == 0 { 1.0 } else { -1.0 };
        (sign * (-1.5 * a.0 + 2.0 * b.0 - 0.5 * c.0), sign * (-1.5 * a.1 + 2.0 * b.1 - 0.5 * c.1))
    };
    for k in 0..last {
        let (p, q) = (points[k], points[k + 1]);
        let (s, t) = (tangent(k), tangent(k + 1));
        path.push(Segment::Cubic(
            (p.0 + s.0 / 3.0, p.1 + s.1 / 3.0),
            (q.0 - t.0 / 3.0, q.1 - t.1 / 3.0),
            q,
        ));
    }
    path
}

/// The graph of a function between neighbouring cuts, as pieces of `count` + 1 points each.
///
/// Where the function has no value there is no graph: the edges are found to an ulp. Towards the ends of a piece the
/// distances of the points shrink like squares, which straightens square-root edges.
pub fn graph_pieces(
    value: impl Fn(f64) -> Option<f64>,
    cuts: &[f64],
    count: usize,
) -> Vec<Vec<(f64, f64)>> {
    graph_pieces_to(TO_AN_ULP, value, cuts, count)
}

/// 54 halvings reach neighbouring `f64` if both ends are of one size. The others are for a bracket with an end near 0.
const TO_AN_ULP: usize = 80;

/// As [`graph_pieces`], with edges that are found by so many halvings of a 64th of a piece: a dozen are enough for
/// a drawing.
pub fn graph_pieces_to(
    halvings: usize,
    value: impl Fn(f64) -> Option<f64>,
    cuts: &[f64],
    count: usize,
) -> Vec<Vec<(f64, f64)>> {
    let mut pieces = Vec::new();
    for pair in cuts.windows(2) {
        for (left, right) in valued(halvings, &value, pair[0], pair[1]) {
            let piece = (0..=count).filter_map(|k| {
                let angle = std::f64::consts::PI * (k as f64 / count as f64);
                let x = left + (right - left) * (0.5 - 0.5 * pxfm::f_cos(angle));
                value(x).map(|y| (x, y))
            });
            pieces.push(piece.collect());
        }
    }
    pieces
}

/// The parts of [left, right] on which `value` exists. A gap or a part shorter than a 64th may be missed.
fn valued(
    halvings: usize,
    value: &impl Fn(f64) -> Option<f64>,
    left: f64,
    right: f64,
) -> Vec<(f64, f64)> {
    /// A piece of a drawing has some hundred points. A gap between two probes is therefore at most a few points wide.
    const PROBES: usize = 64;
    let at = |k: usize| left + (right - left) * (k as f64 / PROBES as f64);
    let mut parts = Vec::new();
    let mut start = value(left).map(|_| left);
    for k in 1..=PROBES {
        let (a, b) = (at(k - 1), at(k));
        match (start, value(b).is_some()) {
            (None, true) => start = Some(edge(halvings, value, a, b)),
            (Some(from), false) => {
                parts.push((from, edge(halvings, value, b, a)));
                start = None;
            }
            _ => {}
        }
    }
    parts.extend(start.map(|from| (from, right)));
    parts
}

/// The last point with a value on the way from `inside` to `outside`.
fn edge(
    halvings: usize,
    value: &impl Fn(f64) -> Option<f64>,
    mut outside: f64,
    mut inside: f64,
) -> f64 {
    for _ in 0..halvings {
        let middle = 0.5 * (inside + outside);
        if value(middle).is_some() { inside = middle } else { outside = middle }
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_drawn_exactly() {
        let points: Vec<_> = (0..5).map(|k| (f64::from(k), f64::from(k * k))).collect();
        // The Bézier form of y = x² on [0, 1].
        assert!(smooth(&points).data().starts_with("M0 0C0.333 0 0.667 0.333 1 1"));
    }
}
