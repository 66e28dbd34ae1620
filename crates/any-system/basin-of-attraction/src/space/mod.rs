//! Which points are there, which labels do they have, and how are they shown?
//!
//! `vectors` are lists of numbers, `interval` and `hyperrectangle` regions; `label` is a basin or the reason why there is none. `raster` and `value_image` are labels and numbers over
//! a window, with `pictures` and `files` of them.

#[cfg(feature = "figures")]
pub(crate) mod files;
pub(crate) mod hyperrectangle;
pub(crate) mod interval;
pub(crate) mod label;
#[cfg(feature = "figures")]
pub(crate) mod pictures;
pub(crate) mod raster;
pub(crate) mod undecided_reason;
pub(crate) mod value_image;
pub(crate) mod vectors;
