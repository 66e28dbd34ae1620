//! The fundamental domain of the map left of α*_n, and the phases of its speeds.
//!
//! ```text
//!   α*_n + f(δ₀) ├──────────────── one turn ────────────────┤ α*_n + δ₀        α*_n
//! ```
//!
//! The nearer the domain is to α*_n, the fewer `f64` it has. So it begins as far out as theory permits, where it is
//! some tenths wide. There one phase takes milliseconds, because every hop towards α*_n is inverted in longer
//! arithmetic. Ψ is analytic in x =
//! |δ|^{1/3} on the domain, and a polynomial through its values at Chebyshev nodes gives all other phases.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use hopper_asymptotics::{BigInt, FatouCoordinate, Offset, Phase, Side};
use passive_hopper::{FixedPointSpeed, LiftOffMap};
use std::f64::consts::PI;

/// For −0.0586 ≤ δ < 0 and M ≤ 1 f rises where the hopper lifts off, for −0.0109 ≤ δ < 0 at all M (docs/theory.md,
/// Theorem 81).
const FARTHEST: f64 = 0.0586;
const FARTHEST_ABOVE_ONE: f64 = 0.0109;

/// The hopper lifts off from every −10⁻³ ≤ δ < 0 for which the loss is below |δ| (docs/theory.md, Theorem 68); from
/// 10⁻⁹ at λ up to some hundred. Nearer domains would have few `f64`.
const NEAREST: f64 = 1e-9;

/// Number of nodes. In x the function is analytic up to x = 0 at least, a fraction of the domain's length away. For
/// n ≤ 30 and all M tried 24 nodes leave less than the error of the phases at the nodes, some 10⁻¹²; 20 nodes leave
/// 6·10⁻¹¹ at n = 8, M = 0.9. Each node takes milliseconds.
const NODES: usize = 24;

/// Points between the nodes at which the polynomial is compared with the phase.
const CHECKS: usize = 7;

/// The error of the polynomial elsewhere, as a multiple of the largest difference at those points. Chosen, not derived.
const SAFETY: f64 = 4.0;

/// Most hops from the domain to the reach of the coordinate. More are needed at mass ratios below some 10⁻⁴ only;
/// then the domain is moved inwards.
const MOST_HOPS: usize = 1000;

/// A number of turns: Ψ less an integer that is the same for the whole domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turns {
    pub(crate) value: f64,
    /// Bound on the error.
    pub(crate) error: f64,
}

/// The speeds from α*_n + f(δ₀) to α*_n + δ₀.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DomainSpeeds {
    pub(crate) n: u64,
    star: FixedPointSpeed,
    /// Some ulps below α*_n + f(δ₀).
    pub(crate) bottom: f64,
    /// α*_n + δ₀, within an ulp.
    pub(crate) top: f64,
}

impl DomainSpeeds {
    /// The widest domain left of α*_n, n ≥ 1, from which the hopper lifts off.
    pub(crate) fn widest(fates: &Fates, n: u64) -> Result<Self, Error> {
        let above_one = fates.map().mass_ratio().value() > 1.0;
        let mut delta = if above_one { -FARTHEST_ABOVE_ONE } else { -FARTHEST };
        loop {
            match DomainSpeeds::from(fates, n, delta) {
                Ok(speeds) => return Ok(speeds),
                Err(error) if delta.abs() <= NEAREST => return Err(error),
                Err(_) => delta *= 0.5,
            }
        }
    }

    fn from(fates: &Fates, n: u64, delta: f64) -> Result<Self, Error> {
        let star = FixedPointSpeed::new(n);
        let top = star.value() + delta;
        let grounded = Error::NoTurn { n, delta };
        let image = fates.map().image(top)?.ok_or(grounded.clone())?;
        // Some ulps for the error of the image: both ends of the circle are covered.
        let bottom = image - 16.0 * f64::EPSILON * image;
        if bottom < top { Ok(DomainSpeeds { n, star, bottom, top }) } else { Err(grounded) }
    }

    pub(crate) fn width(&self) -> f64 {
        self.top - self.bottom
    }

    /// The speeds from δ₀ on to the largest `f64` below α*_n.
    pub(crate) fn inner_side(&self) -> (f64, f64) {
        (self.top, self.star.value().next_down())
    }
}

/// The speeds of one turn, with their phases.
#[derive(Debug, Clone)]
pub(crate) struct FundamentalDomain {
    pub(crate) speeds: DomainSpeeds,
    pub(crate) coordinate: FatouCoordinate,
    /// Ends of x.
    roots: (f64, f64),
    /// Ψ − `whole` at the nodes.
    values: [f64; NODES],
    whole: BigInt,
    error: f64,
}

