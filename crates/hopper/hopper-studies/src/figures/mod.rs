//! The figures of the paper, one file each, from first principles.

mod basin_plot;
mod fig_01_model;
mod fig_02_map;
mod fig_03_segments;
mod fig_04_local_map;
pub(crate) mod fig_05_construction;
mod fig_06_to_09_basins;
mod fig_08_09_coverage;
mod invariance;
mod printed_against_stable;

use crate::choice;
use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;

/// Computes and draws a figure.
pub(crate) type Build = fn(&Progress) -> Result<Figure, Error>;

/// All figures, with their names for `--only`.
pub(crate) const ALL: &[(&str, Build)] = &[
    ("fig1", fig_01_model::build),
    ("fig2", fig_02_map::build),
    ("fig3", fig_03_segments::build),
    ("fig4", fig_04_local_map::build),
    ("fig5", fig_05_construction::build),
    ("fig6", fig_06_to_09_basins::figure_6),
    ("fig7", fig_06_to_09_basins::figure_7),
    ("fig8", fig_06_to_09_basins::figure_8),
    ("fig9", fig_06_to_09_basins::figure_9),
    ("fig8coverage", fig_08_09_coverage::figure_8),
    ("fig9coverage", fig_08_09_coverage::figure_9),
    ("invariance", invariance::build),
    ("printed", printed_against_stable::build),
];

/// The figures with these names; all of them if none is named.
pub(crate) fn named(names: &[String]) -> Result<Vec<(&'static str, Build)>, Error> {
    choice::named("figure", ALL, names)
}
