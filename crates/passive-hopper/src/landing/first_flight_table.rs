//! The first flight by tables.
//!
//! In the interval (nπ, (n+1)π) the landing depends on δ = α − α*_n alone, and it is analytic in δ but for a cube root at
//! δ = 0. The table cuts the interval into pieces whose length is a 16th of their distance from δ = 0. On each
//! of them α − h and Γ are polynomials of degree 7, to an ulp. A piece is the set of numbers δ of one sign with the same
//! exponent and the same first four bits of the fraction: its index is read from the bits of δ, without a search.
//! Pieces are counted from the `f64` nearest to α*_n, because the difference of two close `f64` is exact.
//!
//! A table is made when a speed in its interval is first asked for. That takes some milliseconds.

use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::landing::half_time::HalfTime;
use crate::landing::half_time_root::HalfTimeRoot;
use crate::model::fixed_points::alpha_star;
use crate::precision::double_double::DoubleDouble;
use crate::precision::nearest_integer::nearest_integer;
use std::f64::consts::FRAC_1_PI;
use std::sync::{LazyLock, OnceLock};

/// Intervals with a table: α up to 32π ≈ 100. Each table takes 64 KiB. Faster hops search from an expansion.
/// A power of two, so that an index is masked and not checked.
pub(crate) const TABLES: usize = 32;

/// Coefficients of a piece: eight `f64`, one vector of AVX-512 and one line of the cache. Degree 7 is not derived;
/// on pieces of this length its error is about an ulp (measured).
const COEFFICIENTS: usize = 8;

/// Octaves of |δ| with pieces, from 2⁻¹³ up to 4; |δ| is at most π. Speeds within 2⁻¹³ of α*_n have no
/// piece. They are few, and the careful path solves them.
const OCTAVES: usize = 15;
/// The exponent field of 2⁻¹³ in an `f64`.
const FIRST_OCTAVE: u64 = 1023 - 13;

/// Pieces on one side of α*_n: 16 in each octave, by four bits of the fraction.
const PIECES: usize = 16 * OCTAVES;

/// How near to nπ, in parts of π, a speed has no piece. The kind of the landing changes at nπ, and α/π has a rounding error
/// of 10⁻¹⁴ at α = 100; the value 10⁻⁷ is far above that error, and chosen, not derived. The careful path decides there.
const NEAR_END: f64 = 1e-7;

/// Coefficients by powers of the position on a piece, in [−1, 1].
pub(crate) type Piece = [f64; COEFFICIENTS];

/// The pieces of an interval: those above α*_n, then those below, and one whose values are NaN.
#[derive(Debug)]
#[repr(align(64))]
pub(crate) struct FirstFlightTable {
    /// Γ.
    closing_speed: [Piece; SLOTS],
    /// α − h.
    beyond: [Piece; SLOTS],
}

/// The index of the piece whose values are NaN, for a speed without a piece.
const NO_PIECE: usize = 2 * PIECES;

/// Slots for 481 pieces: up to a power of two, so that an index is masked and not checked.
const SLOTS: usize = 512;

/// Where a speed is in the tables.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TablePosition {
    /// Index n of the interval.
    pub(crate) interval: u64,
    /// Index of the piece; [`NO_PIECE`] for a speed outside the tables.
    pub(crate) piece: u64,
    /// The position on the piece, in [−1, 1].
    pub(crate) at: f64,
    /// 1 below α*_n, where the first landing is sudden, else 0.
    pub(crate) sudden: u64,
}

/// The first flight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FirstFlight {
    /// h, half its time.
    pub(crate) half_time: f64,
    /// α − h.
    pub(crate) beyond: f64,
    /// Γ.
    pub(crate) closing_speed: f64,
}

static ALL_TABLES: [OnceLock<Box<FirstFlightTable>>; TABLES] = [const { OnceLock::new() }; TABLES];

/// Takes the place of a table that is not made yet.
static EMPTY_TABLE: FirstFlightTable = FirstFlightTable::EMPTY;

/// The `f64` nearest to α*_n, from which the pieces are counted, for n < [`TABLES`].
pub(crate) type FixedPoints = [f64; TABLES];

static FIXED_POINTS: LazyLock<FixedPoints> =
    LazyLock::new(|| std::array::from_fn(|n| alpha_star(n as u64)));

/// α*_n for all intervals with a table.
#[inline(always)]
pub(crate) fn fixed_points() -> &'static FixedPoints {
    &FIXED_POINTS
}

impl TablePosition {
    pub(crate) const NOWHERE: TablePosition =
        TablePosition { interval: 0, piece: NO_PIECE as u64, at: 0.0, sudden: 0 };

