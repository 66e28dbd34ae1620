//! The window of lift-off speeds that the paper shows and measures.

use basin_of_attraction::Interval;
use passive_hopper::alpha_star;

/// [α*₁, α*₆]: the five humps of the lift-off map between the first six fixed points.
///
/// Figures 6 and 7 of the paper show this window, and Sec. VI B measures the basins on it.
pub fn five_humps() -> Interval {
    Interval { left: alpha_star(1), right: alpha_star(6) }
}
