//! Box counts: how many boxes contain more than one basin, on intervals and on label images, and how many contain a
//! point.

use crate::boundaries::entropy::entropy;
use crate::error::Error;
use crate::line::interval_basins::IntervalBasins;
use crate::space::label::Label;
use crate::space::raster::LabelImage;
use std::collections::BTreeMap;

/// A count of boxes of one size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxCount {
    /// Side of a box: in the unit of the window, or in pixels.
    pub size: f64,
    /// Number of boxes, without those that lie outside the region of interest.
    pub boxes: u64,
    /// Number of boxes with more than one basin.
    pub mixed: u64,
    /// Number of boxes with at most one basin and an undecided part: they may be mixed.
    pub open: u64,
    /// Number of the open boxes that contain one basin. If the undecided points are known to belong to no basin, as
    /// those of an escape set do, these boxes contain a boundary: see [`with_rest`](Self::with_rest).
    pub half_open: u64,
    /// Sum of the entropies −Σ p ln p of the mixed boxes. The fractions p are of the decided part of the box.
    pub entropy: f64,
}

impl BoxCount {
    /// No boxes of this size yet.
    pub(crate) fn new(size: f64) -> BoxCount {
        BoxCount { size, boxes: 0, mixed: 0, open: 0, half_open: 0, entropy: 0.0 }
    }

    /// Counts one box with these measures of basins and an undecided part, all larger than 0.
    pub(crate) fn count(&mut self, basins: &BTreeMap<Label, f64>, has_undecided: bool) {
        self.boxes += 1;
        if basins.len() > 1 {
            self.mixed += 1;
            let sum: f64 = basins.values().sum();
            self.entropy += entropy(basins.values().map(|part| part / sum));
        } else if has_undecided {
            self.open += 1;
            self.half_open += basins.len() as u64;
        }
    }

    /// The number of boxes on a boundary between basins, or between a basin and the undecided rest.
    ///
    /// For an escape set the rest is the set of the orbits that never escape. Where the rest has no area, its boxes
    /// at scale ε are found by basins that are resolved to less than ε.
    pub fn with_rest(&self) -> u64 {
        self.mixed + self.half_open
    }

    /// The basin entropy: the mean entropy over all boxes. Open boxes count as boxes of one basin.
    pub fn basin_entropy(&self) -> f64 {
        self.entropy / self.boxes as f64
    }

    /// The boundary entropy: the mean entropy over mixed boxes; `None` if no box is mixed.
    ///
    /// If it exceeds ln 2, the boundary is fractal, provided that boxes of this size meet a smooth boundary in at
    /// most two basins. The converse does not hold.
    pub fn boundary_entropy(&self) -> Option<f64> {
        (self.mixed > 0).then(|| self.entropy / self.mixed as f64)
    }
}

/// The number of boxes [left + k size, left + (k+1) size) that contain at least one of the points.
///
/// # Errors
/// [`Error::BadPoints`] if the distance of a point from `left` is infinite or NaN; [`Error::BadBoxSize`] unless
/// `size` is finite, positive, and larger than an ulp of the farthest point's distance from `left`.
pub fn occupied_boxes(points: &[f64], left: f64, size: f64) -> Result<u64, Error> {
    let bad = points.iter().filter(|x| !(*x - left).is_finite()).count();
    if bad > 0 {
        return Err(Error::BadPoints { bad, points: points.len(), left });
    }
    let farthest = points.iter().fold(0.0f64, |farthest, x| farthest.max((x - left).abs()));
    // The index of a box is (x − left)/size rounded down. Beyond 2⁵² an f64 index has no fraction, and neighbouring
    // boxes could not be distinguished.
    let above = f64::EPSILON * farthest;
    if !(size > above && size.is_finite()) {
        return Err(Error::BadBoxSize { size, above, largest: f64::INFINITY });
    }
    let mut boxes: Vec<f64> = points.iter().map(|x| ((x - left) / size).floor()).collect();
    boxes.sort_by(f64::total_cmp);
    boxes.dedup();
    Ok(boxes.len() as u64)
}

/// Boxes of intervals are larger than this number of ulps of the window's larger end: their sides are rounded too.
/// A margin of a factor 4 over one ulp.
const SMALLEST_BOX_ULPS: f64 = 4.0;

/// A last box is left out if it is thinner than this fraction of the window. The quotient of the window's length and
/// the size may exceed a whole number by rounding, some ulps of it; that would add an empty box. 10⁻¹² is thousands of
/// ulps. For windows far from 0 the rounding of their ends is larger, and a thin box may appear. A larger fraction
/// would leave out thin boxes that the caller asked for.
const THINNEST_BOX: f64 = 1e-12;

