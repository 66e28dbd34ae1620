//! Figs. 6 to 9: the basins of attraction over mass ratio and lift-off speed.

use super::basin_plot::basin_figure;
use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use hopper_basin::{FIG_8, FIG_9, first_humps};
use hopper_figures::BasinWindow;

/// Fig. 6: small mass ratios.
pub(super) fn figure_6(progress: &Progress) -> Result<Figure, Error> {
    let window = BasinWindow {
        name: "fig_06_basin",
        mass_ratio: (0.02, 1.0),
        alpha: (first_humps(5).left, first_humps(5).right),
        inset: Some((FIG_8.0, FIG_8.1, "Fig. 8")),
        tick_counts: (6, 8),
    };
    basin_figure(&window, progress)
}

/// Fig. 7: large mass ratios.
pub(super) fn figure_7(progress: &Progress) -> Result<Figure, Error> {
    let window = BasinWindow {
        name: "fig_07_basin_large_mass_ratio",
        mass_ratio: (1.0, 10.0),
        alpha: (first_humps(5).left, first_humps(5).right),
        inset: None,
        tick_counts: (9, 8),
    };
    basin_figure(&window, progress)
}

/// The window of Fig. 8.
pub(super) fn window_8(name: &'static str) -> BasinWindow {
    BasinWindow {
        name,
        mass_ratio: FIG_8.0,
        alpha: FIG_8.1,
        inset: Some((FIG_9.0, FIG_9.1, "Fig. 9")),
        tick_counts: (5, 7),
    }
}

/// The window of Fig. 9.
pub(super) fn window_9(name: &'static str) -> BasinWindow {
    BasinWindow { name, mass_ratio: FIG_9.0, alpha: FIG_9.1, inset: None, tick_counts: (10, 8) }
}

/// Fig. 8: the inset of Fig. 6.
pub(super) fn figure_8(progress: &Progress) -> Result<Figure, Error> {
    let window = window_8("fig_08_basin_inset");
    basin_figure(&window, progress)
}

/// Fig. 9: the inset of Fig. 8.
pub(super) fn figure_9(progress: &Progress) -> Result<Figure, Error> {
    let window = window_9("fig_09_basin_inset");
    basin_figure(&window, progress)
}
