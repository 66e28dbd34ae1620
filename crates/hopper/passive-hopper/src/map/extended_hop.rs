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
use crate::map::limits::{SHORT_FLIGHT, SUDDEN_LIFT_OFF_BUDGET};
use crate::map::speed_error::Changes;
use crate::model::fixed_points::{alpha_star, fixed_point_in, n_pi};
use crate::model::mass_ratio::MassRatio;
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::Extended;
use std::f64::consts::PI;

/// μ and κ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ExtendedMasses<R> {
    pub(crate) mu: R,
    pub(crate) kappa: R,
}

/// Larger mass ratios are scaled: the product of two numbers of 106 bits splits its factors, and above 2⁹⁹⁵ a
/// factor times 2²⁷ + 1 is infinite.
const LARGEST_UNSCALED: f64 = 1e250;

/// 2⁻⁵⁰⁰: with it the largest M, 4.5·10³⁰⁷, is far from both ends of the exponents.
const SCALE: f64 = f64::from_bits((1023 - 500) << 52);

impl<R: Extended> ExtendedMasses<R> {
    pub(crate) fn new(mass_ratio: MassRatio) -> Self {
        // κ = M/(1+M) and μ = κ/(1+M), both sides of each fraction times a power of two, which changes no bit.
        let scale = if mass_ratio.value() > LARGEST_UNSCALED { SCALE } else { 1.0 };
        let m = R::from(mass_ratio.value() * scale);
        let whole = m + scale;
        let kappa = m / whole;
        ExtendedMasses { mu: kappa * scale / whole, kappa }
    }
}

/// Where a hop starts.
#[derive(Debug, Clone, Copy)]
pub(crate) enum HopStart {
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
pub(crate) fn extended_hop(start: HopStart, mass_ratio: MassRatio) -> Result<ExtendedHop, Error> {
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
            HopStart::Speed(alpha) => alpha,
            HopStart::Offset { n, delta } => alpha_star(n) + delta,
        };
        Error::Undecided { alpha, sudden: DoubleDouble::SUDDEN_BUDGET }
    })
}

type HopWith = fn(HopStart, MassRatio) -> Result<Option<ExtendedHop>, Error>;

/// Largest propagated error of a result, relative to the result: an eighth of an ulp, so that the rounding of the
/// result to `f64` dominates. Chosen, not derived. A smaller value sends more chains to the longer arithmetic.
const PRECISE: f64 = 0.125 * f64::EPSILON;

/// A hop in the arithmetic `R`, not rounded.
pub(crate) struct HopIn<R> {
    /// α′².
    pub(crate) next_speed_squared: R,
    /// α² − α′².
    pub(crate) loss_of_square: R,
    /// All landings, rounded; all but the last are sudden.
    pub(crate) landings: Vec<Landing>,
    /// True if every landing, sudden or not and on its branch, is decided for all speeds within the error of the start.
    pub(crate) decided: bool,
    /// Bound on the rounding error of α′²/α²: of a hop that starts at exactly the given speed.
    pub(crate) ratio_error: f64,
    /// The part of `ratio_error` that was propagated from flight to flight.
    pub(crate) propagated: f64,
}

/// Where a hop starts, in the arithmetic `R`.
pub(crate) struct StartIn<R> {
    alpha: R,
    first: ExtendedLanding<R>,
    first_is_sudden: bool,
}

impl<R: Extended> StartIn<R> {
    /// At `alpha`.
    pub(crate) fn at_speed(alpha: R, masses: ExtendedMasses<R>) -> Self {
        let speed = alpha.nearest();
        // `speed` may lie on the other side of nπ than `alpha`, which has more bits.
        let mut n = FixedPointInterval::of(speed).n;
        let beyond = |n: u64| {
            let end = n_pi(n);
            (alpha - (R::from(end.high) + end.low)).nearest() >= 0.0
        };
        if n > 0 && !beyond(n) {
            n -= 1;
        } else if beyond(n + 1) {
            n += 1;
        }
        if n == 0 {
            // In the interval n = 0 the landing is never a triple root: the general root search is accurate.
            let root = first_root(&FixedPointInterval::of(speed), speed);
            let first = ExtendedLanding::near(&root, R::from(0.0), alpha, masses.kappa);
            return StartIn { alpha, first, first_is_sudden: false };
        }
        let star = fixed_point_in::<R>(n);
        let offset = alpha - star;
        let first = NearFixedPoint::new(star).extended_landing(offset, masses.kappa);
        StartIn { alpha, first, first_is_sudden: offset.nearest() < 0.0 }
    }

    /// At α*_n + `offset`.
    fn at_offset(n: u64, offset: R, masses: ExtendedMasses<R>) -> Self {
        let star = fixed_point_in::<R>(n);
        let first = NearFixedPoint::new(star).extended_landing(offset, masses.kappa);
        StartIn { alpha: star + offset, first, first_is_sudden: offset.nearest() < 0.0 }
    }

    /// The hop, for a start and a κ that are known to within `changes`; `None` if the hop exceeds the budget of
    /// `R`. `see` receives each landing, with the bounds after it.
    pub(crate) fn hop(
        self,
        changes: Changes,
        masses: ExtendedMasses<R>,
        see: impl FnMut(&ExtendedLanding<R>, &ErrorBound),
    ) -> Result<Option<HopIn<R>>, Error> {
        let speed = self.alpha.nearest();
        let start = (speed, changes);
        let Some(chain) = chain(self.first, self.first_is_sudden, start, masses, see)? else {
            return Ok(None);
        };
        let mu = masses.mu.nearest();
        let loss_of_square = masses.mu * chain.loss;
        Ok(Some(HopIn {
            next_speed_squared: self.alpha.squared() - loss_of_square,
            loss_of_square,
            decided: chain.settled && !chain.with_start.landing_inconclusive(),
            ratio_error: chain.rounding.ratio_error(mu, speed),
            propagated: chain.rounding.propagated(mu, speed),
            landings: chain.landings,
        }))
    }
}

