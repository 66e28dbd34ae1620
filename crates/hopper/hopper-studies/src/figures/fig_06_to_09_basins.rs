//! Figs. 6 to 9: the basins of attraction over mass ratio and lift-off speed.

use super::basin_plot::basin_figure;
use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use hopper_basin::{FIG_8, FIG_9, first_humps};
use hopper_figures::BasinWindow;

fn texts(title: &str, paper: &str, notes: &str) -> (String, String, String) {
    (title.into(), paper.into(), notes.into())
}

/// Fig. 6: small mass ratios.
pub(super) fn figure_6(progress: &Progress) -> Result<Figure, Error> {
    let window = BasinWindow {
        name: "fig_06_basin",
        mass_ratio: (0.02, 1.0),
        alpha: (first_humps(5).left, first_humps(5).right),
        inset: Some((FIG_8.0, FIG_8.1, "Fig. 8")),
        tick_counts: (6, 8),
    };
    basin_figure(
        &window,
        progress,
        texts(
            "Basins of attraction for small mass ratios",
            "Initial speeds by the fixed point they lead to: first green, second red, third blue and so \
         on. At $M$ = 0.1 most of the window is green; with growing $M$ the fraction of incessant hopping \
         falls rapidly.",
            "BasinWindow $M$ ∈ [0.02, 1], $α$ from $α$^{∗}_{1} to $α$^{∗}_{6} (the paper's lower limit of $M$ is illegible in our copy). What the \
         paper leaves blank is told apart: white decays (hops for ever, ever lower), grey is grounded.",
        ),
    )
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
    basin_figure(
        &window,
        progress,
        texts(
            "Basins of attraction for large mass ratios",
            "$M$ from 1 to 10: towards $M$ = 10 the structure resembles that of small $M$.",
            "BasinWindow $M$ ∈ [1, 10], $α$ from $α$^{∗}_{1} to $α$^{∗}_{6}. The traps are those of 1/$M$, but the basins are not: \
         the map between $nπ$ and $α$^{∗}_{n} is not invariant.",
        ),
    )
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
    basin_figure(
        &window,
        progress,
        texts(
            "The inset of Fig. 6",
            "The same basins at a finer scale.",
            "BasinWindow $M$ ∈ [0.1, 0.2], $α$ from $α$^{∗}_{4} to $α$^{∗}_{6}, chosen to hold Fig. 9; the paper's limits are illegible in our copy.",
        ),
    )
}

/// Fig. 9: the inset of Fig. 8.
pub(super) fn figure_9(progress: &Progress) -> Result<Figure, Error> {
    let window = window_9("fig_09_basin_inset");
    basin_figure(
        &window,
        progress,
        texts(
            "The inset of Fig. 8",
            "Finer still, and structure again.",
            "BasinWindow of the paper, $M$ ∈ [0.17, 0.18], $α$ ∈ [17.0, 17.8].",
        ),
    )
}
