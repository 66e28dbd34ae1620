//! A hop in long arithmetic: for verdicts and values that 53 bits cannot give.
//!
//! The formulas are those of `flight.rs` and `landing.rs`; near a fixed point those of `local.rs`.
//! In 106 bits a hop takes some tens of microseconds, in 1024 bits milliseconds: longer numbers are
//! taken only where shorter ones are in doubt.

use crate::error::Error;
use crate::landing::error_bound::Doubt;
use crate::landing::from_ground::Landing;
use crate::landing::from_ground::{Cell, TakeOff, next_root};
use crate::map::lift_off_map::SUDDEN_LIFT_OFF_BUDGET;
use crate::map::near_fixed_point::WideLocal;
use crate::model::mass_ratio::MassRatio;
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::Real;
use std::f64::consts::PI;

/// μ and κ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WideRatio<R> {
    pub(crate) mu: R,
    pub(crate) kappa: R,
}

impl<R: Real> WideRatio<R> {
    fn new(mass_ratio: MassRatio) -> Self {
        let m = R::from(mass_ratio.value());
        let whole = m + 1.0;
        let kappa = m / whole;
        WideRatio { mu: kappa / whole, kappa }
    }
}

/// The end of a flight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WideLanding<R> {
    pub(crate) closing_speed: R,
    pub(crate) excess: R,
    pub(crate) velocity: R,
    pub(crate) time: R,
}

impl<R: Real> WideLanding<R> {
    fn rounded(&self, sudden: bool) -> Landing {
        Landing {
            time: self.time.nearest(),
            closing_speed: self.closing_speed.nearest(),
            excess: self.excess.nearest(),
            velocity: self.velocity.nearest(),
            sudden,
        }
    }
}

/// Where a hop starts.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Start {
    /// At α.
    Speed(f64),
    /// At α*_n + δ.
    Offset { n: u64, delta: f64 },
}

/// A whole hop, rounded to `f64`.
pub(crate) struct WideHop {
    /// Nothing if grounded.
    pub(crate) next: Option<Next>,
    /// α′².
    pub(crate) next_speed_squared: f64,
    /// All landings, rounded; all but the last are sudden.
    pub(crate) landings: Vec<Landing>,
    /// Whether all verdicts exceed their rounding errors.
    pub(crate) certain: bool,
    /// Whether what flights hand on to each other leaves the digits of the result alone, too.
    pub(crate) precise: bool,
}

/// The lift-off that ends a hop.
pub(crate) struct Next {
    /// α′.
    pub(crate) speed: f64,
    /// α − α′.
    pub(crate) loss: f64,
    /// α′ − α*_n, if the hop started at an offset from it; otherwise α′.
    pub(crate) offset: f64,
}

/// The hop in as many bits as it needs, at most 1024.
///
/// A chain that is over the budget of an arithmetic is given up in it: the last result stands.
pub(crate) fn wide_hop(start: Start, mass_ratio: MassRatio) -> Result<WideHop, Error> {
    let longer = [hop_with::<Long<4>> as HopWith, hop_with::<Long<8>>, hop_with::<Long<16>>];
    let mut hop = hop_with::<DoubleDouble>(start, mass_ratio)?;
    for longer in longer {
        match hop {
            Some(ref found) if found.certain && found.precise => break,
            _ => hop = longer(start, mass_ratio)?.or(hop),
        }
    }
    hop.ok_or_else(|| {
        let alpha = match start {
            Start::Speed(alpha) => alpha,
            Start::Offset { n, delta } => crate::model::fixed_points::alpha_star(n) + delta,
        };
        Error::Undecided { alpha, sudden: DoubleDouble::SUDDEN_BUDGET }
    })
}

type HopWith = fn(Start, MassRatio) -> Result<Option<WideHop>, Error>;

/// The share of an ulp of the result that may be wrong.
const PRECISE: f64 = 0.125 * f64::EPSILON;

/// In one arithmetic; nothing if the chain is over its budget.
fn hop_with<R: Real>(start: Start, mass_ratio: MassRatio) -> Result<Option<WideHop>, Error> {
    let ratio = WideRatio::<R>::new(mass_ratio);
    let (alpha, offset, first, first_is_sudden) = match start {
        Start::Speed(speed) => {
            let cell = Cell::of(speed);
            let alpha = R::from(speed);
            let first = if cell.n == 0 {
                next_wide(R::from(0.0), alpha, ratio.kappa, cell.root(speed).half.h)
            } else {
                let star = R::alpha_star(cell.n);
                WideLocal::new(star).landing(alpha - star, ratio.kappa)
            };
            (alpha, alpha, first, cell.sudden)
        }
        Start::Offset { n, delta } => {
            let star = R::alpha_star(n);
            let offset = R::from(delta);
            let first = WideLocal::new(star).landing(offset, ratio.kappa);
            (star + offset, offset, first, delta < 0.0)
        }
    };
    let Some(chain) = chain(first, first_is_sudden, alpha.nearest(), ratio)? else {
        return Ok(None);
    };
    let loss = ratio.mu * chain.loss;
    let next_speed_squared = alpha.squared() - loss;
    let share = (next_speed_squared / alpha.squared()).nearest();
    let next = (next_speed_squared.nearest() > 0.0).then(|| {
        let speed = next_speed_squared.sqrt();
        let lost = loss / (alpha + speed);
        Next { speed: speed.nearest(), loss: lost.nearest(), offset: (offset - lost).nearest() }
    });
    let (mu, speed) = (ratio.mu.nearest(), alpha.nearest());
    // One sudden lift-off near a fixed point is short, and relatively exact: only chains hand on.
    let handed_on = if chain.landings.len() > 2 { chain.doubt.handed_on(mu, speed) } else { 0.0 };
    let precise = next.as_ref().is_none_or(|next| {
        let error = 0.5 * handed_on * (speed / next.speed) * speed;
        error <= PRECISE * next.offset.abs().min(next.speed)
    });
    Ok(Some(WideHop {
        next,
        next_speed_squared: next_speed_squared.nearest(),
        certain: !chain.doubt.is_real(share, mu, speed),
        precise,
        landings: chain.landings,
    }))
}

