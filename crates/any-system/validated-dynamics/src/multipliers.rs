//! Eigenvalues of all matrices of an enclosure.

use crate::matrix::{Matrix, row_norm};
use interval_arithmetic::Enclosure;
use nalgebra::DMatrix;
use std::fmt;

/// A disc of the complex plane that holds one eigenvalue of each matrix, or more of them where discs meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Multiplier {
    /// The real part of the centre.
    pub real: f64,
    /// The imaginary part of the centre.
    pub imaginary: f64,
    /// The radius.
    pub radius: f64,
    /// True if the disc meets no other one: it holds exactly one eigenvalue.
    pub alone: bool,
}

/// The interval of a real eigenvalue; else the disc.
impl fmt::Display for Multiplier {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.real() {
            Some(real) => real.fmt(formatter),
            None => {
                let Multiplier { real, imaginary, radius, .. } = self;
                write!(formatter, "the disc of radius {radius:e} about {real} + {imaginary} i")
            }
        }
    }
}

impl Multiplier {
    /// Bounds of the absolute value.
    pub fn size(&self) -> Enclosure {
        let (real, imaginary) = (Enclosure::from(self.real), Enclosure::from(self.imaginary));
        let sum = real.squared() + imaginary.squared();
        // Rounding may lead a sum of squares below 0.
        let sum = Enclosure::new(sum.low().max(0.0), sum.high());
        let centre = sum.sqrt().unwrap_or(Enclosure::WHOLE);
        let found = centre.widened(self.radius);
        Enclosure::new(found.low().max(0.0), found.high())
    }

    /// True if the eigenvalue is inside the unit circle for certain.
    pub fn is_inside(&self) -> bool {
        self.size().high() < 1.0
    }

    /// True if the eigenvalue is outside the unit circle for certain.
    pub fn is_outside(&self) -> bool {
        self.size().low() > 1.0
    }

    /// Bounds of an eigenvalue that is real for certain: of a disc on the real axis that meets no other one.
    pub fn real(&self) -> Option<Enclosure> {
        (self.alone && self.imaginary == 0.0)
            .then(|| Enclosure::from(self.real).widened(self.radius))
    }
}

/// Discs that hold the eigenvalues of all matrices of a square enclosure, and for each disc that meets no other one exactly one.
///
/// In the basis of approximate eigenvectors each matrix is D + E, with D of blocks a or (a b; −b a), which is normal. The eigenvalues of
/// D + E are within the norm of E of those of D, and move with E continuously (F. L. Bauer, C. T. Fike, 1960). Without such a basis
/// one disc about 0 holds them all. A matrix that is not square has none.
pub fn multipliers(matrices: &Matrix) -> Vec<Multiplier> {
    if matrices.rows() != matrices.columns() {
        return Vec::new();
    }
    let middle = matrices.middle();
    let near = eigenbasis(&middle).and_then(|(basis, blocks)| {
        let inverse = basis.clone().try_inverse()?;
        let blocks = refined(&(&inverse * &middle * &basis), &blocks);
        let radius = distance(matrices, &basis, &inverse, &blocks)?;
        Some((eigenvalues(&blocks), radius))
    });
    let (values, radius) =
        near.unwrap_or_else(|| (vec![(0.0, 0.0); matrices.rows()], row_norm(matrices)));
    let radii = (Enclosure::from(radius) * 2.0).high();
    let meet = |a: (f64, f64), b: (f64, f64)| {
        let [real, imaginary] = [(a.0, b.0), (a.1, b.1)].map(|(x, y)| Enclosure::from(x) - y);
        let apart = (real.squared() + imaginary.squared()).sqrt();
        !apart.is_some_and(|apart| apart.low() > radii)
    };
    let disc = |own: usize| {
        let alone =
            (0..values.len()).all(|other| other == own || !meet(values[own], values[other]));
        let (real, imaginary) = values[own];
        Multiplier { real, imaginary, radius, alone }
    };
    (0..values.len()).map(disc).collect()
}

