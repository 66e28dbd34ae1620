//! The first landing of a flight from the ground, with certainty.
//!
//! In h, half the time of flight, the landing is a root of V(h) = V ([`HalfFlight`]), and theory
//! gives an interval that holds the first root and no other, on which V(h) increases:
//!
//! ```text
//!   start                          first landing has h in       why
//!   x = 0, V = α ∈ (nπ, α*_n)      (nπ, α)                      A(nπ) = nπ, A(h) − h = Su/D > 0
//!   x = 0, V = α ∈ (α*_n, (n+1)π)  (α, (n+1)π)                  A(h) − h < 0
//!   x > 0, branch b = m            [mπ, V]                      V(mπ) = mπ ≤ V = max at most
//!   x > 0, branch b = m + 1        (max(V, α*_m), (m+1)π)       V((m+1)π) = (m+1)π > V
//! ```
//!
//! where m = ⌊V/π⌋ (0 for V < π), and the branch is m only if m ≥ 1, V < (m+½)π and
//! (−1)^m (V cos V − Y sin V) ≥ 0: V has not passed the local maximum of branch m, which lies on
//! the diagonal, so V(h) − h = S (hC − YS)/D changes sign just there (theory: b.2).

use crate::landing::first_flight_table::{Place, stars};
use crate::landing::half_flight::HalfFlight;
use crate::model::fixed_points::{alpha_star, exact_alpha_star, n_pi};
use crate::precision::double_double::DoubleDouble;
use std::cmp::Ordering;
use std::f64::consts::PI;

/// Above this lift-off speed, 2⁴³, an ulp is 2⁻⁹: too coarse to name a phase of the spring.
pub const LARGEST_LIFT_OFF_SPEED: f64 = 8_796_093_022_208.0;

/// The start of a flight from the ground: y₁ = 1 + excess, ẏ₁ = velocity, y₂ = ẏ₂ = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TakeOff {
    /// Stretch of the spring minus one, x ≥ 0; zero at a gradual lift-off.
    pub excess: f64,
    /// Velocity of the upper mass.
    pub velocity: f64,
}

/// The end of a flight, just after the plastic collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Landing {
    /// Time of flight τ.
    pub time: f64,
    /// Γ = −(1+M) ẏ₂ just before the collision; the landing takes μ Γ² from α².
    pub closing_speed: f64,
    /// Stretch minus one at the landing.
    pub excess: f64,
    /// Velocity of the upper mass, which the collision does not change.
    pub velocity: f64,
    /// Whether the spring pulls the lower mass off again at once.
    pub sudden: bool,
}

/// Where on the first hump-and-window ladder a lift-off speed lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cell {
    /// α ∈ (nπ, (n+1)π).
    pub(crate) n: u64,
    /// α*_n.
    pub(crate) star: DoubleDouble,
    /// α ∈ (nπ, α*_n), n ≥ 1: the first landing is sudden.
    pub(crate) sudden: bool,
}

impl Cell {
    /// The cell of `alpha` > 0, decided on 100 bits.
    pub(crate) fn of(alpha: f64) -> Self {
        let turns = alpha / PI;
        let mut n = turns as u64;
        let part = turns - n as f64;
        if part < 1e-3 && n > 0 && n_pi(n).compare(alpha) == Ordering::Less {
            n -= 1;
        } else if part > 0.999 && n_pi(n + 1).compare(alpha) != Ordering::Less {
            n += 1;
        }
        let star = exact_alpha_star(n);
        Cell { n, star, sudden: n > 0 && star.compare(alpha) == Ordering::Less }
    }

    /// The interval of h that holds the landing.
    fn bracket(&self, alpha: f64) -> (f64, f64) {
        if self.sudden { (self.n as f64 * PI, alpha) } else { (alpha, (self.n + 1) as f64 * PI) }
    }

    /// Half the time of the first flight: from a table to a few ulps, or from an expansion.
    pub(crate) fn root(&self, alpha: f64) -> Root {
        let tabled = Place::of(alpha, stars()).first(alpha);
        let start = tabled.map_or_else(|| self.expansion(alpha), |first| first.half_time);
        solve(0.0, alpha, self.bracket(alpha), start)
    }

