//! One hop.

use crate::kernel::scalar::flight::{Ground, Landed, flight};
use crate::landing::error_bound::LANDING_ULPS;
use crate::landing::first_flight_table::{First, Place, stars};

/// Flights of a hop here; longer chains are left to the careful path.
pub(crate) const FLIGHTS: f64 = 64.0;

/// What a hop needs of M: μ and κ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Masses {
    pub(crate) mu: f64,
    pub(crate) kappa: f64,
}

/// What the flights of a hop add up to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sum {
    /// Σ Γ².
    pub(crate) squares: f64,
    /// Bound on the part of its error that came from flight to flight.
    pub(crate) error: f64,
    /// Σ h, half the time of flight.
    pub(crate) half_time: f64,
    /// Number of flights.
    pub(crate) flights: f64,
}

/// A hop beyond doubt.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Decided {
    pub(crate) sum: Sum,
    /// μ Σ Γ².
    pub(crate) taken: f64,
    /// α′² = α² − μ Σ Γ².
    pub(crate) next_speed_squared: f64,
}

impl Sum {
    /// After the first flight.
    #[inline(always)]
    pub(crate) fn first(first: &First) -> Self {
        let squares = first.closing_speed * first.closing_speed;
        Sum { squares, error: 0.0, half_time: first.half_time, flights: 1.0 }
    }

    /// And another.
    #[inline(always)]
    pub(crate) fn and(&self, landed: &Landed) -> Self {
        Sum {
            squares: self.squares + landed.square,
            error: self.error + landed.square_error,
            half_time: self.half_time + landed.half_time,
            flights: self.flights + 1.0,
        }
    }

    /// The end of the hop, and whether the sign of α′² is beyond doubt.
    #[inline(always)]
    pub(crate) fn end(&self, alpha: f64, mu: f64) -> (Decided, bool) {
        let taken = mu * self.squares;
        let square = alpha * alpha;
        let next_speed_squared = square - taken;
        let rounding = LANDING_ULPS * f64::EPSILON * (2.0 + self.flights) * square;
        let decided = next_speed_squared.abs() > rounding + mu * self.error;
        (Decided { sum: *self, taken, next_speed_squared }, decided)
    }
}

/// The state after a sudden first landing.
#[inline(always)]
pub(crate) fn ground_after(first: &First, alpha: f64, kappa: f64) -> Ground {
    let First { half_time: h, beyond, closing_speed } = *first;
    let excess = 2.0 * h * beyond;
    let velocity = (beyond - h) + kappa * closing_speed;
    let size = 1.0 + alpha + 2.0 * h + closing_speed;
    Ground { excess, velocity, error: LANDING_ULPS * f64::EPSILON * size }
}

/// The hop from `alpha`; nothing where the careful path must decide.
#[inline]
pub(crate) fn hop(alpha: f64, Masses { mu, kappa }: Masses) -> Option<Decided> {
    let place = Place::of(alpha, stars());
    let first = place.first(alpha)?;
    let mut sum = Sum::first(&first);
    if place.sudden == 1 {
        let mut ground = ground_after(&first, alpha, kappa);
        loop {
            let landed = flight(&ground, kappa)?;
            sum = sum.and(&landed);
            ground = landed.ground;
            if !(ground.excess > 0.0) {
                break;
            }
            if !(sum.flights < FLIGHTS) {
                return None;
            }
        }
    }
    let (decided, sure) = sum.end(alpha, mu);
    sure.then_some(decided)
}
