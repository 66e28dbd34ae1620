//! An orbit in 106 to 1024 bits, with a bound on its error.
//!
//! The speed is not rounded to `f64` between hops. The error of a hop has two parts: the rounding errors of the
//! hop, and the error of its start, which the hop propagates by its slope (`speed_error.rs`).

use crate::error::Error;
use crate::kernel::scalar::bounded_next::ROUND_UP;
use crate::kernel::scalar::hop::MassFactors;
use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::map::extended_hop::{ExtendedMasses, StartIn};
use crate::map::lift_off_map::{LiftOffMap, check_speed};
use crate::map::speed_error::{Changes, SquareTangent, change_of_square, tangent_of_square};
use crate::model::fixed_points::{alpha_star, fixed_point_in, n_pi};
use crate::precision::double_double::DoubleDouble;
use crate::precision::long::Long;
use crate::precision::real::Extended;
use std::cmp::Ordering;
use std::fmt::Debug;

/// The arithmetics of an [`ExtendedOrbit`], from short to long.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Arithmetic {
    /// 106 bits.
    Bits106,
    /// 256 bits.
    Bits256,
    /// 512 bits.
    Bits512,
    /// 1024 bits.
    Bits1024,
}

impl Arithmetic {
    /// All arithmetics, from short to long.
    pub const ALL: [Arithmetic; 4] =
        [Arithmetic::Bits106, Arithmetic::Bits256, Arithmetic::Bits512, Arithmetic::Bits1024];
}

/// The result of one hop of an [`ExtendedOrbit`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExtendedStep {
    /// The hopper lifts off again; the orbit is at its next speed.
    LiftsOff,
    /// The hopper is grounded; the orbit stays where it was.
    Grounded,
    /// The arithmetic does not decide the hop, or its budget of sudden lift-offs is used up; the orbit stays where
    /// it was.
    Inconclusive,
}

/// The orbit of a speed in 106 to 1024 bits, with a bound on its error.
///
/// ```
/// use passive_hopper::{Arithmetic, ExtendedOrbit, ExtendedStep, LiftOffMap, MassRatio};
/// let map = LiftOffMap::new(MassRatio::new(0.2)?);
/// let mut orbit = ExtendedOrbit::new(&map, 5.5, Arithmetic::Bits106)?;
/// assert_eq!(orbit.hop()?, ExtendedStep::LiftsOff);
/// assert!((orbit.speed() - 3.783365713345068).abs() < 1e-15 && orbit.error() < 1e-26);
/// # Ok::<(), passive_hopper::Error>(())
/// ```
#[derive(Debug)]
pub struct ExtendedOrbit(Box<dyn Orbit>);

impl ExtendedOrbit {
    /// The orbit that starts at exactly `alpha`, under `map`.
    ///
    /// # Errors
    /// The errors of [`LiftOffMap::hop`] for a wrong speed.
    pub fn new(map: &LiftOffMap, alpha: f64, arithmetic: Arithmetic) -> Result<Self, Error> {
        check_speed(alpha)?;
        Ok(ExtendedOrbit(match arithmetic {
            Arithmetic::Bits106 => Box::new(OrbitIn::<DoubleDouble>::new(map, alpha)),
            Arithmetic::Bits256 => Box::new(OrbitIn::<Long<4>>::new(map, alpha)),
            Arithmetic::Bits512 => Box::new(OrbitIn::<Long<8>>::new(map, alpha)),
            Arithmetic::Bits1024 => Box::new(OrbitIn::<Long<16>>::new(map, alpha)),
        }))
    }

    /// Follows one hop.
    ///
    /// # Errors
    /// [`Error::SuddenLiftOffBudget`] after a million sudden lift-offs.
    pub fn hop(&mut self) -> Result<ExtendedStep, Error> {
        self.0.hop()
    }

    /// The speed, rounded to `f64`.
    pub fn speed(&self) -> f64 {
        self.0.speed()
    }

    /// Bound on the distance of the exact orbit from the speed, which has more bits than an `f64`.
    pub fn error(&self) -> f64 {
        self.0.error()
    }

    /// The speed minus `other`, rounded to `f64`. With `other` next to the speed this shows its further digits.
    pub fn minus(&self, other: f64) -> f64 {
        self.0.minus(other)
    }

    /// Whether the speed is below or above nπ; `None` if its error does not tell.
    pub fn compare_with_multiple_of_pi(&self, n: u64) -> Option<Ordering> {
        let exact = n_pi(n);
        let difference = self.minus(exact.high) - exact.low;
        let rounding = BITS_OF_N_PI * self.speed() + f64::EPSILON * difference.abs();
        (difference.abs() > self.error() + rounding).then(|| difference.total_cmp(&0.0))
    }

    /// The speed minus α*_n, and a bound on the error of this difference.
    pub fn offset_from(&self, n: u64) -> (f64, f64) {
        self.0.offset_from(n)
    }