    /// The same, for those who make the table.
    pub(crate) fn root_without_table(&self, alpha: f64) -> Root {
        solve(0.0, alpha, self.bracket(alpha), self.expansion(alpha))
    }

    /// h to a few digits from the expansion of A about α*_n, or about 0 and π on the first cell.
    fn expansion(&self, alpha: f64) -> f64 {
        if self.n == 0 {
            // A = h/2 (1 + h²/15 + …), and A(π) = π.
            let square = alpha * alpha;
            return 2.0 * alpha / (1.0 + square * (4.0 / 15.0 - 0.016_76 * square));
        }
        let a = self.star.high;
        let square = a * a;
        let w = pxfm::f_cbrt(12.0 * (alpha - a) * (square / (1.0 + square)));
        let t2 = 1.0 / (4.0 * a);
        let t3 = (4.0 + 25.0 / square) / 240.0;
        let t4 = (36.0 - 65.0 / square) / (2880.0 * a);
        a + 0.5 * w * (1.0 + w * (t2 + w * (t3 + w * (w * (1.0 / 1400.0) - t4))))
    }
}

/// The first landing after a gradual lift-off with speed `alpha`: exists and is unique for all.
pub(crate) fn first_landing(alpha: f64, kappa: f64) -> Landing {
    let cell = Cell::of(alpha);
    cell.root(alpha).landing(0.0, alpha, kappa, Some(cell.sudden))
}

/// The first landing after a sudden lift-off, `excess` > 0.
pub(crate) fn next_landing(start: TakeOff, kappa: f64) -> Landing {
    next_root(start, before_maximum(start)).landing(start.excess, start.velocity, kappa, None)
}

/// Half the time of the first flight after a sudden lift-off, on the branch given.
pub(crate) fn next_root(start: TakeOff, before_maximum: bool) -> Root {
    let TakeOff { excess, velocity } = start;
    let bracket = branch(start, before_maximum);
    // On branch 1, V ≈ h/2 − 3x/(2h); elsewhere the middle.
    let guess = if velocity < PI {
        let root = pxfm::f_hypot(velocity, (3.0 * excess).sqrt());
        if velocity < 0.0 { 3.0 * excess / (root - velocity) } else { velocity + root }
    } else {
        0.5 * (bracket.0 + bracket.1)
    };
    solve(excess, velocity, bracket, guess)
}

/// (−1)^m (V cos V − Y sin V), m = ⌊V/π⌋: not negative before the maximum of branch m.
pub(crate) fn maximum_test(start: TakeOff) -> f64 {
    let TakeOff { excess, velocity } = start;
    let (sin, cos) = pxfm::f_sincos(velocity);
    let sign = if (velocity / PI).floor() % 2.0 == 0.0 { 1.0 } else { -1.0 };
    sign * (velocity * cos - (1.0 + excess) * sin)
}

fn before_maximum(start: TakeOff) -> bool {
    start.velocity >= PI && maximum_test(start) >= 0.0
}

/// The interval of h that holds the first landing of a flight with `excess` > 0.
fn branch(start: TakeOff, before_maximum: bool) -> (f64, f64) {
    let velocity = start.velocity;
    if velocity < PI {
        return (velocity.max(0.0), PI);
    }
    let m = (velocity / PI).floor();
    if velocity < (m + 0.5) * PI && before_maximum {
        (m * PI, velocity)
    } else {
        (velocity.max(alpha_star(m as u64)), (m + 1.0) * PI)
    }
}

/// The interval of τ that holds the first landing, for a solver of the printed Eq. (8).
pub(crate) fn time_bracket(start: TakeOff) -> (f64, f64) {
    let (left, right) = if start.excess > 0.0 {
        let (left, right) = branch(start, before_maximum(start));
        (if left > 0.0 { left } else { before_landing(start, right) }, right)
    } else {
        // The whole cell: at its ends Eq. (8) is 2nπ (nπ − α), far from rounding; on the first one
        // the lift-off itself is a root at τ = 0, and h > α.
        let n = Cell::of(start.velocity).n as f64;
        let left = if n == 0.0 { start.velocity } else { n * PI };
        (left, (n + 1.0) * PI)
    };
    (2.0 * left, 2.0 * right)
}

