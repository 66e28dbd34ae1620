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

    /// A marker at a point of the data plane, with a label to its right, or to its left.
    pub fn labelled_point(
        &self,
        svg: &mut Svg,
        point: (f64, f64),
        (marker, color): (Marker, &'static str),
        (side, label): (Anchor, &str),
    ) {
        let (x, y) = self.at(point);
        svg.marker((x, y), marker, MARKER, color);
        let gap = 0.5 * MARKER + GAP;
        let (dx, dy) = match side {
            Anchor::Start => (gap, 3.5),
            Anchor::Middle => (0.0, -gap),
            Anchor::End => (-gap, 3.5),
        };
        svg.text(x + dx, y + dy, side, TICK_SIZE, label);
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
