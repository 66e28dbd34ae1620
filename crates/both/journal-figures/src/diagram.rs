//! Bifurcation diagrams: orbits as shades of grey, branches of solutions, and their bifurcations.

use crate::axes::{Frame, TICK_SIZE};
use crate::error::Error;
use crate::marker::Marker;
use crate::render::indexed_png;
use crate::svg::{Anchor, Pen, Svg};

/// The greys of a pixel with no point, one point, two or more, four or more, and so on.
const GREYS: [u8; 7] = [255, 120, 85, 60, 40, 20, 0];
/// Width of a marker, and the distance of its label, in points.
const MARKER: f64 = 6.5;
const GAP: f64 = 5.0;
/// The dashes of a branch that does not attract.
const DASHES: &str = "4 2.5";

impl Frame {
    /// Points of the data plane as an image of `width` × `height` pixels that fills the frame. The grey of a pixel is the bit length of the
    /// number of its points: one is light, 32 or more are black. Points outside the frame are left out.
    ///
    /// # Errors
    /// [`Error::Render`] if the image cannot be encoded.
    pub fn point_cloud(
        &self,
        svg: &mut Svg,
        (width, height): (usize, usize),
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Result<(), Error> {
        let mut hits = vec![0u32; width * height];
        for point in points {
            let (x, y) = self.at(point);
            let column = (x - self.left) / self.width * width as f64;
            let row = (y - self.top) / self.height * height as f64;
            let is_inside = |place: f64, count: usize| 0.0 <= place && place < count as f64;
            if is_inside(column, width) && is_inside(row, height) {
                hits[row as usize * width + column as usize] += 1;
            }
        }
        let most = GREYS.len() as u32 - 1;
        let shade = |hits: &u32| (u32::BITS - hits.leading_zeros()).min(most) as u8;
        let pixels: Vec<u8> = hits.iter().map(shade).collect();
        let png = indexed_png("points", width, height, &GREYS.map(|grey| [grey; 3]), &pixels)?;
        svg.image(self.left, self.top, self.width, self.height, &png);
        Ok(())
    }

    /// A branch of solutions, as points (x, y) and whether they attract: a solid line where they do, else a dashed one. Parts outside the
    /// frame are cut off.
    ///
    /// ```
    /// use journal_figures::{Frame, Svg};
    /// let mut svg = Svg::new(300.0, 200.0);
    /// let frame = Frame::linear(40.0, 10.0, 250.0, 150.0, (0.0, 1.0), (0.0, 1.0));
    /// frame.branch(&mut svg, &[(0.0, 0.5, true), (0.5, 0.6, true), (1.0, 0.5, false)], "#10386e");
    /// ```
    pub fn branch(&self, svg: &mut Svg, points: &[(f64, f64, bool)], color: &'static str) {
        self.clipped(svg, |svg| {
            let mut rest = points;
            while let Some(&(_, _, attracts)) = rest.first() {
                let count = rest.iter().take_while(|point| point.2 == attracts).count();
                // Each piece goes on to the first point of the next one.
                let piece: Vec<_> = rest.iter().take(count + 1).map(|&(x, y, _)| (x, y)).collect();
                let pen = match attracts {
                    true => Pen::solid(color, 1.4),
                    false => Pen::dashed(color, 1.0, DASHES),
                };
                self.polyline(svg, &piece, pen);
                rest = &rest[count..];
            }
        });
    }

    /// Branches, and above them their marks: each name has its symbol, and stands beside it where it covers least of the branches. A mark at the
    /// place of another one with the same name, as where two branches meet, is drawn once.
    ///
    /// ```
    /// use journal_figures::{Frame, LabelledBranch, Svg};
    /// let mut svg = Svg::new(300.0, 200.0);
    /// let frame = Frame::linear(40.0, 10.0, 250.0, 150.0, (0.0, 1.0), (0.0, 1.0));
    /// let line = vec![(0.2, 0.5, true), (0.6, 0.5, true), (0.8, 0.5, false)];
    /// let marks = vec![(0.6, 0.5, "doubling".to_owned())];
    /// frame.labelled_branches(&mut svg, &[LabelledBranch { line, marks }], ["#10386e", "#d03a2b"]);
    /// ```
    pub fn labelled_branches(
        &self,
        svg: &mut Svg,
        branches: &[LabelledBranch],
        [line, mark]: [&'static str; 2],
    ) {
        for branch in branches {
            self.branch(svg, &branch.line, line);
        }
        let drawn: Vec<(f64, f64)> =
            branches.iter().flat_map(|branch| self.dense(&branch.line)).collect();
        let marks: Vec<_> = branches.iter().flat_map(|branch| &branch.marks).collect();
        for (k, (x, y, name)) in marks.iter().enumerate() {
            let place = self.at((*x, *y));
            let is_here = |(u, v, other): &&(f64, f64, String)| {
                let (left, top) = self.at((*u, *v));
                other == name && pxfm::f_hypot(left - place.0, top - place.1) < 0.5 * MARKER
            };
            if !place.0.is_finite() || !place.1.is_finite() || marks[..k].iter().any(is_here) {
                continue;
            }
            svg.marker(place, symbol(name), MARKER, mark);
            let covers = |label: &Label| (label.covered(self, &drawn), label.order);
            let best = Label::around(place, name).into_iter().min_by_key(covers);
            if let Some(label) = best {
                svg.text(label.at.0, label.at.1, label.anchor, TICK_SIZE, name);
            }
        }
    }

    /// Points of the drawing along a line, at most a point apart.
    fn dense(&self, line: &[(f64, f64, bool)]) -> Vec<(f64, f64)> {
        let corners: Vec<(f64, f64)> = line.iter().map(|&(x, y, _)| self.at((x, y))).collect();
        let mut found = Vec::new();
        for pair in corners.windows(2) {
            let [(x, y), (u, v)] = [pair[0], pair[1]];
            let length = pxfm::f_hypot(u - x, v - y);
            if !length.is_finite() || length > self.width + self.height {
                continue;
            }
            let count = length.ceil().max(1.0);
            let part = |k: f64| (x + (u - x) * k / count, y + (v - y) * k / count);
            found.extend((0..count as usize).map(|k| part(k as f64)));
        }
        found.extend(corners.last());
        found
    }
}

/// A branch of solutions, with what has a name on it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LabelledBranch {
    /// The points (x, y), and whether they attract.
    pub line: Vec<(f64, f64, bool)>,
    /// Points with their names: bifurcations, ends.
    pub marks: Vec<(f64, f64, String)>,
}

/// A place for the name of a mark.
struct Label {
    /// The preferred place comes first.
    order: usize,
    at: (f64, f64),
    anchor: Anchor,
    /// Its left and right end, and its top and bottom.
    sides: [(f64, f64); 2],
}

/// The width of a letter, as a part of the size of the font: the mean one.
const LETTER: f64 = 0.5;

impl Label {
    /// To the right, to the left, above, below, and in the four corners between.
    fn around((x, y): (f64, f64), name: &str) -> Vec<Label> {
        let gap = 0.5 * MARKER + GAP;
        let width = LETTER * TICK_SIZE * name.chars().count() as f64;
        let half = 0.35 * TICK_SIZE;
        let near = 0.7 * gap;
        [
            (gap, 0.0, Anchor::Start),
            (-gap, 0.0, Anchor::End),
            (0.0, -gap - half, Anchor::Middle),
            (0.0, gap + half, Anchor::Middle),
            (near, -near - half, Anchor::Start),
            (near, near + half, Anchor::Start),
            (-near, -near - half, Anchor::End),
            (-near, near + half, Anchor::End),
        ]
        .into_iter()
        .enumerate()
        .map(|(order, (dx, dy, anchor))| {
            let (left, middle) = (x + dx, y + dy);
            let left = match anchor {
                Anchor::Start => left,
                Anchor::Middle => left - 0.5 * width,
                Anchor::End => left - width,
            };
            let sides = [(left - 1.0, left + width + 1.0), (middle - half, middle + half)];
            Label { order, at: (x + dx, middle + half), anchor, sides }
        })
        .collect()
    }

