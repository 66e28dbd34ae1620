//! The hop of all speeds within an error of a given speed: α′ and a bound on its error.
//!
//! On the contact part dF/dα = 2α (1 − 4μW) with 0 ≤ W = D (h − α) ≤ (h + ½)(h − α) (docs/theory.md, Lemma 26). In
//! a window D ≤ h, since SC ≥ 0, and with b = α − h and h′ = dh/dα = D/Γ
//!
//! ```text
//!   dx′/dα = 2bh′ + 2h (1 − h′)      dV′/dα = 1 − 2h′ − 4κ α b h′      d(Γ²)/dα = −8αDb
//! ```
//!
//! docs/theory.md, Lemma 78. A batch uses the functions of this file too (I1).

use crate::kernel::scalar::bounded_next::BoundedSquare;
use crate::kernel::scalar::hop::{FlightSums, MOST_FLIGHTS, MassFactors, state_after_first};
use crate::kernel::scalar::later_flight::later_flight;
use crate::landing::first_flight_table::{
    FirstFlight, FixedPoints, TABLES, TablePosition, fixed_points,
};
use crate::precision::nearest_integer::nearest_integer;
use std::f64::consts::FRAC_1_PI;

/// Largest error of a speed in the kernel. The limit keeps the terms of second order below [`DERIVATIVE_CHANGE`]: on an
/// interval of the tables, α ≤ 32π, the bounds below change by less than 10⁻² within 10⁻⁵.
const LARGEST_SPEED_ERROR: f64 = 1e-5;

/// Largest error relative to the distance from α*_n. The derivatives of the first flight grow like δ^{−2/3} towards
/// δ = 0.
const LARGEST_PART_OF_DISTANCE: f64 = 1.0 / 1024.0;

/// A factor for the change of the derivatives of the first flight within the error, and for the terms of second order.
const DERIVATIVE_CHANGE: f64 = 1.01;

/// Whether all speeds within `error` of `alpha` have the same kind of first landing, with nearly the same derivatives.
/// Without a branch.
#[inline(always)]
pub(crate) fn error_in_range(alpha: f64, error: f64, fixed_points: &FixedPoints) -> bool {
    let alpha_over_pi = alpha * FRAC_1_PI;
    let (_, interval) = nearest_integer(alpha_over_pi - 0.5);
    let delta = alpha - fixed_points[interval as usize % TABLES];
    let (nearest, _) = nearest_integer(alpha_over_pi);
    // The distance of nπ, divided by π: two thirds of the distance are left for the rounding of α/π. The table
    // refuses speeds within 10⁻⁷π of nπ.
    let from_n_pi = (alpha_over_pi - nearest).abs();
    (error <= LARGEST_SPEED_ERROR)
        & (error <= LARGEST_PART_OF_DISTANCE * delta.abs())
        & (error <= from_n_pi)
}

/// Bound on the error of x′ and V′ after a sudden first landing, from an error of the speed.
#[inline(always)]
pub(crate) fn state_error_from_start(
    first: &FirstFlight,
    alpha: f64,
    error: f64,
    kappa: f64,
) -> f64 {
    let FirstFlight { half_time: h, beyond, closing_speed } = *first;
    let rate = h / closing_speed; // at least h′
    let excess = 2.0 * (beyond * rate + h * (1.0 + rate));
    let velocity = 1.0 + 2.0 * rate + 4.0 * kappa * alpha * beyond * rate;
    DERIVATIVE_CHANGE * error * if excess > velocity { excess } else { velocity }
}

/// Bound on the part of the error of α′² that comes directly from an error of the speed, not through later flights.
#[inline(always)]
pub(crate) fn square_error_from_start(
    first: &FirstFlight,
    alpha: f64,
    error: f64,
    mu: f64,
    sudden: bool,
) -> f64 {
    let FirstFlight { half_time: h, beyond, .. } = *first;
    let falling = 4.0 * mu * (h + 0.5) * -beyond - 1.0;
    let in_contact = if falling > 1.0 { falling } else { 1.0 };
    let in_window = 1.0 + 4.0 * mu * h * beyond;
    2.0 * alpha * (DERIVATIVE_CHANGE * error) * if sudden { in_window } else { in_contact }
}

/// The hop of all speeds within `error` of `alpha`; `None` if a landing is inconclusive, or if the speed or the
/// error lies outside the kernel's range.
#[inline]
pub(crate) fn kernel_hop_within(
    alpha: f64,
    error: f64,
    MassFactors { mu, kappa }: MassFactors,
) -> Option<BoundedSquare> {
    if !error_in_range(alpha, error, fixed_points()) {
        return None;
    }
    let position = TablePosition::of(alpha, fixed_points());
    let first = position.first_flight(alpha)?;
    let mut sums = FlightSums::of_first(&first);
    let sudden = position.sudden == 1;
    if sudden {
        let mut state = state_after_first(&first, alpha, kappa);
        state.error += state_error_from_start(&first, alpha, error, kappa);
        loop {
            let end = later_flight(&state, kappa)?;
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
    let direct = square_error_from_start(&first, alpha, error, mu, sudden);
    Some(sums.within(alpha, mu, direct))
}
