//! The lift-off map α' = f(α; M) in its stable form.

use crate::error::Error;
use crate::kernel::scalar::hop::{Decided, Masses, hop as fast_hop};
use crate::landing::error_bound::Doubt;
use crate::landing::from_ground::Landing;
use crate::landing::from_ground::TakeOff;
use crate::landing::from_ground::{LARGEST_LIFT_OFF_SPEED, first_landing, next_landing};
use crate::map::extended_hop::{Start, WideHop, wide_hop};
use crate::map::many_at_once::images;
use crate::model::mass_ratio::MassRatio;
use crate::precision::double_double::DoubleDouble;
use crate::precision::real::Real;

/// Sudden lift-offs that one hop may have before it is given up with an error.
///
/// Theory bounds their number by ((α√M + √(α²M + 8αα*_1))/(2α*_1))²; scans find 1013 at M = 10⁴. A hop
/// that uses up the budget takes some tenths of a second.
pub const SUDDEN_LIFT_OFF_BUDGET: usize = 1_000_000;

/// Above this speed, 2²⁸, hops are computed in longer arithmetic at once: an ulp of the phase is 10⁻⁸.
pub(crate) const LARGEST_PLAIN_SPEED: f64 = 268_435_456.0;

/// The map from one gradual lift-off speed to the next, at a fixed mass ratio.
///
/// ```text
///   α'² = α² − μ Σ Γᵢ²        summed over the landings of the hop; negative: grounded
/// ```
///
/// Speeds are in units of the model's length m₂g/k times ω. While no landing is sudden, the sum has
/// one term that knows nothing of M: the invariance under M → 1/M.
///
/// ```
/// use passive_hopper::{LiftOffMap, MassRatio};
/// let map = LiftOffMap::new(MassRatio::new(0.2)?);
/// let image = map.image(5.5)?.expect("hops again");
/// assert!((image - 3.783365713345068).abs() < 1e-15);
/// // Too slow to clear the ground again at M = 1:
/// assert_eq!(LiftOffMap::new(MassRatio::ONE).image(2.0)?, None);
/// # Ok::<(), passive_hopper::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LiftOffMap {
    mass_ratio: MassRatio,
    pub(crate) masses: Masses,
}

/// All that one hop does to the lift-off speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hop {
    /// The lift-off speed it started with, α.
    pub speed: f64,
    /// The next gradual lift-off speed α'; nothing if the hopper is grounded.
    pub next: Option<f64>,
    /// α − α', without cancellation; nothing if grounded.
    pub loss: Option<f64>,
    /// α'², negative if grounded.
    pub next_speed_squared: f64,
    /// Number of sudden lift-offs on the way.
    pub sudden: usize,
    /// Total time of flight τ.
    pub flight_time: f64,
    /// Whether every verdict on the way (sudden or not, on which branch a flight lands, grounded or
    /// not) is larger than its rounding error. What 53 bits leave open is computed with 106, and then
    /// with up to 1024; false means that these do not suffice either, or would take too long.
    pub certain: bool,
}

impl LiftOffMap {
    /// The map at `mass_ratio`.
    pub fn new(mass_ratio: MassRatio) -> Self {
        let masses = Masses { mu: mass_ratio.mu(), kappa: mass_ratio.kappa() };
        LiftOffMap { mass_ratio, masses }
    }

    /// The mass ratio M.
    pub fn mass_ratio(&self) -> MassRatio {
        self.mass_ratio
    }

    /// f(α): the next lift-off speed, or nothing if the hopper is grounded.
    ///
    /// # Errors
    /// As [`hop`](Self::hop), and [`Error::Undecided`] for a hop that is not
    /// [certain](Hop::certain).
    #[inline]
    pub fn image(&self, alpha: f64) -> Result<Option<f64>, Error> {
        match fast_hop(alpha, self.masses) {
            Some(decided) => Ok(decided.next()),
            None => self.careful_image(alpha),
        }
    }

