//! Boxes that hold more than one basin: counted on points, intervals and label images.

use crate::entropy::entropy;
use crate::{Error, IntervalBasins, LabelImage};
use std::collections::BTreeMap;

/// Boxes of one size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxCount {
    /// Side of a box: in the unit of the window, or in pixels.
    pub size: f64,
    /// All boxes.
    pub boxes: u64,
    /// Boxes with more than one label.
    pub mixed: u64,
    /// Boxes with one label at most and something undecided: mixed or not.
    pub open: u64,
    /// Sum of the entropies −Σ p ln p of the mixed boxes, of what is decided in them.
    pub entropy: f64,
}

impl BoxCount {
    /// The basin entropy: the mean over all boxes.
    pub fn basin_entropy(&self) -> f64 {
        self.entropy / self.boxes as f64
    }

    /// The boundary entropy: the mean over mixed boxes; nothing without one. Above ln 2 the boundary is
    /// fractal; below, nothing follows.
    pub fn boundary_entropy(&self) -> Option<f64> {
        (self.mixed > 0).then(|| self.entropy / self.mixed as f64)
    }
}

/// How many boxes [left + k size, left + (k+1) size) hold at least one of the points.
///
/// # Errors
/// [`Error::BadBoxSize`] unless `size` is positive, and large enough to tell the boxes of all points apart.
pub fn occupied_boxes(points: &[f64], left: f64, size: f64) -> Result<u64, Error> {
    let reach = points.iter().fold(0.0f64, |reach, x| reach.max((x - left).abs()));
    // Boxes must be told apart, wherever the points are.
    if !(size > f64::EPSILON * reach && size.is_finite() && reach.is_finite()) {
        return Err(Error::BadBoxSize { size });
    }
    let mut boxes: Vec<f64> = points.iter().map(|x| ((x - left) / size).floor()).collect();
    boxes.sort_by(f64::total_cmp);
    boxes.dedup();
    Ok(boxes.len() as u64)
}

impl IntervalBasins {
    /// Counts boxes of one size, from the left end of the window on.
    ///
    /// A label counts in a box if it has more than `resolution` boxes of it: ends that fall on the
    /// sides of boxes are known to an ulp only. Exact but for that: nothing is sampled.
    ///
    /// # Errors
    /// [`Error::BadBoxSize`] unless `size` is positive and not so small that boxes cannot be told apart.
    pub fn boxes(&self, size: f64, resolution: f64) -> Result<BoxCount, Error> {
        let window = self.window();
        let ulp = f64::EPSILON * window.left.abs().max(window.right.abs());
        if !(size > 4.0 * ulp && size.is_finite()) {
            return Err(Error::BadBoxSize { size });
        }
        let boxes = ((window.length() / size) * (1.0 - 1e-12)).ceil().max(1.0);
        let index = |x: f64| ((x - window.left) / size).floor().clamp(0.0, boxes - 1.0);
        // Boxes in which a part ends; those inside an undecided gap are counted below.
        let ends =
            self.intervals().iter().flat_map(|part| [part.interval.left, part.interval.right]);
        let mut candidates: Vec<f64> = ends.chain([window.left, window.right]).map(index).collect();
        candidates.sort_by(f64::total_cmp);
        candidates.dedup();
        let mut count = BoxCount { size, boxes: boxes as u64, mixed: 0, open: 0, entropy: 0.0 };
        let mut first = 0;
        for k in candidates {
            let left = window.left + k * size;
            let right = (left + size).min(window.right);
            while self.intervals().get(first).is_some_and(|part| part.interval.right <= left) {
                first += 1;
            }
            let mut lengths: BTreeMap<u16, f64> = BTreeMap::new();
            for part in self.intervals()[first..].iter().take_while(|p| p.interval.left < right) {
                let inside = part.interval.right.min(right) - part.interval.left.max(left);
                *lengths.entry(part.label).or_insert(0.0) += inside.max(0.0);
            }
            let decided: f64 = lengths.values().sum();
            lengths.retain(|_, length| *length > resolution * size);
            if lengths.len() > 1 {
                count.mixed += 1;
                let sum: f64 = lengths.values().sum();
                count.entropy += entropy(lengths.values().map(|length| length / sum));
            } else if (right - left) - decided > resolution * size {
                count.open += 1;
            }
        }
        count.open += self.boxes_in_gaps(size, resolution, boxes);
        Ok(count)
    }

    /// Boxes that lie inside undecided gaps, with no end of a part or of the window in them.
    fn boxes_in_gaps(&self, size: f64, resolution: f64, boxes: f64) -> u64 {
        let window = self.window();
        let starts = self.intervals().iter().map(|part| part.interval.left).chain([window.right]);
        let ends = self.intervals().iter().map(|part| part.interval.right);
        let place = |x: f64| ((x - window.left) / size).floor().clamp(0.0, boxes - 1.0);
        std::iter::once(window.left)
            .chain(ends)
            .zip(starts)
            .filter(|(left, right)| right - left > resolution * size)
            .map(|(left, right)| (place(right) - place(left) - 1.0).max(0.0) as u64)
            .sum()
    }
}

impl LabelImage {
    /// Counts square boxes of `side` pixels; boxes that do not fit are left out.
    ///
    /// The slope of ln `mixed` against ln 1/`size` estimates the dimension of the boundary, and
    /// 2 − slope is what some tools call the uncertainty exponent; for the exponent by pairs of points
    /// see [`uncertain_fraction`](crate::uncertain_fraction).
    ///
    /// # Errors
    /// [`Error::BadBoxSize`] if no box fits.
    pub fn boxes(&self, side: usize) -> Result<BoxCount, Error> {
        let (columns, rows) = (self.grid.columns, self.grid.rows);
        if side == 0 || side > columns || side > rows {
            return Err(Error::BadBoxSize { size: side as f64 });
        }
        let (across, up) = (columns / side, rows / side);
        let mut count = BoxCount {
            size: side as f64,
            boxes: (across * up) as u64,
            mixed: 0,
            open: 0,
            entropy: 0.0,
        };
        for corner in 0..across * up {
            let (column, row) = (side * (corner % across), side * (corner / across));
            let mut found: BTreeMap<u16, usize> = BTreeMap::new();
            for line in row..row + side {
                let from = line * columns + column;
                for &label in &self.labels[from..from + side] {
                    *found.entry(label).or_insert(0) += 1;
                }
            }
            if found.len() > 1 {
                count.mixed += 1;
                let all = (side * side) as f64;
                count.entropy += entropy(found.values().map(|&pixels| pixels as f64 / all));
            }
        }
        Ok(count)
    }
}
