//! Which share of every pixel of a column belongs to each basin?
//!
//! A pixel of a [raster of labels](crate::basin_raster) has the fate of its middle, so that a basin thinner than a
//! pixel is shown in some pixels only. A pixel of a coverage raster has the shares of all its speeds at the mass
//! ratio of its column.
//!
//! ```text
//!   coverage_limits.rs    how small the undecided part of a pixel becomes; what the shares stand on
//!   images.rs             images of speeds and of intervals of speeds
//!   preimage_guess.rs     which speed may have a given image
//!   laps_sweep.rs         intervals of known label, from 0 up, by images of gaps
//!   line_basins.rs        the intervals of a column: by the sweep, or by the fates of samples
//!   coverage_column.rs    one column: intervals with certain ends, and shares of pixels
//!   coverage_raster.rs    columns side by side
//!   coverage_summary.rs   what a raster stands on, and how much of it is undecided
//! ```
//!
//! This room uses `traps`, `fates`, `basins` and `raster` for the map's laps, and the rasters of shares of `circle`.

pub(crate) mod coverage_column;
pub(crate) mod coverage_limits;
pub(crate) mod coverage_raster;
pub(crate) mod coverage_summary;
pub(crate) mod images;
pub(crate) mod laps_sweep;
pub(crate) mod line_basins;
pub(crate) mod preimage_guess;
