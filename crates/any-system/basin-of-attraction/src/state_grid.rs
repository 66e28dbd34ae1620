//! A region of state space divided into cells.

use crate::error::Error;
use crate::hyperrectangle::Hyperrectangle;
use crate::unmatched::Border;

/// Cells of a region, by number.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StateGrid {
    region: Hyperrectangle,
    /// Cells along every side.
    cells: u64,
}

/// The largest number of coordinates: a cell of a region of d dimensions has 3^d − 1 neighbours, 59 048 for ten.
const MOST_DIMENSIONS: usize = 10;

impl StateGrid {
    /// `cells` along every side of the region.
    pub(crate) fn new(region: Hyperrectangle, cells: usize) -> Result<Self, Error> {
        let dimension = region.dimension();
        let number = (cells as u64).checked_pow(dimension.min(64) as u32);
        if cells == 0 || dimension > MOST_DIMENSIONS || number.is_none() {
            return Err(Error::BadStateGrid { cells, dimension, most: MOST_DIMENSIONS });
        }
        Ok(StateGrid { region, cells: cells as u64 })
    }

    /// The number of coordinates.
    pub(crate) fn dimension(&self) -> usize {
        self.region.dimension()
    }

    /// The number of the cell that contains a point; `None` outside the region.
    pub(crate) fn cell(&self, point: &[f64]) -> Option<u64> {
        if !self.region.contains(point) {
            return None;
        }
        let sides = self.region.sides().iter().zip(point);
        Some(sides.rev().fold(0, |number, (side, &x)| {
            let at = (x - side.left) / side.length() * self.cells as f64;
            // The right end of the region belongs to the last cell.
            number * self.cells + (at as u64).min(self.cells - 1)
        }))
    }

    /// Cells along a side.
    pub(crate) fn cells(&self) -> u64 {
        self.cells
    }

    /// Where a point is farthest outside the region, in lengths of its sides; `None` inside.
    pub(crate) fn beyond(&self, point: &[f64]) -> Option<Border> {
        let sides = self.region.sides();
        let excess = |own: &Border| own.excess() / sides[own.coordinate].length();
        let outside =
            |(coordinate, (&reached, side)): (usize, (&f64, &crate::interval::Interval))| {
                let border = match reached {
                    x if x < side.left => side.left,
                    x if x > side.right => side.right,
                    _ => return None,
                };
                Some(Border { coordinate, border, reached })
            };
        let all = point.iter().zip(sides).enumerate().filter_map(outside);
        all.max_by(|a, b| excess(a).total_cmp(&excess(b)))
    }

    /// The cells that share at least a corner with a cell.
    pub(crate) fn neighbours(&self, cell: u64) -> Vec<u64> {
        let mut found = vec![(0, 1)];
        let mut rest = cell;
        for _ in 0..self.dimension() {
            let at = rest % self.cells;
            rest /= self.cells;
            let around = at.saturating_sub(1)..=(at + 1).min(self.cells - 1);
            found = around
                .flat_map(|at| found.iter().map(move |&(number, unit)| (number + at * unit, unit)))
                .collect();
            found.iter_mut().for_each(|(_, unit)| *unit = unit.saturating_mul(self.cells));
        }
        found.into_iter().map(|(number, _)| number).filter(|&number| number != cell).collect()
    }

    /// Whether a cell lies at the border of the region.
    pub(crate) fn is_at_border(&self, cell: u64) -> bool {
        let places = std::iter::successors(Some(cell), |rest| Some(rest / self.cells));
        let mut places = places.take(self.dimension()).map(|rest| rest % self.cells);
        places.any(|at| at == 0 || at + 1 == self.cells)
    }

    /// The point of a cell with these coordinates between 0 and 1 in it.
    pub(crate) fn point(&self, cell: u64, within: impl Fn(u64) -> f64) -> Vec<f64> {
        let mut rest = cell;
        let coordinate = |(k, side): (u64, &crate::interval::Interval)| {
            let at = rest % self.cells;
            rest /= self.cells;
            side.left + side.length() * ((at as f64 + within(k)) / self.cells as f64)
        };
        (0..).zip(self.region.sides()).map(coordinate).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::Interval;

    #[test]
    fn cells_points_and_neighbours_agree() {
        let sides = vec![Interval { left: -1.0, right: 2.0 }; 3];
        let grid = StateGrid::new(Hyperrectangle::new(sides).unwrap(), 4).unwrap();
        for cell in 0..64 {
            let middle = grid.point(cell, |_| 0.5);
            assert_eq!(grid.cell(&middle), Some(cell));
            let near = grid.neighbours(cell);
            let length = 0.75;
            for other in (0..64).filter(|&other| other != cell) {
                let there = grid.point(other, |_| 0.5);
                let beside = middle.iter().zip(&there).all(|(a, b)| (a - b).abs() < 1.5 * length);
                assert_eq!(near.contains(&other), beside, "{cell} {other}");
            }
        }
        assert_eq!(grid.cell(&[2.0, 2.0, 2.0]), Some(63));
        assert_eq!(grid.cell(&[2.1, 0.0, 0.0]), None);
        assert_eq!((0..64).filter(|&cell| !grid.is_at_border(cell)).count(), 8);
        let border = Border { coordinate: 2, border: -1.0, reached: -3.0 };
        assert_eq!(grid.beyond(&[2.5, 0.0, -3.0]), Some(border));
        assert_eq!(grid.beyond(&[2.0, 0.0, -1.0]), None);
        assert_eq!(grid.cell(&[f64::NAN, 0.0, 0.0]), None);
        let wide = Hyperrectangle::new(vec![Interval { left: 0.0, right: 1.0 }; 10]).unwrap();
        assert!(StateGrid::new(wide.clone(), 100).is_err() && StateGrid::new(wide, 0).is_err());
    }
}
