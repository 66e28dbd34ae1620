//! The sudden windows (nπ, α*_n), where the map is known to rise.

use basin_of_attraction::Interval;
use passive_hopper::alpha_star;
use std::f64::consts::PI;

/// How near to α*_n the proof goes.
const NEAR: f64 = 1e-3;

/// For windows n = 1, 2, …: the largest M and the largest slope; proved in `tests/rising_windows.rs`.
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

/// A window on which the map is proved to rise, for small mass ratios.
///
/// These are under 0.9056: a hop has at most one sudden lift-off, and the map is continuous on the window. The
/// proof, with intervals for the derivative over the plane of h and M, is a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RisingWindow {
    /// From nπ to 10⁻³ below α*_n.
    pub part: Interval,
    /// The largest M of the proof.
    pub largest_mass_ratio: f64,
    /// α′ (dα′/dα)/α lies between zero and this.
    pub steepest: f64,
}

/// Window n = 1, …, 8; nothing for others, at which nobody has looked.
///
/// ```
/// let window = hopper_basin::rising_window(1).expect("one of the eight");
/// assert!(window.largest_mass_ratio > 0.9 && window.part.contains(4.0));
/// ```
pub fn rising_window(n: u64) -> Option<RisingWindow> {
    let at = usize::try_from(n).ok()?.checked_sub(1)?;
    let &(largest_mass_ratio, steepest) = PROVED.get(at)?;
    let part = Interval { left: n as f64 * PI, right: alpha_star(n) - NEAR };
    Some(RisingWindow { part, largest_mass_ratio, steepest })
}
