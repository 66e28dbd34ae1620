//! Basins of the passive hopper that are proved.
//!
//! | item | role |
//! |---|---|
//! | [`Strip`] | all mass ratios of an interval |
//! | [`ProvedImages`] | hops from all speeds of an interval, enclosed with rounding outwards |
//! | [`proved_trap`], [`ProvedCrisis`] | traps and crises, enclosed |
//! | [`ProvedLine`] | the basins of a line of speeds, for all mass ratios of a strip |
//! | [`ProvedPoints`], [`proved_points`] | the fates of single speeds at one M; of the points of a raster |
//! | [`proved_basins`], [`basins_at_every_mass_ratio`] | all basins at one M as intervals |
//! | [`fixed_point`] | α*_n, enclosed |
//! | [`Theorem`], [`CertificateLine`] | a statement with the steps of its proof, and the numbers with which another program checks it |

mod basins;
mod cell;
mod certificate;
mod error;
mod fixed_points;
mod hop;
mod lengths;
mod line;
mod points;
mod theorems;
mod traps;

pub use basins::{basins_at_every_mass_ratio, proved_basins};
pub use cell::Cell;
pub use certificate::{BasinGap, BasinInterval, CERTIFICATE_VERSION, CertificateLine};
pub use error::Error;
pub use fixed_points::fixed_point;
pub use hop::proved_images::ProvedImages;
pub use hop::strip::Strip;
pub use line::ProvedLine;
pub use points::{PointFate, ProvedPoints};
pub use theorems::cells::{CellShares, ProvedCells, ProvedStrip, proved_strips};
pub use theorems::crisis::crises;
pub use theorems::everything_hops::everything_hops;
pub use theorems::measures::{ProvedFraction, ProvedFractions, measures};
pub use theorems::one_sided::one_sided;
pub use theorems::one_sudden::one_sudden;
pub use theorems::raster::proved_points;
pub use theorems::raster_theorems::{cells_theorem, points_theorem};
pub use theorems::rising::rising;
pub use theorems::theorem::{Step, Theorem};
pub use theorems::trap_edges::trap_edges;
pub use theorems::{QUICK_THEOREMS, QuickTheorem};
pub use traps::{ProvedCrisis, proved_trap};
