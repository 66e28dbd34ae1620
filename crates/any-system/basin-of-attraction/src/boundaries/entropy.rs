//! The Shannon entropy of fractions.

/// −Σ p ln p, with 0 ln 0 = 0. The fractions are not normalised.
///
/// ```
/// let entropy = basin_of_attraction::entropy([0.5, 0.5, 0.0]);
/// assert!((entropy - 2f64.ln()).abs() < 1e-15);
/// ```
pub fn entropy(fractions: impl IntoIterator<Item = f64>) -> f64 {
    let term = |p: f64| if p > 0.0 { -p * pxfm::f_log(p) } else { 0.0 };
    fractions.into_iter().map(term).sum()
}