impl IntervalBasins {
    /// Counts boxes of one size, starting at the left end of the window.
    ///
    /// Ends that coincide with sides of boxes are known to an ulp only, and could otherwise count on the wrong side.
    /// All other results are computed from the intervals, without samples.
    ///
    /// # Errors
    /// [`Error::BadBoxSize`] unless `size` is finite and larger than four ulps of the window's larger end.
    pub fn boxes(&self, size: f64, resolution: f64) -> Result<BoxCount, Error> {
        let window = self.window();
        let ulp = f64::EPSILON * window.left.abs().max(window.right.abs());
        let above = SMALLEST_BOX_ULPS * ulp;
        if !(size > above && size.is_finite()) {
            return Err(Error::BadBoxSize { size, above, largest: f64::INFINITY });
        }
        let boxes = ((window.length() / size) * (1.0 - THINNEST_BOX)).ceil().max(1.0);
        let index = |x: f64| ((x - window.left) / size).floor().clamp(0.0, boxes - 1.0);
        // Only a box with an end of an interval, or of the window, can be mixed. All other boxes lie inside one
        // interval, or inside one undecided gap. `boxes_in_gaps` counts the boxes inside gaps.
        let ends =
            self.intervals().iter().flat_map(|part| [part.interval.left, part.interval.right]);
        let mut candidates: Vec<f64> = ends.chain([window.left, window.right]).map(index).collect();
        candidates.sort_by(f64::total_cmp);
        candidates.dedup();
        let mut count = BoxCount::new(size);
        let mut first = 0;
        // The boxes come from left to right, so that intervals left of a box are never used again.
        for k in candidates {
            let left = window.left + k * size;
            let right = (left + size).min(window.right);
            while self.intervals().get(first).is_some_and(|part| part.interval.right <= left) {
                first += 1;
            }
            let mut lengths: BTreeMap<Label, f64> = BTreeMap::new();
            for part in self.intervals()[first..].iter().take_while(|p| p.interval.left < right) {
                let inside = part.interval.right.min(right) - part.interval.left.max(left);
                *lengths.entry(part.label).or_insert(0.0) += inside.max(0.0);
            }
            let decided: f64 = lengths.values().sum();
            lengths.retain(|_, length| *length > resolution * size);
            count.count(&lengths, (right - left) - decided > resolution * size);
        }
        count.boxes = boxes as u64;
        count.open += self.boxes_in_gaps(size, resolution, boxes);
        Ok(count)
    }

    /// The number of boxes that lie inside undecided gaps and contain no end of an interval or of the window.
    fn boxes_in_gaps(&self, size: f64, resolution: f64, boxes: f64) -> u64 {
        let window = self.window();
        let starts = self.intervals().iter().map(|part| part.interval.left).chain([window.right]);
        let ends = self.intervals().iter().map(|part| part.interval.right);
        let index = |x: f64| ((x - window.left) / size).floor().clamp(0.0, boxes - 1.0);
        std::iter::once(window.left)
            .chain(ends)
            .zip(starts)
            .filter(|(left, right)| right - left > resolution * size)
            .map(|(left, right)| (index(right) - index(left) - 1.0).max(0.0) as u64)
            .sum()
    }
}

