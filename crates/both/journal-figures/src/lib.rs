//! Figures for journals: axes, smooth curves and labels set as mathematics, as SVG and PNG.
//!
//! The crate returns bytes. It neither writes files nor prints.
//!
//! | item | role |
//! |---|---|
//! | [`Svg`] | a drawing: lines, areas, labels, images, in points with y downwards |
//! | [`Frame`] | a rectangle of the drawing that shows a window of the plane, with axes |
//! | [`ticks`], [`decades`] | round tick positions with their labels |
//! | [`Marker`] | symbols that differ by shape as well as by colour |
//! | [`Svg::line_key`], [`Svg::marker_key`] | a sample of a line or a symbol, with its name |
//! | [`smooth`], [`graph_pieces`] | curves and graphs of functions that do not exist everywhere |
//! | [`Frame::point_cloud`], [`Frame::branch`], [`Frame::labelled_branches`] | bifurcation diagrams: orbits in greys, branches that attract or not, bifurcations |
//! | [`cobweb`] | the corners of the cobweb of an orbit |
//! | [`palette`] | colours for categories |
//! | [`html`] | the markup of labels as HTML |
//! | [`Path`], [`Segment`] | outlines of straight lines and cubic Bézier pieces |
//! | [`render`], [`indexed_png`], [`rgb_png`] | a drawing as SVG with outlined labels and as PNG; a PNG with a palette, or with three bytes a pixel |
//! | [`animated_png`], [`animated_gif`], [`AnimationForm`] | frames one after another |
//! | [`csv_file`], [`csv_text`], [`npy_header`] | the data beside a drawing: tables, and arrays for NumPy |
//!
//! ```
//! use journal_figures::{Frame, Pen, Svg, render, ticks};
//!
//! let mut svg = Svg::new(300.0, 220.0);
//! let frame = Frame::linear(50.0, 10.0, 240.0, 160.0, (0.0, 2.0), (0.0, 4.0));
//! let parabola: Vec<_> = (0..=20).map(|k| 0.1 * f64::from(k)).map(|x| (x, x * x)).collect();
//! frame.clipped(&mut svg, |svg| frame.curve(svg, &parabola, Pen::solid("#000", 1.5)));
//! frame.axes(&mut svg, &ticks(frame.x, 4), &ticks(frame.y, 4), "$x$", "$x$^{2}");
//! let rendered = render("parabola", &svg, 2.0)?; // 2 pixels for each 1/96 inch
//! assert!(rendered.svg.starts_with("<svg") && rendered.png.starts_with(b"\x89PNG"));
//! # Ok::<(), journal_figures::Error>(())
//! ```
//!
//! # Accuracy
//!
//! Coordinates in the SVG have three decimals of a point, 0.4 µm on paper. The same drawing gives the same
//! SVG on every machine: the font is part of the crate, and logarithms come from `pxfm`. The bytes of a PNG depend on
//! the version of the compressor too.
//!
//! # Not here
//!
//! No choice of fonts, no scripts but Latin, Greek and mathematical italics (a character that the font lacks is an
//! error), no legends that place themselves, no three-dimensional drawings, no files.

mod animation;
pub mod axes;
mod cobweb;
mod curve;
mod data;
mod diagram;
mod document;
mod error;
mod font;
mod key;
pub mod label;
mod marker;
mod npy;
pub mod palette;
mod path;
mod raster;
mod render;
mod svg;

pub use animation::{AnimationForm, AnimationFrame, animated_gif, animated_png};
pub use axes::{Frame, Scale, decades, ticks};
pub use cobweb::cobweb;
pub use curve::{graph_pieces, graph_pieces_to, smooth};
pub use data::{DataFile, csv_file, csv_text};
pub use diagram::LabelledBranch;
pub use error::Error;
pub use label::html;
pub use marker::Marker;
pub use npy::{Element, Order, npy_header};
pub use path::{Path, Point, Segment};
pub use render::{Rendered, indexed_png, render, rgb_png};
pub use svg::{Anchor, Pen, Svg, base64};
