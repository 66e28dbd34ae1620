//! The first flight by tables.
//!
//! In the cell (nπ, (n+1)π) the landing depends on δ = α − α*_n alone, and all that is not analytic in it
//! is the cube root at δ = 0 (theory: c). On pieces whose length is a 16th of their distance from there, α − h
//! and Γ are polynomials of degree 7, to an ulp. The pieces are the numbers of one sign with the same exponent
//! and the same first four bits: an index needs no search. They are counted from α*_n as `f64` has it, so that
//! a place is exact.

use crate::kernel::scalar::turn::nearest;
use crate::landing::from_ground;
use crate::landing::half_flight::HalfFlight;
use crate::model::fixed_points::alpha_star;
use crate::precision::double_double::DoubleDouble;
use std::f64::consts::FRAC_1_PI;
use std::sync::{LazyLock, OnceLock};

/// Cells with a table: α up to 100.
pub(crate) const CELLS: usize = 32;

/// Coefficients of a piece.
const COEFFICIENTS: usize = 8;

/// Octaves of |δ|, from 2⁻¹³ up to 4.
const OCTAVES: usize = 15;
const FIRST_OCTAVE: u64 = 1023 - 13;

/// Pieces on one side of α*_n.
const PIECES: usize = 16 * OCTAVES;

/// How near to nπ, in parts of π, a speed is left to the careful path.
const NEAR_END: f64 = 1e-7;

/// Coefficients by powers of the place on a piece, in [−1, 1].
pub(crate) type Piece = [f64; COEFFICIENTS];

/// The pieces of a cell: those above α*_n, then those below, and one that gives no number.
#[derive(Debug)]
#[repr(align(64))]
pub(crate) struct Cell {
    /// Γ.
    closing_speed: [Piece; SLOTS],
    /// α − h.
    beyond: [Piece; SLOTS],
}

/// The index of the piece that gives no number.
const NO_PIECE: usize = 2 * PIECES;

/// Pieces of a cell, up to a power of two.
const SLOTS: usize = 512;

/// Where a speed is in the tables.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    /// Index of the cell.
    pub(crate) cell: u64,
    /// Index of the piece; the last one for a speed outside the tables.
    pub(crate) piece: u64,
    /// Where on the piece, in [−1, 1].
    pub(crate) at: f64,
    /// 1 below α*_n, where the first landing is sudden, else 0.
    pub(crate) sudden: u64,
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

static TABLES: [OnceLock<Box<Cell>>; CELLS] = [const { OnceLock::new() }; CELLS];

/// What stands for cells that are not made yet.
static NO_CELL: Cell = Cell::EMPTY;

/// α*_n, rounded: what the pieces are counted from.
pub(crate) type Stars = [f64; CELLS];

static STARS: LazyLock<Stars> = LazyLock::new(|| std::array::from_fn(|n| alpha_star(n as u64)));

/// α*_n, for all cells with a table.
#[inline(always)]
pub(crate) fn stars() -> &'static Stars {
    &STARS
}

impl Place {
    pub(crate) const NOWHERE: Place = Place { cell: 0, piece: NO_PIECE as u64, at: 0.0, sudden: 0 };

    /// The place of `alpha` > 0; none outside the tables, next to nπ, and within 2⁻¹³ of α*_n. No branch.
    #[inline(always)]
    pub(crate) fn of(alpha: f64, stars: &Stars) -> Self {
        const ONE: u64 = 1023 << 52;
        let turns = alpha * FRAC_1_PI;
        let (n, bits) = nearest(turns - 0.5);
        let part = turns - n;
        let cell = bits & (CELLS as u64 - 1);
        let delta = alpha - stars[cell as usize]; // exact
        let bits = delta.to_bits() & (u64::MAX >> 1);
        let index = (bits >> 48).wrapping_sub(FIRST_OCTAVE << 4);
        let sudden = delta.to_bits() >> 63;
        let inside = (index < PIECES as u64)
            & (turns < CELLS as f64)
            & (part < 1.0 - NEAR_END)
            & ((part > NEAR_END) | (turns < 0.5));
        let piece = if inside { index + sudden * PIECES as u64 } else { NO_PIECE as u64 };
        // The bits after the first four, as the fraction of a number in [1, 2).
        let fraction = f64::from_bits((bits << 4) & (u64::MAX >> 12) | ONE);
        Place { cell, piece, at: 2.0 * fraction - 3.0, sudden: if inside { sudden } else { 0 } }
    }