impl LabelImage {
    /// Counts square boxes of `side` pixels, from the lower left corner. Boxes that reach beyond the image are left
    /// out. An image of one row or one column is a line: its boxes have `side` pixels.
    ///
    /// Undecided pixels belong to no basin: a box with one basin and undecided pixels is open. Pixels outside the
    /// region of interest do not count. A box without any other pixels is no box.
    ///
    /// The slope of ln `mixed` against ln 1/`size` estimates the box dimension of the boundary. Some programs call
    /// the dimension of the image less this slope the uncertainty exponent;
    /// [`uncertain_fraction`](crate::uncertain_fraction) measures that exponent by perturbed starts.
    ///
    /// # Errors
    /// [`Error::BadBoxSize`] for a side of 0, and for a side that exceeds the image; [`Error::BadImage`] as for
    /// [`check`](Self::check).
    pub fn boxes(&self, side: usize) -> Result<BoxCount, Error> {
        self.check()?;
        let (columns, rows) = (self.grid.columns, self.grid.rows);
        let of_axis = |pixels: usize| if pixels == 1 { 1 } else { side };
        let (wide, high) = (of_axis(columns), of_axis(rows));
        if side == 0 || wide > columns || high > rows || side > columns.max(rows) {
            let axes = [columns, rows].into_iter().filter(|&pixels| pixels > 1);
            let largest = axes.min().unwrap_or(1) as f64;
            return Err(Error::BadBoxSize { size: side as f64, above: 0.0, largest });
        }
        let (across, up) = (columns / wide, rows / high);
        let mut count = BoxCount::new(side as f64);
        for corner in 0..across * up {
            let (column, row) = (wide * (corner % across), high * (corner / across));
            let mut basins: BTreeMap<Label, f64> = BTreeMap::new();
            let (mut undecided, mut outside) = (0, 0);
            for line in row..row + high {
                let from = line * columns + column;
                for &label in &self.labels[from..from + wide] {
                    undecided += usize::from(label.is_undecided());
                    outside += usize::from(label.is_outside());
                    if label.is_decided() {
                        *basins.entry(label).or_insert(0.0) += 1.0;
                    }
                }
            }
            if outside < wide * high {
                count.count(&basins, undecided > 0);
            }
        }
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::interval::Interval;
    use crate::space::raster::Grid;

    #[test]
    fn points_that_are_no_numbers_are_an_error_with_their_number() {
        let count = |points: &[f64], left| occupied_boxes(points, left, 0.5);
        assert_eq!(count(&[0.1, 0.2, 0.6], 0.0), Ok(2));
        let points = [0.1, f64::NAN, 0.6, f64::INFINITY, f64::NAN];
        assert_eq!(count(&points, 0.0), Err(Error::BadPoints { bad: 3, points: 5, left: 0.0 }));
        let error = count(&points, 0.0).unwrap_err().to_string();
        assert!(error.starts_with("3 of 5 points"), "{error}");
        assert!(matches!(count(&[0.1], f64::NAN), Err(Error::BadPoints { bad: 1, .. })));
        assert!(matches!(count(&[f64::MAX], f64::MIN), Err(Error::BadPoints { bad: 1, .. })));
    }

    /// Basins `a` and `b`, undecided `?`, outside `.`; the first line is the highest row.
    fn image(lines: &[&str]) -> LabelImage {
        let label = |pixel: char| match pixel {
            '?' => Label::UNDECIDED_PRECISION,
            '.' => Label::OUTSIDE,
            basin => Label::from(basin as u8 - b'a'),
        };
        let labels: Vec<Label> =
            lines.iter().rev().flat_map(|line| line.chars().map(label)).collect();
        let unit = Interval { left: 0.0, right: 1.0 };
        let grid =
            Grid { x: unit, y: unit, columns: labels.len() / lines.len(), rows: lines.len() };
        LabelImage { grid, labels }
    }

    #[test]
    fn undecided_pixels_are_no_basin_in_boxes() {
        let count = image(&["aa??a?ab", "aa??a?a?"]).boxes(2).unwrap();
        assert_eq!((count.boxes, count.mixed, count.open, count.half_open), (4, 1, 2, 1));
        // One pixel of b and two of a: the undecided pixel has no part in the entropy.
        assert!((count.entropy - entropy([1.0 / 3.0, 2.0 / 3.0])).abs() < 1e-15);
        assert_eq!(count.with_rest(), 2);
    }

    #[test]
    fn pixels_outside_the_region_of_interest_are_not_counted_in_boxes() {
        let count = image(&["aa..a.a.", "aa..a.b."]).boxes(2).unwrap();
        assert_eq!((count.boxes, count.mixed, count.open), (3, 1, 0));
        assert_eq!(count.boundary_entropy(), Some(std::f64::consts::LN_2));
    }

    #[test]
    fn an_image_of_one_row_has_boxes_of_a_line() {
        for line in [image(&["aabbab"]), image(&["a", "a", "b", "b", "a", "b"])] {
            let count = line.boxes(2).unwrap();
            assert_eq!((count.boxes, count.mixed), (3, 1));
            assert!(matches!(line.boxes(7), Err(Error::BadBoxSize { largest: 6.0, .. })));
        }
    }

    #[test]
    fn boxes_of_an_image_of_the_wrong_size_are_an_error() {
        let mut bad = image(&["aabb", "aabb"]);
        bad.labels.pop();
        assert_eq!(bad.boxes(2), Err(Error::BadImage { labels: 7, columns: 4, rows: 2 }));
        bad.grid.columns = 0;
        assert_eq!(bad.boxes(1), Err(Error::BadImage { labels: 7, columns: 0, rows: 2 }));
    }
}