/// The hop in the arithmetic `R`; `None` if the hop exceeds the budget of `R`.
fn hop_with<R: Extended>(
    start: HopStart,
    mass_ratio: MassRatio,
) -> Result<Option<ExtendedHop>, Error> {
    watched_hop_with::<R>(start, mass_ratio, |_, _| ())
}

/// As [`hop_with`]; `see` receives each landing, with the bounds after it.
pub(crate) fn watched_hop_with<R: Extended>(
    start: HopStart,
    mass_ratio: MassRatio,
    see: impl FnMut(&ExtendedLanding<R>, &ErrorBound),
) -> Result<Option<ExtendedHop>, Error> {
    let masses = ExtendedMasses::<R>::new(mass_ratio);
    let (from, offset) = match start {
        HopStart::Speed(speed) => {
            let alpha = R::from(speed);
            (StartIn::at_speed(alpha, masses), alpha)
        }
        HopStart::Offset { n, delta } => {
            let offset = R::from(delta);
            (StartIn::at_offset(n, offset, masses), offset)
        }
    };
    let alpha = from.alpha;
    let Some(hop) = from.hop(Changes::of_speed(0.0), masses, see)? else { return Ok(None) };
    let HopIn { next_speed_squared, loss_of_square: loss, .. } = hop;
    let ratio = (next_speed_squared / alpha.squared()).nearest();
    let next = (next_speed_squared.nearest() > 0.0).then(|| {
        let speed = next_speed_squared.sqrt();
        let lost = loss / (alpha + speed);
        Next { speed: speed.nearest(), loss: lost.nearest(), offset: (offset - lost).nearest() }
    });
    let speed = alpha.nearest();
    // The bound is absolute. At an offset from a fixed point the time of the first flight and the state after it
    // have small relative errors instead, and a short second flight keeps them (docs/theory.md, Lemma 73 and
    // Theorem 74, to first order in the rounding; Section 12). There the propagated error is neglected; an offset
    // far below the spacing of the arithmetic would otherwise never be precise.
    let relative = matches!(start, HopStart::Offset { .. })
        && match hop.landings.as_slice() {
            [_] => true,
            [_, second] => second.time < SHORT_FLIGHT,
            _ => false,
        };
    let propagated = if relative { 0.0 } else { hop.propagated };
    let precise = next.as_ref().is_none_or(|next| {
        // d(α′) = ½ α²/α′ d(α′²/α²).
        let error = 0.5 * propagated * (speed / next.speed) * speed;
        error <= PRECISE * next.offset.abs().min(next.speed)
    });
    Ok(Some(ExtendedHop {
        next,
        next_speed_squared: next_speed_squared.nearest(),
        certain: hop.decided && ratio.abs() > hop.ratio_error,
        precise,
        landings: hop.landings,
    }))
}

/// All flights of a hop.
struct Chain<R> {
    /// Σ Γ².
    loss: R,
    landings: Vec<Landing>,
    /// The bound for a hop that starts at exactly the given speed.
    rounding: ErrorBound,
    /// The bound that contains the error of the start.
    with_start: ErrorBound,
    /// Whether the search of every landing has ended before its limit.
    settled: bool,
}

/// All flights of a hop, from its first landing and the decision whether that landing is sudden, for a start and a κ
/// that are known to within `changes`; `None` if the hop exceeds the budget of the arithmetic.
fn chain<R: Extended>(
    first: ExtendedLanding<R>,
    first_is_sudden: bool,
    (alpha, changes): (f64, Changes),
    masses: ExtendedMasses<R>,
    mut see: impl FnMut(&ExtendedLanding<R>, &ErrorBound),
) -> Result<Option<Chain<R>>, Error> {
    let kappa = masses.kappa.nearest();
    let mut landing = first;
    let mut rounded = first.rounded(first_is_sudden);
    let mut hop = Chain {
        loss: first.closing_speed.squared(),
        landings: vec![rounded],
        rounding: ErrorBound::of_extended(alpha, R::EPSILON),
        with_start: ErrorBound::of_extended(alpha, R::EPSILON).with_speed_error(changes.speed),
        settled: first.settled,
    };
    hop.rounding.add_flight(&rounded, kappa);
    hop.with_start.add_flight(&rounded, kappa);
    hop.with_start.add_kappa_error(changes.kappa, rounded.closing_speed);
    see(&landing, &hop.rounding);
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
        let Some(start) = start.resolved() else { break };
        let test = if start.velocity >= PI { maximum_test(x, v) } else { f64::INFINITY };
        let root = next_root(start, start.velocity >= PI && test >= 0.0);
        landing = ExtendedLanding::near(&root, x, v, masses.kappa);
        hop.settled &= landing.settled;
        hop.loss = hop.loss + landing.closing_speed.squared();
        rounded = landing.rounded(false);
        rounded.sudden = is_sudden(rounded.excess, rounded.velocity);
        hop.rounding.add_flight_on_branch(&rounded, kappa, test);
        hop.with_start.add_flight_on_branch(&rounded, kappa, test);
        hop.with_start.add_kappa_error(changes.kappa, rounded.closing_speed);
        see(&landing, &hop.rounding);
        hop.landings.push(rounded);
    }
    Ok(Some(hop))
}