    /// The speed minus α*_n as the sum of two `f64`, and a bound on the error of this sum. The first is the nearest
    /// `f64`.
    pub fn long_offset_from(&self, n: u64) -> (f64, f64, f64) {
        self.0.long_offset_from(n)
    }

    /// Follows all starts within `radius` of the start with this orbit, by its [`tangent`](Self::tangent), at all
    /// mass ratios whose κ = M/(1+M) lies within `kappa_radius` of its own. A hop is then inconclusive unless it is
    /// of one kind for all of them. Call it before the first hop.
    pub fn with_radii(mut self, radius: f64, kappa_radius: f64) -> Self {
        self.0.set_radii(radius, kappa_radius);
        self
    }

    /// How the orbits of near starts and mass ratios differ from this one; `None` without [radii](Self::with_radii).
    pub fn tangent(&self) -> Option<OrbitTangent> {
        self.0.tangent()
    }

    /// Moves the orbit to α*_n + `delta`, which is known to within `error`: the end of hops that were not followed
    /// one by one. Nothing of the speed before is kept.
    ///
    /// # Errors
    /// The errors of [`LiftOffMap::hop`] for the new speed; a wrong `error` makes the next hop inconclusive.
    pub fn move_to(&mut self, n: u64, delta: f64, error: f64) -> Result<(), Error> {
        check_speed(alpha_star(n) + delta)?;
        self.0.move_to(n, delta, error);
        Ok(())
    }
}

/// How an orbit x moves with the offset y of its start and the offset k of κ = M/(1+M):
///
/// ```text
///   |x(y, k) − x(0, 0) − slope y − kappa_slope k| ≤ rounding s + second s²      s = max(|y|/radius, |k|/kappa_radius) ≤ 1
/// ```
///
/// The bounds are those of docs/theory.md, Lemma 78: the second order is an estimate, which is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitTangent {
    /// ∂x/∂y.
    pub slope: f64,
    /// ∂x/∂k.
    pub kappa_slope: f64,
    /// Bound on the errors of the slopes, times the radii.
    pub rounding: f64,
    /// Bound on the second order.
    pub second: f64,
    /// The largest |y|.
    pub radius: f64,
    /// The largest |k|.
    pub kappa_radius: f64,
}

impl OrbitTangent {
    fn start(radius: f64, kappa_radius: f64) -> Self {
        OrbitTangent {
            slope: 1.0,
            kappa_slope: 0.0,
            rounding: 0.0,
            second: 0.0,
            radius,
            kappa_radius,
        }
    }

    /// Bound on the part of the slopes.
    pub fn first_order(&self) -> f64 {
        (self.slope * self.radius).abs() + (self.kappa_slope * self.kappa_radius).abs()
    }

    /// Bound on |x(y, k) − x(0, 0)|.
    pub fn reach(&self) -> f64 {
        self.first_order() + self.rounding + self.second
    }

    /// The tangent after a hop to `next` = √F with the tangent of F, whose argument moves by at most the reach.
    fn after(&self, square: &SquareTangent, next: f64) -> Self {
        // √(F + D) = √F + D/(2√F) − D²/(2√F (√F + √(F + D))²), and the last root is at least √(F − change).
        let twice = 2.0 * next;
        let largest = square.change();
        let least = next + (next * next - largest).max(0.0).sqrt();
        let bend = (square.second + largest * largest / (least * least)) / twice;
        let by_speed = square.by_speed / twice;
        let (slope, by_kappa) = (by_speed * self.slope, by_speed * self.kappa_slope);
        let kappa_slope = by_kappa + square.by_kappa / twice;
        // Three roundings of each slope, and the rounding of these bounds.
        let sizes = (slope * self.radius).abs()
            + (by_kappa.abs() + (square.by_kappa / twice).abs()) * self.kappa_radius;
        let rounding = square.rounding / twice + by_speed.abs() * self.rounding;
        OrbitTangent {
            slope,
            kappa_slope,
            rounding: ROUND_UP * (rounding + 3.0 * f64::EPSILON * sizes),
            second: ROUND_UP * (bend + by_speed.abs() * self.second),
            ..*self
        }
    }
}

/// An orbit in one of the arithmetics.
trait Orbit: Debug + Send {
    fn hop(&mut self) -> Result<ExtendedStep, Error>;
    fn speed(&self) -> f64;
    fn error(&self) -> f64;
    fn minus(&self, other: f64) -> f64;
    fn offset_from(&self, n: u64) -> (f64, f64);
    fn long_offset_from(&self, n: u64) -> (f64, f64, f64);
    fn set_radii(&mut self, radius: f64, kappa_radius: f64);
    fn tangent(&self) -> Option<OrbitTangent>;
    fn move_to(&mut self, n: u64, delta: f64, error: f64);
}

#[derive(Debug)]
struct OrbitIn<R> {
    speed: R,
    error: f64,
    tangent: Option<OrbitTangent>,
    masses: ExtendedMasses<R>,
    factors: MassFactors,
}

