//! The first flight by a table: how much longer than 2α*_n it is.
//!
//! In the cell (nπ, (n+1)π) the shift t = τ − 2α*_n is an analytic function of w = (α − α*_n)^{1/3}, from one end
//! through the fixed point to the other (theory: c), and knows nothing of M. So t/w is a polynomial of degree 13 on
//! each of 16 pieces, to a few ulps: a start from which Newton's method on V(h) = α has one step to go.

use crate::LocalFlight;
use crate::alpha_star;
use crate::landing::Cell;
use crate::lossless::n_pi;
use std::sync::LazyLock;

/// Cells with a table: α up to 101.
const CELLS: u64 = 32;

/// Pieces of a cell.
const PIECES: usize = 16;

/// Coefficients of a piece.
const COEFFICIENTS: usize = 14;

/// t/w over one cell.
struct Table {
    /// w at nπ.
    left: f64,
    /// Pieces per unit of w.
    scale: f64,
    /// By powers of the place on the piece, in [−1, 1].
    pieces: [[f64; COEFFICIENTS]; PIECES],
}

static TABLES: LazyLock<Vec<Table>> = LazyLock::new(|| (1..=CELLS).map(Table::new).collect());

/// t of a lift-off speed in its cell; nothing for cells without a table, and within 10⁻³⁰⁰ of α*_n.
pub(crate) fn time_shift(alpha: f64, cell: &Cell) -> Option<f64> {
    let table = TABLES.get(usize::try_from(cell.n).ok()?.checked_sub(1)?)?;
    let delta = (alpha - cell.star.high) - cell.star.low;
    (delta.abs() >= 1e-300).then(|| table.time_shift(delta))
}

impl Table {
    fn new(n: u64) -> Self {
        let star = alpha_star(n);
        let end = |turns: u64| pxfm::f_cbrt((n_pi(turns) - star).high);
        let (left, right) = (end(n), end(n + 1));
        let scale = PIECES as f64 / (right - left);
        let flight = LocalFlight::new(n);
        let pieces = std::array::from_fn(|piece| {
            let middle = left + (piece as f64 + 0.5) / scale;
            piece_about(|place| {
                let w = middle + 0.5 * place / scale;
                flight.time_shift(w * w * w) / w
            })
        });
        Table { left, scale, pieces }
    }

    fn time_shift(&self, delta: f64) -> f64 {
        let w = pxfm::f_cbrt(delta);
        let at = (w - self.left) * self.scale;
        // The ends of the cell may round beyond the table by an ulp.
        let piece = (at.max(0.0) as usize).min(PIECES - 1);
        let place = 2.0 * (at - piece as f64) - 1.0;
        w * polynomial(&self.pieces[piece], place)
    }
}

/// Even and odd powers apart: two chains that do not wait for each other.
fn polynomial(c: &[f64; COEFFICIENTS], x: f64) -> f64 {
    let square = x * x;
    let (mut even, mut odd) = (0.0, 0.0);
    for pair in c.rchunks_exact(2) {
        even = even * square + pair[0];
        odd = odd * square + pair[1];
    }
    even + x * odd
}

/// The polynomial through the values of `f` at the Chebyshev nodes of [−1, 1], by powers.
fn piece_about(f: impl Fn(f64) -> f64) -> [f64; COEFFICIENTS] {
    const V: usize = COEFFICIENTS;
    let cosine = |k: usize, j: usize| pxfm::f_cospi((k * (2 * j + 1)) as f64 / (2 * V) as f64);
    let values: [f64; V] = std::array::from_fn(|j| f(cosine(1, j)));
    let chebyshev: [f64; V] = std::array::from_fn(|k| {
        let factor = if k == 0 { 1.0 } else { 2.0 } / V as f64;
        factor * (0..V).map(|j| values[j] * cosine(k, j)).sum::<f64>()
    });
    // T₀ = 1, T₁ = x, Tₖ₊₁ = 2x Tₖ − Tₖ₋₁ by powers.
    let (mut before, mut now) = ([0.0; V], [0.0; V]);
    (before[0], now[1]) = (1.0, 1.0);
    let mut powers = [0.0; V];
    powers[0] = chebyshev[0];
    for coefficient in &chebyshev[1..] {
        for (power, term) in powers.iter_mut().zip(now) {
            *power += coefficient * term;
        }
        let mut next = before.map(|term| -term);
        for k in 1..V {
            next[k] += 2.0 * now[k - 1];
        }
        (before, now) = (now, next);
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against Newton's method, on both sides and at any distance from α*_n.
        #[test]
        fn as_newton(n in 1..=CELLS, part in -1.0..1.0f64, exponent in -250.0..250.0f64) {
            let star = alpha_star(n);
            let end = if part < 0.0 { star - n_pi(n) } else { n_pi(n + 1) - star };
            let delta = part * end.high * pxfm::f_exp10(exponent.min(0.0));
            let table = &TABLES[n as usize - 1];
            let exact = LocalFlight::new(n).time_shift(delta);
            prop_assert!((table.time_shift(delta) / exact - 1.0).abs() < 2e-15);
        }
    }

    /// By powers as by Chebyshev polynomials.
    #[test]
    fn a_piece_is_its_polynomial() {
        let f = |x: f64| 1.0 / (3.0 + x);
        let piece = piece_about(f);
        for k in -10..=10 {
            let x = f64::from(k) / 10.0;
            assert!((polynomial(&piece, x) / f(x) - 1.0).abs() < 1e-9, "{x}");
        }
    }
}
