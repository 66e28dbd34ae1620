//! Which basins has a map of the line, as intervals and with bounds?
//!
//! `fate` follows one orbit of a `scalar_map` to a trap. On `branches` there are preimages (`preimage`, `preimage_tree`), and all basins (`basin_search`,
//! `interval_basins`), until a limit of `refinement`; `probes` test what a caller gives. Then `pixel_shares`, distances (`boundary_distance`), and what
//! never enters a trap: `itineraries`, `gap_lengths`, `repeller` (of `full_branches`, by their `transfer_operator`) with proved `repeller_bounds`, `kneading`.

pub(crate) mod basin_search;
pub(crate) mod boundary_distance;
pub(crate) mod branches;
pub(crate) mod fate;
pub(crate) mod full_branches;
pub(crate) mod gap_lengths;
pub(crate) mod interval_basins;
pub(crate) mod itineraries;
pub(crate) mod kneading;
pub(crate) mod pixel_shares;
pub(crate) mod preimage;
pub(crate) mod preimage_tree;
pub(crate) mod probes;
pub(crate) mod refinement;
pub(crate) mod repeller;
pub(crate) mod repeller_bounds;
pub(crate) mod scalar_map;
pub(crate) mod transfer_operator;
