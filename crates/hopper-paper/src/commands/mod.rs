//! The commands, one file each.

mod animation;
pub mod basin_raster;
pub mod beyond_paper;
mod claim_lines;
mod column_bytes;
mod coverage_files;
mod figure_files;
mod kept;
pub mod model_figures;
pub mod reproduce_paper;
mod share_files;
pub mod verify_invariance;
mod zoom_files;
