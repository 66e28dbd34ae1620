//! A hop in `f64` from a speed that is known to within an error, with a bound on the error of the next speed.
//!
//! The kernel's bound is tried first. It adds absolute values, and costs little more than the hop. The bound of
//! `speed_error.rs` has the signs of the true derivative, and takes three times as many instructions.

use crate::kernel::scalar::bounded_next::{BoundedNext, BoundedSquare};
use crate::kernel::scalar::ground_state::GroundState;
use crate::kernel::scalar::half_angle::HalfAngle;
use crate::kernel::scalar::hop::{MassFactors, watched_kernel_hop};
use crate::kernel::scalar::hop_from_interval::kernel_hop_within;
use crate::landing::error_bound::ErrorBound;
use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::landing::flight_derivative::FlightDerivative;
use crate::landing::flight_ends::{Landing, TakeOff};
use crate::map::lift_off_map::{LiftOffMap, check_speed};
use crate::map::limits::LARGEST_PLAIN_SPEED;
use crate::map::plain_landings::PlainLandings;
use crate::map::speed_error::{Changes, TangentSums};
use crate::model::fixed_points::{alpha_star, n_pi};
use crate::model::mass_ratio::MassRatio;
use std::f64::consts::PI;

/// The hop of every speed within an error of a given speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HopWithin {
    /// All these speeds hop again, and their next speeds lie within `error` of `speed`.
    Next {
        /// The computed α′.
        speed: f64,
        /// Bound on the distance of the exact α′ from `speed`.
        error: f64,
    },
    /// The hopper is grounded from all these speeds.
    Grounded,
    /// `f64` does not decide the hop of all these speeds alike, or gives no bound.
    Inconclusive,
}

impl HopWithin {
    /// From the kernel's α′; `None` if the kernel has none.
    #[inline(always)]
    pub(crate) fn from_kernel(BoundedNext { speed, error }: BoundedNext) -> Option<Self> {
        if speed > 0.0 {
            Some(HopWithin::Next { speed, error })
        } else if speed <= BoundedNext::INCONCLUSIVE {
            Some(HopWithin::Inconclusive)
        } else {
            (speed <= BoundedNext::GROUNDED).then_some(HopWithin::Grounded)
        }
    }
}

impl LiftOffMap {
    /// The hop of all speeds within `error` of `alpha`, in `f64`. With `error` = 0 it is the hop of `alpha` alone.
    ///
    /// ```
    /// use passive_hopper::{HopWithin, LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::new(0.2)?);
    /// let HopWithin::Next { speed, error } = map.hop_within(5.5, 1e-12) else { panic!() };
    /// assert!(error > 1e-13 && error < 1e-11);
    /// assert!((speed - map.image(5.5)?.unwrap()).abs() <= error);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// A wrong speed gives [`HopWithin::Inconclusive`].
    pub fn hop_within(&self, alpha: f64, error: f64) -> HopWithin {
        kernel_hop_within(alpha, error, self.factors)
            .and_then(|found| HopWithin::from_kernel(found.next()))
            .unwrap_or_else(|| self.signed_hop_within(alpha, error))
    }

    /// As [`hop_within`](Self::hop_within), with the signs of the derivative: the error hardly grows where the
    /// map's slope is near 1. It takes about a third of a microsecond.
    pub fn signed_hop_within(&self, alpha: f64, error: f64) -> HopWithin {
        self.signed_square_within(alpha, Changes::of_speed(error))
            .and_then(|found| HopWithin::from_kernel(found.next()))
            .unwrap_or(HopWithin::Inconclusive)
    }

    /// As [`signed_hop_within`](Self::signed_hop_within), for all mass ratios from `first` to `last` as well, which
    /// contain that of the map.
    ///
    /// ```
    /// use passive_hopper::{HopWithin, LiftOffMap, MassRatio};
    /// let [first, middle, last] = [0.1999, 0.2, 0.2001].map(|m| MassRatio::new(m).unwrap());
    /// let map = LiftOffMap::new(middle);
    /// let HopWithin::Next { speed, error } = map.hop_within_masses(5.5, 1e-6, (first, last)) else { panic!() };
    /// for ratio in [first, last] {
    ///     let next = LiftOffMap::new(ratio).image(5.5 + 1e-6)?.unwrap();
    ///     assert!((next - speed).abs() <= error);
    /// }
    /// assert!(error < 2e-3);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// A wrong speed or mass ratio gives [`HopWithin::Inconclusive`].
    pub fn hop_within_masses(
        &self,
        alpha: f64,
        error: f64,
        masses: (MassRatio, MassRatio),
    ) -> HopWithin {
        self.change_of_kappa(masses)
            .and_then(|kappa| self.signed_square_within(alpha, Changes { speed: error, kappa }))
            .and_then(|found| HopWithin::from_kernel(found.next()))
            .unwrap_or(HopWithin::Inconclusive)
    }

    /// The largest |Δκ| between the map and the mass ratios from the first to the last; `None` unless its own is
    /// among them.
    fn change_of_kappa(&self, (first, last): (MassRatio, MassRatio)) -> Option<f64> {
        let kappa = self.factors.kappa;
        let (below, above) = (kappa - first.kappa(), last.kappa() - kappa);
        // Each κ has two roundings.
        (below >= 0.0 && above >= 0.0).then(|| below.max(above) + 4.0 * f64::EPSILON * kappa)
    }

