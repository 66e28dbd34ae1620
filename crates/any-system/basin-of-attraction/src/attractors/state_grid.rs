//! A region of state space divided into cells.

use crate::attractors::axis::Axis;
use crate::attractors::unmatched::Border;
use crate::error::Error;
use crate::space::hyperrectangle::Hyperrectangle;
use crate::space::interval::Interval;
use crate::space::vectors::check_dimension;

/// Cells of a region: along each axis as many as are asked for, of equal or of given lengths.
///
/// ```
/// use basin_of_attraction::{Hyperrectangle, Interval, StateGrid};
/// use std::f64::consts::PI;
/// // Angle and rate of a pendulum. The angle is periodic: it has no border.
/// let region = Hyperrectangle::new(vec![Interval::new(-PI, PI)?, Interval::new(-3.0, 3.0)?])?;
/// let grid = StateGrid::new(region, &[200, 60])?.periodic(0)?;
/// # assert_eq!(grid.dimension(), 2);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct StateGrid {
    pub(super) axes: Vec<Axis>,
    /// The number of coordinates of a state.
    dimension: usize,
}

/// The largest number of axes: a cell of a region of d dimensions has 3^d − 1 neighbours, 59 048 for ten.
const MOST_AXES: usize = 10;

/// With fewer cells along an axis each of them is at the border of the region, and no orbit can be seen to stay away from it.
const FEWEST_CELLS: usize = 3;

impl StateGrid {
    /// So many cells along each side of a region, of equal lengths.
    ///
    /// # Errors
    /// [`Error::BadStateGrid`] for more than ten sides, and more than 2⁶³ cells; [`Error::WrongDimension`] for another number of numbers
    /// than sides; [`Error::BadSearch`] for fewer than three cells along a side.
    pub fn new(region: Hyperrectangle, cells: &[usize]) -> Result<StateGrid, Error> {
        check_dimension(cells.len(), region.dimension())?;
        let axis = |(coordinate, (&side, &cells)): (usize, (&Interval, &usize))| {
            Axis::new(coordinate, side, cells as u64)
        };
        let axes: Vec<Axis> = region.sides().iter().zip(cells).enumerate().map(axis).collect();
        StateGrid { dimension: axes.len(), axes }.checked()
    }

