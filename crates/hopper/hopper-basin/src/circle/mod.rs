//! Which fates are shown at every scale left of a fixed point?
//!
//! Left of α*_n the fate of a speed depends on the fraction of its Fatou coordinate alone (docs/theory.md, Section
//! 16). So one circle of phases, [`phase_basins`], has all that is seen there, however near to α*_n. It is found on
//! one fundamental domain of speeds.
//!
//! ```text
//!   circle_limits.rs        how far the circle is refined; what its labels stand on
//!   fundamental_domain.rs   the speeds from α*_n + f(δ₀) to α*_n + δ₀, and their phases
//!   labelled_speeds.rs      the domain as intervals with certain ends
//!   falls_onto.rs           what the orbit of a boundary point comes to
//!   phase_basins.rs         the intervals of phase; look-ups
//!   phase_shares.rs         sums over an interval of phases
//!   edge_chart.rs           windows about a speed that comes to α*_n exactly
//!   edge_derivatives.rs     the derivatives of many hops there, from differences in longer arithmetic
//!   edge_path.rs            such a speed over the mass ratio, by continuation
//!   edge_pixels.rs          the shares between pairs of speeds near it
//!   edge_phases.rs          the phases of their pixels
//!   edge_window.rs          the pixels of windows about it, at one mass ratio and in the (M, α) plane
//!   edge_search.rs          the speeds near a given one that come to a fixed point
//!   nearest_edge.rs         the one nearest to a speed, at any distance
//!   grounding_edge.rs       the nearest speed from which a hop just uses up the energy
//!   local_fractions.rs      p_{n,k}: the share of every fate, with bounds
//!   gap_count.rs            the number of gaps between boundary points, at any scale
//!   upwards.rs              the vertical axis of a raster of shares
//!   share_column.rs         one column of a raster of shares: left of α*_n, or about an edge
//!   share_raster.rs         columns side by side: the circle over M, unrolled by phase or by distance
//! ```
//!
//! This room uses `basins`, `fates` and `traps`.

pub(crate) mod circle_limits;
pub(crate) mod edge_chart;
pub(crate) mod edge_derivatives;
pub(crate) mod edge_path;
pub(crate) mod edge_phases;
pub(crate) mod edge_pixels;
pub(crate) mod edge_search;
pub(crate) mod edge_window;
pub(crate) mod falls_onto;
pub(crate) mod fundamental_domain;
pub(crate) mod gap_count;
pub(crate) mod grounding_edge;
pub(crate) mod labelled_speeds;
pub(crate) mod local_fractions;
mod nearest_edge;
pub(crate) mod phase_basins;
pub(crate) mod phase_shares;
pub(crate) mod share_column;
pub(crate) mod share_raster;
pub(crate) mod upwards;
