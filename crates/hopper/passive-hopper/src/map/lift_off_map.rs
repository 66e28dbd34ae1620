//! The lift-off map α' = f(α; M) in its stable form.
//!
//! A hop is computed by the first of these methods whose decisions are all conclusive: the kernel; landing by landing
//! in `f64`, with an error bound; landing by landing in longer arithmetic.
//!
//! Proof: docs/theory.md, Theorem 4; the invariance under M → 1/M: docs/theory.md, Corollary 10.

use crate::error::Error;
use crate::kernel::scalar::hop::{DecidedHop, MassFactors, kernel_hop};
use crate::landing::error_bound::ErrorBound;
use crate::landing::flight_ends::Landing;
use crate::map::extended_hop::{ExtendedHop, HopStart, extended_hop};
use crate::map::limits::LARGEST_PLAIN_SPEED;
use crate::map::plain_landings::PlainLandings;
use crate::model::mass_ratio::MassRatio;
use crate::model::motion::LARGEST_LIFT_OFF_SPEED;
use crate::precision::double_double::DoubleDouble;
use crate::precision::real::Extended;

/// The map from one gradual lift-off speed to the next, at a fixed mass ratio.
///
/// ```text
///   α'² = α² − μ Σ Γᵢ²        summed over the landings of the hop; negative: grounded
/// ```
///
/// Speeds are in units of the model's length m₂g/k times ω. If no landing is sudden, the sum has one term, which does
/// not depend on M. As μ is the same for M and 1/M, f is then the same for both mass ratios.
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
    pub(crate) factors: MassFactors,
}

/// One hop, with every decision larger than its error: the change of the lift-off speed, the number of sudden
/// lift-offs, and the time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hop {
    /// The lift-off speed α at the start of the hop.
    pub speed: f64,
    /// The next gradual lift-off speed α'; `None` if the hopper is grounded.
    pub next: Option<f64>,
    /// α − α', without cancellation; `None` if the hopper is grounded.
    pub loss: Option<f64>,
    /// α'², negative if grounded.
    pub next_speed_squared: f64,
    /// Number of sudden lift-offs.
    pub sudden: usize,
    /// Total time of flight τ.
    pub flight_time: f64,
}

impl Hop {
    /// The energy that the landings of the hop take, ½(1+M)(α² − α′²) in units of m₁m₂g²/k.
    ///
    /// Gradual lift-offs differ in the energy ½(1+M)α² alone. If the hopper is grounded, α′² is negative, and the
    /// result is the loss up to the last landing.
    pub fn energy_loss(&self, mass_ratio: MassRatio) -> f64 {
        let of_square = match (self.loss, self.next) {
            // α² − α′² = (α − α′)(α + α′), which does not cancel.
            (Some(loss), Some(next)) => loss * (self.speed + next),
            _ => self.speed * self.speed - self.next_speed_squared,
        };
        0.5 * (1.0 + mass_ratio.value()) * of_square
    }
}

impl LiftOffMap {
    /// The map at `mass_ratio`.
    pub fn new(mass_ratio: MassRatio) -> Self {
        let factors = MassFactors { mu: mass_ratio.mu(), kappa: mass_ratio.kappa() };
        LiftOffMap { mass_ratio, factors }
    }

    /// The mass ratio M.
    pub fn mass_ratio(&self) -> MassRatio {
        self.mass_ratio
    }

    /// Whether the map accepts the lift-off speed `alpha`.
    ///
    /// # Errors
    /// [`Error::LiftOffSpeed`] unless `alpha` is positive and finite, [`Error::LiftOffSpeedTooLarge`] above 2⁴³.
    pub fn check_speed(&self, alpha: f64) -> Result<(), Error> {
        check_speed(alpha)
    }

    /// f(α): the next lift-off speed, or `None` if the hopper is grounded.
    ///
    /// # Errors
    /// The errors of [`hop`](Self::hop).
    #[inline]
    pub fn image(&self, alpha: f64) -> Result<Option<f64>, Error> {
        match kernel_hop(alpha, self.factors) {
            Some(decided) => Ok(decided.next()),
            None => self.careful_image(alpha),
        }
    }

    /// The image for a speed that the kernel leaves undecided. An invalid speed gives its error.
    #[cold]
    pub(crate) fn careful_image(&self, alpha: f64) -> Result<Option<f64>, Error> {
        self.decide(alpha, |_| ()).map(|(hop, _)| hop.next)
    }

    /// The hop that starts with speed `alpha`.
    ///
    /// # Errors
    /// The errors of [`check_speed`](Self::check_speed); [`Error::Undecided`] if a decision of the hop is not
    /// larger than its error in 1024 bits, or would take too long; [`Error::SuddenLiftOffBudget`] after a million
    /// sudden lift-offs.
    pub fn hop(&self, alpha: f64) -> Result<Hop, Error> {
        match kernel_hop(alpha, self.factors) {
            Some(decided) => Ok(decided.hop(alpha)),
            None => self.decide(alpha, |_| ()).map(|(hop, _)| hop),
        }
    }

