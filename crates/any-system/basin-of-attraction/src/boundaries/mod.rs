//! Where is a boundary, what is it like, and which orbits stay on it?
//!
//! `boundary_between`, `edge_tracking` and `fatal_shock` find points of it. `boxes`, `region_boxes` and `entropy` measure it, as do `uncertainty` on the line,
//! `region_uncertainty` with `uncertainty_fit`, `smooth_boundary` and `ln_2_criterion`; `wada` compares the boundaries of basins. `escape_times` and
//! `chaotic_saddle` are about orbits that stay for long.

pub(crate) mod boundary_between;
pub(crate) mod boxes;
pub(crate) mod chaotic_saddle;
pub(crate) mod edge_tracking;
pub(crate) mod entropy;
pub(crate) mod escape_times;
pub(crate) mod fatal_shock;
pub(crate) mod ln_2_criterion;
pub(crate) mod region_boxes;
pub(crate) mod region_uncertainty;
pub(crate) mod smooth_boundary;
pub(crate) mod uncertainty;
pub(crate) mod uncertainty_fit;
pub(crate) mod wada;
