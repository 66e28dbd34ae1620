//! A hop in extended arithmetic, for hops whose decisions or values 53 bits do not settle.
//!
//! The formulas are those of the room `landing`, generic over the arithmetic. In 106 bits a hop takes some tens of
//! microseconds, in 1024 bits milliseconds. A longer arithmetic is used only if a shorter one was inconclusive.

use crate::error::Error;
use crate::landing::error_bound::ErrorBound;
use crate::landing::extended_landing::ExtendedLanding;
use crate::landing::first_landing::first_root;
use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::landing::flight_ends::{Landing, TakeOff, is_sudden};
use crate::landing::local_flight::NearFixedPoint;
use crate::landing::next_landing::{maximum_test, next_root};
use crate::map::limits::SUDDEN_LIFT_OFF_BUDGET;
use crate::model::fixed_points::{alpha_star, fixed_point_in};
use crate::model::mass_ratio::MassRatio;
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::Extended;
use std::f64::consts::PI;

/// μ and κ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ExtendedMasses<R> {
    pub(crate) mu: R,
    kappa: R,
}

impl<R: Extended> ExtendedMasses<R> {
    pub(crate) fn new(mass_ratio: MassRatio) -> Self {
        let m = R::from(mass_ratio.value());
        let whole = m + 1.0;
        let kappa = m / whole;
        ExtendedMasses { mu: kappa / whole, kappa }
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
pub(crate) struct ExtendedHop {
    /// `None` if the hopper is grounded.
    pub(crate) next: Option<Next>,
    /// α′².
    pub(crate) next_speed_squared: f64,
    /// All landings, rounded; all but the last are sudden.
    pub(crate) landings: Vec<Landing>,
    /// True if every decision is conclusive.
    pub(crate) certain: bool,
    /// True if the error propagated from flight to flight changes no digit of the result.
    pub(crate) precise: bool,
}

/// The lift-off that ends a hop.
pub(crate) struct Next {
    /// α′.
    pub(crate) speed: f64,
    /// α − α′.
    pub(crate) loss: f64,
    /// α′ − α*_n if the hop started at an offset from α*_n; otherwise α′.
    pub(crate) offset: f64,
}

/// The hop in as many bits as it needs: 106, 256, 512, at most 1024.
///
/// Each arithmetic has a budget of sudden lift-offs. If a hop exceeds the budget, the result of the next shorter
/// arithmetic is returned, with its `certain` and `precise`.
pub(crate) fn extended_hop(start: Start, mass_ratio: MassRatio) -> Result<ExtendedHop, Error> {
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
            Start::Offset { n, delta } => alpha_star(n) + delta,
        };
        Error::Undecided { alpha, sudden: DoubleDouble::SUDDEN_BUDGET }
    })
}

type HopWith = fn(Start, MassRatio) -> Result<Option<ExtendedHop>, Error>;

/// Largest propagated error of a result, relative to the result: an eighth of an ulp, so that the rounding of the
/// result to `f64` dominates. Chosen, not derived. A smaller value sends more chains to the longer arithmetic.
const PRECISE: f64 = 0.125 * f64::EPSILON;

/// The hop in the arithmetic `R`; `None` if the hop exceeds the budget of `R`.
fn hop_with<R: Extended>(
    start: Start,
    mass_ratio: MassRatio,
) -> Result<Option<ExtendedHop>, Error> {
    watched_hop_with::<R>(start, mass_ratio, |_, _| ())
}

