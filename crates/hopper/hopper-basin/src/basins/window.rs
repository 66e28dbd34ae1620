//! The windows of mass ratio and lift-off speed of the paper's basins.

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

/// The (M, α) windows of two of the paper's figures.
///
/// Each is the range of mass ratios, and the range of lift-off speeds. Figs. 6 and 7 show all of [`first_humps`]`(5)`.
///
/// ```
/// use hopper_basin::{FIG_8, FIG_9, first_humps};
/// let ((from, to), (bottom, top)) = FIG_9;
/// assert!(FIG_8.0.0 < from && to < FIG_8.0.1 && FIG_8.1.0 < bottom && top < FIG_8.1.1);
/// assert!(first_humps(5).left < FIG_8.1.0 && FIG_8.1.1 < first_humps(5).right);
/// ```
pub type FigureWindow = ((f64, f64), (f64, f64));

/// Fig. 8, a part of Fig. 6: the basins of M ∈ [0.1, 0.2] at a finer scale. Its limits are illegible in our copy of the
/// paper. Here α runs from α*_4 to α*_6, cut to three decimals: this window contains that of Fig. 9.
pub const FIG_8: FigureWindow = ((0.1, 0.2), (14.066, 20.371));

/// Fig. 9, a part of Fig. 8, with the limits that the paper prints: M ∈ [0.17, 0.18], α ∈ [17.0, 17.8].
pub const FIG_9: FigureWindow = ((0.17, 0.18), (17.0, 17.8));
