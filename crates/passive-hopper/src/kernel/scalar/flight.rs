//! A later flight: from (x, V), x > 0, to its landing.

use super::start;
use crate::kernel::scalar::turn::{Turn, nearest, turned};
use crate::landing::error_bound::LANDING_ULPS;
use std::f64::consts::{FRAC_1_PI, PI};

/// Steps of order four that a search may take; two suffice for nearly all.
const STEPS: usize = 8;

/// The last step is so small that a turn by it needs three terms, and its fourth power is nothing.
const LAST_STEP: f64 = 3e-5;

/// A share whose square is under an ulp.
const FIRST_ORDER: f64 = 1e-9;

/// A state on the ground: stretch minus one and velocity, and a bound on the errors of both.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ground {
    pub(crate) excess: f64,
    pub(crate) velocity: f64,
    pub(crate) error: f64,
}

/// The end of a flight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Landed {
    pub(crate) ground: Ground,
    /// Γ².
    pub(crate) square: f64,
    /// Bound on the error of Γ² that came with the start.
    pub(crate) square_error: f64,
    /// h, half the time.
    pub(crate) half_time: f64,
    /// Whether the search has come to its end, on its branch, and no verdict is in doubt.
    pub(crate) settled: bool,
}

/// The branch that a flight lands on, and where its search starts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Branch {
    pub(crate) left: f64,
    pub(crate) right: f64,
    /// Where the search starts.
    pub(crate) start: f64,
    /// (−1)^m on a branch that is to be behind α*_m, where u (−1)^m < 0; else 0.
    pub(crate) side: f64,
    /// 1 if the branch is beyond doubt, else 0.
    pub(crate) sure: f64,
}

impl Branch {
    /// The branch for V < π.
    #[inline(always)]
    pub(crate) fn slow(ground: &Ground) -> Self {
        let Ground { excess, velocity, .. } = *ground;
        Branch {
            left: if velocity > 0.0 { velocity } else { 0.0 },
            right: PI,
            start: start::slow(excess, velocity),
            side: 0.0,
            sure: 1.0,
        }
    }

    /// The branch for V ≥ π.
    #[inline(always)]
    pub(crate) fn fast(ground: &Ground) -> Self {
        let Ground { excess, velocity, error } = *ground;
        let turns = velocity * FRAC_1_PI;
        let (m, parity) = nearest(turns - 0.5);
        let part = turns - m;
        let turn = Turn::near(velocity);
        let test = turned(velocity * turn.cos - (1.0 + excess) * turn.sin, parity);
        let before = (test >= 0.0) & (part < 0.5);
        let size = 4.0 * (1.0 + excess + velocity);
        let slack = 1e-8 * size + error + size * error;
        let (low, high) = (m * PI, (m + 1.0) * PI);
        let sure = (test.abs() > slack) & (part > 1e-9) & (part < 1.0 - 1e-9) & (velocity < 128.0);
        Branch {
            left: if before { low } else { velocity },
            right: if before { velocity } else { high },
            start: start::fast(excess, velocity, m, if before { -1.0 } else { 1.0 }),
            side: if before { 0.0 } else { turned(1.0, parity) },
            sure: if sure { 1.0 } else { 0.0 },
        }
    }

    /// `h` moved by `step`, or half way to the end that this would pass.
    #[inline(always)]
    pub(crate) fn moved(&self, h: f64, step: f64) -> f64 {
        let next = h + step;
        let next = if next > self.left { next } else { 0.5 * (h + self.left) };
        if next < self.right { next } else { 0.5 * (h + self.right) }
    }

    /// The start, if it is inside.
    #[inline(always)]
    pub(crate) fn first(&self) -> f64 {
        let inside = (self.start > self.left) & (self.start < self.right);
        if inside { self.start } else { 0.5 * (self.left + self.right) }
    }
}

/// F(h) = h² − YS² − VD = D (V(h) − V), and F′/2, F″/2, F‴/4.
#[inline(always)]
fn function(turn: &Turn, ground: &Ground) -> [f64; 4] {
    let Turn { h, sin, cos, d, .. } = *turn;
    let (y, v) = (1.0 + ground.excess, ground.velocity);
    let (square, product) = (sin * sin, sin * cos);
    let double = 1.0 - 2.0 * square; // cos 2h
    let f = (h * h - y * square) - v * d;
    let half_first = h - y * product - v * square;
    let half_second = 1.0 - y * double - 2.0 * (v * product);
    [f, half_first, half_second, 2.0 * (y * product) - v * double]
}