/// An h > 0 before the landing on branch 1: V(h) falls to −∞ towards the lift-off at h = 0.
fn before_landing(start: TakeOff, right: f64) -> f64 {
    let mut h = 0.5 * right;
    while h > f64::MIN_POSITIVE && HalfFlight::at(h).start_speed(start.excess) >= start.velocity {
        h *= 0.5;
    }
    h
}

/// A root of V(h) = V: an `f64` h, and what is left.
pub(crate) struct Root {
    pub(crate) half: HalfFlight,
    /// V(h) − V.
    residual: f64,
    /// The exact root minus h.
    rest: f64,
}

/// Halley's method inside a bracket on which V(h) increases.
///
/// It stops when the residual, which is a backward error in V, is about an ulp of V, or of V − h where
/// that is much smaller: then the map is right, even where h is not (at α*_n it is a triple root); or when
/// what is left is so little that its square does not count. It is handed on and corrected to first order.
fn solve(excess: f64, velocity: f64, bracket: (f64, f64), start: f64) -> Root {
    const ENOUGH: usize = 200; // bisection alone ends within 64 + 53 steps of any bracket
    const LARGE: f64 = 8.0; // below, an ulp of V is one of V − h, or nearly
    let (mut left, mut right) = bracket;
    let mut h = if start > left && start < right { start } else { 0.5 * (left + right) };
    let mut half = HalfFlight::at(h);
    let mut residual = (h - velocity) + half.speed_beyond_h(excess);
    for _ in 0..ENOUGH {
        let scale = velocity.abs().min(h).min((h - velocity).abs() + LARGE);
        if residual.abs() <= f64::EPSILON * scale || is_linear(&half, residual, excess) {
            break;
        }
        if residual > 0.0 {
            right = h;
        } else {
            left = h;
        }
        let step = halley(residual, half.start_speed_slope(excess), half.start_speed_bend(excess));
        let halley = h - step;
        let next = if halley > left && halley < right { halley } else { 0.5 * (left + right) };
        if next <= left || next >= right {
            break;
        }
        h = next;
        half = HalfFlight::at(h);
        residual = (h - velocity) + half.speed_beyond_h(excess);
    }
    let rest =
        (-residual / half.start_speed_slope(excess)).clamp(left.min(h) - h, right.max(h) - h);
    Root { half, residual, rest: if rest.is_nan() { 0.0 } else { rest } }
}

/// A share whose square is under an ulp.
const FIRST_ORDER: f64 = 1e-9;

/// Whether the residual is so small that corrections of first order leave less than an ulp: of h, and of Γ².
fn is_linear(half: &HalfFlight, residual: f64, excess: f64) -> bool {
    let closing = half.closing_speed(excess);
    let step = residual.abs() / half.start_speed_slope(excess);
    step <= FIRST_ORDER * half.h.min(1.0)
        && (residual * half.loss_slope(excess)).abs() <= FIRST_ORDER * closing * closing
}

/// Halley's step, or Newton's where the two differ by much.
fn halley(residual: f64, slope: f64, bend: f64) -> f64 {
    let newton = residual / slope;
    let bent = 1.0 - 0.5 * newton * (bend / slope);
    if bent > 0.5 && bent < 2.0 { newton / bent } else { newton }
}

impl Root {
    fn landing(&self, excess: f64, velocity: f64, kappa: f64, sudden: Option<bool>) -> Landing {
        let half = &self.half;
        let (h, rest) = (half.h, self.rest);
        let loss_slope = half.loss_slope(excess);
        let uncorrected = half.closing_speed(excess);
        let change = self.residual / uncorrected * (loss_slope / uncorrected);
        let closing_speed = if change.abs() < 0.5 {
            uncorrected * (1.0 - change).sqrt()
        } else {
            // Next to a triple root all of it may be correction.
            (uncorrected * uncorrected - self.residual * loss_slope).max(0.0).sqrt()
        };
        // x' = x + 2h (V − h) on the parabola, moved by `rest`.
        let landed = excess + 2.0 * h * (velocity - h) + 2.0 * rest * (velocity - 2.0 * h);
        let upper = (velocity - 2.0 * h) - 2.0 * rest + kappa * closing_speed;
        let sudden = sudden.unwrap_or(landed > 0.0 || (landed == 0.0 && upper > 0.0));
        Landing { time: 2.0 * (h + rest), closing_speed, excess: landed, velocity: upper, sudden }
    }
}
