//! Polynomials through values at Chebyshev nodes.

use std::sync::LazyLock;

/// Number of nodes, for the state along a step and for a guard along it. The interpolants of the state have degree
/// eight, so that a smooth guard of the state has degree 16 or more: 16 values show whether its coefficients decay.
/// More nodes cost more evaluations on every interval; fewer nodes need more halvings.
pub(super) const NODES: usize = 16;

/// The Chebyshev nodes in [−1, 1], and the matrix from values there to Chebyshev coefficients.
///
/// A crate that uses this one has a second transform, for tables: with 8 nodes, in 106 bits, to coefficients by
/// powers. Of the two only the formula of the nodes is the same.
pub(super) struct Transform {
    /// cos((2j + 1)π/2V) for V nodes, from right to left.
    pub(super) nodes: [f64; NODES],
    /// Row k: (2 − δₖ₀)/V · cos(k(2j + 1)π/2V).
    weights: [[f64; NODES]; NODES],
}

/// Built once, at the first use.
pub(super) static CHEBYSHEV: LazyLock<Transform> = LazyLock::new(Transform::new);

impl Transform {
    fn new() -> Self {
        let cosine =
            |k: usize, j: usize| pxfm::f_cospi((k * (2 * j + 1)) as f64 / (2 * NODES) as f64);
        let nodes = std::array::from_fn(|j| cosine(1, j));
        let weights = std::array::from_fn(|k| {
            let factor = if k == 0 { 1.0 } else { 2.0 } / NODES as f64;
            std::array::from_fn(|j| factor * cosine(k, j))
        });
        Transform { nodes, weights }
    }

    /// The first K Chebyshev coefficients of the polynomial with these values at the nodes: numbers, or states
    /// component by component.
    pub(super) fn coefficients<T, const K: usize>(&self, values: &[T; NODES]) -> [T; K]
    where
        T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
    {
        std::array::from_fn(|k| {
            let weights = &self.weights[k];
            let rest = values.iter().zip(weights).skip(1);
            rest.fold(values[0] * weights[0], |sum, (&value, &weight)| sum + value * weight)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_of_a_polynomial_are_exact() {
        // T₉ + 2T₃ − 1 at the nodes: cos 9θ + 2 cos 3θ − 1.
        let values = CHEBYSHEV.nodes.map(|u| {
            let angle = pxfm::f_acos(u);
            pxfm::f_cos(9.0 * angle) + 2.0 * pxfm::f_cos(3.0 * angle) - 1.0
        });
        let coefficients: [f64; NODES] = CHEBYSHEV.coefficients(&values);
        for (k, found) in coefficients.iter().enumerate() {
            let exact = [-1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0].get(k).unwrap_or(&0.0);
            assert!((found - exact).abs() < 1e-14, "{k}: {found}");
        }
    }
}