/// A bound of the norm of B⁻¹ A B − D, for all A of an enclosure: with R ≈ B⁻¹ it is that of (RB)⁻¹ (R A B − R B D).
fn distance(
    matrices: &Matrix,
    basis: &DMatrix<f64>,
    inverse: &DMatrix<f64>,
    blocks: &DMatrix<f64>,
) -> Option<f64> {
    let [basis, inverse, blocks] = [basis, inverse, blocks].map(Matrix::of_numbers);
    let near_identity = inverse.times(&basis);
    let off = inverse.times(&matrices.times(&basis)).minus(&near_identity.times(&blocks));
    let epsilon = row_norm(&Matrix::identity(basis.rows()).minus(&near_identity));
    if !(epsilon < 0.5) {
        return None;
    }
    // ‖(RB)⁻¹ N‖ ≤ ‖N‖ + ‖N‖ ε/(1 − ε) in the norm of rows, and the Euclidean one of n rows is at most √n times as large.
    let size = Enclosure::from(off.rows() as f64).sqrt()?;
    let more = Enclosure::ONE / (Enclosure::ONE - Enclosure::from(epsilon));
    let found = Enclosure::from(row_norm(&off)) * more * size;
    found.high().is_finite().then_some(found.high())
}

/// The eigenvalues of a matrix of blocks.
fn eigenvalues(blocks: &DMatrix<f64>) -> Vec<(f64, f64)> {
    let size = blocks.nrows();
    let above = |at: usize| if at + 1 < size { blocks[(at, at + 1)] } else { 0.0 };
    let below = |at: usize| if at > 0 { blocks[(at, at - 1)] } else { 0.0 };
    (0..size)
        .map(|at| (blocks[(at, at)], if above(at) != 0.0 { above(at) } else { below(at) }))
        .collect()
}

/// The blocks of a matrix in the basis of its eigenvectors, which has more digits than the eigenvalues from which the basis was found.
fn refined(found: &DMatrix<f64>, blocks: &DMatrix<f64>) -> DMatrix<f64> {
    let size = blocks.nrows();
    let mut refined = DMatrix::zeros(size, size);
    let mut at = 0;
    while at < size {
        let is_pair = at + 1 < size && blocks[(at, at + 1)] != 0.0;
        if is_pair {
            let real = found[(at, at)].midpoint(found[(at + 1, at + 1)]);
            let imaginary = found[(at, at + 1)].midpoint(-found[(at + 1, at)]);
            (refined[(at, at)], refined[(at + 1, at + 1)]) = (real, real);
            (refined[(at, at + 1)], refined[(at + 1, at)]) = (imaginary, -imaginary);
        } else {
            refined[(at, at)] = found[(at, at)];
        }
        at += if is_pair { 2 } else { 1 };
    }
    refined
}

/// Approximate eigenvectors as columns, and the blocks: of a pair a ± ib the real and the imaginary part of a vector.
pub(crate) fn eigenbasis(matrix: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    if !matrix.iter().all(|x| x.is_finite()) {
        return None;
    }
    let size = matrix.nrows();
    let mut values: Vec<(f64, f64)> = matrix
        .clone()
        .complex_eigenvalues()
        .iter()
        .map(|value| (value.re, value.im.abs()))
        .collect();
    values.sort_by(|a, b| b.0.total_cmp(&a.0).then(b.1.total_cmp(&a.1)));
    let mut basis = DMatrix::zeros(size, size);
    let mut blocks = DMatrix::zeros(size, size);
    let mut at = 0;
    while at < size {
        let (real, imaginary) = values[at];
        let is_pair = imaginary != 0.0 && at + 1 < size;
        let vectors = eigenvectors(matrix, real, if is_pair { imaginary } else { 0.0 })?;
        basis.set_column(at, &vectors.0);
        blocks[(at, at)] = real;
        if is_pair {
            basis.set_column(at + 1, &vectors.1);
            blocks[(at + 1, at + 1)] = real;
            (blocks[(at, at + 1)], blocks[(at + 1, at)]) = (imaginary, -imaginary);
        }
        at += if is_pair { 2 } else { 1 };
    }
    Some((basis, blocks))
}