/// All flights of a hop.
struct Chain<R> {
    /// Σ Γ².
    loss: R,
    landings: Vec<Landing>,
    /// What rounding errors leave open.
    doubt: Doubt,
}

/// The rest of a hop whose first landing is known, with its verdict; nothing if it is over the
/// arithmetic's budget.
fn chain<R: Real>(
    first: WideLanding<R>,
    first_is_sudden: bool,
    alpha: f64,
    ratio: WideRatio<R>,
) -> Result<Option<Chain<R>>, Error> {
    let kappa = ratio.kappa.nearest();
    let mut landing = first;
    let mut rounded = first.rounded(first_is_sudden);
    let mut hop = Chain {
        loss: first.closing_speed.squared(),
        landings: vec![rounded],
        doubt: Doubt::wide(alpha, R::EPSILON),
    };
    hop.doubt.pass(&rounded, kappa);
    while rounded.sudden {
        let sudden = hop.landings.len();
        let (x, v) = (landing.excess, landing.velocity);
        let start = TakeOff { excess: x.nearest(), velocity: v.nearest() };
        if sudden > SUDDEN_LIFT_OFF_BUDGET {
            let TakeOff { excess, velocity } = start;
            return Err(Error::SuddenLiftOffBudget { sudden: sudden - 1, excess, velocity });
        }
        if sudden > R::SUDDEN_BUDGET {
            return Ok(None);
        }
        if !(start.excess > 0.0) {
            break; // a flight too short to see
        }
        let test = if start.velocity >= PI { maximum_test(x, v) } else { f64::INFINITY };
        let root = next_root(start, start.velocity >= PI && test >= 0.0);
        landing = next_wide(x, v, ratio.kappa, root.half.h);
        hop.loss = hop.loss + landing.closing_speed.squared();
        rounded = landing.rounded(false);
        rounded.sudden = rounded.excess > 0.0 || (rounded.excess == 0.0 && rounded.velocity > 0.0);
        hop.doubt.pass_on_branch(&rounded, kappa, test);
        hop.landings.push(rounded);
    }
    Ok(Some(hop))
}

/// (−1)^m (V cos V − Y sin V), as in `landing.rs`.
fn maximum_test<R: Real>(x: R, v: R) -> f64 {
    let (sin, cos) = v.sin_cos();
    let test = (v * cos - (x + 1.0) * sin).nearest();
    if (v.nearest() / PI).floor() % 2.0 == 0.0 { test } else { -test }
}

/// Most Newton steps: from a good `f64` start each doubles the digits; next to a double root one halves
/// the error only.
const NEWTON_STEPS: usize = 400;

/// The landing of the flight from stretch 1 + `x` and speed `v`, by Newton's method from an `f64` h.
fn next_wide<R: Real>(x: R, v: R, kappa: R, start: f64) -> WideLanding<R> {
    let mut h = R::from(start);
    let mut half = WideHalf::at(h);
    for _ in 0..NEWTON_STEPS {
        let residual = (h - v) + half.sin * half.rho - x * half.sigma;
        let slope = half.rho * (half.rho - x * (half.sin / half.d)) * 2.0;
        if slope.nearest() == 0.0 {
            break;
        }
        let step = residual / slope;
        if !(step.nearest().abs() > R::EPSILON * h.nearest()) {
            break;
        }
        h = h - step;
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

/// The functions of h, as in [`crate::landing::half_flight::HalfFlight`].
struct WideHalf<R> {
    sin: R,
    d: R,
    u: R,
    rho: R,
    sigma: R,
}

impl<R: Real> WideHalf<R> {
    fn at(h: R) -> Self {
        let (sin, cos) = h.sin_cos();
        let (d, u) = if h.nearest() < 1.0 { series(h) } else { (h - sin * cos, h * cos - sin) };
        WideHalf { sin, d, u, rho: u / d, sigma: sin.squared() / d }
    }
}

/// D and u by their series, as in `flight.rs`: the closed forms cancel at small h.
fn series<R: Real>(h: R) -> (R, R) {
    let minus_square = -h.squared();
    let (mut d, mut u) = (R::from(0.0), R::from(0.0));
    let mut term = h; // (−1)^k h^{2k+1}/(2k+1)!
    let mut power_of_four = 1.0;
    for k in 1..=SERIES_TERMS {
        term = (term * minus_square).over(2 * k * (2 * k + 1));
        power_of_four *= 4.0;
        d = d - term * power_of_four;
        u = u + term * f64::from(2 * k);
        if !(term.nearest().abs() * power_of_four > R::EPSILON * d.nearest()) {
            break;
        }
    }
    (d, u)
}

/// 4^k/(2k+1)! is under 2⁻¹⁰²⁴ here.
const SERIES_TERMS: u32 = 110;
