//! The first flight by tables.
//!
//! In the interval (nπ, (n+1)π) the landing depends on δ = α − α*_n alone. The table cuts the interval into pieces
//! whose length is a 16th of their distance from δ = 0, or less. On each piece α − h and Γ are polynomials of
//! degree 7. A piece is the set of numbers δ of one sign with the same exponent and the same first four bits of the
//! fraction: its index is read from the bits of δ, without a search. In the code δ is measured from the `f64`
//! nearest to α*_n, because the difference of two close `f64` is exact.
//!
//! # Why these pieces
//! h(α) is the inverse of A(h) = (h² − S²)/D, which is meromorphic in the whole plane. Such an inverse is singular
//! only above critical values and asymptotic values of A. A′ = 2u²/D² vanishes only where tan h = h ≠ 0, and these
//! h are real: the critical values are ±α*_k, k ≥ 1. A tends to a finite value along a path to infinity only where
//! |Im h| → ∞, and then A = tan h + … → ±i. So h(α) and Γ(α) continue analytically along every path that avoids
//! ±α*_k and ±i. Therefore the error of a polynomial of degree 7 decreases as ρ⁻⁸, where ρ = z + √(z² − 1) and z is
//! the distance of the nearest singularity from the centre of the piece, divided by half the length of the piece
//! (Bernstein's ellipse):
//!
//! ```text
//!   interval n     nearest singularities                smallest ρ
//!   n ≥ 1          α*_n, at 16.5/0.5 half-lengths       66        next to nπ and (n+1)π also α*_{n∓1}, ρ ≥ 95
//!   0              ±i, and next to π α*_1               83        α = 0 is not singular
//! ```
//!
//! In the interval 0 pieces of a 16th would have ρ = 42 next to π, because α*_1 is only 1.35 from π. The error
//! would grow by a factor (66/42)⁸ ≈ 40. The pieces there are half as long. No speed lies below α*_0 = 0, so that
//! the places of the other sign are free for them.
//!
//! A table is computed when a speed in its interval is used for the first time. That takes some milliseconds.

use crate::landing::chebyshev_interpolation::{COEFFICIENTS, INTERPOLATION};
use crate::landing::error_bound::LANDING_ULPS;
use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::landing::half_time::HalfTime;
use crate::landing::half_time_root::HalfTimeRoot;
use crate::model::fixed_points::alpha_star;
use crate::precision::double_double::DoubleDouble;
use crate::precision::nearest_integer::nearest_integer;
use std::f64::consts::FRAC_1_PI;
use std::sync::{LazyLock, OnceLock};

/// Intervals with a table: α up to 32π ≈ 100. Each table takes 64 KiB. For faster hops the root search starts from an
/// expansion. The number is a power of two, so that a mask replaces the bounds check of an index.
pub(crate) const TABLES: usize = 32;

/// Bound on the error of the tables, in units of ε = 2⁻⁵²: TABLE_ULPS·ε·Γ for Γ, and
/// TABLE_ULPS·ε·(|α − h| + [`BEYOND_FLOOR`]) for α − h.
///
/// *Rounding.* Let q be Σ|cₖ|/|c₀| over k ≥ 1, with |c₀| + BEYOND_FLOOR instead of |c₀| for α − h. On every piece q
/// ≤ 0.065. c₀ is rounded once and takes part in three additions of [`polynomial`]. Every other term takes part in
/// at most eleven roundings. The error is at most (4 + 11q)/(1 − q) half-units, below 2.6 ε. *Interpolation.* Its
/// error is T₈ times a function that changes little on a piece. At the extrema of T₈ it is at most 0.45 ε Γ and
/// 1.05 ε (|α − h| + BEYOND_FLOOR), computed with 40 digits. `xtask/generators/first_flight.py` makes these numbers
/// and q. docs/theory.md, Lemma 61, uses the bound.
///
/// Measured with both: 1.9 and 1.7, at 214 723 speeds on all pieces of all intervals, against 40 digits.
pub(crate) const TABLE_ULPS: f64 = 4.0;

/// α − h vanishes at nπ and (n+1)π, but the error of its polynomial does not vanish there. The value is the
/// smallest power of two for which the bound of the rounding stays below three units: a smaller one makes q larger.
pub(crate) const BEYOND_FLOOR: f64 = 0.25;

/// The decisions of a hop count LANDING_ULPS for each quantity of a landing. The errors of Γ² and of x′ = 2h (α −
/// h) are twice those of the factors, and |α − h| < 1. If the tables were worse, the difference would be negative,
/// which is no `usize`, and the crate would not compile.
const _: usize = (2.0 * TABLE_ULPS * (1.0 + BEYOND_FLOOR) < LANDING_ULPS) as usize - 1;

