//! A hop in `f64` from a speed that is known to within an error, with a bound on the error of the next speed.
//!
//! The kernel's bound is tried first. It adds absolute values, and costs little more than the hop. The bound of
//! `speed_error.rs` has the signs of the true derivative, and costs several hops.

use crate::error::Error;
use crate::kernel::scalar::hop::{BoundedSquare, kernel_hop_within};
use crate::landing::error_bound::ErrorBound;
use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::map::lift_off_map::{LiftOffMap, check_speed};
use crate::map::limits::LARGEST_PLAIN_SPEED;
use crate::map::speed_error::change_of_square;
use crate::model::fixed_points::n_pi;

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
    /// From α′² and the bound on its error.
    pub(crate) fn from_square(square: f64, error: f64) -> Self {
        if !(square.abs() > error) {
            return HopWithin::Inconclusive;
        }
        if square < 0.0 {
            return HopWithin::Grounded;
        }
        // |α̂′ − α′| = |F̂ − F|/(α̂′ + α′), with α′ ≥ √(F̂ − error), and an ulp for the root.
        let speed = square.sqrt();
        let least = (square - error).sqrt();
        HopWithin::Next { speed, error: error / (speed + least) * ROUND_UP + f64::EPSILON * speed }
    }
}

/// More than the roundings of the quotient above.
pub(crate) const ROUND_UP: f64 = 1.0 + 8.0 * f64::EPSILON;

impl LiftOffMap {
    /// An error unless `alpha` is a speed from which the map has a hop.
    ///
    /// # Errors
    /// The errors of [`hop`](Self::hop) for a wrong speed.
    pub fn check_speed(&self, alpha: f64) -> Result<(), Error> {
        check_speed(alpha)
    }

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
        match kernel_hop_within(alpha, error, self.factors) {
            Some(BoundedSquare { square, error }) => HopWithin::from_square(square, error),
            None => self.signed_hop_within(alpha, error),
        }
    }

    /// As [`hop_within`](Self::hop_within), with the signs of the derivative: the error hardly grows where the map's slope
    /// is near 1. It takes some microseconds.
    pub fn signed_hop_within(&self, alpha: f64, error: f64) -> HopWithin {
        self.signed_square_within(alpha, error).map_or(HopWithin::Inconclusive, |found| {
            HopWithin::from_square(found.square, found.error)
        })
    }

    fn signed_square_within(&self, alpha: f64, error: f64) -> Option<BoundedSquare> {
        if check_speed(alpha).is_err() || alpha > LARGEST_PLAIN_SPEED || !on_one_side(alpha, error)
        {
            return None;
        }
        let kappa = self.factors.kappa;
        let mut rounding = ErrorBound::of_f64(alpha);
        let mut with_start = rounding.clone().with_speed_error(error);
        let (mut found, mut ratios_squared) = (Vec::new(), 0.0);
        for landing in self.landings(alpha).ok()? {
            let landing = landing.ok()?;
            let ratio = landing.closing_speed / alpha;
            ratios_squared += ratio * ratio;
            rounding.add_flight(&landing, kappa);
            with_start.add_flight(&landing, kappa);
            if with_start.landing_inconclusive() {
                return None;
            }
            found.push(landing);
        }
        let (mu, square) = (self.factors.mu, alpha * alpha);
        let propagated = change_of_square(alpha, error, &found, self.factors)?;
        Some(BoundedSquare {
            square: square * (1.0 - mu * ratios_squared),
            error: square * rounding.ratio_error(mu, alpha) + propagated,
        })
    }
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
