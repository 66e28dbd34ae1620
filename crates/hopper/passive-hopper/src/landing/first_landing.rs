//! The first landing after a gradual lift-off. It exists and is unique for every α > 0 (docs/theory.md,
//! Theorem 7).

use crate::landing::first_flight_table::{TablePosition, fixed_points};
use crate::landing::fixed_point_interval::FixedPointInterval;
use crate::landing::flight_ends::Landing;
use crate::landing::half_time_root::HalfTimeRoot;

/// The first landing after a gradual lift-off with speed `alpha`.
pub(crate) fn first_landing(alpha: f64, kappa: f64) -> Landing {
    let interval = FixedPointInterval::of(alpha);
    first_root(&interval, alpha).landing(0.0, alpha, kappa, Some(interval.sudden))
}

/// Half the time of the first flight. The search starts from the table, which is right to some ulps. Outside the table
/// it starts from an expansion.
pub(crate) fn first_root(interval: &FixedPointInterval, alpha: f64) -> HalfTimeRoot {
    let tabled = TablePosition::of(alpha, fixed_points()).first_flight(alpha);
    let start = tabled.map_or_else(|| interval.half_time_estimate(alpha), |first| first.half_time);
    HalfTimeRoot::solve(0.0, alpha, interval.half_time_bracket(alpha), start)
}
