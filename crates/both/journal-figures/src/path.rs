//! Outlines on the page: straight lines and cubic Bézier pieces.

use std::fmt::Write;

/// A point on the page, in points, y downwards.
pub type Point = (f64, f64);

/// One step of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Segment {
    /// Starts a new contour.
    Move(Point),
    /// A straight line.
    Line(Point),
    /// A cubic Bézier piece: two control points, then the end.
    Cubic(Point, Point, Point),
    /// A straight line to the start of the contour.
    Close,
}

/// A sequence of contours.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Path {
    segments: Vec<Segment>,
}

/// Distance of the control points from the ends of a quarter circle, in units of the radius.
///
/// With this value the middle of the cubic piece lies on the circle. Elsewhere the piece lies outside it by 3 parts in
/// 10 000 of the radius at most, which is not visible.
const QUARTER: f64 = 4.0 / 3.0 * (std::f64::consts::SQRT_2 - 1.0);

impl Path {
    /// A straight line from each point to the next one.
    pub fn polyline(points: impl IntoIterator<Item = Point>) -> Self {
        let mut path = Path::default();
        for (k, point) in points.into_iter().enumerate() {
            path.push(if k == 0 { Segment::Move(point) } else { Segment::Line(point) });
        }
        path
    }

    /// A closed polygon.
    pub fn polygon(corners: impl IntoIterator<Item = Point>) -> Self {
        let mut path = Path::polyline(corners);
        path.push(Segment::Close);
        path
    }

    /// A rectangle, given by its upper left corner and its size.
    pub fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Self {
        Path::polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])
    }

    /// A circle.
    pub fn circle((x, y): Point, radius: f64) -> Self {
        let (r, c) = (radius, QUARTER * radius);
        let segments = vec![
            Segment::Move((x + r, y)),
            Segment::Cubic((x + r, y + c), (x + c, y + r), (x, y + r)),
            Segment::Cubic((x - c, y + r), (x - r, y + c), (x - r, y)),
            Segment::Cubic((x - r, y - c), (x - c, y - r), (x, y - r)),
            Segment::Cubic((x + c, y - r), (x + r, y - c), (x + r, y)),
            Segment::Close,
        ];
        Path { segments }
    }

    /// Adds a step.
    pub fn push(&mut self, segment: Segment) {
        self.segments.push(segment);
    }

    /// The steps, in order.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// True if the path has no steps.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// The path with every point replaced by its image.
    #[must_use]
    pub fn map(mut self, image: impl Fn(Point) -> Point) -> Self {
        for segment in &mut self.segments {
            *segment = match *segment {
                Segment::Move(p) => Segment::Move(image(p)),
                Segment::Line(p) => Segment::Line(image(p)),
                Segment::Cubic(a, b, p) => Segment::Cubic(image(a), image(b), image(p)),
                Segment::Close => Segment::Close,
            };
        }
        self
    }

    /// The path in SVG's own letters, with three decimals at most.
    pub fn data(&self) -> String {
        let mut d = String::new();
        for segment in &self.segments {
            match *segment {
                Segment::Move(p) => points(&mut d, 'M', &[p]),
                Segment::Line(p) => points(&mut d, 'L', &[p]),
                Segment::Cubic(a, b, p) => points(&mut d, 'C', &[a, b, p]),
                Segment::Close => d.push('Z'),
            }
        }
        d
    }
}

#[cfg(test)]
impl Path {
    /// Left, upper, right and lower limit of the ends of all steps.
    pub(crate) fn limits_of_ends(&self) -> [f64; 4] {
        let ends = self.segments.iter().filter_map(|segment| match *segment {
            Segment::Move(p) | Segment::Line(p) | Segment::Cubic(_, _, p) => Some(p),
            Segment::Close => None,
        });
        ends.fold([f64::MAX, f64::MAX, f64::MIN, f64::MIN], |l, (x, y)| {
            [l[0].min(x), l[1].min(y), l[2].max(x), l[3].max(y)]
        })
    }
}

fn points(d: &mut String, letter: char, points: &[Point]) {
    for (k, (x, y)) in points.iter().enumerate() {
        d.push(if k == 0 { letter } else { ' ' });
        number(d, *x);
        d.push(' ');
        number(d, *y);
    }
}

/// Writes a number with three decimals at most: a thousandth of a point is not visible.
pub(crate) fn number(out: &mut String, value: f64) {
    let start = out.len();
    let _ = write!(out, "{value:.3}");
    let short = out.trim_end_matches('0').trim_end_matches('.').len();
    out.truncate(short);
    if &out[start..] == "-0" {
        out.replace_range(start.., "0");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_no_trailing_zeros() {
        for (value, text) in
            [(100.0, "100"), (-0.0001, "0"), (0.25, "0.25"), (-1.2345, "-1.234"), (0.0, "0")]
        {
            let mut out = String::from("M0 ");
            number(&mut out, value);
            assert_eq!(out, format!("M0 {text}"));
        }
    }

    #[test]
    fn a_rectangle_as_svg_writes_it() {
        assert_eq!(Path::rectangle(1.0, 2.0, 3.5, 4.0).data(), "M1 2L4.5 2L4.5 6L1 6Z");
    }

    #[test]
    fn the_middle_of_each_quarter_lies_on_the_circle() {
        let circle = Path::circle((1.0, -2.0), 3.0);
        let mut from = (0.0, 0.0);
        for segment in circle.segments() {
            match *segment {
                Segment::Move(p) => from = p,
                Segment::Cubic(a, b, p) => {
                    let middle = |p0: f64, p1: f64, p2: f64, p3: f64| {
                        0.125 * (p0 + 3.0 * p1 + 3.0 * p2 + p3)
                    };
                    let x = middle(from.0, a.0, b.0, p.0) - 1.0;
                    let y = middle(from.1, a.1, b.1, p.1) + 2.0;
                    assert!((pxfm::f_hypot(x, y) - 3.0).abs() < 1e-14);
                    from = p;
                }
                _ => {}
            }
        }
    }
}
