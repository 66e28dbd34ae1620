//! The window of lift-off speeds of the paper's basins.

use basin_of_attraction::Interval;
use passive_hopper::alpha_star;

/// The lift-off speeds of the first `count` humps with n ≥ 1: [α*_1, α*_{count+1}].
///
/// The paper's Figs. 6 and 7 and its basin fractions have five humps.
///
/// ```
/// let window = hopper_basin::first_humps(5);
/// assert_eq!(window.left, passive_hopper::alpha_star(1));
/// assert_eq!(window.right, passive_hopper::alpha_star(6));
/// ```
pub fn first_humps(count: u64) -> Interval {
    Interval { left: alpha_star(1), right: alpha_star(count.saturating_add(1)) }
}
