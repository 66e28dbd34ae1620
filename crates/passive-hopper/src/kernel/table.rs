//! The first flight by tables.
//!
//! In the cell (nπ, (n+1)π) the landing depends on δ = α − α*_n alone, and all that is not analytic in it
//! is the cube root at δ = 0 (theory: c). On pieces whose length is a 16th of their distance from there, α − h
//! and Γ are polynomials of degree 7, to an ulp. The pieces are the numbers of one sign with the same exponent
//! and the same first four bits: an index needs no search.

use crate::double_double::DoubleDouble;
use crate::landing;
use crate::{HalfFlight, alpha_star};
use std::f64::consts::{FRAC_1_PI, PI};
use std::sync::{LazyLock, OnceLock};

/// Cells with a table: α up to 100.
const CELLS: usize = 32;

/// Coefficients of a piece.
const COEFFICIENTS: usize = 8;

/// Octaves of |δ|, from 2⁻⁹ up to 4.
const OCTAVES: usize = 11;
const FIRST_OCTAVE: u64 = 1023 - 9;

/// Pieces on one side of α*_n.
const PIECES: usize = 16 * OCTAVES;

/// How near to nπ, in parts of π, a speed is left to the careful path.
const NEAR_END: f64 = 1e-7;

/// The functions on a piece, by powers of the place in [−1, 1].
#[derive(Debug, Clone, Copy)]
#[repr(align(128))]
struct Piece {
    /// Γ.
    closing_speed: [f64; COEFFICIENTS],
    /// α − h.
    beyond: [f64; COEFFICIENTS],
}

/// The pieces of a cell: those above α*_n, then those below.
#[derive(Debug)]
pub(crate) struct Cell {
    pieces: Box<[Piece]>,
}

/// A speed in its cell.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    /// Index of the piece.
    piece: usize,
    /// Where on it, in [−1, 1].
    at: f64,
    /// Below α*_n: the first landing is sudden.
    pub(crate) sudden: bool,
}

/// The first flight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct First {
    /// h, half its time.
    pub(crate) half_time: f64,
    /// α − h.
    pub(crate) beyond: f64,
    /// Γ.
    pub(crate) closing_speed: f64,
}

static TABLES: [OnceLock<Cell>; CELLS] = [const { OnceLock::new() }; CELLS];

/// α*_n in two parts.
static STARS: LazyLock<[DoubleDouble; CELLS]> =
    LazyLock::new(|| std::array::from_fn(|n| alpha_star(n as u64)));

impl Cell {
    /// The cell of `alpha` and the place there; nothing outside the tables, next to nπ, and within 2⁻⁹ of α*_n.
    #[inline(always)]
    pub(crate) fn of(alpha: f64) -> Option<(&'static Cell, Place)> {
        let turns = alpha * FRAC_1_PI;
        let n = turns as usize;
        let part = turns - n as f64;
        let star = STARS.get(n)?;
        if !(part > NEAR_END && part < 1.0 - NEAR_END) && n > 0 || !(alpha < PI || n > 0) {
            return None;
        }
        let place = Place::at((alpha - star.high) - star.low)?;
        let slot = TABLES.get(n)?;
        let cell = match slot.get() {
            Some(cell) => cell,
            None => slot.get_or_init(|| Cell::new(n as u64)),
        };
        Some((cell, place))
    }

    /// The first flight from `alpha`.
    #[inline(always)]
    pub(crate) fn first(&self, place: &Place, alpha: f64) -> First {
        let beyond = self.beyond(place);
        First { half_time: alpha - beyond, beyond, closing_speed: self.closing_speed(place) }
    }

    /// Γ.
    #[inline(always)]
    pub(crate) fn closing_speed(&self, place: &Place) -> f64 {
        self.pieces.get(place.piece).map_or(f64::NAN, |p| polynomial(&p.closing_speed, place.at))
    }

    /// α − h.
    #[inline(always)]
    pub(crate) fn beyond(&self, place: &Place) -> f64 {
        self.pieces.get(place.piece).map_or(f64::NAN, |p| polynomial(&p.beyond, place.at))
    }

