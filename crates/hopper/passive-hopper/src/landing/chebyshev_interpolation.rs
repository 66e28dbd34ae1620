//! The polynomial through given values at the Chebyshev nodes, for the pieces of the first flight.

use crate::precision::double_double::DoubleDouble;
use std::sync::LazyLock;

/// Coefficients of a piece: eight `f64`, one vector of AVX-512 and one line of the cache. With degree 7 the error
/// of the interpolation is below that of the rounding; see `TABLE_ULPS` in `first_flight_table.rs`. With degree 6
/// it would be 100 times as large.
pub(crate) const COEFFICIENTS: usize = 8;

/// Interpolation at the Chebyshev nodes of [−1, 1]: from values to coefficients by powers.
///
/// `hybrid-system` has a transform at Chebyshev nodes too, in `ode/chebyshev.rs`. The two share no code: this one has
/// 8 nodes, computes in 106 bits and gives coefficients by powers; that one has 16, computes in `f64` and gives
/// Chebyshev coefficients.
pub(crate) struct Interpolation {
    pub(crate) nodes: [DoubleDouble; COEFFICIENTS],
    /// Coefficient k is Σ matrix[k][j] value[j].
    matrix: [[DoubleDouble; COEFFICIENTS]; COEFFICIENTS],
}

pub(crate) static INTERPOLATION: LazyLock<Interpolation> = LazyLock::new(Interpolation::new);

impl Interpolation {
    fn new() -> Self {
        const V: usize = COEFFICIENTS;
        let sixteenth = DoubleDouble::multiple_of_pi(1.0 / (2 * V) as f64);
        let cosine = |k: usize| (sixteenth * k as f64).sin_cos().1;
        // T_m by powers: T₀ = 1, T₁ = x, Tₘ₊₁ = 2x Tₘ − Tₘ₋₁, all whole numbers.
        let mut chebyshev = [[0.0; V]; V];
        (chebyshev[0][0], chebyshev[1][1]) = (1.0, 1.0);
        for m in 2..V {
            for k in 0..V {
                let shifted = if k > 0 { chebyshev[m - 1][k - 1] } else { 0.0 };
                chebyshev[m][k] = 2.0 * shifted - chebyshev[m - 2][k];
            }
        }
        let entry = |k: usize, j: usize| {
            let term = |m: usize| {
                let weight = if m == 0 { 1.0 } else { 2.0 } / V as f64;
                cosine(m * (2 * j + 1)) * (weight * chebyshev[m][k])
            };
            (0..V).map(term).fold(DoubleDouble::ZERO, |sum, term| sum + term)
        };
        Interpolation {
            nodes: std::array::from_fn(|j| cosine(2 * j + 1)),
            matrix: std::array::from_fn(|k| std::array::from_fn(|j| entry(k, j))),
        }
    }

    /// The coefficients by powers of the polynomial with these values at the nodes.
    pub(crate) fn coefficients(&self, values: [DoubleDouble; COEFFICIENTS]) -> [f64; COEFFICIENTS] {
        self.matrix.map(|row| {
            let terms = row.iter().zip(values).map(|(&factor, value)| factor * value);
            terms.fold(DoubleDouble::ZERO, |sum, term| sum + term).high
        })
    }
}