impl FundamentalDomain {
    /// The domain left of α*_n, n ≥ 1.
    pub(crate) fn new(fates: &Fates, n: u64) -> Result<Self, Error> {
        let coordinate = FatouCoordinate::new(n, fates.map().mass_ratio(), Side::Left)?;
        let mut speeds = DomainSpeeds::widest(fates, n)?;
        // From far out the hops to the coordinate's reach may be too many.
        loop {
            match FundamentalDomain::on(fates, speeds, &coordinate) {
                Ok(domain) => return Ok(domain),
                Err(error) => {
                    let delta = speeds.star.offset_of(speeds.top);
                    if delta.abs() <= coordinate.reach() {
                        return Err(error);
                    }
                    speeds = DomainSpeeds::from(fates, n, 0.5 * delta)?;
                }
            }
        }
    }

    fn on(
        fates: &Fates,
        speeds: DomainSpeeds,
        coordinate: &FatouCoordinate,
    ) -> Result<Self, Error> {
        let DomainSpeeds { n, star, bottom, top } = speeds;
        let (offset, image_offset) = (star.offset_of(top), star.offset_of(bottom));
        let roots = (pxfm::f_cbrt(-offset), pxfm::f_cbrt(-image_offset));
        let mut domain = FundamentalDomain {
            speeds,
            coordinate: coordinate.clone(),
            roots,
            values: [0.0; NODES],
            whole: BigInt::default(),
            error: 0.0,
        };
        let inner = Inner { fates, n, coordinate, lowest: offset, whole: None };
        let (_, whole) = inner.turns(offset)?;
        domain.whole = whole.clone();
        let inner = Inner { whole: Some(whole), ..inner };
        for k in 0..NODES {
            let (turns, _) = inner.turns(domain.cube(node(k)))?;
            domain.values[k] = turns.value;
            domain.error = domain.error.max(turns.error);
        }
        let mut largest: f64 = 0.0;
        for k in 0..CHECKS {
            let at = (2 * k + 1) as f64 / CHECKS as f64 - 1.0;
            let (turns, _) = inner.turns(domain.cube(at))?;
            largest = largest.max((turns.value - domain.polynomial(at)).abs());
        }
        // The rounding of x, whose range has one turn.
        let rounding = 4.0 * f64::EPSILON * (1.0 + roots.1 / (roots.1 - roots.0));
        domain.error += SAFETY * largest + rounding;
        Ok(domain)
    }

    /// The phase of a speed of the domain, in turns.
    pub(crate) fn turns(&self, speed: f64) -> Turns {
        self.turns_at(self.speeds.star.offset_of(speed))
    }

    fn turns_at(&self, delta: f64) -> Turns {
        let root = pxfm::f_cbrt(-delta);
        let (from, to) = self.roots;
        let at = ((root - from) - (to - root)) / (to - from);
        Turns { value: self.polynomial(at), error: self.error }
    }

    /// Ψ at any offset from the lowest one of the domain on to 0.
    ///
    /// Beyond the range of the series the orbit leads outwards into the domain, in some tens of hops. Hops inwards,
    /// as for [`FatouCoordinate::phase`], would have a smaller error, and take milliseconds.
    pub(crate) fn phase(&self, map: &LiftOffMap, delta: Offset) -> Result<Phase, Error> {
        let DomainSpeeds { n, star, bottom, top } = self.speeds;
        let (lowest, highest) = (star.offset_of(bottom), star.offset_of(top));
        let mut near = delta.nearest();
        if near.abs() <= self.coordinate.range() {
            return Ok(self.coordinate.phase(delta)?);
        }
        if !(near >= lowest && near < 0.0) {
            let range =
                hopper_asymptotics::Error::OutsideRange { value: near, left: lowest, right: 0.0 };
            return Err(range.into());
        }
        let (mut hops, mut error) = (0_i64, 0.0);
        while near > highest {
            let no_turn = Error::NoTurn { n, delta: near };
            let next = map.hop_near_fixed_point(n, near)?.next.ok_or(no_turn.clone())?;
            hops += 1;
            if !(next < near) || hops > MOST_HOPS as i64 {
                return Err(no_turn);
            }
            // The slope of Ψ at the end of a hop is below its mean over the hop. The error of f is 8 ulps of the
            // image; two more stand for the rounding of the sum.
            error += 10.0 * f64::EPSILON * next.abs() / (near - next);
            near = next;
        }
        let turns = self.turns_at(near);
        Ok(Phase::new(&self.whole + hops, turns.value, turns.error + error))
    }

