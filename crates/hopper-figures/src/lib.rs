//! Figures of the passive hopper, as drawings: basins over the plane, shares of fates, and the graph of the map.
//!
//! | item | role |
//! |---|---|
//! | [`draw_basins`], [`Window`] | a raster of fates with axes, legend and the frame of an inset |
//! | [`label_png`], [`legend`] | its pixels alone; its legend alone |
//! | [`draw_shares`], [`share_png`], [`share_pixels`] | a raster whose pixels cover several fates |
//! | [`draw_hops`] | a raster of numbers of hops, with axes and scale |
//! | [`fate_colors`] | the colour and the name of every fate |
//! | [`graph_pieces`], [`cuts`] | the graph of the map, in pieces that are smooth |
//!
//! ```
//! use hopper_figures::{cuts, graph_pieces};
//! use passive_hopper::{LiftOffMap, MassRatio};
//! let map = LiftOffMap::new(MassRatio::new(0.2)?);
//! let pieces = graph_pieces(&map, &cuts(2), 100);
//! assert!(pieces.iter().flatten().all(|&(alpha, next)| next <= alpha));
//! # Ok::<(), passive_hopper::Error>(())
//! ```
//!
//! # Not here
//! Files (`journal_figures::render` gives the bytes of a drawing), and the figures of one paper (`hopper-paper`).

mod basins;
mod error;
pub mod fate_colors;
mod graph;
mod hops;
mod shares;

pub use basins::{Inset, PIXELS, Window, draw_basins, label_png, legend};
pub use error::Error;
pub use graph::{cuts, graph_pieces};
pub use hops::draw_hops;
pub use shares::{draw_shares, share_pixels, share_png};
