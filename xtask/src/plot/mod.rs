//! Drawing to SVG and PNG: axes, smooth curves and labels set as mathematics.

pub mod axes;
pub mod curve;
mod document;
pub mod font;
pub mod label;
mod marker;
pub mod palette;
pub mod path;
mod raster;
pub mod render;
pub mod svg;

pub use axes::{Frame, Scale, decades, ticks};
pub use marker::Marker;
pub use path::Path;
pub use svg::{Anchor, Pen, Svg};
