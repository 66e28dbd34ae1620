//! The commands, one file each.

pub mod basin_raster;
pub mod beyond_paper;
mod claim_lines;
mod column_bytes;
mod figure_files;
mod kept;
pub mod model_figures;
pub mod reproduce_paper;
mod share_files;
pub mod verify_invariance;
mod zoom_files;
