//! The commands, one file each.

pub mod beyond_paper;
mod certificates;
mod claim_lines;
mod figure_files;
pub mod model_figures;
pub mod prove;
pub mod reproduce_paper;
pub mod verify_invariance;
