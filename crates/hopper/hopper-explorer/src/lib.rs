//! The core of the explorer: the libraries behind a few functions with numbers in, and bytes or text out.
//!
//! ```text
//!   page ── numbers ──► exports ──► one room for each view ──► passive-hopper, hopper-basin, hopper-proof, hopper-figures
//!        ◄── bytes, JSON ── answer
//! ```
//!
//! It holds no mathematics: colours, names, labels, pieces of the map and samples of the motion are those of the
//! libraries. A tile is computed in strips of columns, so that a worker can look for newer wishes between two of
//! them.
//!
//! | item | role |
//! |---|---|
//! | [`Tile`], [`TileStrip`], [`numbered`], [`strip`], [`places`] | pixels of the (M, α) plane, layer by layer of `hopper_figures::LAYERS` |
//! | [`point`], [`proof`] | a fate with its reasons, and the orbit hop by hop; whether the fate is proved |
//! | [`map`] | the map at one M: its pieces, fixed points, traps and crises |
//! | [`motion`], [`units`] | both masses against time; metres and seconds |
//! | [`circle`], [`intervals`] | the circle of fates of α*_n; the basins at one M as intervals |
//! | [`Depth`] | windows of any size about a boundary point |
//! | [`legend`] | colours and names, and the windows of the paper |
//! | `systems`, `OpenSystem` (feature `systems`) | other systems: their attractors and basins, by the crates for any system |
//!
//! # Not here
//! What the page looks like (`page/`), and any number that no library computes.

mod answer;
mod circle;
mod depth;
#[cfg(not(feature = "systems"))]
mod exports;
mod json;
mod labels;
mod legend;
mod map;
mod motion;
mod point;
mod refusal;
#[cfg(feature = "systems")]
mod system_exports;
#[cfg(feature = "systems")]
mod systems;
mod tile;

pub use circle::{circle, intervals};
pub use depth::Depth;
pub use legend::legend;
pub use map::map;
pub use motion::{motion, units};
pub use point::{point, proof};
pub use refusal::Refusal;
#[cfg(feature = "systems")]
pub use systems::{OpenSystem, SYSTEMS, System, systems};
pub use tile::{Tile, TileStrip, numbered, places, strip};
