//! The sudden windows (nπ, α*_n) on which the map is proved to rise.
//!
//! The proof is a test, `rising_windows/tests.rs`: it encloses the derivative over the plane of h and M with intervals.

use basin_of_attraction::Interval;
use passive_hopper::alpha_star;
use std::f64::consts::PI;

/// How near to α*_n the proof goes.
///
/// At α*_n the slope changes like the cube root of the distance, and an interval proof needs ever smaller boxes. Speeds
/// in the remaining 10⁻³ have no lap; in a raster of the paper's window they are 0.03 % of the rows.
const DISTANCE_FROM_STAR: f64 = 1e-3;

/// For the windows n = 1, 2, …: the largest M and a bound on the relative slope |α′ (dα′/dα)/α|.
///
/// The test proves both. The mass ratios must be below 0.9056, up to which a hop has at most one sudden lift-off. The
/// slopes are 8n + 2, about a third above the largest found on samples (7.8, 14, …, 50). A bound that is too large
/// widens the error bounds of itineraries, so that fewer gaps close.
///
/// Samples rise up to M = 0.905 in windows 4 to 8 as well, and in 9 and 10. How the smaller mass ratios of windows 4
/// to 8 were chosen is not recorded; near 0.905 the smallest slope tends to zero with n, and a proof needs more boxes.
const PROVED: [(f64, f64); 8] = [
    (0.905, 10.0),
    (0.905, 18.0),
    (0.905, 26.0),
    (0.9, 34.0),
    (0.89, 42.0),
    (0.87, 50.0),
    (0.85, 58.0),
    (0.83, 66.0),
];

/// A part of a sudden window on which the map is proved to rise, for small mass ratios.
///
/// For these mass ratios a hop has at most one sudden lift-off, and the map is continuous on the window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RisingWindow {
    /// From nπ to 10⁻³ below α*_n.
    pub(crate) part: Interval,
    /// The largest M of the proof.
    pub(crate) largest_mass_ratio: f64,
    /// α′ (dα′/dα)/α lies between zero and this.
    pub(crate) steepest: f64,
}

/// Window n if n is in 1, …, 8; `None` for all other windows, for which there is no proof.
pub(crate) fn rising_window(n: u64) -> Option<RisingWindow> {
    let at = usize::try_from(n).ok()?.checked_sub(1)?;
    let &(largest_mass_ratio, steepest) = PROVED.get(at)?;
    let part = Interval { left: n as f64 * PI, right: alpha_star(n) - DISTANCE_FROM_STAR };
    Some(RisingWindow { part, largest_mass_ratio, steepest })
}

#[cfg(test)]
mod tests;