    fn signed_square_within(&self, alpha: f64, changes: Changes) -> Option<BoundedSquare> {
        let error = changes.speed;
        if check_speed(alpha).is_err() || alpha > LARGEST_PLAIN_SPEED || !on_one_side(alpha, error)
        {
            return None;
        }
        let (flights, square) =
            self.kernel_flights(alpha, changes).or_else(|| self.plain_flights(alpha, changes))?;
        flights.within(square)
    }

    /// The flights by the kernel, and α′² with its rounding error; `None` if the kernel leaves the hop undecided.
    #[inline]
    fn kernel_flights(
        &self,
        alpha: f64,
        changes: Changes,
    ) -> Option<(SignedFlights, BoundedSquare)> {
        let factors = self.factors;
        let mut flights = SignedFlights::new(alpha, changes, factors);
        let mut start = TakeOff { excess: 0.0, velocity: alpha };
        let decided = watched_kernel_hop(alpha, factors, |end| {
            let GroundState { excess, velocity, error } = end.state;
            let (time, closing_speed) = (2.0 * end.half_time, end.closing_speed_squared.sqrt());
            let landing = Landing { time, closing_speed, excess, velocity, sudden: excess > 0.0 };
            let HalfAngle { sin, cos, d, .. } = HalfAngle::at(end.half_time);
            let functions = (2.0 * sin * cos, 2.0 * sin * sin, 2.0 * d);
            let derivative =
                FlightDerivative::from_functions(start, &landing, factors.kappa, functions);
            start = landing.take_off();
            flights.add(&landing, &derivative, error);
        })?;
        let error = decided.sums.error_of_square(alpha, factors.mu);
        Some((flights, BoundedSquare { square: decided.next_speed_squared, error }))
    }

    /// The same by the general solver; `None` if there are too many.
    fn plain_flights(
        &self,
        alpha: f64,
        changes: Changes,
    ) -> Option<(SignedFlights, BoundedSquare)> {
        let MassFactors { mu, kappa } = self.factors;
        let mut flights = SignedFlights::new(alpha, changes, self.factors);
        let mut rounding = ErrorBound::of_f64(alpha);
        let mut ratios_squared = 0.0;
        let mut start = TakeOff { excess: 0.0, velocity: alpha };
        for landing in PlainLandings::new(alpha, kappa) {
            let landing = landing.ok()?;
            let ratio = landing.closing_speed / alpha;
            ratios_squared += ratio * ratio;
            let derivative = FlightDerivative::new(start, &landing, kappa);
            start = landing.take_off();
            rounding.add_differentiated(&landing, &derivative, kappa);
            // The bound of a landing contains the roundings of this solver.
            flights.add(&landing, &derivative, 0.0);
        }
        let square = alpha * alpha;
        let error = square * rounding.ratio_error(mu, alpha);
        let square = square * (1.0 - mu * ratios_squared);
        Some((flights, BoundedSquare { square, error }))
    }
}

/// The flights of a hop from all speeds within an error, one after the other.
struct SignedFlights {
    changes: Changes,
    kappa: f64,
    /// For the decisions.
    bound: ErrorBound,
    tangent: TangentSums,
}

impl SignedFlights {
    fn new(alpha: f64, changes: Changes, factors: MassFactors) -> Self {
        SignedFlights {
            changes,
            kappa: factors.kappa,
            bound: ErrorBound::of_f64(alpha).with_speed_error(changes.speed),
            tangent: TangentSums::new(alpha, changes, factors),
        }
    }

    /// Adds a flight. `error` bounds the rounding errors of x′ and V′ beyond those that an [`ErrorBound`] contains.
    fn add(&mut self, landing: &Landing, derivative: &FlightDerivative, error: f64) {
        self.bound.add_differentiated(landing, derivative, self.kappa);
        self.bound.add_kappa_error(self.changes.kappa, landing.closing_speed);
        self.bound.add_state_error(error);
        self.tangent.add(landing, derivative);
    }

    /// α′² with the rounding error of `square` and the change within the error; `None` if a landing is inconclusive.
    fn within(&self, square: BoundedSquare) -> Option<BoundedSquare> {
        if self.bound.landing_inconclusive() {
            return None;
        }
        if self.changes == Changes::of_speed(0.0) {
            return Some(square);
        }
        Some(BoundedSquare { error: square.error + self.tangent.tangent()?.change(), ..square })
    }
}

/// Whether all speeds within `error` of `alpha` lie on one side of every α*_n, n ≥ 1, and of every nπ. The kind of the
/// first landing is then the same for all.
fn on_one_side(alpha: f64, error: f64) -> bool {
    if error == 0.0 || is_far_from_ends(alpha, error) {
        return true;
    }
    let FixedPointInterval { n, fixed_point, .. } = FixedPointInterval::of(alpha);
    let away = |distance: f64| distance.abs() > 2.0 * error;
    (n == 0 || (away(fixed_point.offset_of(alpha)) && away(n_pi(n).offset_of(alpha))))
        && away(n_pi(n + 1).offset_of(alpha))
}

/// As [`on_one_side`], in `f64` and without a branch: true only if it is certain.
fn is_far_from_ends(alpha: f64, error: f64) -> bool {
    /// More than the rounding errors of α/π, relative to it.
    const ROUNDING: f64 = 4.0 * f64::EPSILON;
    let alpha_over_pi = alpha / PI;
    let part = alpha_over_pi - alpha_over_pi.floor();
    let least = error + ROUNDING * alpha;
    // π > 2: the distance of nπ is more than twice `least`. The quotient is then below the right integer.
    let inside = part.min(1.0 - part) > least;
    let offset = (alpha - alpha_star(alpha_over_pi as u64)).abs();
    inside & (offset > 2.0 * least)
}
