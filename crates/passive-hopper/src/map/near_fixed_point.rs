//! A hop in the coordinate of a fixed point: (n, δ) with α = α*_n + δ, to (n, δ′).
//!
//! With a = α*_n, τ = 2a + t, η = t/2, h = a + η and tan a = a (theory: c), exactly
//!
//! ```text
//!   δ(t) = N/Q      N = a (t − sin t) + (t²/2 − 1 + cos t)       Q = 2a + t − sin(2a + t) = 2D
//!   Γ    = 4 b²/(R² Q)        b = (1 + a² + aη) sin η − η cos η          R² = 1 + a²
//!   S u/D = −2 (a cos η + sin η) b/(R² Q)          δ′ = δ − μ Σ Γ²/(α + α′)
//! ```
//!
//! Nothing cancels but in δ − loss, near the end of an interval of attraction: there the hop is
//! computed in longer arithmetic.

use crate::error::Error;
use crate::landing::error_bound::Doubt;
use crate::landing::from_ground::Landing;
use crate::landing::from_ground::TakeOff;
use crate::landing::from_ground::{LARGEST_LIFT_OFF_SPEED, next_landing};
use crate::map::extended_hop::{Start, WideLanding, wide_hop};
use crate::map::lift_off_map::LARGEST_PLAIN_SPEED;
use crate::map::lift_off_map::LiftOffMap;
use crate::model::fixed_points::alpha_star;
use crate::model::fixed_points::{exact_alpha_star, n_pi};
use crate::precision::real::Real;

/// While the loss is under this share of |δ|, its own rounding does not show in δ′.
const SMALL_LOSS: f64 = 1.0 / 16.0;

/// A hop near a fixed point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalHop {
    /// δ′ = α′ − α*_n; nothing if the hopper is grounded.
    pub next: Option<f64>,
    /// δ − δ′, without cancellation; nothing if grounded.
    pub loss: Option<f64>,
    /// Number of sudden lift-offs.
    pub sudden: usize,
    /// By how much the first flight is longer than 2α*_n.
    pub time_shift: f64,
}

impl LiftOffMap {
    /// The hop from α = α*_n + `delta`, in the coordinate δ.
    ///
    /// δ′ is right to a few ulps of itself, from |δ| = 10⁻³⁰⁰ to the ends of the cell
    /// (nπ, (n+1)π): orbits follow the algebraic approach to α*_n for ever, where α itself would
    /// stand still.
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::ONE);
    /// let hop = map.hop_near_fixed_point(1, 1e-60)?;
    /// // f(α* + δ) = α* + δ − λδ^{4/3}: far below the spacing of α.
    /// let lambda = hop.loss.expect("it hops again") / 1e-80;
    /// assert!((lambda - 3.616949794602146).abs() < 1e-14);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Offset`] unless n ≥ 1 and α lies in the cell of α*_n, outside 10⁻³⁰⁰ of α*_n (an
    /// offset of zero is welcome); [`Error::SuddenLiftOffBudget`] as for [`hop`](Self::hop);
    /// [`Error::Undecided`] where 1024 bits, or the budget of flights in them, do not give the verdicts and
    /// the digits of δ′.
    pub fn hop_near_fixed_point(&self, n: u64, delta: f64) -> Result<LocalHop, Error> {
        let star = exact_alpha_star(n);
        // The cell (nπ, (n+1)π) in δ, to 100 bits.
        let (left, right) = (n_pi(n) - star, n_pi(n + 1) - star);
        let inside = left.compare(delta).is_gt() && right.compare(delta).is_lt();
        let resolved = delta == 0.0 || delta.abs() >= 1e-300;
        if n == 0 || star.high > LARGEST_LIFT_OFF_SPEED || !inside || !resolved {
            return Err(Error::Offset { n, delta, left: left.high, right: right.high });
        }
        if delta == 0.0 {
            return Ok(LocalHop { next: Some(0.0), loss: Some(0.0), sudden: 0, time_shift: 0.0 });
        }
        let local = LocalFlight { a: star.high };
        let t = local.time_shift(delta);
        let fast = (local.a <= LARGEST_PLAIN_SPEED).then(|| self.fast(&local, delta, t)).flatten();
        fast.map_or_else(|| self.wide(n, delta, t), Ok)
    }

    /// In plain `f64`; nothing if the loss is not small against δ.
    fn fast(&self, local: &LocalFlight, delta: f64, t: f64) -> Option<LocalHop> {
        let mu = self.mass_ratio().mu();
        let kappa = self.mass_ratio().kappa();
        let (excess, velocity, closing_speed) = local.landing(t, kappa);
        let mut loss = closing_speed * closing_speed;
        let sudden = usize::from(delta < 0.0);
        if sudden > 0 {
            let start = TakeOff { excess, velocity };
            let next = next_landing(start, kappa);
            // A longer chain is no small loss; and the verdict must be larger than its error: that of a
            // short flight is relative to the excess.
            let short = next.time < 1.0 && next.excess < -1e-10 * excess;
            if next.sudden
                || !(short || Self::is_clear(local, start, t, closing_speed, &next, kappa))
            {
                return None;
            }
            loss += next.closing_speed * next.closing_speed;
        }
        let taken = mu * loss;
        if !(taken <= SMALL_LOSS * 2.0 * local.a * delta.abs()) {
            return None;
        }
        // δ′ = δ − μ Σ Γ²/(α + α′)
        let alpha = local.a + delta;
        let change = taken / (alpha + (alpha * alpha - taken).sqrt());
        Some(LocalHop { next: Some(delta - change), loss: Some(change), sudden, time_shift: t })
    }

    /// Whether the verdict of the second landing is larger than its rounding error.
    fn is_clear(
        local: &LocalFlight,
        start: TakeOff,
        t: f64,
        closing_speed: f64,
        next: &Landing,
        kappa: f64,
    ) -> bool {
        let TakeOff { excess, velocity } = start;
        let time = 2.0 * local.a + t;
        let mut doubt = Doubt::plain(local.a);
        doubt.pass(&Landing { time, closing_speed, excess, velocity, sudden: true }, kappa);
        doubt.pass(next, kappa);
        !doubt.is_doubtful()
    }

    fn wide(&self, n: u64, delta: f64, time_shift: f64) -> Result<LocalHop, Error> {
        let hop = wide_hop(Start::Offset { n, delta }, self.mass_ratio())?;
        let sudden = hop.landings.len() - 1;
        if !(hop.certain && hop.precise) {
            return Err(Error::Undecided { alpha: alpha_star(n) + delta, sudden });
        }
        let (next, loss) = hop.next.map(|next| (next.offset, next.loss)).unzip();
        Ok(LocalHop { next, loss, sudden, time_shift })
    }
}

