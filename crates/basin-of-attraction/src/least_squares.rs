//! The least-squares line and parabola through points.

/// A straight line fitted to points by least squares.
pub(crate) struct FittedLine {
    pub(crate) slope: f64,
    /// Sum of the squared residuals.
    pub(crate) squared_residuals: f64,
    /// Σ (x − mean)². The variance of the residuals divided by this is the variance of the slope.
    pub(crate) spread: f64,
}

/// Fits a line to (x, y). The points must have at least two different x, or the slope is NaN.
pub(crate) fn fit_line(points: &[(f64, f64)]) -> FittedLine {
    let n = points.len() as f64;
    let (mean_x, mean_y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let spread: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.0 - mean_x)).sum();
    let slope = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum::<f64>() / spread;
    let residual = |p: &(f64, f64)| (p.1 - mean_y) - slope * (p.0 - mean_x);
    let squared_residuals = points.iter().map(|p| residual(p) * residual(p)).sum();
    FittedLine { slope, squared_residuals, spread }
}

/// The curvature of a parabola fitted to points by least squares.
pub(crate) struct FittedCurvature {
    /// The coefficient of the square.
    pub(crate) curvature: f64,
    /// Its standard error, from the residuals of the parabola with n − 3 degrees of freedom.
    pub(crate) standard_error: f64,
}

/// Fits y = a + bx + cx² to at least four points with different x.
///
/// With independent normal errors of equal variance and c = 0, `curvature` over `standard_error` has Student's
/// distribution with n − 3 degrees of freedom.
pub(crate) fn fit_curvature(points: &[(f64, f64)]) -> FittedCurvature {
    let n = points.len() as f64;
    let line = fit_line(points);
    let (mean_x, mean_y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let cubes: f64 = points.iter().map(|p| (p.0 - mean_x).powi(3)).sum();
    // z² less its projections on 1 and z, z = x − mean: orthogonal to the line, so that the fit of c is separate.
    let square = |x: f64| {
        let z = x - mean_x;
        z * z - cubes / line.spread * z - line.spread / n
    };
    let norm: f64 = points.iter().map(|p| square(p.0) * square(p.0)).sum();
    let curvature = points.iter().map(|p| square(p.0) * (p.1 - mean_y)).sum::<f64>() / norm;
    let residual =
        |p: &(f64, f64)| (p.1 - mean_y) - line.slope * (p.0 - mean_x) - curvature * square(p.0);
    let squares: f64 = points.iter().map(|p| residual(p) * residual(p)).sum();
    FittedCurvature { curvature, standard_error: (squares / (n - 3.0) / norm).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curvature_of_a_parabola_is_found() {
        let points = [0.0, 1.0, 2.5, 4.0, 7.0].map(|x| (x, 3.0 - 2.0 * x + 0.25 * x * x));
        let fit = fit_curvature(&points);
        assert!((fit.curvature - 0.25).abs() < 1e-14 && fit.standard_error < 1e-14);
    }

    /// The textbook case of four points at 0, 1, 2, 3: the contrasts are (1, −1, −1, 1) and (−1, 3, −3, 1).
    #[test]
    fn the_standard_error_comes_from_the_residuals() {
        let fit = fit_curvature(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 4.0)]);
        assert!((fit.curvature - 0.25).abs() < 1e-14);
        assert!((fit.standard_error - 0.05f64.sqrt() / 2.0).abs() < 1e-14);
    }
}