    /// How many of these points it covers; more than all of them if it is not inside the frame.
    fn covered(&self, frame: &Frame, points: &[(f64, f64)]) -> usize {
        let [(left, right), (top, bottom)] = self.sides;
        let is_inside = frame.left < left
            && right < frame.left + frame.width
            && frame.top < top
            && bottom < frame.top + frame.height;
        let is_covered = |&&(x, y): &&(f64, f64)| left < x && x < right && top < y && y < bottom;
        points.iter().filter(is_covered).count() + if is_inside { 0 } else { points.len() + 1 }
    }
}

/// The symbol of a bifurcation; a square for other names.
fn symbol(name: &str) -> Marker {
    match name {
        "fold" => Marker::Disc,
        "doubling" => Marker::Diamond,
        "Neimark–Sacker" | "Hopf" => Marker::Ring,
        "transcritical" => Marker::Cross,
        "pitchfork" => Marker::Triangle,
        _ => Marker::Square,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_in_their_pixels() {
        let frame = Frame::linear(0.0, 0.0, 10.0, 10.0, (0.0, 1.0), (0.0, 1.0));
        let drawn = |points: &[(f64, f64)]| {
            let mut svg = Svg::new(10.0, 10.0);
            frame.point_cloud(&mut svg, (2, 2), points.iter().copied()).unwrap();
            svg
        };
        let pixels =
            |bytes: &[u8]| indexed_png("points", 2, 2, &GREYS.map(|g| [g; 3]), bytes).unwrap();
        let expected = |bytes: &[u8]| {
            let mut svg = Svg::new(10.0, 10.0);
            svg.image(0.0, 0.0, 10.0, 10.0, &pixels(bytes));
            svg
        };
        // The upper row comes first.
        assert_eq!(drawn(&[(0.1, 0.9), (0.2, 0.8), (0.9, 0.1)]), expected(&[2, 0, 0, 1]));
        let outside = [(1.5, 0.5), (0.5, -0.1), (f64::NAN, 0.5), (1.0, 1.0)];
        assert_eq!(drawn(&outside), expected(&[0, 0, 0, 0]));
        assert_eq!(drawn(&vec![(0.6, 0.6); 1000]), expected(&[0, 6, 0, 0]));
    }

    #[test]
    fn names_stand_beside_branches_and_once() {
        let frame = Frame::linear(0.0, 0.0, 200.0, 200.0, (0.0, 1.0), (0.0, 1.0));
        let fold = |x: f64| (x, 0.5, String::from("fold"));
        let drawn = |line: &[(f64, f64, bool)], marks: &[(f64, f64, String)]| {
            let mut svg = Svg::new(200.0, 200.0);
            let branch = LabelledBranch { line: line.to_vec(), marks: marks.to_vec() };
            frame.labelled_branches(&mut svg, &[branch], ["#000", "#f00"]);
            svg
        };
        // Two at one place are one, and what is nowhere is not drawn.
        let single = drawn(&[], &[fold(0.5)]);
        assert_eq!(drawn(&[], &[fold(0.5), fold(0.501), fold(f64::NAN)]), single);
        assert_ne!(drawn(&[], &[fold(0.5), (0.5, 0.5, String::from("grazing"))]), single);
        // To the right, unless the branch or the frame is there.
        let side = |line: &[(f64, f64, bool)], x: f64| {
            let points = frame.dense(line);
            let covers = |label: &Label| (label.covered(&frame, &points), label.order);
            let all = Label::around(frame.at((x, 0.5)), "fold");
            all.into_iter().min_by_key(covers).unwrap().order
        };
        let right = [(0.5, 0.5, true), (1.0, 0.5, true)];
        let both = [(0.0, 0.5, true), (1.0, 0.5, true)];
        assert_eq!(
            [side(&[], 0.5), side(&[], 0.99), side(&right, 0.5), side(&both, 0.5)],
            [0, 1, 1, 2]
        );
    }

    #[test]
    fn a_branch_is_dashed_where_it_does_not_attract() {
        let frame = Frame::linear(0.0, 0.0, 10.0, 10.0, (0.0, 1.0), (0.0, 1.0));
        let mut drawn = Svg::new(10.0, 10.0);
        let points = [(0.0, 0.0, true), (0.5, 0.5, false), (1.0, 0.0, false)];
        frame.branch(&mut drawn, &points, "#000");
        let mut expected = Svg::new(10.0, 10.0);
        frame.clipped(&mut expected, |svg| {
            frame.polyline(svg, &[(0.0, 0.0), (0.5, 0.5)], Pen::solid("#000", 1.4));
            frame.polyline(svg, &[(0.5, 0.5), (1.0, 0.0)], Pen::dashed("#000", 1.0, DASHES));
        });
        assert_eq!(drawn, expected);
    }
}