    /// What the fast path leaves open.
    #[cold]
    pub(crate) fn careful_image(&self, alpha: f64) -> Result<Option<f64>, Error> {
        let (hop, _) = self.decide(alpha, |_| ())?;
        if !hop.certain {
            return Err(Error::Undecided { alpha, sudden: hop.sudden });
        }
        Ok(hop.next)
    }

    /// f of all `speeds` at once, each replaced by its image, with the bits of [`image`](Self::image);
    /// nothing, for a grounded hopper, stays nothing.
    ///
    /// Many times faster than one after the other: flights of different hops share the lanes of a
    /// vector unit, AVX-512, AVX2 or whatever the processor has.
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::new(0.2)?);
    /// let mut speeds = [Some(5.5), Some(7.0), None];
    /// map.images(&mut speeds)?;
    /// assert_eq!(speeds, [map.image(5.5)?, map.image(7.0)?, None]);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// The first of those that [`image`](Self::image) gives. All others are replaced all the same; those
    /// with an error keep their speeds.
    pub fn images(&self, speeds: &mut [Option<f64>]) -> Result<(), Error> {
        images(speeds, |_| *self, |&speed| speed, |speed| speed)
    }

    /// The images of speeds each under a map of its own, as [`images`](Self::images) gives them for one map: for
    /// work over many mass ratios with few speeds each.
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let [light, heavy] = [0.2, 0.8].map(|m| MassRatio::new(m).map(LiftOffMap::new));
    /// let (light, heavy) = (light?, heavy?);
    /// let mut hops = [(&light, Some(5.5)), (&heavy, Some(5.5)), (&heavy, None)];
    /// LiftOffMap::images_of_pairs(&mut hops)?;
    /// assert_eq!(hops.map(|hop| hop.1), [light.image(5.5)?, heavy.image(5.5)?, None]);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`images`](Self::images).
    pub fn images_of_pairs(hops: &mut [(&LiftOffMap, Option<f64>)]) -> Result<(), Error> {
        images(hops, |hop| *hop.0, |hop| hop.1, |hop| &mut hop.1)
    }

    /// The hop that starts with speed `alpha`.
    ///
    /// # Errors
    /// [`Error::LiftOffSpeed`] unless `alpha` is positive and finite,
    /// [`Error::LiftOffSpeedTooLarge`] above 2⁴³, [`Error::SuddenLiftOffBudget`] after a million
    /// sudden lift-offs.
    pub fn hop(&self, alpha: f64) -> Result<Hop, Error> {
        match fast_hop(alpha, self.masses) {
            Some(decided) => Ok(decided.hop(alpha)),
            None => self.decide(alpha, |_| ()).map(|(hop, _)| hop),
        }
    }

    /// The hop with its landings, in the arithmetic that decided it.
    pub(crate) fn path(&self, alpha: f64) -> Result<(Hop, Vec<Landing>), Error> {
        let mut plain = Vec::new();
        let (hop, longer) = self.decide(alpha, |landing| plain.push(*landing))?;
        Ok((hop, longer.unwrap_or(plain)))
    }

    /// The hop, with the landings of the longer arithmetic if that was needed; `see` sees those in plain
    /// `f64`.
    fn decide(
        &self,
        alpha: f64,
        see: impl FnMut(&Landing),
    ) -> Result<(Hop, Option<Vec<Landing>>), Error> {
        check_speed(alpha)?;
        if alpha <= LARGEST_PLAIN_SPEED {
            let hop = self.plain_hop(alpha, see)?;
            if hop.certain || hop.sudden > DoubleDouble::SUDDEN_BUDGET {
                return Ok((hop, None));
            }
        }
        let hop = wide_hop(Start::Speed(alpha), self.mass_ratio)?;
        Ok((self.rounded(alpha, &hop), Some(hop.landings)))
    }

    /// The hop in plain `f64`, certain or not.
    fn plain_hop(&self, alpha: f64, mut see: impl FnMut(&Landing)) -> Result<Hop, Error> {
        let landings = self.landings(alpha)?;
        let (mut shares, mut sudden, mut flight_time) = (0.0, 0, 0.0);
        let mut doubt = Doubt::plain(alpha);
        for landing in landings {
            let landing = landing?;
            let ratio = landing.closing_speed / alpha;
            shares += ratio * ratio;
            sudden += usize::from(landing.sudden);
            flight_time += landing.time;
            doubt.pass(&landing, self.masses.kappa);
            see(&landing);
        }
        let t = self.masses.mu * shares;
        let certain = !doubt.is_real(1.0 - t, self.masses.mu, alpha);
        // t = 1 − α'²/α²; the loss α t/(1 + √(1−t)) keeps its digits when t is small.
        let loss = (t < 1.0).then(|| alpha * t / (1.0 + (1.0 - t).sqrt()));
        let next = loss.map(|loss| if t < 0.5 { alpha - loss } else { alpha * (1.0 - t).sqrt() });
        let next_speed_squared = alpha * alpha * (1.0 - t);
        Ok(Hop { speed: alpha, next, loss, next_speed_squared, sudden, flight_time, certain })
    }

    fn rounded(&self, alpha: f64, hop: &WideHop) -> Hop {
        Hop {
            speed: alpha,
            next: hop.next.as_ref().map(|next| next.speed),
            loss: hop.next.as_ref().map(|next| next.loss),
            next_speed_squared: hop.next_speed_squared,
            sudden: hop.landings.len() - 1,
            flight_time: hop.landings.iter().map(|landing| landing.time).sum(),
            certain: hop.certain,
        }
    }

    /// The landings of the hop that starts with speed `alpha`, one after the other, in plain `f64`: of a
    /// hop that is decided in longer arithmetic the later ones may be others.
    ///
    /// # Errors
    /// As [`hop`](Self::hop), the budget's from the iterator.
    pub fn landings(&self, alpha: f64) -> Result<Landings, Error> {
        check_speed(alpha)?;
        let start = TakeOff { excess: 0.0, velocity: alpha };
        Ok(Landings { kappa: self.masses.kappa, start: Some(start), flights: 0 })
    }
}