    /// The position of `alpha` > 0; [`NO_PIECE`] outside the tables, next to nπ, and within 2⁻¹³ of α*_n.
    ///
    /// Loops over many speeds inline this function: it has no branch.
    #[inline(always)]
    pub(crate) fn of(alpha: f64, fixed_points: &FixedPoints) -> Self {
        /// The bits of 1.0: exponent field and zero fraction.
        const ONE: u64 = 1023 << 52;
        let half_turns = alpha * FRAC_1_PI;
        let (n, bits) = nearest_integer(half_turns - 0.5);
        let part = half_turns - n;
        let interval = bits & (TABLES as u64 - 1);
        let delta = alpha - fixed_points[interval as usize]; // exact
        let bits = delta.to_bits() & (u64::MAX >> 1);
        // Exponent and four bits of the fraction, from the first octave on; below it the index wraps to a huge number.
        let index = (bits >> 48).wrapping_sub(FIRST_OCTAVE << 4);
        let sudden = delta.to_bits() >> 63;
        // Near 0 there is no end to keep away from: the interval n = 0 begins there.
        let inside = (index < PIECES as u64)
            & (half_turns < TABLES as f64)
            & (part < 1.0 - NEAR_END)
            & ((part > NEAR_END) | (half_turns < 0.5));
        let piece = if inside { index + sudden * PIECES as u64 } else { NO_PIECE as u64 };
        // The bits after the first four, as the fraction of a number in [1, 2).
        let fraction = f64::from_bits((bits << 4) & (u64::MAX >> 12) | ONE);
        TablePosition {
            interval,
            piece,
            at: 2.0 * fraction - 3.0,
            sudden: if inside { sudden } else { 0 },
        }
    }

    /// The first flight from `alpha`; `None` outside the tables.
    #[inline(always)]
    pub(crate) fn first_flight(&self, alpha: f64) -> Option<FirstFlight> {
        if self.piece == NO_PIECE as u64 {
            return None;
        }
        let table = FirstFlightTable::get(self.interval);
        let beyond = polynomial(table.of_beyond(self.piece), self.at);
        let closing_speed = polynomial(table.of_closing_speed(self.piece), self.at);
        Some(FirstFlight { half_time: alpha - beyond, beyond, closing_speed })
    }
}

impl FirstFlightTable {
    const EMPTY: FirstFlightTable = {
        let mut piece = [[0.0; COEFFICIENTS]; SLOTS];
        piece[NO_PIECE] = [f64::NAN; COEFFICIENTS];
        FirstFlightTable { closing_speed: piece, beyond: piece }
    };

    /// The table of (nπ, (n+1)π), made when it is first asked for.
    #[inline(always)]
    pub(crate) fn get(n: u64) -> &'static FirstFlightTable {
        let slot = &ALL_TABLES[n as usize % TABLES];
        match slot.get() {
            Some(table) => table,
            None => slot.get_or_init(|| FirstFlightTable::new(n)),
        }
    }

    /// All tables; an empty one for each that is not made yet.
    pub(crate) fn all() -> [&'static FirstFlightTable; TABLES] {
        std::array::from_fn(|n| ALL_TABLES[n].get().map_or(&EMPTY_TABLE, |table| &**table))
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
        let fixed_point = DoubleDouble::from(alpha_star(n));
        let end = |half_turns: u64| {
            (DoubleDouble::multiple_of_pi(half_turns as f64) - fixed_point).high.abs()
        };
        let mut table = Box::new(FirstFlightTable::EMPTY);
        for (side, sign, half_turns) in [(0, 1.0, n + 1), (PIECES, -1.0, n)] {
            // No speed of the interval lies on a piece that begins beyond its end.
            let reach = end(half_turns);
            for index in (0..PIECES).take_while(|&index| left_end(index) < reach) {
                let (closing_speed, beyond) = piece(fixed_point, index, sign);
                table.closing_speed[side + index] = closing_speed;
                table.beyond[side + index] = beyond;
            }
        }
        table
    }
}

/// The left end of a piece, as |δ|.
fn left_end(index: usize) -> f64 {
    f64::from_bits((FIRST_OCTAVE << 52) + ((index as u64) << 48))
}

/// A polynomial of degree seven, by Estrin's scheme: its terms do not wait for each other.
#[inline(always)]
pub(crate) fn polynomial(c: &Piece, x: f64) -> f64 {
    let square = x * x;
    let fourth = square * square;
    let low = (c[0] + c[1] * x) + square * (c[2] + c[3] * x);
    let high = (c[4] + c[5] * x) + square * (c[6] + c[7] * x);
    low + fourth * high
}

/// Γ and α − h on a piece of the side with this `sign`.
fn piece(fixed_point: DoubleDouble, index: usize, sign: f64) -> (Piece, Piece) {
    let left = left_end(index);
    let half = 0.5 * (left_end(index + 1) - left);
    let values: [_; COEFFICIENTS] = std::array::from_fn(|k| {
        let size = (INTERPOLATION.nodes[k] + 1.0) * half + left;
        exact_first(fixed_point + size * sign)
    });
    (
        INTERPOLATION.coefficients(values.map(|(speed, _)| speed)),
        INTERPOLATION.coefficients(values.map(|(_, beyond)| beyond)),
    )
}

/// Γ and α − h from `alpha`, to nearly 30 digits: one evaluation in 106 bits at the root that `f64` finds, corrected to
/// first order.
fn exact_first(alpha: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let interval = FixedPointInterval::of(alpha.high);
    let (bracket, start) =
        (interval.half_time_bracket(alpha.high), interval.half_time_estimate(alpha.high));
    let half = HalfTimeRoot::solve(0.0, alpha.high, bracket, start).half;
    let h = DoubleDouble::from(half.h);
    let exact = HalfTime::extended_at(h);
    let residual = ((h - alpha) + exact.speed_beyond_h(DoubleDouble::ZERO)).high;
    let closing_speed = exact.closing_speed(DoubleDouble::ZERO);
    let rest = -residual * half.d / closing_speed.high;
    let change = -0.5 * residual * half.loss_slope(0.0) / closing_speed.high;
    (closing_speed + change, (alpha - h) + -rest)
}

/// Interpolation at the Chebyshev nodes of [−1, 1]: from values to coefficients by powers.
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
