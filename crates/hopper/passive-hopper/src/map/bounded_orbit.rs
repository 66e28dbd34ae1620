//! An orbit with a bound on the error of each speed, in the shortest arithmetic that suffices.
//!
//! ```text
//!   f64, sum of absolute values ──► f64, signed derivative ──► 106 … 1024 bits, from the start again
//! ```
//!
//! The orbit goes one step to the right if a hop is inconclusive, or if its bound is larger than [`COARSE`].
//!
//! The bounds in `f64` grow by a factor of some hundred in a hop. So the orbit in 106 bits is followed beside the
//! first hops in `f64`: the distance from it is the error that they really have.

use crate::error::Error;
use crate::map::extended_orbit::{Arithmetic, ExtendedOrbit, ExtendedStep};
use crate::map::hop_within::HopWithin;
use crate::map::lift_off_map::LiftOffMap;

/// A bound larger than this part of its speed moves the orbit to longer arithmetic: a table of speeds then shows
/// nine digits at least. A smaller number costs time, since a hop in 106 bits takes fifty times as long; a larger
/// one shows fewer digits.
const COARSE: f64 = 1e-9;

/// Most hops in each of [`Arithmetic::ALL`]: they take some tenths of a second. After them the orbit goes on in
/// `f64`, from the last speed and its error: one that is caught by a fixed point forgets them.
const EXTENDED_BUDGETS: [usize; 4] = [2048, 512, 128, 64];

/// The exact orbit of a speed, with a bound on the error of each speed that it shows.
///
/// ```
/// use passive_hopper::{BoundedOrbit, ExtendedStep, LiftOffMap, MassRatio};
/// let map = LiftOffMap::new(MassRatio::new(0.2)?);
/// let mut orbit = BoundedOrbit::new(&map, 5.5)?;
/// assert_eq!((orbit.speed(), orbit.error()), (5.5, 0.0));
/// assert_eq!(orbit.hop()?, ExtendedStep::LiftsOff);
/// assert!((orbit.speed() - 3.783365713345068).abs() < 1e-15 && orbit.error() < 1e-15);
/// # Ok::<(), passive_hopper::Error>(())
/// ```
#[derive(Debug)]
pub struct BoundedOrbit<'a> {
    map: &'a LiftOffMap,
    start: f64,
    hops: usize,
    speed: f64,
    error: f64,
    /// The orbit in 106 bits beside that in `f64`, as far as it goes.
    beside: Option<ExtendedOrbit>,
    /// The orbit in longer arithmetic, once `f64` does not suffice.
    extended: Option<(Arithmetic, ExtendedOrbit)>,
}

/// The speeds of an orbit from its start on, as [`BoundedOrbit::follow`] found them.
#[derive(Debug, Clone, PartialEq)]
pub struct FollowedOrbit {
    /// The lift-off speeds; the first one is the start.
    pub speeds: Vec<f64>,
    /// Bounds on the distances of the exact orbit from them.
    pub errors: Vec<f64>,
    /// How the last hop ended. After [`ExtendedStep::LiftsOff`] the orbit goes on.
    pub end: ExtendedStep,
    /// The arithmetic that the orbit needed; `None` for `f64`.
    pub arithmetic: Option<Arithmetic>,
}

