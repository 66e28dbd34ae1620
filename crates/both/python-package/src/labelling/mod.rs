//! What are the basins of any labelling, and which attractors has any map?
//!
//! `label_image` measures an image of labels. `samples` labels random points of a region by a vectorised function
//! of Python. `attractors` finds those of a map by recurrences. `interval` is a number with its interval.

mod attractors;
mod interval;
mod label_image;
mod samples;

pub(crate) use attractors::{Attractors, label_codes};
pub(crate) use interval::Interval;
pub(crate) use label_image::{BoxCount, LabelImage};
pub(crate) use samples::{UncertaintyExponent, region_fractions, uncertainty_exponent};