/// As [`hop_with`]; `see` receives each landing, with the bounds after it.
pub(crate) fn watched_hop_with<R: Extended>(
    start: Start,
    mass_ratio: MassRatio,
    see: impl FnMut(&ExtendedLanding<R>, &ErrorBound),
) -> Result<Option<ExtendedHop>, Error> {
    let masses = ExtendedMasses::<R>::new(mass_ratio);
    let (alpha, offset, first, first_is_sudden) = match start {
        Start::Speed(speed) => {
            let interval = FixedPointInterval::of(speed);
            let alpha = R::from(speed);
            let first = if interval.n == 0 {
                // In the interval n = 0 the landing is never a triple root: the general root search is accurate.
                let root = first_root(&interval, speed);
                ExtendedLanding::near(&root, R::from(0.0), alpha, masses.kappa)
            } else {
                let star = fixed_point_in::<R>(interval.n);
                NearFixedPoint::new(star).extended_landing(alpha - star, masses.kappa)
            };
            (alpha, alpha, first, interval.sudden)
        }
        Start::Offset { n, delta } => {
            let star = fixed_point_in::<R>(n);
            let offset = R::from(delta);
            let first = NearFixedPoint::new(star).extended_landing(offset, masses.kappa);
            (star + offset, offset, first, delta < 0.0)
        }
    };
    let Some(chain) = chain(first, first_is_sudden, alpha.nearest(), masses, see)? else {
        return Ok(None);
    };
    let loss = masses.mu * chain.loss;
    let next_speed_squared = alpha.squared() - loss;
    let ratio = (next_speed_squared / alpha.squared()).nearest();
    let next = (next_speed_squared.nearest() > 0.0).then(|| {
        let speed = next_speed_squared.sqrt();
        let lost = loss / (alpha + speed);
        Next { speed: speed.nearest(), loss: lost.nearest(), offset: (offset - lost).nearest() }
    });
    let (mu, speed) = (masses.mu.nearest(), alpha.nearest());
    // With at most one sudden landing the propagated error is neglected. The bound is absolute, but the single flight
    // after a sudden landing near a fixed point is short, and its landing has a small relative error.
    let propagated =
        if chain.landings.len() > 2 { chain.error_bound.propagated(mu, speed) } else { 0.0 };
    let precise = next.as_ref().is_none_or(|next| {
        // d(α′) = ½ α²/α′ d(α′²/α²).
        let error = 0.5 * propagated * (speed / next.speed) * speed;
        error <= PRECISE * next.offset.abs().min(next.speed)
    });
    Ok(Some(ExtendedHop {
        next,
        next_speed_squared: next_speed_squared.nearest(),
        certain: !chain.error_bound.inconclusive(ratio, mu, speed),
        precise,
        landings: chain.landings,
    }))
}

/// All flights of a hop.
struct Chain<R> {
    /// Σ Γ².
    loss: R,
    landings: Vec<Landing>,
    error_bound: ErrorBound,
}

/// All flights of a hop, from its first landing and the decision whether that landing is sudden; `None` if the hop
/// exceeds the budget of the arithmetic.
fn chain<R: Extended>(
    first: ExtendedLanding<R>,
    first_is_sudden: bool,
    alpha: f64,
    masses: ExtendedMasses<R>,
    mut see: impl FnMut(&ExtendedLanding<R>, &ErrorBound),
) -> Result<Option<Chain<R>>, Error> {
    let kappa = masses.kappa.nearest();
    let mut landing = first;
    let mut rounded = first.rounded(first_is_sudden);
    let mut hop = Chain {
        loss: first.closing_speed.squared(),
        landings: vec![rounded],
        error_bound: ErrorBound::of_extended(alpha, R::EPSILON),
    };
    hop.error_bound.add_flight(&rounded, kappa);
    see(&landing, &hop.error_bound);
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
            break; // x′ rounds to zero: the next flight is too short for an f64 and loses no energy
        }
        let test = if start.velocity >= PI { maximum_test(x, v) } else { f64::INFINITY };
        let root = next_root(start, start.velocity >= PI && test >= 0.0);
        landing = ExtendedLanding::near(&root, x, v, masses.kappa);
        hop.loss = hop.loss + landing.closing_speed.squared();
        rounded = landing.rounded(false);
        rounded.sudden = is_sudden(rounded.excess, rounded.velocity);
        hop.error_bound.add_flight_on_branch(&rounded, kappa, test);
        see(&landing, &hop.error_bound);
        hop.landings.push(rounded);
    }
    Ok(Some(hop))
}
