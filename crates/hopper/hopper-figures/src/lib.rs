//! Figures of the passive hopper, as drawings: basins, shares of fates, the map, cobwebs, and the motion of both
//! masses.
//!
//! | item | role |
//! |---|---|
//! | [`LAYERS`], [`Layer`], [`LayerColumns`], [`draw_layer`] | the table of what the pixels of a raster can show: fates, hops, shares, proofs, phases and numbers of a hop; [`Scale`] has their colours |
//! | [`draw_basins`], [`BasinWindow`] | a raster of fates with axes, legend and the frame of an inset |
//! | [`label_png`], [`legend`] | its pixels alone; its legend alone |
//! | [`draw_shares`], [`share_png`], [`share_pixels`], [`share_words`] | a raster whose pixels cover several fates |
//! | [`draw_coverage`], [`coverage_png`] | the same over (M, α), with undecided parts |
//! | [`ZoomPixels`], [`draw_zoom_frame`], [`draw_zoom`] | the frames of a zoom into an edge, and all of them side by side |
//! | [`fate_colors`] | the colour and the name of every fate |
//! | [`Graph`], [`graph_pieces`], [`cuts`], [`cuts_between`] | the graph of the map, in pieces that are smooth |
//! | [`MapPlot`] | the map with its fixed points and traps, and the cobweb of an orbit |
//! | [`Motion`], [`MotionEvent`], [`draw_motion`] | the motion of both masses, sampled, with its events, and against time |
//! | [`frame_times`], [`draw_frame`], [`animation_frame`], [`animation`] | the frames of its animation, and the file |
//! | [`draw_ground`], [`draw_block`], [`draw_spring`] | the parts of a drawn hopper |
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
//! Files (`journal_figures::render` gives the bytes of a drawing), and the figures of one paper (`hopper-studies`).

mod animation;
mod basins;
mod coverage;
mod error;
pub mod fate_colors;
mod graph;
mod layer_columns;
mod layer_drawing;
mod layers;
mod machine;
mod map_plot;
mod motion;
mod motion_errors;
mod motion_frames;
mod motion_plot;
mod number_columns;
mod scales;
mod shares;
mod zoom;

pub use animation::{AnimationForm, AnimationFrame, animation, animation_frame};
pub use basins::{BasinWindow, Inset, PIXELS, draw_basins, draw_pixels, label_png, legend};
pub use coverage::{coverage_png, draw_coverage};
pub use error::Error;
pub use graph::{Graph, cuts, cuts_between, graph_pieces};
pub use layer_columns::LayerColumns;
pub use layer_drawing::draw_layer;
pub use layers::{
    BesideEdges, Content, FLAG, LAYERS, Layer, Meaning, Values, WITHOUT_FLAG, label_of,
};
pub use machine::{draw_block, draw_ground, draw_spring};
pub use map_plot::MapPlot;
pub use motion::{Motion, MotionEvent, Sample};
pub use motion_errors::{SampleError, motion_with_errors};
pub use motion_frames::{draw_frame, frame_times};
pub use motion_plot::draw_motion;
pub use scales::Scale;
pub use shares::{draw_shares, share_pixels, share_png, share_words};
pub use zoom::{ZoomPixels, draw_zoom, draw_zoom_frame};