    /// The first flight from `alpha`; nothing for a place outside the tables.
    #[inline(always)]
    pub(crate) fn first(&self, alpha: f64) -> Option<First> {
        if self.piece == NO_PIECE as u64 {
            return None;
        }
        let cell = Cell::get(self.cell);
        let beyond = polynomial(cell.of_beyond(self.piece), self.at);
        let closing_speed = polynomial(cell.of_closing_speed(self.piece), self.at);
        Some(First { half_time: alpha - beyond, beyond, closing_speed })
    }
}

impl Cell {
    const EMPTY: Cell = {
        let mut piece = [[0.0; COEFFICIENTS]; SLOTS];
        piece[NO_PIECE] = [f64::NAN; COEFFICIENTS];
        Cell { closing_speed: piece, beyond: piece }
    };

    /// A cell, made when it is first asked for.
    #[inline(always)]
    pub(crate) fn get(n: u64) -> &'static Cell {
        let slot = &TABLES[n as usize % CELLS];
        match slot.get() {
            Some(cell) => cell,
            None => slot.get_or_init(|| Cell::new(n)),
        }
    }

    /// All cells, those not made yet without numbers.
    pub(crate) fn all() -> [&'static Cell; CELLS] {
        std::array::from_fn(|n| TABLES[n].get().map_or(&NO_CELL, |cell| &**cell))
    }

    /// The coefficients of Γ.
    #[inline(always)]
    pub(crate) fn of_closing_speed(&self, piece: u64) -> &Piece {
        &self.closing_speed[piece as usize % SLOTS]
    }

    /// The coefficients of α − h.
    #[inline(always)]
    pub(crate) fn of_beyond(&self, piece: u64) -> &Piece {
        &self.beyond[piece as usize % SLOTS]
    }

    #[cold]
    fn new(n: u64) -> Box<Self> {
        let star = DoubleDouble::from(alpha_star(n));
        let end = |turns: u64| (DoubleDouble::multiple_of_pi(turns as f64) - star).high.abs();
        let mut cell = Box::new(Cell::EMPTY);
        for (side, sign, turns) in [(0, 1.0, n + 1), (PIECES, -1.0, n)] {
            // Pieces beyond the cell are never asked for.
            let reach = end(turns);
            for index in (0..PIECES).take_while(|&index| left_end(index) < reach) {
                let (closing_speed, beyond) = piece(star, index, sign);
                cell.closing_speed[side + index] = closing_speed;
                cell.beyond[side + index] = beyond;
            }
        }
        cell
    }
}

/// The left end of a piece, as |δ|.
fn left_end(index: usize) -> f64 {
    f64::from_bits((FIRST_OCTAVE << 52) + ((index as u64) << 48))
}

/// Polynomials of eight places at once.
pub(crate) trait Eight {
    /// Those with the coefficients of `rows`, each at its place.
    fn polynomials(rows: [&Piece; 8], at: &[f64; 8]) -> [f64; 8];
}

/// One by one.
pub(crate) struct OneByOne;

impl Eight for OneByOne {
    #[inline(always)]
    fn polynomials(rows: [&Piece; 8], at: &[f64; 8]) -> [f64; 8] {
        std::array::from_fn(|k| polynomial(rows[k], at[k]))
    }
}

/// A polynomial of degree seven.
#[inline(always)]
fn polynomial(c: &Piece, x: f64) -> f64 {
    let square = x * x;
    let fourth = square * square;
    let low = (c[0] + c[1] * x) + square * (c[2] + c[3] * x);
    let high = (c[4] + c[5] * x) + square * (c[6] + c[7] * x);
    low + fourth * high
}

/// Γ and α − h on a piece of the side with this `sign`.
fn piece(star: DoubleDouble, index: usize, sign: f64) -> (Piece, Piece) {
    let left = left_end(index);
    let half = 0.5 * (left_end(index + 1) - left);
    let values: [_; COEFFICIENTS] = std::array::from_fn(|k| {
        let size = (INTERPOLATION.nodes[k] + 1.0) * half + left;
        exact_first(star + size * sign)
    });
    (
        INTERPOLATION.coefficients(values.map(|(speed, _)| speed)),
        INTERPOLATION.coefficients(values.map(|(_, beyond)| beyond)),
    )
}

/// Γ and α − h from `alpha`, to 30 digits or nearly.
///
/// One evaluation in longer arithmetic at the root that `f64` finds, corrected to first order.
fn exact_first(alpha: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let root = from_ground::Cell::of(alpha.high).root_without_table(alpha.high);
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