    /// The landings of the hop that starts with speed `alpha`, in their order: one more than its sudden lift-offs.
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
    /// let map = LiftOffMap::new(MassRatio::ONE);
    /// let landings = map.landings(alpha_star(1) - 0.1)?;
    /// assert!(landings.len() == 2 && landings[0].sudden && !landings[1].sudden);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`hop`](Self::hop).
    pub fn landings(&self, alpha: f64) -> Result<Vec<Landing>, Error> {
        self.path(alpha).map(|(_, landings)| landings)
    }

    /// The hop computed landing by landing, with its landings in the arithmetic that decided the hop.
    pub(crate) fn path(&self, alpha: f64) -> Result<(Hop, Vec<Landing>), Error> {
        let mut plain = Vec::new();
        let (hop, longer) = self.decide(alpha, |landing| plain.push(*landing))?;
        Ok((hop, longer.unwrap_or(plain)))
    }

    /// The hop computed landing by landing, and its landings in longer arithmetic if that was needed. `see` receives
    /// the landings in plain `f64`.
    fn decide(
        &self,
        alpha: f64,
        mut see: impl FnMut(&Landing),
    ) -> Result<(Hop, Option<Vec<Landing>>), Error> {
        check_speed(alpha)?;
        if alpha <= LARGEST_PLAIN_SPEED {
            let (hop, certain) = self.plain_hop(alpha, |landing, _| see(landing))?;
            if certain {
                return Ok((hop, None));
            }
            // Longer arithmetic does not allow so many sudden lift-offs.
            if hop.sudden > DoubleDouble::SUDDEN_BUDGET {
                return Err(Error::Undecided { alpha, sudden: hop.sudden });
            }
        }
        let hop = extended_hop(HopStart::Speed(alpha), self.mass_ratio)?;
        if !hop.certain {
            return Err(Error::Undecided { alpha, sudden: hop.landings.len() - 1 });
        }
        Ok((self.rounded(alpha, &hop), Some(hop.landings)))
    }

    /// The hop in plain `f64`, and whether every decision is larger than its error. `see` receives each landing,
    /// with the bounds after it.
    pub(crate) fn plain_hop(
        &self,
        alpha: f64,
        mut see: impl FnMut(&Landing, &ErrorBound),
    ) -> Result<(Hop, bool), Error> {
        let landings = PlainLandings::new(alpha, self.factors.kappa);
        // Σ (Γ/α)²: of ratios, so that no square underflows for tiny α.
        let (mut ratios_squared, mut sudden, mut flight_time) = (0.0, 0, 0.0);
        let mut error_bound = ErrorBound::of_f64(alpha);
        for landing in landings {
            let landing = landing?;
            let ratio = landing.closing_speed / alpha;
            ratios_squared += ratio * ratio;
            sudden += usize::from(landing.sudden);
            flight_time += landing.time;
            error_bound.add_flight(&landing, self.factors.kappa);
            see(&landing, &error_bound);
        }
        let t = self.factors.mu * ratios_squared;
        let certain = !error_bound.inconclusive(1.0 - t, self.factors.mu, alpha);
        // t = 1 − α'²/α². The loss α t/(1 + √(1−t)) keeps its digits for small t, and α' = α − loss then has only
        // one rounding. For t ≥ ½ the difference would cancel: there the root is better.
        let loss = (t < 1.0).then(|| alpha * t / (1.0 + (1.0 - t).sqrt()));
        let next = loss.map(|loss| if t < 0.5 { alpha - loss } else { alpha * (1.0 - t).sqrt() });
        let next_speed_squared = alpha * alpha * (1.0 - t);
        Ok((Hop { speed: alpha, next, loss, next_speed_squared, sudden, flight_time }, certain))
    }

    /// The hop of the map, from the hop in longer arithmetic.
    pub(crate) fn rounded(&self, alpha: f64, hop: &ExtendedHop) -> Hop {
        Hop {
            speed: alpha,
            next: hop.next.as_ref().map(|next| next.speed),
            loss: hop.next.as_ref().map(|next| next.loss),
            next_speed_squared: hop.next_speed_squared,
            sudden: hop.landings.len() - 1,
            flight_time: hop.landings.iter().map(|landing| landing.time).sum(),
        }
    }
}

impl DecidedHop {
    pub(crate) fn hop(&self, alpha: f64) -> Hop {
        let next = self.next();
        Hop {
            speed: alpha,
            next,
            // α − α′ = (α² − α′²)/(α + α′), which does not cancel.
            loss: next.map(|next| self.loss_of_square / (alpha + next)),
            next_speed_squared: self.next_speed_squared,
            sudden: self.sums.flights as usize - 1,
            flight_time: 2.0 * self.sums.half_time,
        }
    }
}

/// See [`LiftOffMap::check_speed`].
pub(crate) fn check_speed(alpha: f64) -> Result<(), Error> {
    if !(alpha > 0.0) || !alpha.is_finite() {
        return Err(Error::LiftOffSpeed { value: alpha });
    }
    if alpha > LARGEST_LIFT_OFF_SPEED {
        return Err(Error::LiftOffSpeedTooLarge { value: alpha, largest: LARGEST_LIFT_OFF_SPEED });
    }
    Ok(())
}
