//! The commands, one file each.

pub mod check_bounds;
pub mod check_reference;
pub mod compare_events;
pub mod compare_peers;
pub mod interval_coverage;
pub mod scale;
pub mod speed;
pub mod work_precision;
