//! Eigenvalues of derivatives, and how far they are known.

use nalgebra::{Complex, DMatrix, DVector, Schur};

/// Sweeps of the method for eigenvalues, for each of them. A few are usual; LAPACK stops at as many.
const MOST_SWEEPS: usize = 30;

/// A matrix, and how far each entry may be from the exact one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Uncertain {
    pub(crate) matrix: DMatrix<f64>,
    pub(crate) errors: DMatrix<f64>,
}

impl Uncertain {
    /// The product with a matrix on the left.
    pub(crate) fn after(&self, left: &Uncertain) -> Uncertain {
        let sizes = [&left.matrix, &self.matrix].map(DMatrix::abs);
        // Each product and each sum rounds.
        let rounding = f64::EPSILON * (self.matrix.nrows() as f64 + 1.0);
        let errors = &left.errors * &sizes[1]
            + &sizes[0] * &self.errors
            + (&sizes[0] * &sizes[1]) * rounding;
        Uncertain { matrix: &left.matrix * &self.matrix, errors }
    }

    /// The eigenvalues, and how far each may be from the exact one; none if the matrix has an entry that is not finite, or if they are not
    /// found.
    pub(crate) fn eigenvalues(&self) -> (Vec<Complex<f64>>, Vec<f64>) {
        let values = eigenvalues(&self.matrix);
        let errors = values.iter().map(|value| self.eigenvalue_error(value)).collect();
        (values, errors)
    }

    /// To first order an eigenvalue changes by Σ Pᵢⱼ Eⱼᵢ, with the projector P = x yᵀ / yᵀx on its eigenvector; and no
    /// eigenvalue changes by more than (2‖A‖ + ‖E‖)^(1 − 1/n) ‖E‖^(1/n) (L. Elsner, 1985), where several ones are nearly equal.
    fn eigenvalue_error(&self, value: &Complex<f64>) -> f64 {
        let n = self.matrix.nrows();
        // The eigenvalues of a matrix with roundings are computed.
        let rounding = f64::EPSILON * self.matrix.norm();
        let errors = self.errors.map(|error| error + rounding);
        let (size, error) = (self.matrix.norm(), errors.norm());
        let most = pxfm::f_pow(2.0 * size + error, 1.0 - 1.0 / n as f64)
            * pxfm::f_pow(error, 1.0 / n as f64);
        let complex = self.matrix.map(|entry| Complex::new(entry, 0.0));
        let shifted = &complex - DMatrix::identity(n, n) * *value;
        let vectors = (complex_null_vector(&shifted), complex_null_vector(&shifted.adjoint()));
        let (Some(x), Some(y)) = vectors else { return most };
        let overlap = y.dotc(&x).norm();
        let sum = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let moved: f64 = sum.map(|(i, j)| x[i].norm() * y[j].norm() * errors[(j, i)]).sum();
        (moved / overlap).min(most)
    }
}

/// The eigenvalues of a matrix; none if it has an entry that is not finite, or if they are not found.
///
/// The shifts of the method do not converge for some matrices with much symmetry, such as that of a cyclic shift. In other coordinates
/// these have none.
pub(crate) fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Complex<f64>> {
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return Vec::new();
    }
    let n = matrix.nrows();
    let found = |matrix: DMatrix<f64>| Schur::try_new(matrix, f64::EPSILON, MOST_SWEEPS * (n + 1));
    let schur = found(matrix.clone()).or_else(|| {
        // A reflection in a direction without symmetry.
        let mut normal =
            DVector::from_fn(n, |k, _| (0.618_033_988_75 * (k + 1) as f64).fract() + 0.1);
        normal /= normal.norm();
        let reflection = DMatrix::identity(n, n) - &normal * normal.transpose() * 2.0;
        found(&reflection * matrix * &reflection)
    });
    schur.map_or(Vec::new(), |schur| schur.complex_eigenvalues().iter().copied().collect())
}

/// The vector that a matrix maps nearest to zero, of length 1.
pub(crate) fn null_vector(matrix: &DMatrix<f64>) -> Option<DVector<f64>> {
    let svd = matrix.clone().try_svd(false, true, f64::EPSILON, 10_000)?;
    let smallest = svd.singular_values.imin();
    Some(svd.v_t?.row(smallest).transpose())
}

/// The complex vector that a matrix maps nearest to zero, of length 1.
pub(crate) fn complex_null_vector(matrix: &DMatrix<Complex<f64>>) -> Option<DVector<Complex<f64>>> {
    let svd = matrix.clone().try_svd(false, true, f64::EPSILON, 10_000)?;
    let smallest = svd.singular_values.imin();
    Some(svd.v_t?.row(smallest).adjoint())
}
