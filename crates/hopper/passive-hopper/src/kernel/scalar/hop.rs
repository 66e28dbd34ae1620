//! One hop: the first flight from its table, later flights one after the other, and the decision on α′².

use crate::kernel::scalar::bounded_next::BoundedSquare;
use crate::kernel::scalar::ground_state::GroundState;
use crate::kernel::scalar::later_flight::{FlightEnd, later_flight};
use crate::landing::error_bound::LANDING_ULPS;
use crate::landing::first_flight_table::{FirstFlight, TablePosition, fixed_points};

/// Most flights of a hop in the kernel. The general solver computes hops with more flights.
///
/// The error bound grows from flight to flight, so that the decisions of long chains are often inconclusive. In a batch
/// a few long chains would also keep nearly empty vectors busy. 8192 hops of the paper's window have at most ten
/// flights. The limit changes the computing time only, not the result.
pub(crate) const MOST_FLIGHTS: f64 = 64.0;

/// The two functions of M in a hop, μ = M/(1+M)² and κ = M/(1+M).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MassFactors {
    pub(crate) mu: f64,
    pub(crate) kappa: f64,
}

/// Sums over the flights of a hop.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlightSums {
    /// Σ Γ².
    pub(crate) closing_speeds_squared: f64,
    /// Bound on the error of the later flights' part of Σ Γ².
    pub(crate) error: f64,
    /// Σ h, half the time of flight.
    pub(crate) half_time: f64,
    /// Number of flights.
    pub(crate) flights: f64,
}

/// A hop with every decision larger than its error bound (I2).
#[derive(Debug, Clone, Copy)]
pub(crate) struct DecidedHop {
    pub(crate) sums: FlightSums,
    /// μ Σ Γ² = α² − α′².
    pub(crate) loss_of_square: f64,
    /// α′² = α² − μ Σ Γ²; negative if the hopper is grounded.
    pub(crate) next_speed_squared: f64,
}

impl FlightSums {
    /// The sums after the first flight. No error is propagated to the first flight. The error of the table is
    /// counted by [`end`](Self::end).
    #[inline(always)]
    pub(crate) fn of_first(first: &FirstFlight) -> Self {
        let square = first.closing_speed * first.closing_speed;
        FlightSums {
            closing_speeds_squared: square,
            error: 0.0,
            half_time: first.half_time,
            flights: 1.0,
        }
    }

    /// The sums with one more flight.
    #[inline(always)]
    pub(crate) fn with(&self, end: &FlightEnd) -> Self {
        FlightSums {
            closing_speeds_squared: self.closing_speeds_squared + end.closing_speed_squared,
            error: self.error + end.closing_speed_squared_error,
            half_time: self.half_time + end.half_time,
            flights: self.flights + 1.0,
        }
    }

    /// The end of the hop, and whether the sign of α′² is larger than its error bound (I2).
    ///
    /// As long as the hop continues, μ times the partial sum is below α², because the remaining energy is positive.
    /// The roundings of μ, of the squares and of the sums are therefore counted in ulps of α²: at most 4 + 2
    /// flights halves of an ulp. The first flight's Γ², from the table, has at most 8 ulps. `LANDING_ULPS` for each
    /// flight and for two more is above both (docs/theory.md, Theorem 66). The rounding errors of the later Γ² are
    /// in `error`.
    #[inline(always)]
    pub(crate) fn end(&self, alpha: f64, mu: f64) -> (DecidedHop, bool) {
        let loss_of_square = mu * self.closing_speeds_squared;
        let next_speed_squared = alpha * alpha - loss_of_square;
        let decided = next_speed_squared.abs() > self.error_of_square(alpha, mu);
        (DecidedHop { sums: *self, loss_of_square, next_speed_squared }, decided)
    }

    /// Bound on the error of α′²; see [`end`](Self::end).
    #[inline(always)]
    pub(crate) fn error_of_square(&self, alpha: f64, mu: f64) -> f64 {
        let rounding = LANDING_ULPS * f64::EPSILON * (2.0 + self.flights) * (alpha * alpha);
        rounding + mu * self.error
    }
}

impl FlightSums {
    /// α′² with a bound on its error, for a hop whose start has an error that changes α′² by at most `direct`,
    /// apart from its part through later flights.
    #[inline(always)]
    pub(crate) fn within(&self, alpha: f64, mu: f64, direct: f64) -> BoundedSquare {
        let (hop, _) = self.end(alpha, mu);
        let error = self.error_of_square(alpha, mu) + direct;
        BoundedSquare { square: hop.next_speed_squared, error }
    }
}

impl DecidedHop {
    /// α′, or `None` if the hopper is grounded.
    #[inline(always)]
    pub(crate) fn next(&self) -> Option<f64> {
        (self.next_speed_squared > 0.0).then(|| self.next_speed_squared.sqrt())
    }
}

/// The state after a sudden first landing: x′ = 2h (α − h), V′ = (α − h) − h + κΓ.
///
/// The table gives α − h to an ulp of α − h. Therefore x′ keeps its digits next to α*_n, where it vanishes.
#[inline(always)]
pub(crate) fn state_after_first(first: &FirstFlight, alpha: f64, kappa: f64) -> GroundState {
    let FirstFlight { half_time: h, beyond, closing_speed } = *first;
    let excess = 2.0 * h * beyond;
    let velocity = (beyond - h) + kappa * closing_speed;
    let size = 1.0 + alpha + 2.0 * h + closing_speed;
    GroundState { excess, velocity, error: LANDING_ULPS * f64::EPSILON * size }
}

/// The hop from `alpha`; `None` if the general solver must decide.
#[inline]
pub(crate) fn kernel_hop(alpha: f64, factors: MassFactors) -> Option<DecidedHop> {
    watched_kernel_hop(alpha, factors, |_| ())
}

/// The hop from `alpha`; `see` receives each flight's end. A `see` that does nothing costs nothing: the function is
/// compiled for it.
#[inline(always)]
pub(crate) fn watched_kernel_hop(
    alpha: f64,
    MassFactors { mu, kappa }: MassFactors,
    mut see: impl FnMut(&FlightEnd),
) -> Option<DecidedHop> {
    let position = TablePosition::of(alpha, fixed_points());
    let first = position.first_flight(alpha)?;
    let mut sums = FlightSums::of_first(&first);
    see(&FlightEnd {
        state: state_after_first(&first, alpha, kappa),
        closing_speed_squared: sums.closing_speeds_squared,
        closing_speed_squared_error: sums.error,
        half_time: first.half_time,
        accepted: true,
    });
    if position.sudden == 1 {
        let mut state = state_after_first(&first, alpha, kappa);
        loop {
            let end = later_flight(&state, kappa)?;
            see(&end);
            sums = sums.with(&end);
            state = end.state;
            if !(state.excess > 0.0) {
                break;
            }
            if !(sums.flights < MOST_FLIGHTS) {
                return None;
            }
        }
    }
    let (hop, decided) = sums.end(alpha, mu);
    decided.then_some(hop)
}
