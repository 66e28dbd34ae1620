//! Cost of rasters by size, and what many workers gain.

mod cpu_time;
mod plan;
mod rasters;
mod simulation;
pub(crate) mod table;

pub(crate) use plan::{Plan, plan};
pub(crate) use rasters::{Raster, growth_per_doubling, measure};
pub(crate) use simulation::{Finished, simulate};
