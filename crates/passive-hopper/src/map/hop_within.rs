//! A hop in `f64` from a speed that is known to within an error, with a bound on the error of the next speed.
//!
//! The kernel's bound is tried first. It adds absolute values, and costs little more than the hop. The bound of
//! `speed_error.rs` has the signs of the true derivative, and costs about five hops.

use crate::kernel::scalar::bounded_next::{BoundedNext, BoundedSquare};
use crate::kernel::scalar::ground_state::GroundState;
use crate::kernel::scalar::hop::{MassFactors, watched_kernel_hop};
use crate::kernel::scalar::hop_from_interval::kernel_hop_within;
use crate::landing::error_bound::ErrorBound;
use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::landing::flight_derivative::FlightDerivative;
use crate::landing::flight_ends::{Landing, TakeOff};
use crate::map::lift_off_map::{LiftOffMap, check_speed};
use crate::map::limits::LARGEST_PLAIN_SPEED;
use crate::map::plain_landings::PlainLandings;
use crate::map::speed_error::{Changes, tangent_of_flights};
use crate::model::fixed_points::n_pi;
use crate::model::mass_ratio::MassRatio;
use smallvec::SmallVec;

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

    /// As [`hop_within`](Self::hop_within), with the signs of the derivative: the error hardly grows where the map's slope
    /// is near 1. It takes about half a microsecond.
    pub fn signed_hop_within(&self, alpha: f64, error: f64) -> HopWithin {
        self.signed_square_within(alpha, Changes::of_speed(error))
            .and_then(|found| HopWithin::from_kernel(found.next()))
            .unwrap_or(HopWithin::Inconclusive)
    }

    /// As [`signed_hop_within`](Self::signed_hop_within), for all mass ratios from `first` to `last` as well, which contain that of the
    /// map.
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

    /// The largest |Δκ| between the map and the mass ratios from the first to the last; `None` unless its own is among them.
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
        let kappa = self.factors.kappa;
        let Landings { all, square } =
            self.kernel_landings(alpha).or_else(|| self.plain_landings(alpha))?;
        let mut with_start = ErrorBound::of_f64(alpha).with_speed_error(error);
        for WithError { landing, derivative, error } in &all {
            with_start.add_differentiated(landing, derivative, kappa);
            with_start.add_kappa_error(changes.kappa, landing.closing_speed);
            with_start.add_state_error(*error);
            if with_start.landing_inconclusive() {
                return None;
            }
        }
        if changes == Changes::of_speed(0.0) {
            return Some(square);
        }
        let flights = all.iter().map(|flight| (&flight.landing, flight.derivative));
        let tangent = tangent_of_flights(alpha, changes, flights, self.factors)?;
        Some(BoundedSquare { error: square.error + tangent.change(), ..square })
    }

    /// The landings by the kernel; `None` if it leaves the hop undecided.
    fn kernel_landings(&self, alpha: f64) -> Option<Landings> {
        let mut all = SmallVec::<[WithError; USUAL]>::new();
        let mut start = TakeOff { excess: 0.0, velocity: alpha };
        let decided = watched_kernel_hop(alpha, self.factors, |end| {
            let GroundState { excess, velocity, error } = end.state;
            let (time, closing_speed) = (2.0 * end.half_time, end.closing_speed_squared.sqrt());
            let landing = Landing { time, closing_speed, excess, velocity, sudden: true };
            let derivative = FlightDerivative::new(start, &landing, self.factors.kappa);
            start = landing.take_off();
            all.push(WithError { landing, derivative, error });
        })?;
        all.last_mut()?.landing.sudden = false;
        let error = decided.sums.error_of_square(alpha, self.factors.mu);
        let square = BoundedSquare { square: decided.next_speed_squared, error };
        Some(Landings { all, square })
    }

    /// The landings by the general solver; `None` if there are too many.
    fn plain_landings(&self, alpha: f64) -> Option<Landings> {
        let MassFactors { mu, kappa } = self.factors;
        let mut rounding = ErrorBound::of_f64(alpha);
        let (mut all, mut ratios_squared) = (SmallVec::new(), 0.0);
        let mut start = TakeOff { excess: 0.0, velocity: alpha };
        for landing in PlainLandings::new(alpha, kappa) {
            let landing = landing.ok()?;
            let ratio = landing.closing_speed / alpha;
            ratios_squared += ratio * ratio;
            let derivative = FlightDerivative::new(start, &landing, kappa);
            start = landing.take_off();
            rounding.add_differentiated(&landing, &derivative, kappa);
            // The bound of a landing contains the roundings of this solver.
            all.push(WithError { landing, derivative, error: 0.0 });
        }
        let square = alpha * alpha;
        let error = square * rounding.ratio_error(mu, alpha);
        let square = BoundedSquare { square: square * (1.0 - mu * ratios_squared), error };
        Some(Landings { all, square })
    }
}

/// Room for the landings of most hops.
const USUAL: usize = 4;

/// The landings of a hop, and α′² with the rounding error alone.
struct Landings {
    all: SmallVec<[WithError; USUAL]>,
    square: BoundedSquare,
}

/// A landing, and the derivative of the flight before it.
struct WithError {
    landing: Landing,
    derivative: FlightDerivative,
    /// Bound on the rounding errors of x′ and V′ beyond those that an [`ErrorBound`] contains.
    error: f64,
}

/// Whether all speeds within `error` of `alpha` lie on one side of every α*_n, n ≥ 1, and of every nπ. The kind of the
/// first landing is then the same for all.
fn on_one_side(alpha: f64, error: f64) -> bool {
    if error == 0.0 {
        return true;
    }
    let FixedPointInterval { n, fixed_point, .. } = FixedPointInterval::of(alpha);
    let away = |distance: f64| distance.abs() > 2.0 * error;
    (n == 0 || (away(fixed_point.offset_of(alpha)) && away(n_pi(n).offset_of(alpha))))
        && away(n_pi(n + 1).offset_of(alpha))
}
