//! Matrices and vectors of enclosures.

use interval_arithmetic::Enclosure;
use nalgebra::DMatrix;

/// A matrix whose entries are enclosures: every matrix of numbers in them is among its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    /// Row by row.
    entries: Vec<Enclosure>,
}

impl Matrix {
    /// The matrix with these entries, by row and column.
    pub fn from_fn(
        rows: usize,
        columns: usize,
        mut entry: impl FnMut(usize, usize) -> Enclosure,
    ) -> Matrix {
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        Matrix { rows, columns, entries: places.map(|(row, column)| entry(row, column)).collect() }
    }

    /// The identity.
    pub fn identity(size: usize) -> Matrix {
        Matrix::from_fn(size, size, |row, column| Enclosure::from(f64::from(row == column)))
    }

    /// The matrix of numbers, exactly.
    pub fn of_numbers(numbers: &DMatrix<f64>) -> Matrix {
        Matrix::from_fn(numbers.nrows(), numbers.ncols(), |row, column| {
            Enclosure::from(numbers[(row, column)])
        })
    }

    /// The matrix of a list of entries, row by row; entries that the list does not have are 0.
    pub(crate) fn of_rows(rows: usize, columns: usize, entries: &[Enclosure]) -> Matrix {
        Matrix::from_fn(rows, columns, |row, column| {
            entries.get(row * columns + column).copied().unwrap_or(Enclosure::ZERO)
        })
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The entry of a row and a column; `None` beyond the last ones.
    pub fn get(&self, row: usize, column: usize) -> Option<Enclosure> {
        (row < self.rows && column < self.columns).then(|| self.at(row, column))
    }

    pub(crate) fn at(&self, row: usize, column: usize) -> Enclosure {
        self.entries[row * self.columns + column]
    }

    /// The entries of a row.
    pub(crate) fn row(&self, row: usize) -> &[Enclosure] {
        &self.entries[row * self.columns..][..self.columns]
    }

    /// All entries, row by row.
    pub fn entries(&self) -> &[Enclosure] {
        &self.entries
    }

    /// The products A B, for a matrix B with as many rows as this one has columns.
    pub(crate) fn times(&self, other: &Matrix) -> Matrix {
        Matrix::from_fn(self.rows, other.columns, |row, column| {
            dot(self.row(row), (0..other.rows).map(|k| other.at(k, column)))
        })
    }

    /// The products A x.
    pub(crate) fn apply(&self, vector: &[Enclosure]) -> Vec<Enclosure> {
        (0..self.rows).map(|row| dot(self.row(row), vector.iter().copied())).collect()
    }

    /// The differences, entry by entry.
    pub(crate) fn minus(&self, other: &Matrix) -> Matrix {
        Matrix::from_fn(self.rows, self.columns, |row, column| {
            self.at(row, column) - other.at(row, column)
        })
    }

    /// The sums, entry by entry.
    pub(crate) fn plus(&self, other: &Matrix) -> Matrix {
        Matrix::from_fn(self.rows, self.columns, |row, column| {
            self.at(row, column) + other.at(row, column)
        })
    }

    /// Numbers in the middle of the entries.
    pub fn middle(&self) -> DMatrix<f64> {
        DMatrix::from_fn(self.rows, self.columns, |row, column| self.at(row, column).middle())
    }

    /// The upper bound of the widths of all entries.
    pub fn width(&self) -> f64 {
        self.entries.iter().map(Enclosure::width).fold(0.0, f64::max)
    }
}

/// Σ a_k b_k. Terms that are 0 exactly are left out: rounding outwards would make them wide.
pub(crate) fn dot(a: &[Enclosure], b: impl Iterator<Item = Enclosure>) -> Enclosure {
    let terms = a.iter().zip(b).filter(|(a, b)| **a != Enclosure::ZERO && *b != Enclosure::ZERO);
    let products = terms.map(|(a, b)| match (*a, b) {
        (Enclosure::ONE, b) => b,
        (a, Enclosure::ONE) => a,
        (a, b) => a * b,
    });
    products.fold(Enclosure::ZERO, sum)
}

/// An upper bound of the largest sum of absolute values of a row.
pub(crate) fn row_norm(matrix: &Matrix) -> f64 {
    let sum = |row| {
        let sizes = matrix.row(row).iter().map(|x| Enclosure::from(x.magnitude()));
        sizes.fold(Enclosure::ZERO, |sum, x| sum + x).high()
    };
    (0..matrix.rows()).map(sum).fold(0.0, f64::max)
}

/// a + b, exactly if one of them is 0.
pub(crate) fn sum(a: Enclosure, b: Enclosure) -> Enclosure {
    if a == Enclosure::ZERO {
        b
    } else if b == Enclosure::ZERO {
        a
    } else {
        a + b
    }
}

/// The sums of two vectors.
pub(crate) fn sums(a: &[Enclosure], b: &[Enclosure]) -> Vec<Enclosure> {
    a.iter().zip(b).map(|(a, b)| sum(*a, *b)).collect()
}

/// The common part of two boxes that hold the same points. Without one, which would be a fault, both.
pub(crate) fn common(a: &[Enclosure], b: &[Enclosure]) -> Vec<Enclosure> {
    a.iter().zip(b).map(|(a, b)| a.intersection(b).unwrap_or_else(|| a.hull(b))).collect()
}

/// The distances of the points of a box from a point.
pub(crate) fn offsets(all: &[Enclosure], point: &[f64]) -> Vec<Enclosure> {
    all.iter()
        .zip(point)
        .map(|(x, &c)| if *x == Enclosure::from(c) { Enclosure::ZERO } else { *x - c })
        .collect()
}

/// The point in the middle of a box.
pub(crate) fn middle(all: &[Enclosure]) -> Vec<f64> {
    all.iter().map(Enclosure::middle).collect()
}

/// The numbers as enclosures, exactly.
pub(crate) fn exact(numbers: &[f64]) -> Vec<Enclosure> {
    numbers.iter().map(|&x| Enclosure::from(x)).collect()
}