/// The first flight from near α*_n in plain `f64`, as functions of t = τ − 2α*_n.
///
/// Everything keeps its relative accuracy, however small t is.
///
/// ```
/// use passive_hopper::LocalFlight;
/// let flight = LocalFlight::new(1);
/// let t = flight.time_shift(1e-30);
/// assert!((flight.delta(t) / 1e-30 - 1.0).abs() < 1e-14);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalFlight {
    a: f64,
}

impl LocalFlight {
    /// The flights near α*_n, n ≥ 1. (At n = 0 the functions of [`crate::landing::half_flight::HalfFlight`] serve.)
    pub fn new(n: u64) -> Self {
        LocalFlight { a: alpha_star(n.max(1)) }
    }

    /// δ(t), the offset of the lift-off speed from α*_n.
    pub fn delta(&self, t: f64) -> f64 {
        self.offset(t).0
    }

    /// Γ(t), the closing speed.
    pub fn closing_speed(&self, t: f64) -> f64 {
        self.landing(t, 0.0).2
    }

    /// W(t) = sin h (sin h − h cos h) of α′ dα′/dα = α (1 − 4μW).
    pub fn w(&self, t: f64) -> f64 {
        let eta = 0.5 * t;
        let (sin, cos) = pxfm::f_sincos(eta);
        (self.a * cos + sin) * (self.b(eta) / (1.0 + self.a * self.a))
    }

    /// δ(t) and Q(t).
    fn offset(&self, t: f64) -> (f64, f64) {
        let a = self.a;
        let half = 0.5 * t;
        let bend = -2.0 * pxfm::f_sinmx(half) * (half + pxfm::f_sin(half));
        let q = self.q(t);
        ((bend - a * pxfm::f_sinmx(t)) / q, q)
    }

    fn q(&self, t: f64) -> f64 {
        let square = self.a * self.a;
        let (sin, cos) = pxfm::f_sincos(t);
        let sine = (2.0 * self.a * cos + (1.0 - square) * sin) / (1.0 + square);
        2.0 * self.a + t - sine
    }

    /// b(η).
    fn b(&self, eta: f64) -> f64 {
        let (sin, cos) = pxfm::f_sincos(eta);
        (1.0 + self.a * (self.a + eta)) * sin - eta * cos
    }

