//! The least-squares line through points.

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
