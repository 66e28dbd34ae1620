//! The least-squares line through points, with equal weights and with given ones.

/// A straight line fitted to points by least squares.
pub(crate) struct FittedLine {
    pub(crate) slope: f64,
    /// Sum of the squared residuals.
    pub(crate) squared_residuals: f64,
}

/// Fits a line to (x, y). The points must have at least two different x, or the slope is NaN.
pub(crate) fn fit_line(points: &[(f64, f64)]) -> FittedLine {
    let n = points.len() as f64;
    let (mean_x, mean_y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let spread: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.0 - mean_x)).sum();
    let slope = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum::<f64>() / spread;
    let residual = |p: &(f64, f64)| (p.1 - mean_y) - slope * (p.0 - mean_x);
    FittedLine { slope, squared_residuals: points.iter().map(|p| residual(p) * residual(p)).sum() }
}

/// The coefficients c of the slope Σ c y of the line with the least Σ w (y − a − bx)²: c = w (x − x̄)/Σ w (x −
/// x̄)², where x̄ is the weighted mean.
///
/// Σ c = 0 and Σ c x = 1, so that a straight line has its own slope for every choice of weights. At least two
/// different x must have a weight above 0, or the coefficients are NaN.
pub(crate) fn slope_coefficients(places: &[f64], weights: &[f64]) -> Vec<f64> {
    let points = || places.iter().zip(weights);
    let mean = points().map(|(x, w)| w * x).sum::<f64>() / weights.iter().sum::<f64>();
    let spread: f64 = points().map(|(x, w)| w * (x - mean) * (x - mean)).sum();
    points().map(|(x, w)| w * (x - mean) / spread).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_has_its_slope_for_all_weights() {
        let places = [0.0, 1.0, 2.5, 4.0, 7.0];
        for weights in [[1.0; 5], [0.0, 1.0, 3.0, 1.0, 0.0], [5.0, 1e-3, 0.0, 2.0, 1.0]] {
            let coefficients = slope_coefficients(&places, &weights);
            let slope: f64 =
                coefficients.iter().zip(places).map(|(c, x)| c * (3.0 - 2.0 * x)).sum();
            assert!((slope + 2.0).abs() < 1e-13, "{slope}");
            assert!(coefficients.iter().sum::<f64>().abs() < 1e-13);
        }
    }

    /// Textbook: with equal weights the coefficients of four points at 0, 1, 2, 3 are −0.3, −0.1, 0.1, 0.3.
    #[test]
    fn equal_weights_give_the_ordinary_slope() {
        let coefficients = slope_coefficients(&[0.0, 1.0, 2.0, 3.0], &[2.0; 4]);
        for (coefficient, textbook) in coefficients.iter().zip([-0.3, -0.1, 0.1, 0.3]) {
            assert!((coefficient - textbook).abs() < 1e-15);
        }
    }
}
