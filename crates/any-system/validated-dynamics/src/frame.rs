//! Frames: directions in which the errors of a set are kept, nearly orthogonal, with an enclosure of the inverse.

use crate::matrix::{Matrix, row_norm};
use interval_arithmetic::Enclosure;
use nalgebra::DMatrix;

/// A matrix of directions with an enclosure of its inverse.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Frame {
    /// The directions, as columns.
    pub(crate) directions: DMatrix<f64>,
    /// Encloses the inverse.
    pub(crate) inverse: Matrix,
}

impl Frame {
    /// The axes.
    pub(crate) fn axes(size: usize) -> Frame {
        Frame { directions: DMatrix::identity(size, size), inverse: Matrix::identity(size) }
    }

    /// The orthogonal frame whose first direction is the longest of these columns, each one with its length in `weights`: then those
    /// of the others that are left when the directions before are taken away. Long thin sets keep their shape so (R. J. Lohner, 1987).
    pub(crate) fn of_columns(columns: &DMatrix<f64>, weights: &[f64]) -> Frame {
        let size = columns.nrows();
        let mut order: Vec<usize> = (0..columns.ncols()).collect();
        let length = |&column: &usize| columns.column(column).norm() * weights[column];
        order.sort_by(|a, b| length(b).total_cmp(&length(a)));
        let mut directions: Vec<Vec<f64>> = Vec::with_capacity(size);
        let wanted = order.iter().map(|&column| columns.column(column).iter().copied().collect());
        let axes = (0..size).map(|axis| (0..size).map(|row| f64::from(row == axis)).collect());
        // Columns that depend on each other leave directions open: axes fill them.
        for candidate in wanted.chain(axes) {
            if directions.len() == size {
                break;
            }
            directions.extend(orthogonal_part(candidate, &directions));
        }
        let directions = DMatrix::from_fn(size, size, |row, column| directions[column][row]);
        match inverse_of(&directions, &directions.transpose()) {
            Some(inverse) => Frame { directions, inverse },
            None => Frame::axes(size),
        }
    }

    /// The longest of these columns that do not depend on each other, with length 1, and directions that are orthogonal to them where there
    /// are fewer than rows.
    pub(crate) fn independent(columns: &DMatrix<f64>) -> DMatrix<f64> {
        let size = columns.nrows();
        let mut left: Vec<Vec<f64>> =
            columns.column_iter().map(|column| column.iter().copied().collect()).collect();
        let (mut kept, mut orthogonal): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        let norm = |vector: &[f64]| vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        while orthogonal.len() < size {
            let beside = |vector: &Vec<f64>| {
                let part = orthogonal_part(vector.clone(), &orthogonal)?;
                let along: f64 = part.iter().zip(vector).map(|(x, y)| x * y).sum();
                Some((part, along))
            };
            let found =
                left.iter().enumerate().filter_map(|(place, own)| Some((place, beside(own)?)));
            let Some((place, (part, _))) = found.max_by(|a, b| a.1.1.total_cmp(&b.1.1)) else {
                break;
            };
            let own = left.swap_remove(place);
            let length = norm(&own);
            kept.push(own.iter().map(|x| x / length).collect());
            orthogonal.push(part);
        }
        for axis in 0..size {
            let unit = (0..size).map(|row| f64::from(row == axis)).collect();
            if let Some(part) =
                orthogonal_part(unit, &orthogonal).filter(|_| orthogonal.len() < size)
            {
                kept.push(part.clone());
                orthogonal.push(part);
            }
        }
        DMatrix::from_fn(size, size, |row, column| kept[column][row])
    }

    /// The frame of directions that a map has moved, with these widths in them; the axes for a map into another number of components,
    /// which leaves no frame that is worth while.
    pub(crate) fn of_moved(moved: &Matrix, widths: &[f64]) -> Frame {
        match moved.rows() == moved.columns() {
            true => Frame::of_columns(&moved.middle(), widths),
            false => Frame::axes(moved.rows()),
        }
    }

    /// The directions, as enclosures.
    pub(crate) fn matrix(&self) -> Matrix {
        Matrix::of_numbers(&self.directions)
    }
}

/// A direction whose part beside the others is shorter than this part of it is one of them, to rounding.
const DEPENDENT: f64 = 1e-10;

/// The part of a vector that is orthogonal to unit vectors, of length 1; `None` if it is lost in rounding.
fn orthogonal_part(mut vector: Vec<f64>, others: &[Vec<f64>]) -> Option<Vec<f64>> {
    let norm = |vector: &[f64]| vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    let before = norm(&vector);
    // The second time takes away what rounding has left.
    for _ in 0..2 {
        for other in others {
            let along: f64 = vector.iter().zip(other).map(|(x, y)| x * y).sum();
            vector.iter_mut().zip(other).for_each(|(x, y)| *x -= along * y);
        }
    }
    let after = norm(&vector);
    let is_kept = after > DEPENDENT * before && after.is_finite() && before > 0.0;
    is_kept.then(|| vector.iter().map(|x| x / after).collect())
}

/// An enclosure of the inverse of a matrix A, from an approximate inverse R: with E = I − RA of norm ε < 1 it is (I − E)⁻¹R, and
/// (I − E)⁻¹ − I has entries of at most ε/(1 − ε), in the norm of the largest sum of a row. `None` if ε is above ½.
pub(crate) fn inverse_of(matrix: &DMatrix<f64>, near: &DMatrix<f64>) -> Option<Matrix> {
    let size = matrix.nrows();
    let near = Matrix::of_numbers(near);
    let error = Matrix::identity(size).minus(&near.times(&Matrix::of_numbers(matrix)));
    let epsilon = row_norm(&error);
    // NaN has no inverse.
    if !(epsilon < 0.5) {
        return None;
    }
    let most = (Enclosure::from(epsilon) / (Enclosure::ONE - Enclosure::from(epsilon))).high();
    let near_identity = Matrix::from_fn(size, size, |row, column| {
        Enclosure::from(f64::from(row == column)).widened(most)
    });
    Some(near_identity.times(&near))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_has_its_inverse_also_for_columns_that_depend_on_each_other() {
        let columns = DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 0.1, 1.0, 2.0, 0.1, 3.0, 6.0, 0.3]);
        let frame = Frame::of_columns(&columns, &[1.0, 1.0, 5.0]);
        let product = frame.inverse.times(&frame.matrix());
        for (row, column) in (0..3).flat_map(|row| (0..3).map(move |column| (row, column))) {
            let entry = product.at(row, column);
            assert!(entry.contains(f64::from(row == column)) && entry.width() < 1e-14);
        }
    }
}
