//! What are the basins of any labelling?
//!
//! `label_image` measures an image of labels. `samples` labels random points of a region by a vectorised function
//! of Python. `interval` is a number with its interval. `codes` are those of labels that are no basins.

mod codes;
mod interval;
mod label_image;
mod samples;

pub(crate) use codes::label_codes;
pub(crate) use interval::Interval;
pub(crate) use label_image::{BoxCount, LabelImage};
pub(crate) use samples::{UncertaintyExponent, region_fractions, region_of, uncertainty_exponent};
