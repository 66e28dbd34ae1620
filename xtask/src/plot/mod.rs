//! Drawing: a small SVG writer with axes, smooth curves and labels set as mathematics.

pub mod axes;
pub mod curve;
pub mod label;
mod marker;
pub mod palette;
pub mod render;
pub mod svg;

pub use axes::{Frame, Scale, decades, ticks};
pub use marker::Marker;
pub use svg::{Anchor, Pen, Svg};