/// The step of order four, Householder's third.
#[inline(always)]
pub(crate) fn step(turn: &Turn, ground: &Ground) -> f64 {
    let [f, half_first, half_second, quarter_third] = function(turn, ground);
    let (first, second, third) = (2.0 * half_first, 2.0 * half_second, 4.0 * quarter_third);
    let slope = first * first;
    -f * (slope - 0.5 * f * second) / (first * (slope - f * second) + f * f * third * (1.0 / 6.0))
}

/// The step of order three, Halley's: enough for the last one.
#[inline(always)]
pub(crate) fn last_step(turn: &Turn, ground: &Ground) -> f64 {
    let [f, half_first, half_second, _] = function(turn, ground);
    -f * half_first / (2.0 * (half_first * half_first) - 0.5 * (f * half_second))
}

/// The landing a last `step` away from `turn`.
#[inline(always)]
pub(crate) fn land(turn: &Turn, step: f64, ground: &Ground, branch: &Branch, kappa: f64) -> Landed {
    let Ground { excess: x, velocity: v, error } = *ground;
    let y = 1.0 + x;
    let end = turn_by(turn, step);
    let Turn { h, sin, cos, d, u } = end;
    let (square, product) = (sin * sin, sin * cos);
    let inverse = 1.0 / d;
    let rho = u * inverse;
    let w = u - x * sin;
    let raw = 2.0 * rho * w; // Γ before the correction
    let residual = (h - v) + (sin * rho - x * (square * inverse));
    let loss_slope = -4.0 * (h * sin * w + u * (h * sin + x * cos) + 2.0 * square * rho * w);
    let per_speed = d / (2.0 * (u * w)); // 1/Γ, without waiting for ρ
    let share = residual * per_speed;
    let rest = -share * d;
    let change = -0.5 * share * loss_slope;
    let closing = raw + change;
    let excess = (x + 2.0 * h * (v - h)) + 2.0 * rest * (v - 2.0 * h);
    let velocity = (v - 2.0 * h) - 2.0 * rest + kappa * closing;
    // What the flight makes of the errors: its linear map, all terms positive.
    let size = y + v.abs() + 2.0 * h + closing;
    let rounding = LANDING_ULPS * f64::EPSILON * size;
    let before = error + 4.0 * f64::EPSILON * size;
    let time_error = 2.0 * (square + d) * before * per_speed;
    let rate = (v * (1.0 - 2.0 * square) - 2.0 * y * product).abs() + 1e-5 * size;
    let excess_error = rounding + 1.5 * before + rate * time_error;
    let closing_error = 2.5 * before + excess.abs() * time_error;
    let velocity_error = rounding + before + time_error + kappa * closing_error;
    let error = if excess_error > velocity_error { excess_error } else { velocity_error };
    let scale = if h < 1.0 { h } else { 1.0 };
    let settled = (step.abs() <= LAST_STEP * scale)
        & (rest.abs() <= FIRST_ORDER * scale)
        & (change.abs() <= FIRST_ORDER * raw)
        & (h > branch.left)
        & (h < branch.right)
        & ((branch.side == 0.0) | (branch.side * u < 0.0))
        & (branch.sure > 0.0)
        & (excess.abs() > error);
    Landed {
        ground: Ground { excess, velocity, error },
        square: closing * closing,
        square_error: 2.0 * closing * closing_error,
        half_time: h + rest,
        settled,
    }
}

/// The functions at h + `e`, by Taylor's series.
#[inline(always)]
fn turn_by(turn: &Turn, e: f64) -> Turn {
    let Turn { h, sin, cos, d, u } = *turn;
    let half = 0.5 * e * e;
    let cubed = half * e * (1.0 / 3.0);
    let sine = e - cubed;
    let (square, product) = (sin * sin, sin * cos);
    Turn {
        h: h + e,
        sin: sin + (cos * sine - sin * half),
        cos: cos - (sin * sine + cos * half),
        d: d + (2.0 * square * e + 4.0 * product * half + 4.0 * (1.0 - 2.0 * square) * cubed),
        u: u - (h * sin * e + (sin + h * cos) * half + (2.0 * cos - h * sin) * cubed),
    }
}

/// The flight from `ground`; nothing where the careful path must decide.
#[inline]
pub(crate) fn flight(ground: &Ground, kappa: f64) -> Option<Landed> {
    let branch = if ground.velocity < PI { Branch::slow(ground) } else { Branch::fast(ground) };
    let mut turn = Turn::near(branch.first());
    for _ in 0..STEPS {
        turn = Turn::at(branch.moved(turn.h, step(&turn, ground)));
        let last = last_step(&turn, ground);
        if last.abs() <= LAST_STEP {
            let landed = land(&turn, last, ground, &branch, kappa);
            if landed.settled {
                return Some(landed);
            }
        }
    }
    None
}