/// Octaves of |δ| with pieces, from 2⁻¹³ up to 4; |δ| is at most π. Speeds within 2⁻¹³ of α*_n have no piece. Such
/// speeds are few. The kernel leaves them undecided, and the root search solves them.
const OCTAVES: usize = 15;
/// The exponent field of 2⁻¹³ in an `f64`.
const FIRST_OCTAVE: u64 = 1023 - 13;

/// Pieces on one side of α*_n: 16 in each octave, by four bits of the fraction. In the interval 0 there are twice
/// as many.
const PIECES: usize = 16 * OCTAVES;

/// Speeds nearer to nπ than this, in units of π, have no piece. The kind of the landing changes at nπ, and α/π has a
/// rounding error of 10⁻¹⁴ at α = 100. The value 10⁻⁷ is far above that error; it is chosen, not derived. The kernel
/// leaves these speeds undecided, and `FixedPointInterval` decides the kind of their landing on 100 bits.
const NEAR_END: f64 = 1e-7;

/// Coefficients by powers of the position on a piece, in [−1, 1].
pub(crate) type Piece = [f64; COEFFICIENTS];

/// The pieces of an interval: first the pieces above α*_n, then the pieces below α*_n, then one piece whose values are
/// NaN. In the interval 0: first the left halves of the pieces, then their right halves.
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

/// Slots for 481 pieces, rounded up to a power of two: a mask then replaces the bounds check of an index.
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

/// Used in place of a table that is not computed yet.
static EMPTY_TABLE: FirstFlightTable = FirstFlightTable::EMPTY;

/// The `f64` nearest to α*_n, from which δ is measured, for n < [`TABLES`].
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
    /// The function has no branch. Loops over many speeds inline it.
    #[inline(always)]
    pub(crate) fn of(alpha: f64, fixed_points: &FixedPoints) -> Self {
        /// The bits of 1.0: exponent field and zero fraction.
        const ONE: u64 = 1023 << 52;
        let alpha_over_pi = alpha * FRAC_1_PI;
        let (n, bits) = nearest_integer(alpha_over_pi - 0.5);
        let part = alpha_over_pi - n;
        let interval = bits & (TABLES as u64 - 1);
        let delta = alpha - fixed_points[interval as usize]; // exact
        let bits = delta.to_bits() & (u64::MAX >> 1);
        // The exponent and the first four bits of the fraction, counted from the first octave. For a smaller |δ| the
        // index wraps to a huge number.
        let index = (bits >> 48).wrapping_sub(FIRST_OCTAVE << 4);
        let sudden = delta.to_bits() >> 63;
        // In the interval n = 0, where δ ≥ 0, the fifth bit of the fraction takes the place of the sign.
        let is_halved = interval == 0;
        let (second_half, shift_of) =
            if is_halved { (bits >> 47 & 1, bits << 5) } else { (sudden, bits << 4) };
        // In the interval n = 0 the kind of the landing does not change near α = 0: small speeds keep their piece.
        let inside = (index < PIECES as u64)
            & (alpha_over_pi < TABLES as f64)
            & (part < 1.0 - NEAR_END)
            & ((part > NEAR_END) | (alpha_over_pi < 0.5));
        let piece = if inside { index + second_half * PIECES as u64 } else { NO_PIECE as u64 };
        // The remaining bits of the fraction, as the fraction of a number in [1, 2).
        let fraction = f64::from_bits(shift_of & (u64::MAX >> 12) | ONE);
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

    /// The table of (nπ, (n+1)π), computed at its first use.
    #[inline(always)]
    pub(crate) fn get(n: u64) -> &'static FirstFlightTable {
        let slot = &ALL_TABLES[n as usize % TABLES];
        match slot.get() {
            Some(table) => table,
            None => slot.get_or_init(|| FirstFlightTable::new(n)),
        }
    }

    /// All tables, with an empty table for each that is not computed yet.
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
        let end = |multiple: u64| {
            (DoubleDouble::multiple_of_pi(multiple as f64) - fixed_point).high.abs()
        };
        let (above, below) = (end(n + 1), end(n));
        let mut table = Box::new(FirstFlightTable::EMPTY);
        for slot in 0..NO_PIECE {
            let span = Span::of(n, slot);
            // No speed of the interval lies on a piece that begins beyond its end.
            if span.left < if span.sign > 0.0 { above } else { below } {
                let (closing_speed, beyond) = span.coefficients(fixed_point);
                table.closing_speed[slot] = closing_speed;
                table.beyond[slot] = beyond;
            }
        }
        table
    }
}

/// The left end of a piece, as |δ|.
fn left_end(index: usize) -> f64 {
    f64::from_bits((FIRST_OCTAVE << 52) + ((index as u64) << 48))
}