    /// δ at −1 ≤ `at` ≤ 1.
    fn cube(&self, at: f64) -> f64 {
        let (from, to) = self.roots;
        let root = from + 0.5 * (1.0 + at) * (to - from);
        -root * root * root
    }

    /// Barycentric interpolation.
    fn polynomial(&self, at: f64) -> f64 {
        let (mut above, mut below) = (0.0, 0.0);
        for (k, value) in self.values.iter().enumerate() {
            let distance = at - node(k);
            if distance == 0.0 {
                return *value;
            }
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            let weight = sign * pxfm::f_sin(angle(k)) / distance;
            above += weight * value;
            below += weight;
        }
        above / below
    }
}

fn angle(k: usize) -> f64 {
    (2 * k + 1) as f64 * PI / (2 * NODES) as f64
}

fn node(k: usize) -> f64 {
    pxfm::f_cos(angle(k))
}

/// Phases of offsets that may lie beyond the reach of the coordinate.
struct Inner<'a> {
    fates: &'a Fates,
    n: u64,
    coordinate: &'a FatouCoordinate,
    /// δ₀: the first preimage is not lower, but for the ulps below f(δ₀).
    lowest: f64,
    /// The integer that is subtracted; `None` for that of the first phase.
    whole: Option<BigInt>,
}

impl Inner<'_> {
    /// Ψ at `delta` less the integer, and the integer.
    fn turns(&self, delta: f64) -> Result<(Turns, BigInt), Error> {
        let (mut inner, mut hops, mut error) = (delta, 0, 0.0);
        while inner.abs() > self.coordinate.reach() {
            let before = inner;
            let slope;
            (inner, slope) = self.preimage(before)?;
            hops += 1;
            if hops > MOST_HOPS || !(inner > before) {
                return Err(Error::NoTurn { n: self.n, delta });
            }
            // The mean of dΨ/dδ over a turn is 1/loss, and it grows by at most the slope of f over one turn. The
            // error of f is 8 ulps of the image, and the search adds two.
            error += 10.0 * f64::EPSILON * before.abs() * slope / (inner - before);
        }
        let phase = self.coordinate.phase(Offset::from(inner))?.plus(-(hops as i64));
        let whole = self.whole.clone().unwrap_or_else(|| phase.whole().clone());
        let apart = i64::try_from(phase.whole() - &whole)
            .map_err(|_| Error::NoTurn { n: self.n, delta })?;
        let value = apart as f64 + phase.fraction();
        Ok((Turns { value, error: phase.error() + error + f64::EPSILON }, whole))
    }

    /// The offset on the left from which a hop leads to `delta`, and the slope of f there.
    fn preimage(&self, delta: f64) -> Result<(f64, f64), Error> {
        let map = self.fates.map();
        // f(δ) < δ and f(0) = 0, and f rises between them. A part in 10⁶ is far more than the ulps below f(δ₀).
        let (mut low, mut high) = (delta.max(self.lowest * (1.0 + 1e-6)), 0.0);
        let value = |at: f64| -> Result<Option<f64>, Error> {
            Ok(map.hop_near_fixed_point(self.n, at)?.next.map(|next| next - delta))
        };
        let start = low;
        let mut last = (start, value(start)?);
        // The loss grows as |δ|^{4/3}, and a step inwards by half of it is a fair guess.
        let mut guess = start + 0.5 * last.1.map_or(-start, |difference| -difference);
        let mut slope = 1.0;
        for _ in 0..200 {
            if !(guess > low && guess < high) {
                guess = 0.5 * (low + high);
            }
            let here = value(guess)?;
            match here {
                Some(difference) if difference >= 0.0 => high = guess,
                _ => low = guess,
            }
            let (Some(now), (before_at, Some(before))) = (here, last) else {
                last = (guess, here);
                guess = 0.5 * (low + high);
                continue;
            };
            let found = (now - before) / (guess - before_at);
            // Rounding decides the quotient of two neighbours.
            if (guess - before_at).abs() > 1e-6 * guess.abs() && found.is_finite() {
                slope = found.max(1.0);
            }
            let step = now / slope;
            last = (guess, here);
            let done = step.abs() <= 2.0 * f64::EPSILON * guess.abs();
            guess -= step;
            if done || high - low <= 2.0 * f64::EPSILON * high.abs() {
                return Ok((guess, slope));
            }
        }
        Err(Error::NoTurn { n: self.n, delta })
    }
}