    /// t of δ, by Newton's method from its expansion in δ^{1/3}.
    ///
    /// On t³ ∝ δ it converges quadratically in relative terms, however small δ is.
    pub fn time_shift(&self, delta: f64) -> f64 {
        let square = self.a * self.a;
        let r2 = 1.0 + square;
        let w = pxfm::f_cbrt(delta) * pxfm::f_cbrt(12.0 * square / r2);
        let mut t = w * (1.0 + w * (0.25 / self.a + w * (4.0 + 25.0 / square) / 240.0));
        for _ in 0..12 {
            let (offset, q) = self.offset(t);
            let b = self.b(0.5 * t);
            let slope = 4.0 * (b / q) * (b / q) / r2;
            let step = (offset - delta) / slope;
            if !step.is_finite() {
                break;
            }
            t -= step;
            if step.abs() <= 1e-15 * t.abs() {
                break;
            }
        }
        t
    }

    /// (excess, velocity, Γ) at the first landing.
    fn landing(&self, t: f64, kappa: f64) -> (f64, f64, f64) {
        let a = self.a;
        let (square, eta) = (a * a, 0.5 * t);
        let (sin, cos) = pxfm::f_sincos(eta);
        let b = (1.0 + a * (a + eta)) * sin - eta * cos;
        // Q = 2a + t − sin(2a + t), by the double angle.
        let sine = 2.0 * (a * (1.0 - 2.0 * sin * sin) + (1.0 - square) * sin * cos);
        let q = (2.0 * a + t) - sine / (1.0 + square);
        let scale = b / (q * (1.0 + square));
        let beyond = -2.0 * (a * cos + sin) * scale; // S u/D
        let h = a + eta;
        let closing_speed = 4.0 * b * scale;
        (2.0 * h * beyond, beyond - h + kappa * closing_speed, closing_speed)
    }
}

/// The local functions in longer arithmetic.
pub(crate) struct WideLocal<R> {
    a: R,
    r2: R,
}

impl<R: Real> WideLocal<R> {
    pub(crate) fn new(star: R) -> Self {
        WideLocal { a: star, r2: star.squared() + 1.0 }
    }

    /// δ(t), Q(t).
    fn offset(&self, t: R) -> (R, R) {
        let (sin, cos) = t.sin_cos();
        let (rest, bend) = if t.nearest().abs() < 1.0 {
            remainders(t)
        } else {
            (t - sin, t.squared() * 0.5 + cos + -1.0)
        };
        let a = self.a;
        let sine = (a * cos * 2.0 + (-a.squared() + 1.0) * sin) / self.r2;
        let q = a * 2.0 + t - sine;
        ((a * rest + bend) / q, q)
    }

    /// b(η).
    fn b(&self, eta: R) -> (R, R, R) {
        let (sin, cos) = eta.sin_cos();
        ((self.a * (self.a + eta) + 1.0) * sin - eta * cos, sin, cos)
    }

    /// The first landing from α = a + `delta`.
    pub(crate) fn landing(&self, delta: R, kappa: R) -> WideLanding<R> {
        let start = LocalFlight { a: self.a.nearest() }.time_shift(delta.nearest());
        let mut t = R::from(start);
        for _ in 0..NEWTON_STEPS {
            let (offset, q) = self.offset(t);
            let scaled = self.b(t * 0.5).0 / q;
            let slope = scaled.squared() * 4.0 / self.r2;
            if slope.nearest() == 0.0 {
                break;
            }
            let step = (offset - delta) / slope;
            if !(step.nearest().abs() > R::EPSILON * t.nearest().abs()) {
                break;
            }
            t = t - step;
        }
        let q = self.offset(t).1;
        let eta = t * 0.5;
        let (b, sin, cos) = self.b(eta);
        let scale = b / (q * self.r2);
        let beyond = (self.a * cos + sin) * scale * -2.0;
        let h = self.a + eta;
        let closing_speed = b * scale * 4.0;
        WideLanding {
            closing_speed,
            excess: h * beyond * 2.0,
            velocity: beyond - h + kappa * closing_speed,
            time: h * 2.0,
        }
    }
}

/// From 15 digits each step doubles them; in between, rounding may move t for ever.
const NEWTON_STEPS: usize = 40;

/// t − sin t and t²/2 − 1 + cos t by their series.
fn remainders<R: Real>(t: R) -> (R, R) {
    let minus_square = -t.squared();
    let (mut odd, mut even) = (t * minus_square, minus_square.squared());
    (odd, even) = (-odd.over(6), even.over(24));
    let (mut rest, mut bend) = (odd, even);
    for k in 2..=SERIES_TERMS {
        odd = (odd * minus_square).over(2 * k * (2 * k + 1));
        even = (even * minus_square).over((2 * k + 1) * (2 * k + 2));
        (rest, bend) = (rest + odd, bend + even);
        if !(odd.nearest().abs() > R::EPSILON * rest.nearest().abs()) {
            break;
        }
    }
    (rest, bend)
}

/// 1/(2k+1)! is under 2⁻¹⁰²⁴ here.
const SERIES_TERMS: u32 = 90;
