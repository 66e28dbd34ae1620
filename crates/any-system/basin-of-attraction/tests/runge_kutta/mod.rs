//! Runge and Kutta's method of order 4, for the flows of the tests.

/// The state after `steps` steps of Runge and Kutta's method, each of length `h`.
pub(crate) fn after<const N: usize>(
    field: impl Fn([f64; N]) -> [f64; N],
    start: &[f64],
    h: f64,
    steps: usize,
) -> Option<Vec<f64>> {
    let mut z: [f64; N] = start.try_into().ok()?;
    for _ in 0..steps {
        let step = |slope: [f64; N], part: f64| std::array::from_fn(|i| z[i] + part * h * slope[i]);
        let a = field(z);
        let b = field(step(a, 0.5));
        let c = field(step(b, 0.5));
        let d = field(step(c, 1.0));
        z = std::array::from_fn(|i| z[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
    }
    Some(z.to_vec())
}