/// The factor by which an eigenvalue is moved, so that the matrix can be inverted: then the inverse is large along the vector.
const MOVED: f64 = 1e-10;

/// The real and the imaginary part u + iv of an approximate eigenvector to a + ib, with A u = a u − b v and A v = b u + a v, by inverse
/// iteration in twice as many real components.
fn eigenvectors(
    matrix: &DMatrix<f64>,
    real: f64,
    imaginary: f64,
) -> Option<(nalgebra::DVector<f64>, nalgebra::DVector<f64>)> {
    let size = matrix.nrows();
    let scale = matrix.amax().max(f64::MIN_POSITIVE);
    let moved = real + MOVED * scale;
    let shifted = DMatrix::from_fn(2 * size, 2 * size, |row, column| {
        let (own, other) = (row % size, column % size);
        match (row < size, column < size) {
            (true, true) | (false, false) => {
                matrix[(own, other)] - if own == other { moved } else { 0.0 }
            }
            (true, false) => {
                if own == other {
                    imaginary
                } else {
                    0.0
                }
            }
            (false, true) => {
                if own == other {
                    -imaginary
                } else {
                    0.0
                }
            }
        }
    });
    // Cofactors, which `DMatrix::try_inverse` takes for small matrices, lose all digits of one that is nearly singular.
    let inverse = shifted.lu().try_inverse()?;
    // No eigenvector of a real model is orthogonal to this one, with digits of √2 and √3.
    let mut vector = nalgebra::DVector::from_fn(2 * size, |row, _| {
        if row < size {
            1.0 + 0.414 * row as f64
        } else if imaginary != 0.0 {
            0.732
        } else {
            0.0
        }
    });
    for _ in 0..3 {
        vector = &inverse * vector;
        vector /= vector.norm();
    }
    vector
        .iter()
        .all(|x| x.is_finite())
        .then(|| (vector.rows(0, size).into_owned(), vector.rows(size, size).into_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn discs_hold_a_pair_and_a_real_eigenvalue() {
        // A turn by 1 times 0.9, and 2, in another basis.
        let (sine, cosine) = Enclosure::from(1.0).sin_cos();
        let (c, s) = (0.9 * cosine.low(), 0.9 * sine.low());
        let turn = DMatrix::from_row_slice(3, 3, &[c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 2.0]);
        let basis = DMatrix::from_row_slice(3, 3, &[1.0, 0.5, 0.0, 0.0, 1.0, 0.3, 0.2, 0.0, 1.0]);
        let matrix = &basis * turn * basis.clone().try_inverse().unwrap_or_default();
        let found = multipliers(&Matrix::of_numbers(&matrix));
        assert!(found.iter().all(|found| found.radius < 1e-13), "{found:?}");
        assert!(found[0].real == 2.0 || found[0].is_outside());
        assert!(found[1].is_inside() && found[2].is_inside());
        assert!(found[1].size().contains(0.9) || (found[1].size().middle() - 0.9).abs() < 1e-14);
        assert_eq!(found[0].real().map(|x| x.contains(2.0)), Some(true));
    }

    #[test]
    fn a_matrix_without_a_basis_has_one_disc() {
        let jordan = DMatrix::from_row_slice(2, 2, &[0.5, 1.0, 0.0, 0.5]);
        let found = multipliers(&Matrix::of_numbers(&jordan));
        assert!(found.iter().all(|found| (found.real - 0.5).abs() <= found.radius));
        assert!(found.iter().all(|found| !found.alone && found.real().is_none()));
    }
}