impl<R: Extended> OrbitIn<R> {
    fn new(map: &LiftOffMap, alpha: f64) -> Self {
        let masses = ExtendedMasses::new(map.mass_ratio());
        OrbitIn { speed: R::from(alpha), error: 0.0, tangent: None, masses, factors: map.factors }
    }
}

/// Distance of a speed from nπ, relative to the speed, within which its side counts as undecided.
///
/// The stored nπ errs by at most 2⁻¹⁰⁵ = 2.5·10⁻³² of itself (docs/theory.md, Lemma 65). 10⁻²⁹ is 400 times as
/// much. All arithmetics use the same nπ. A larger value leaves more orbits undecided, those that come so near to
/// an nπ.
const BITS_OF_N_PI: f64 = 1e-29;

impl<R: Extended + Send> Orbit for OrbitIn<R> {
    fn hop(&mut self) -> Result<ExtendedStep, Error> {
        let speed = self.speed.nearest();
        // The start of the orbit is exact, and the solver decides its first landing on the bits of α*_n and nπ.
        let reach =
            |tangent: OrbitTangent| Changes { speed: tangent.reach(), kappa: tangent.kappa_radius };
        let beside = self.tangent.map_or(Changes::of_speed(0.0), reach);
        let within = Changes { speed: self.error + beside.speed, ..beside };
        if within.speed > 0.0 && !on_one_side_in(self.speed, within.speed) {
            return Ok(ExtendedStep::Inconclusive);
        }
        let start = StartIn::at_speed(self.speed, self.masses);
        let Some(hop) = start.hop(within, self.masses, |_, _| ())? else {
            return Ok(ExtendedStep::Inconclusive);
        };
        let own = Changes::of_speed(self.error);
        let change = change_of_square(speed, own, &hop.landings, self.factors);
        let (true, Some(change)) = (hop.decided, change) else {
            return Ok(ExtendedStep::Inconclusive);
        };
        let square = hop.next_speed_squared.nearest();
        let error = speed * speed * hop.ratio_error + change;
        if !(square.abs() > error) {
            return Ok(ExtendedStep::Inconclusive);
        }
        if square < 0.0 {
            return Ok(ExtendedStep::Grounded);
        }
        let next = hop.next_speed_squared.sqrt();
        if let Some(tangent) = &mut self.tangent {
            let Some(of_square) = tangent_of_square(speed, within, &hop.landings, self.factors)
            else {
                return Ok(ExtendedStep::Inconclusive);
            };
            if !(square > of_square.change() + error) {
                return Ok(ExtendedStep::Inconclusive);
            }
            *tangent = tangent.after(&of_square, next.nearest());
        }
        // As in `BoundedSquare::next`.
        let least = (square - error).max(0.0).sqrt();
        self.error = ROUND_UP * (error / (next.nearest() + least)) + R::EPSILON * next.nearest();
        self.speed = next;
        Ok(ExtendedStep::LiftsOff)
    }

    fn speed(&self) -> f64 {
        self.speed.nearest()
    }

    fn error(&self) -> f64 {
        self.error
    }

    fn minus(&self, other: f64) -> f64 {
        (self.speed - R::from(other)).nearest()
    }

    fn offset_from(&self, n: u64) -> (f64, f64) {
        let (offset, rest, error) = self.long_offset_from(n);
        (offset, error + rest.abs())
    }

    fn long_offset_from(&self, n: u64) -> (f64, f64, f64) {
        let star = if n == 0 { R::from(0.0) } else { fixed_point_in::<R>(n) };
        let offset = self.speed - star;
        let nearest = offset.nearest();
        let rest = (offset - R::from(nearest)).nearest();
        // The roundings of α*_n, of the differences, and of the rest.
        let rounding = 2.0 * R::EPSILON * self.speed.nearest() + f64::EPSILON * rest.abs();
        (nearest, rest, self.error + rounding)
    }

    fn set_radii(&mut self, radius: f64, kappa_radius: f64) {
        self.tangent = Some(OrbitTangent::start(radius, kappa_radius));
    }

    fn tangent(&self) -> Option<OrbitTangent> {
        self.tangent
    }

    fn move_to(&mut self, n: u64, delta: f64, error: f64) {
        self.speed = fixed_point_in::<R>(n) + delta;
        self.error = error + 2.0 * R::EPSILON * self.speed.nearest();
    }
}

/// As [`on_one_side`](crate::map::hop_within::on_one_side), for a speed with more bits.
fn on_one_side_in<R: Extended>(speed: R, error: f64) -> bool {
    let nearest = speed.nearest();
    let n = FixedPointInterval::of(nearest).n;
    let least = 2.0 * error + BITS_OF_N_PI * nearest;
    let away = |from: DoubleDouble| {
        let from = R::from(from.high) + from.low;
        (speed - from).nearest().abs() > least
    };
    let away_from_star = || {
        let least = 2.0 * error + R::EPSILON * nearest;
        (speed - fixed_point_in::<R>(n)).nearest().abs() > least
    };
    (n == 0 || (away(n_pi(n)) && away_from_star())) && away(n_pi(n + 1))
}