    fn new(n: u64) -> Self {
        let star = alpha_star(n);
        let end = |turns: u64| (DoubleDouble::multiple_of_pi(turns as f64) - star).high.abs();
        let side = |below: bool| {
            let reach = end(if below { n } else { n + 1 });
            (0..PIECES).map(move |index| {
                let left = left_end(index);
                // Pieces beyond the cell are never asked for.
                if left < reach { Piece::new(star, index, below) } else { Piece::EMPTY }
            })
        };
        Cell { pieces: side(false).chain(side(true)).collect() }
    }
}

/// The left end of a piece, as |δ|.
fn left_end(index: usize) -> f64 {
    f64::from_bits((FIRST_OCTAVE << 52) + ((index as u64) << 48))
}

impl Place {
    /// The place of δ.
    #[inline(always)]
    fn at(delta: f64) -> Option<Self> {
        const ONE: u64 = 1023 << 52;
        let bits = delta.to_bits() & (u64::MAX >> 1);
        let index = (bits >> 48).wrapping_sub(FIRST_OCTAVE << 4) as usize;
        // The bits after the first four, as the fraction of a number in [1, 2).
        let fraction = f64::from_bits((bits << 4) & (u64::MAX >> 12) | ONE);
        let sudden = delta < 0.0;
        let piece = index + if sudden { PIECES } else { 0 };
        (index < PIECES).then_some(Place { piece, at: 2.0 * fraction - 3.0, sudden })
    }
}

#[inline(always)]
fn polynomial(c: &[f64; COEFFICIENTS], x: f64) -> f64 {
    let square = x * x;
    let fourth = square * square;
    let low = (c[0] + c[1] * x) + square * (c[2] + c[3] * x);
    let high = (c[4] + c[5] * x) + square * (c[6] + c[7] * x);
    low + fourth * high
}

impl Piece {
    const EMPTY: Piece = Piece { closing_speed: [0.0; COEFFICIENTS], beyond: [0.0; COEFFICIENTS] };

    fn new(star: DoubleDouble, index: usize, below: bool) -> Self {
        let left = left_end(index);
        let half = 0.5 * (left_end(index + 1) - left);
        let nodes = &INTERPOLATION.nodes;
        let values: [_; COEFFICIENTS] = std::array::from_fn(|k| {
            let size = (nodes[k] + 1.0) * half + left;
            exact_first(star + if below { -size } else { size })
        });
        Piece {
            closing_speed: INTERPOLATION.coefficients(values.map(|(speed, _)| speed)),
            beyond: INTERPOLATION.coefficients(values.map(|(_, beyond)| beyond)),
        }
    }
}

/// Γ and α − h from `alpha`, to 30 digits or nearly.
///
/// One evaluation in longer arithmetic at the root that `f64` finds, corrected to first order.
fn exact_first(alpha: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let root = landing::Cell::of(alpha.high).root_without_table(alpha.high);
    let half = HalfFlight::at(root.half.h);
    let h = DoubleDouble::from(half.h);
    let (sin, cos) = h.sin_cos();
    let d = h - sin * cos;
    let u = h * cos - sin;
    let rho = u / d;
    let residual = ((h - alpha) + sin * rho).high;
    let closing_speed = rho * u * 2.0;
    let rest = -residual * half.d / closing_speed.high;
    let change = -0.5 * residual * half.loss_slope(0.0) / closing_speed.high;
    (closing_speed + change, (alpha - h) + -rest)
}

/// From values at the Chebyshev nodes of [−1, 1] to powers.
struct Interpolation {
    nodes: [DoubleDouble; COEFFICIENTS],
    /// Coefficient k is Σ matrix[k][j] value[j].
    matrix: [[DoubleDouble; COEFFICIENTS]; COEFFICIENTS],
}

static INTERPOLATION: LazyLock<Interpolation> = LazyLock::new(Interpolation::new);

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

    fn coefficients(&self, values: [DoubleDouble; COEFFICIENTS]) -> [f64; COEFFICIENTS] {
        self.matrix.map(|row| {
            let terms = row.iter().zip(values).map(|(&factor, value)| factor * value);
            terms.fold(DoubleDouble::ZERO, |sum, term| sum + term).high
        })
    }
}