impl Decided {
    /// α′, or nothing if the hopper is grounded.
    #[inline(always)]
    pub(crate) fn next(&self) -> Option<f64> {
        (self.next_speed_squared > 0.0).then(|| self.next_speed_squared.sqrt())
    }

    fn hop(&self, alpha: f64) -> Hop {
        let next = self.next();
        Hop {
            speed: alpha,
            next,
            loss: next.map(|next| self.taken / (alpha + next)),
            next_speed_squared: self.next_speed_squared,
            sudden: self.sum.flights as usize - 1,
            flight_time: 2.0 * self.sum.half_time,
            certain: true,
        }
    }
}

fn check_speed(alpha: f64) -> Result<(), Error> {
    if !(alpha > 0.0) || !alpha.is_finite() {
        return Err(Error::LiftOffSpeed { value: alpha });
    }
    if alpha > LARGEST_LIFT_OFF_SPEED {
        return Err(Error::LiftOffSpeedTooLarge { value: alpha, largest: LARGEST_LIFT_OFF_SPEED });
    }
    Ok(())
}

/// The landings between two gradual lift-offs; see [`LiftOffMap::landings`].
#[derive(Debug, Clone)]
pub struct Landings {
    kappa: f64,
    start: Option<TakeOff>,
    flights: usize,
}

impl Iterator for Landings {
    type Item = Result<Landing, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let start = self.start?;
        if self.flights > SUDDEN_LIFT_OFF_BUDGET {
            self.start = None;
            let TakeOff { excess, velocity } = start;
            let sudden = self.flights - 1;
            return Some(Err(Error::SuddenLiftOffBudget { sudden, excess, velocity }));
        }
        let landing = if self.flights == 0 {
            first_landing(start.velocity, self.kappa)
        } else {
            next_landing(start, self.kappa)
        };
        self.flights += 1;
        // A sudden landing whose excess rounds to zero or below is followed by a flight too short
        // to see, which loses nothing.
        let again = landing.sudden && landing.excess > 0.0;
        self.start =
            again.then_some(TakeOff { excess: landing.excess, velocity: landing.velocity });
        Some(Ok(landing))
    }
}
