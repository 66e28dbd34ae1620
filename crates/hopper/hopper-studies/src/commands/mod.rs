//! The commands, one file each.

pub(crate) mod beyond_paper;
mod certificates;
pub(crate) mod check_bounds;
pub(crate) mod check_reference;
mod claim_lines;
pub(crate) mod compare_events;
pub(crate) mod compare_peers;
mod figure_files;
pub(crate) mod interval_coverage;
pub(crate) mod model_figures;
pub(crate) mod prove;
pub(crate) mod reproduce_paper;
pub(crate) mod scale;
pub(crate) mod speed;
pub(crate) mod verify_invariance;
pub(crate) mod work_precision;
