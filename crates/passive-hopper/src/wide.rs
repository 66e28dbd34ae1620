//! A hop in double-double arithmetic: for verdicts and values that 53 bits cannot give.
//!
//! The formulas are those of `flight.rs` and `landing.rs`; near a fixed point those of `local.rs`.
//! A hop takes some tens of microseconds, so it is computed only where the fast one is in doubt.

use crate::double_double::{DoubleDouble, inverse_factorials};
use crate::doubt::Doubt;
use crate::landing::{Cell, TakeOff, next_root};
use crate::local::WideLocal;
use crate::{Error, Landing, MassRatio, SUDDEN_LIFT_OFF_BUDGET};
use std::f64::consts::PI;

/// Relative rounding error of double-double operations, 2⁻¹⁰⁰ to be safe.
const EPSILON: f64 = 7.9e-31;

/// μ and κ to 106 bits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WideRatio {
    pub(crate) mu: DoubleDouble,
    pub(crate) kappa: DoubleDouble,
}

impl WideRatio {
    pub(crate) fn new(mass_ratio: MassRatio) -> Self {
        let m = DoubleDouble::from(mass_ratio.value());
        let whole = m + 1.0;
        let kappa = m / whole;
        WideRatio { mu: kappa / whole, kappa }
    }
}

/// The end of a flight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WideLanding {
    pub(crate) closing_speed: DoubleDouble,
    pub(crate) excess: DoubleDouble,
    pub(crate) velocity: DoubleDouble,
    pub(crate) time: DoubleDouble,
}

impl WideLanding {
    fn rounded(&self, sudden: bool) -> Landing {
        Landing {
            time: self.time.high,
            closing_speed: self.closing_speed.high,
            excess: self.excess.high,
            velocity: self.velocity.high,
            sudden,
        }
    }
}

/// A whole hop.
pub(crate) struct WideHop {
    /// Σ Γ².
    pub(crate) loss: DoubleDouble,
    pub(crate) sudden: usize,
    pub(crate) flight_time: f64,
    /// What its rounding errors leave open.
    pub(crate) doubt: Doubt,
}

/// The hop that starts with `alpha`.
pub(crate) fn wide_hop(alpha: f64, ratio: WideRatio) -> Result<WideHop, Error> {
    let cell = Cell::of(alpha);
    let first = if cell.n == 0 {
        next_wide(DoubleDouble::ZERO, alpha.into(), ratio.kappa, cell.root(alpha).half.h)
    } else {
        let local = WideLocal::new(cell.star);
        local.landing(DoubleDouble::from(alpha) - cell.star, ratio.kappa)
    };
    wide_chain(first, cell.sudden, alpha, ratio)
}

/// The rest of a hop whose first landing is known, with its verdict.
pub(crate) fn wide_chain(
    first: WideLanding,
    first_is_sudden: bool,
    alpha: f64,
    ratio: WideRatio,
) -> Result<WideHop, Error> {
    let mut landing = first;
    let mut sudden = first_is_sudden;
    let mut hop = WideHop {
        loss: first.closing_speed.squared(),
        sudden: 0,
        flight_time: first.time.high,
        doubt: Doubt::new(alpha, EPSILON),
    };
    hop.doubt.pass(&first.rounded(sudden), ratio.kappa.high);
    while sudden {
        hop.sudden += 1;
        if hop.sudden > SUDDEN_LIFT_OFF_BUDGET {
            let (excess, velocity) = (landing.excess.high, landing.velocity.high);
            return Err(Error::SuddenLiftOffBudget { sudden: hop.sudden - 1, excess, velocity });
        }
        if !(landing.excess.high > 0.0) {
            break; // a flight too short to see
        }
        let (x, v) = (landing.excess, landing.velocity);
        let start = TakeOff { excess: x.high, velocity: v.high };
        let test = maximum_test(x, v);
        let root = next_root(start, start.velocity >= PI && test >= 0.0);
        landing = next_wide(x, v, ratio.kappa, root.half.h);
        hop.loss = hop.loss + landing.closing_speed.squared();
        hop.flight_time += landing.time.high;
        sudden = landing.excess.high > 0.0
            || (landing.excess.high == 0.0 && landing.velocity.high > 0.0);
        hop.doubt.pass(&landing.rounded(sudden), ratio.kappa.high);
    }
    Ok(hop)
}

/// (−1)^m (V cos V − Y sin V), as in `landing.rs`.
fn maximum_test(x: DoubleDouble, v: DoubleDouble) -> f64 {
    let (sin, cos) = v.sin_cos();
    let test = (v * cos - (x + 1.0) * sin).high;
    if (v.high / PI).floor() % 2.0 == 0.0 { test } else { -test }
}

/// The landing of the flight from stretch 1 + `x` and speed `v`, by Newton's method from an `f64` h.
fn next_wide(x: DoubleDouble, v: DoubleDouble, kappa: DoubleDouble, start: f64) -> WideLanding {
    let mut h = DoubleDouble::from(start);
    let mut half = WideHalf::at(h);
    for _ in 0..4 {
        let residual = (h - v) + half.sin * half.rho - x * half.sigma;
        let slope = 2.0 * half.rho.high * (half.rho.high - x.high * (half.sin.high / half.d.high));
        let step = residual.high / slope;
        if !step.is_finite() || step.abs() <= 1e-31 * h.high {
            break;
        }
        h = h - DoubleDouble::exact_sum(step, residual.low / slope);
        half = WideHalf::at(h);
    }
    let closing_speed = half.rho * (half.u - x * half.sin) * 2.0;
    WideLanding {
        closing_speed,
        excess: x + h * (v - h) * 2.0,
        velocity: v - h * 2.0 + kappa * closing_speed,
        time: h * 2.0,
    }
}

/// The functions of h, as in [`crate::HalfFlight`].
struct WideHalf {
    sin: DoubleDouble,
    d: DoubleDouble,
    u: DoubleDouble,
    rho: DoubleDouble,
    sigma: DoubleDouble,
}

impl WideHalf {
    fn at(h: DoubleDouble) -> Self {
        let (sin, cos) = h.sin_cos();
        let (d, u) = if h.high < 1.0 { series(h) } else { (h - sin * cos, h * cos - sin) };
        WideHalf { sin, d, u, rho: u / d, sigma: sin.squared() / d }
    }
}

/// D and u by their series: the closed forms cancel at small h.
fn series(h: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let square = h.squared();
    let inverse = inverse_factorials();
    let (mut d, mut u) = (DoubleDouble::ZERO, DoubleDouble::ZERO);
    for k in (1..=18i32).rev() {
        let coefficient = inverse[2 * k as usize + 1];
        d = coefficient * 4f64.powi(k) - d * square;
        u = -coefficient * f64::from(2 * k) - u * square;
    }
    let cube = square * h;
    (d * cube, u * cube)
}