impl<'a> BoundedOrbit<'a> {
    /// Follows the orbit of `alpha` under `map` for `hops` hops, or until the hopper is grounded or a hop is
    /// inconclusive.
    ///
    /// ```
    /// use passive_hopper::{BoundedOrbit, ExtendedStep, LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::new(0.2)?);
    /// let orbit = BoundedOrbit::follow(&map, 5.5, 3)?;
    /// assert_eq!((orbit.speeds.len(), orbit.errors.len()), (4, 4));
    /// assert_eq!((orbit.end, orbit.arithmetic), (ExtendedStep::LiftsOff, None));
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new) and [`hop`](Self::hop).
    pub fn follow(map: &'a LiftOffMap, alpha: f64, hops: usize) -> Result<FollowedOrbit, Error> {
        let mut orbit = Self::new(map, alpha)?;
        let (mut speeds, mut errors) = (vec![alpha], vec![0.0]);
        let mut end = ExtendedStep::LiftsOff;
        while speeds.len() <= hops {
            end = orbit.hop()?;
            if end != ExtendedStep::LiftsOff {
                break;
            }
            speeds.push(orbit.speed());
            errors.push(orbit.error());
        }
        Ok(FollowedOrbit { speeds, errors, end, arithmetic: orbit.arithmetic() })
    }

    /// The orbit that starts at exactly `alpha`, under `map`.
    ///
    /// # Errors
    /// The errors of [`LiftOffMap::check_speed`].
    pub fn new(map: &'a LiftOffMap, alpha: f64) -> Result<Self, Error> {
        map.check_speed(alpha)?;
        let beside = Some(ExtendedOrbit::new(map, alpha, Arithmetic::ALL[0])?);
        let (start, speed) = (alpha, alpha);
        Ok(BoundedOrbit { map, start, hops: 0, speed, error: 0.0, beside, extended: None })
    }

    /// The number of hops since the start.
    pub fn hops(&self) -> usize {
        self.hops
    }

    /// The lift-off speed.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Bound on the distance of the exact orbit from [`speed`](Self::speed).
    pub fn error(&self) -> f64 {
        self.error
    }

    /// The arithmetic that the orbit needs; `None` for `f64`.
    pub fn arithmetic(&self) -> Option<Arithmetic> {
        self.extended.as_ref().map(|(arithmetic, _)| *arithmetic)
    }

    /// Follows one hop. After [`ExtendedStep::Grounded`] and [`ExtendedStep::Inconclusive`] the orbit stays where
    /// it was.
    ///
    /// # Errors
    /// [`Error::SuddenLiftOffBudget`] after a million sudden lift-offs in a hop.
    pub fn hop(&mut self) -> Result<ExtendedStep, Error> {
        if self.is_in_f64() {
            match self.plain_hop() {
                HopWithin::Next { speed, error } => {
                    self.hops += 1;
                    (self.speed, self.error) = (speed, self.sharp_error(speed)?.min(error));
                    return Ok(ExtendedStep::LiftsOff);
                }
                HopWithin::Grounded => return Ok(ExtendedStep::Grounded),
                HopWithin::Inconclusive => {}
            }
        }
        let needed = self.arithmetic();
        let mut coarse = None;
        let longer = Arithmetic::ALL.into_iter().zip(EXTENDED_BUDGETS);
        for (arithmetic, most) in longer.filter(|(other, _)| needed <= Some(*other)) {
            if self.hops >= most {
                break;
            }
            let orbit = match self.extended.take() {
                Some((own, orbit)) if own == arithmetic => Some(orbit),
                _ => self.followed_again(arithmetic)?,
            };
            let Some(mut orbit) = orbit else { continue };
            match orbit.hop()? {
                ExtendedStep::LiftsOff if orbit.error() > COARSE * orbit.speed() => {
                    coarse = Some((arithmetic, orbit));
                }
                ExtendedStep::LiftsOff => return Ok(self.move_to(arithmetic, orbit)),
                ExtendedStep::Grounded => {
                    self.extended = Some((arithmetic, orbit));
                    return Ok(ExtendedStep::Grounded);
                }
                ExtendedStep::Inconclusive => {}
            }
        }
        // No arithmetic is finer within its hops.
        let known = coarse.map(|(arithmetic, orbit)| self.move_to(arithmetic, orbit));
        Ok(known.unwrap_or(ExtendedStep::Inconclusive))
    }

    /// Whether the next hop is tried in `f64`: up to the first one that needs more, and after the last that longer
    /// arithmetic has time for.
    fn is_in_f64(&self) -> bool {
        let most = |own: Arithmetic| EXTENDED_BUDGETS[own as usize];
        self.arithmetic().is_none_or(|own| self.hops >= most(own))
    }

    /// Takes the speed after one more hop from the orbit in longer arithmetic.
    fn move_to(&mut self, arithmetic: Arithmetic, orbit: ExtendedOrbit) -> ExtendedStep {
        (self.speed, self.hops) = (orbit.speed(), self.hops + 1);
        // The speed shown is rounded to `f64`.
        self.error = orbit.error() + 0.5 * f64::EPSILON * self.speed;
        (self.extended, self.beside) = (Some((arithmetic, orbit)), None);
        ExtendedStep::LiftsOff
    }

    /// The distance of `speed`, that of the last hop, from the orbit in 106 bits; infinite where that ends.
    fn sharp_error(&mut self, speed: f64) -> Result<f64, Error> {
        let within = self.beside.take().filter(|_| self.hops <= EXTENDED_BUDGETS[0]);
        let Some(mut orbit) = within else { return Ok(f64::INFINITY) };
        if orbit.hop()? != ExtendedStep::LiftsOff {
            return Ok(f64::INFINITY);
        }
        let off = orbit.minus(speed).abs();
        // The difference is rounded.
        let error = (off + orbit.error()) * (1.0 + f64::EPSILON);
        self.beside = Some(orbit);
        Ok(error)
    }

    /// The next hop in `f64`; inconclusive also if its bound is too large.
    fn plain_hop(&self) -> HopWithin {
        let fine = |hop: &HopWithin| match *hop {
            HopWithin::Next { speed, error } => error <= COARSE * speed,
            HopWithin::Grounded => true,
            HopWithin::Inconclusive => false,
        };
        let absolute = self.map.hop_within(self.speed, self.error);
        if fine(&absolute) {
            return absolute;
        }
        let signed = self.map.signed_hop_within(self.speed, self.error);
        if fine(&signed) { signed } else { HopWithin::Inconclusive }
    }

    /// The orbit from its start to here in longer arithmetic; `None` if that leaves one of these hops inconclusive.
    fn followed_again(&self, arithmetic: Arithmetic) -> Result<Option<ExtendedOrbit>, Error> {
        let mut orbit = ExtendedOrbit::new(self.map, self.start, arithmetic)?;
        for _ in 0..self.hops {
            if orbit.hop()? != ExtendedStep::LiftsOff {
                return Ok(None);
            }
        }
        Ok(Some(orbit))
    }
}
