//! The cells along one coordinate of a region.

use crate::space::interval::Interval;

/// What converges to the border of two cells ends some ulps from it, on either side: within this part of a cell.
const BORDER: f64 = 1e-9;

/// Adding 2⁵² to a number from 0 to 2⁵² rounds it to the nearest whole one, which the low bits of the sum are. Processors do this for several
/// numbers at once, and convert one at a time.
const TO_WHOLE: f64 = (1u64 << 52) as f64;

/// A whole number from 0 to 2³².
#[inline(always)]
pub(crate) fn whole(number: f64) -> usize {
    (number + TO_WHOLE).to_bits() as u32 as usize
}

/// The cells along one coordinate.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    pub(crate) coordinate: usize,
    pub(crate) side: Interval,
    pub(crate) cells: u64,
    /// Cells for each unit of length, if they are equal.
    per_length: f64,
    pub(crate) is_periodic: bool,
    /// The ends of cells of given lengths; empty for equal ones.
    pub(crate) edges: Vec<f64>,
}

impl Axis {
    /// So many equal cells on a side.
    pub(crate) fn new(coordinate: usize, side: Interval, cells: u64) -> Axis {
        let per_length = cells as f64 / side.length();
        Axis { coordinate, side, cells, per_length, is_periodic: false, edges: Vec::new() }
    }

    /// The same side with another number of cells.
    pub(crate) fn with_cells(&self, cells: u64) -> Axis {
        let per_length = cells as f64 / self.side.length();
        Axis { cells, per_length, edges: self.edges.clone(), ..*self }
    }

    /// Moves a number into the period.
    pub(crate) fn wrap(&self, x: &mut f64) {
        let side = self.side;
        if !(side.left <= *x && *x < side.right) && x.is_finite() {
            let turns = ((*x - side.left) / side.length()).floor();
            *x = (*x - turns * side.length()).clamp(side.left, side.right);
            // A small negative number plus a period is the period.
            if *x == side.right {
                *x = side.left;
            }
        }
    }

    /// The number of the cell of a place on the side.
    #[inline(always)]
    pub(crate) fn cell(&self, x: f64) -> u64 {
        let at = match self.edges.is_empty() {
            true => (x - self.side.left) * self.per_length,
            false => self.part(x) * self.cells as f64,
        };
        // The right end of the region belongs to the last cell.
        (at as i64 as u64).min(self.cells - 1)
    }

    /// Multiplies numbers of cells by that of this axis, and adds the [cells](Self::cell) of these places: NaN outside the side.
    pub(crate) fn add_cells(&self, places: &[f64], cells: &mut [f64]) {
        let (count, Interval { left, right }) = (self.cells as f64, self.side);
        let add = |cell: &mut f64, x: f64, own: f64| {
            let own = if (left <= x) & (x <= right) { own } else { f64::NAN };
            *cell = *cell * count + own;
        };
        if !self.edges.is_empty() {
            cells.iter_mut().zip(places).for_each(|(cell, &x)| add(cell, x, self.cell(x) as f64));
            return;
        }
        for (cell, &x) in cells.iter_mut().zip(places) {
            let at = (x - left) * self.per_length;
            let near = (at + TO_WHOLE) - TO_WHOLE;
            let own = if near > at { near - 1.0 } else { near };
            // Cells that are too short for a number per length give NaN at the left end.
            let own = if own > 0.0 { own } else { 0.0 };
            add(cell, x, if own < count - 1.0 { own } else { count - 1.0 });
        }
    }

    /// Whether a place on the side is on the border of two cells, to rounding.
    pub(crate) fn is_on_border(&self, x: f64) -> bool {
        let at = self.part(x) * self.cells as f64;
        let into_cell = at - at as i64 as f64;
        !(BORDER..=1.0 - BORDER).contains(&into_cell)
    }

    /// The cell of a place on the side, and the one beside it if the place is on their border, to rounding.
    pub(crate) fn touched(&self, x: f64) -> Vec<u64> {
        let own = self.cell(x);
        if !self.is_on_border(x) {
            return vec![own];
        }
        // The border is on the left of the cell, or on its right.
        let beside = match self.part(x) * self.cells as f64 - (own as f64) < 0.5 {
            true => own.checked_sub(1).or(self.is_periodic.then(|| self.cells - 1)),
            false if own + 1 < self.cells => Some(own + 1),
            false => self.is_periodic.then_some(0),
        };
        std::iter::once(own).chain(beside).collect()
    }

    /// How far along the axis a place is, from 0 to 1: cells of given lengths are equal parts.
    pub(crate) fn part(&self, x: f64) -> f64 {
        let Some(last) = self.edges.len().checked_sub(1) else {
            return (x - self.side.left) / self.side.length();
        };
        let at = self.edges.partition_point(|edge| *edge <= x).clamp(1, last);
        let (left, right) = (self.edges[at - 1], self.edges[at]);
        ((at - 1) as f64 + (x - left) / (right - left)) / last as f64
    }

    /// The place so far along the axis.
    pub(crate) fn place(&self, part: f64) -> f64 {
        let Some(last) = self.edges.len().checked_sub(1) else {
            return self.side.left + self.side.length() * part;
        };
        let at = ((part * last as f64) as usize).min(last - 1);
        self.edges[at] + (self.edges[at + 1] - self.edges[at]) * (part * last as f64 - at as f64)
    }
}