/// A polynomial of degree seven by Estrin's scheme: the processor computes its terms in parallel.
#[inline(always)]
pub(crate) fn polynomial(c: &Piece, x: f64) -> f64 {
    let square = x * x;
    let fourth = square * square;
    let low = (c[0] + c[1] * x) + square * (c[2] + c[3] * x);
    let high = (c[4] + c[5] * x) + square * (c[6] + c[7] * x);
    low + fourth * high
}

/// The part of an interval that a piece covers: δ from `sign`·`left` to `sign`·(`left` + `width`).
struct Span {
    left: f64,
    width: f64,
    sign: f64,
}

impl Span {
    /// The part of the interval n that the piece at index `slot` covers.
    fn of(n: u64, slot: usize) -> Self {
        let (index, second) = (slot % PIECES, slot >= PIECES);
        let left = left_end(index);
        let width = left_end(index + 1) - left;
        if n > 0 {
            return Span { left, width, sign: if second { -1.0 } else { 1.0 } };
        }
        let half = 0.5 * width;
        Span { left: if second { left + half } else { left }, width: half, sign: 1.0 }
    }

    /// Γ and α − h by powers of the position.
    fn coefficients(&self, fixed_point: DoubleDouble) -> (Piece, Piece) {
        let half = 0.5 * self.width;
        let values: [_; COEFFICIENTS] = std::array::from_fn(|k| {
            let size = (INTERPOLATION.nodes[k] + 1.0) * half + self.left;
            exact_first(fixed_point + size * self.sign)
        });
        (
            INTERPOLATION.coefficients(values.map(|(speed, _)| speed)),
            INTERPOLATION.coefficients(values.map(|(_, beyond)| beyond)),
        )
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// α, then Γ and α − h as sums of two numbers: from 50 digits, made with mpmath from A(h) = α.
    ///
    /// The first two are the places with the largest errors of each of both, among 214 723. At the third and
    /// fourth, next to π, pieces of a 16th had errors of up to 20 units in Γ and 330 in α − h.
    const WORST: [(f64, [f64; 2], [f64; 2]); 6] = [
        (
            48.174857773621056,
            [64.63483573257757, -1.3977531131515864e-15],
            [0.46046174632412634, 1.497611630725665e-17],
        ),
        (
            18.220755271931772,
            [33.93062084686079, -3.5040945001288176e-16],
            [-0.3034370889122746, -1.9848269902102622e-17],
        ),
        (
            3.1295085938536618,
            [6.28295651784837, 4.204715306189653e-16],
            [-0.006041956554337576, -2.0596303722638652e-19],
        ),
        (
            3.1261,
            [6.282809513057498, -2.962179347373632e-16],
            [-0.007746172419638805, 3.3418752643031823e-19],
        ),
        (
            2.618033988749895,
            [5.892865180711441, -1.1689865843587998e-17],
            [-0.25628266739301353, -5.9058381172073745e-18],
        ),
        (
            1.8632011245757307,
            [4.222473248762292, 1.5181248118923702e-16],
            [-0.5598694317209838, -5.0354735356522825e-17],
        ),
    ];

    /// Errors of Γ and α − h at `alpha` in the units of [`TABLE_ULPS`].
    fn errors(alpha: f64, gamma: DoubleDouble, beyond: DoubleDouble) -> [f64; 2] {
        let found = TablePosition::of(alpha, fixed_points()).first_flight(alpha).unwrap();
        let far = |found: f64, exact: DoubleDouble| (-exact + found).high.abs() / f64::EPSILON;
        [
            far(found.closing_speed, gamma) / gamma.high,
            far(found.beyond, beyond) / (beyond.high.abs() + BEYOND_FLOOR),
        ]
    }

    #[test]
    fn the_worst_places_are_within_the_bound() {
        for (alpha, gamma, beyond) in WORST {
            let exact = |[high, low]: [f64; 2]| DoubleDouble::from(high) + low;
            let [of_gamma, of_beyond] = errors(alpha, exact(gamma), exact(beyond));
            assert!(of_gamma < 2.0 && of_beyond < 2.0, "{alpha}: {of_gamma} {of_beyond}");
        }
    }

    /// Every piece of some intervals, against the function that is interpolated, at four places that are no nodes.
    #[test]
    fn every_piece_is_within_the_bound() {
        for n in [0, 1, 2, 31] {
            for span in (0..NO_PIECE).map(|slot| Span::of(n, slot)) {
                for part in [0.001, 0.25, 0.64, 0.999] {
                    let alpha = alpha_star(n) + span.sign * (span.left + part * span.width);
                    let position = TablePosition::of(alpha, fixed_points());
                    if position.interval != n || position.piece == NO_PIECE as u64 {
                        continue; // beyond the end of the interval, or next to it
                    }
                    let (gamma, beyond) = exact_first(DoubleDouble::from(alpha));
                    let errors = errors(alpha, gamma, beyond);
                    assert!(errors.iter().all(|&error| error < TABLE_ULPS), "{alpha}: {errors:?}");
                }
            }
        }
    }
}