    /// So many cells along every side.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn uniform(region: Hyperrectangle, cells: usize) -> Result<StateGrid, Error> {
        let all = vec![cells; region.dimension()];
        StateGrid::new(region, &all)
    }

    /// Cells with these ends, for each coordinate a list that increases. Short cells separate attractors where these are small.
    ///
    /// # Errors
    /// As [`new`](Self::new); [`Error::BadInterval`] for ends that do not increase.
    pub fn from_edges(edges: Vec<Vec<f64>>) -> Result<StateGrid, Error> {
        let side = |edges: &Vec<f64>| {
            let (left, right) = (edges.first().copied(), edges.last().copied());
            let increases = |pair: &[f64]| pair[0] < pair[1];
            if let Some(pair) = edges.windows(2).find(|pair| !increases(pair)) {
                return Err(Error::BadInterval { left: pair[0], right: pair[1] });
            }
            Interval::new(left.unwrap_or(f64::NAN), right.unwrap_or(f64::NAN))
        };
        let region = Hyperrectangle::new(edges.iter().map(side).collect::<Result<_, _>>()?)?;
        let cells: Vec<usize> = edges.iter().map(|edges| edges.len() - 1).collect();
        let mut grid = StateGrid::new(region, &cells)?;
        grid.axes.iter_mut().zip(edges).for_each(|(axis, edges)| axis.edges = edges);
        Ok(grid)
    }

    /// The same grid with a periodic coordinate, such as an angle: its side is one period. The map must take states that differ by a period
    /// to states that do. Orbits are moved into the period after each step.
    ///
    /// # Errors
    /// [`Error::WrongDimension`] for a coordinate that the grid does not have.
    pub fn periodic(mut self, coordinate: usize) -> Result<StateGrid, Error> {
        let expected = self.dimension;
        let axis = self.axes.iter_mut().find(|axis| axis.coordinate == coordinate);
        axis.ok_or(Error::WrongDimension { dimension: coordinate + 1, expected })?.is_periodic =
            true;
        Ok(self)
    }

    /// The same cells of some coordinates of states with `dimension` coordinates: axis k has coordinate `coordinates[k]`. The others do not
    /// tell attractors apart: two are one if the cells of one of them are among those of the other.
    ///
    /// An orbit crosses cells of an attractor to which it does not come, as the others are not seen. So it has come to an attractor only if it stays in the
    /// cells for [`RecurrenceLimits::recurrences`](crate::RecurrenceLimits::recurrences) steps. Its time is the step at which the stay begins.
    ///
    /// To project by a function, follow states that have its values as further coordinates.
    ///
    /// # Errors
    /// [`Error::WrongDimension`] for another number of coordinates than axes, and for a coordinate that is not below `dimension`;
    /// [`Error::BadSearch`] for one that is there twice.
    pub fn of_coordinates(
        mut self,
        coordinates: &[usize],
        dimension: usize,
    ) -> Result<StateGrid, Error> {
        check_dimension(coordinates.len(), self.axes.len())?;
        for (place, &coordinate) in coordinates.iter().enumerate() {
            if coordinate >= dimension {
                let (dimension, expected) = (coordinate + 1, dimension);
                return Err(Error::WrongDimension { dimension, expected });
            }
            if coordinates[..place].contains(&coordinate) {
                let (name, remedy) = ("a coordinate", "; give each of them once");
                return Err(Error::BadSearch { name, value: coordinate as f64, remedy });
            }
            self.axes[place].coordinate = coordinate;
        }
        self.dimension = dimension;
        Ok(self)
    }

    fn checked(self) -> Result<StateGrid, Error> {
        if let Some(axis) = self.axes.iter().find(|axis| axis.cells < FEWEST_CELLS as u64) {
            let (name, remedy) = ("a number of cells along a side", "; give 3 or more");
            return Err(Error::BadSearch { name, value: axis.cells as f64, remedy });
        }
        let number = self.axes.iter().try_fold(1u64, |all, axis| all.checked_mul(axis.cells));
        let number = number.filter(|number| *number <= i64::MAX as u64);
        if self.axes.len() > MOST_AXES || number.is_none() {
            let cells = self.most_cells() as usize;
            let (dimension, most) = (self.axes.len(), MOST_AXES);
            return Err(Error::BadStateGrid { cells, dimension, most });
        }
        Ok(self)
    }

    /// The grid with n, 2n + 1, 4n + 3, … cells for n; `None` if they cannot be numbered.
    ///
    /// The odd numbers matter: cells of n and of 2n share their corners, and a fixed point on a corner belongs to one
    /// of four cells, which orbits in the others never enter.
    pub(crate) fn finer(&self, halvings: u32) -> Option<StateGrid> {
        let mut finer = self.clone();
        let parts = 1u64.checked_shl(halvings)?;
        for axis in &mut finer.axes {
            let cells = axis.cells.checked_mul(parts)?.checked_add(parts - 1)?;
            *axis = axis.with_cells(cells);
        }
        finer.checked().ok()
    }

    /// The number of coordinates of a state.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The largest number of cells along an axis.
    pub(crate) fn most_cells(&self) -> u64 {
        self.axes.iter().map(|axis| axis.cells).max().unwrap_or(0)
    }

    /// The number of cells.
    pub(crate) fn count(&self) -> u64 {
        self.axes.iter().map(|axis| axis.cells).product()
    }

    /// The largest absolute value of a coordinate of a state in the region; infinite if a coordinate has no cells.
    pub(crate) fn largest(&self) -> f64 {
        let ends = self.axes.iter().flat_map(|axis| [axis.side.left, axis.side.right]);
        let largest = ends.fold(0.0, |largest: f64, end| largest.max(end.abs()));
        if self.has_hidden() { f64::INFINITY } else { largest }
    }

    /// Whether a coordinate of the states has no cells.
    pub(crate) fn has_hidden(&self) -> bool {
        self.axes.len() < self.dimension
    }

    pub(crate) fn is_periodic(&self) -> bool {
        self.axes.iter().any(|axis| axis.is_periodic)
    }

    /// Moves a state into the periods of its coordinates.
    pub(crate) fn wrap(&self, state: &mut [f64]) {
        let periodic = self.axes.iter().filter(|axis| axis.is_periodic);
        periodic.for_each(|axis| axis.wrap(&mut state[axis.coordinate]));
    }

    /// The same of many states, by columns.
    pub(crate) fn wrap_columns(&self, columns: &mut [Vec<f64>]) {
        for axis in self.axes.iter().filter(|axis| axis.is_periodic) {
            columns[axis.coordinate].iter_mut().for_each(|x| axis.wrap(x));
        }
    }

    /// The number of the cell that contains a state, moved into its periods; `None` outside the region.
    pub(crate) fn cell(&self, state: &[f64]) -> Option<u64> {
        self.cell_by(|coordinate| state[coordinate])
    }

    /// The same of a state with these coordinates.
    #[inline(always)]
    pub(crate) fn cell_by(&self, at: impl Fn(usize) -> f64) -> Option<u64> {
        let mut number = 0;
        for axis in self.axes.iter().rev() {
            let x = at(axis.coordinate);
            if !axis.side.contains(x) {
                return None;
            }
            number = number * axis.cells + axis.cell(x);
        }
        Some(number)
    }

    /// The numbers of the cells of many states, by columns; NaN outside the region. For fewer than 2⁵² cells.
    ///
    /// There is no branch: the processor does not foresee where orbits end, and a wrong guess takes as long as some steps of a simple map.
    pub(crate) fn cells_of_columns(&self, columns: &[Vec<f64>], cells: &mut Vec<f64>) {
        cells.clear();
        cells.resize(columns.first().map_or(0, Vec::len), 0.0);
        for axis in self.axes.iter().rev() {
            axis.add_cells(&columns[axis.coordinate], cells);
        }
    }

    /// Where a state is farthest outside the region, in lengths of its sides; `None` inside.
    pub(crate) fn beyond(&self, state: &[f64]) -> Option<Border> {
        let excess = |own: &(Border, f64)| own.0.excess() / own.1;
        let outside = |axis: &Axis| {
            let (reached, side) = (state[axis.coordinate], axis.side);
            let border = match reached {
                x if x < side.left => side.left,
                x if x > side.right => side.right,
                _ => return None,
            };
            Some((Border { coordinate: axis.coordinate, border, reached }, side.length()))
        };
        let all = self.axes.iter().filter_map(outside);
        all.max_by(|a, b| excess(a).total_cmp(&excess(b))).map(|(border, _)| border)
    }

    /// The most cells that share a corner with a cell.
    pub(crate) fn most_neighbours(&self) -> usize {
        3usize.pow(self.axes.len() as u32)
    }

    /// The cells that share at least a corner with a cell.
    pub(crate) fn neighbours(&self, cell: u64) -> Vec<u64> {
        let mut found = vec![0];
        let (mut rest, mut unit) = (cell, 1u64);
        for axis in &self.axes {
            let at = rest % axis.cells;
            rest /= axis.cells;
            let beside = |by: i64| {
                let next = at as i64 + by;
                match axis.is_periodic {
                    true => Some(next.rem_euclid(axis.cells as i64) as u64),
                    false => u64::try_from(next).ok().filter(|next| *next < axis.cells),
                }
            };
            let around: Vec<u64> = [-1, 0, 1].into_iter().filter_map(beside).collect();
            found = around.iter().flat_map(|at| found.iter().map(move |n| n + at * unit)).collect();
            unit = unit.saturating_mul(axis.cells);
        }
        found.retain(|&number| number != cell);
        found
    }

    /// Whether a cell lies at the border of the region.
    pub(crate) fn is_at_border(&self, cell: u64) -> bool {
        let mut rest = cell;
        self.axes.iter().any(|axis| {
            let at = rest % axis.cells;
            rest /= axis.cells;
            !axis.is_periodic && (at == 0 || at + 1 == axis.cells)
        })
    }

    /// Moves a state into a cell, to the place with these coordinates between 0 and 1 in it.
    pub(crate) fn move_into(&self, cell: u64, within: impl Fn(u64) -> f64, state: &mut [f64]) {
        let mut rest = cell;
        for (k, axis) in (0..).zip(&self.axes) {
            let at = rest % axis.cells;
            rest /= axis.cells;
            state[axis.coordinate] = axis.place((at as f64 + within(k)) / axis.cells as f64);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(dimension: usize) -> Hyperrectangle {
        Hyperrectangle::new(vec![Interval { left: -1.0, right: 2.0 }; dimension]).unwrap()
    }

    #[test]
    fn cells_points_and_neighbours_agree() {
        let grid = StateGrid::uniform(cube(3), 4).unwrap();
        let middle = |cell| {
            let mut middle = vec![f64::NAN; 3];
            grid.move_into(cell, |_| 0.5, &mut middle);
            middle
        };
        for cell in 0..64 {
            assert_eq!(grid.cell(&middle(cell)), Some(cell));
            let near = grid.neighbours(cell);
            let length = 0.75;
            for other in (0..64).filter(|&other| other != cell) {
                let (here, there) = (middle(cell), middle(other));
                let beside = here.iter().zip(&there).all(|(a, b)| (a - b).abs() < 1.5 * length);
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
        assert!(StateGrid::uniform(cube(10), 100).is_err());
        assert!(
            StateGrid::uniform(cube(11), 3).is_err() && StateGrid::uniform(cube(1), 2).is_err()
        );
        assert!(StateGrid::new(cube(2), &[4]).is_err());
    }

    /// A periodic axis has no border, and its first and last cells are neighbours.
    #[test]
    fn periodic_axes_have_no_border() {
        let grid = StateGrid::new(cube(2), &[6, 4]).unwrap().periodic(0).unwrap();
        let mut state = [2.25, 0.0];
        grid.wrap(&mut state);
        assert_eq!(state, [-0.75, 0.0]);
        for turns in [-7.0, -1.0, 1e6] {
            let mut state = [0.3 + 3.0 * turns, 0.0];
            grid.wrap(&mut state);
            assert!((state[0] - 0.3).abs() < 1e-9, "{turns} {state:?}");
        }
        assert_eq!(grid.neighbours(6).len(), 8);
        assert!(grid.neighbours(6).contains(&11) && !grid.is_at_border(6) && grid.is_at_border(0));
        assert!(grid.clone().periodic(2).is_err());
        assert_eq!(grid.finer(2).unwrap().most_cells(), 27);
    }

    /// Cells of given lengths, of two coordinates of three.
    #[test]
    fn given_edges_and_some_coordinates() {
        let edges = vec![vec![0.0, 1.0, 1.5, 1.75, 4.0], vec![-1.0, 0.0, 1.0, 5.0]];
        let grid = StateGrid::from_edges(edges).unwrap().of_coordinates(&[2, 0], 3).unwrap();
        assert_eq!((grid.dimension(), grid.cell(&[3.0, f64::NAN, 1.6])), (3, Some(2 + 2 * 4)));
        assert_eq!(grid.cell(&[5.0, 0.0, 4.0]), Some(11));
        for cell in 0..12 {
            let mut state = [0.0; 3];
            grid.move_into(cell, |k| [0.3, 0.9][k as usize], &mut state);
            assert_eq!((grid.cell(&state), state[1]), (Some(cell), 0.0));
        }
        assert!(StateGrid::from_edges(vec![vec![0.0, 2.0, 1.0, 3.0]]).is_err());
        assert!(StateGrid::from_edges(vec![Vec::new()]).is_err());
        let line = || StateGrid::uniform(cube(2), 5).unwrap();
        assert!(line().of_coordinates(&[0, 0], 3).is_err());
        assert!(
            line().of_coordinates(&[0], 3).is_err() && line().of_coordinates(&[0, 3], 3).is_err()
        );
    }
}
