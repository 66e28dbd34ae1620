//! The ways in which a guard along a flow meets zero.

use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;
use hybrid_system::{Direction, FirstCrossing, QuasiPolynomial};
use journal_figures::{Anchor, Frame, Marker, Pen, Svg};

const CURVE: Pen = Pen::solid("#10386e", 1.8);
const BAND: &str = "#ececea";

/// A panel: its texts, the guard, the horizon of the search and the range that is drawn.
struct GuardPanel {
    title: &'static str,
    says: &'static str,
    quasi_polynomial: QuasiPolynomial,
    horizon: f64,
    range: (f64, f64),
}

fn panels() -> Vec<GuardPanel> {
    // 3 (t − 0.84)(t − 1.16)(3 − t): it is negative for 0.32 only, and samples at 0.8 and 1.2 miss that.
    let narrow = QuasiPolynomial::polynomial(&[-0.84, 1.0])
        * QuasiPolynomial::polynomial(&[-1.16, 1.0])
        * QuasiPolynomial::polynomial(&[9.0, -3.0]);
    vec![
        GuardPanel {
            title: "a crossing",
            says: "the first change of sign",
            quasi_polynomial: QuasiPolynomial::cosine(1.0, 1.4)
                + QuasiPolynomial::polynomial(&[0.15]),
            horizon: 3.2,
            range: (-1.1, 1.3),
        },
        GuardPanel {
            title: "a narrow dip",
            says: "bounds find it, samples (dots) do not",
            quasi_polynomial: narrow,
            horizon: 2.4,
            range: (-0.5, 1.3),
        },
        GuardPanel {
            title: "a touch",
            says: "an error: grazing at this time",
            quasi_polynomial: QuasiPolynomial::polynomial(&[1.0, -1.6, 0.64]),
            horizon: 3.0,
            range: (-0.5, 1.3),
        },
        GuardPanel {
            title: "a start at zero",
            says: "left upwards, like $t$^{3}; then back",
            quasi_polynomial: QuasiPolynomial::polynomial(&[0.0, 0.0, 0.0, 1.0, -0.5]),
            horizon: 2.6,
            range: (-1.4, 1.3),
        },
    ]
}

/// Four panels, each with a marker at the result of the search.
pub(super) fn figure(_: &Job) -> Result<Figure, Error> {
    let mut svg = Svg::new(680.0, 430.0);
    for (k, panel) in panels().into_iter().enumerate() {
        let (x, y) = (44.0 + 330.0 * (k % 2) as f64, 34.0 + 206.0 * (k / 2) as f64);
        let frame = Frame::linear(x, y, 290.0, 136.0, (0.0, panel.horizon), panel.range);
        let zero = frame.at((0.0, 0.0)).1;
        svg.fill_rect(frame.left, zero, frame.width, frame.top + frame.height - zero, BAND);
        frame.polyline(&mut svg, &[(0.0, 0.0), (panel.horizon, 0.0)], Pen::solid("#777", 0.8));
        let points: Vec<_> = (0..=300)
            .map(|k| panel.horizon * f64::from(k) / 300.0)
            .map(|t| (t, panel.quasi_polynomial.value(t)))
            .collect();
        frame.clipped(&mut svg, |svg| frame.curve(svg, &points, CURVE));
        if k == 1 {
            for sample in 0..=6 {
                let t = 0.4 * f64::from(sample);
                svg.dot(frame.at((t, panel.quasi_polynomial.value(t))).0, zero, 2.6, "#a3260f");
            }
        }
        let found =
            match panel.quasi_polynomial.first_crossing(Direction::Falling, panel.horizon)? {
                FirstCrossing::At { time, .. } => Some((time, Marker::Disc)),
                FirstCrossing::Touch { time, .. } | FirstCrossing::Undecided { time, .. } => {
                    Some((time, Marker::Diamond))
                }
                FirstCrossing::Never => None,
            };
        if let Some((time, marker)) = found {
            svg.marker(frame.at((time, 0.0)), marker, 9.0, "#000");
        }
        frame.axes(&mut svg, &[], &[], "time $t$", "guard $g$");
        svg.text(x, y - 10.0, Anchor::Start, 12.5, &format!("{}: {}", panel.title, panel.says));
    }
    Figure::new("guards", svg, Vec::new(), &[])
}
