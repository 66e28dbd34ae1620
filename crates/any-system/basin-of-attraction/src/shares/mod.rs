//! Which part of a region has each basin, and how stable is an attractor?
//!
//! `fractions` are parts with ranges: of random points (`region_fractions`, `sampling`), of stratified ones (`low_discrepancy`), of images
//! (`image_fractions`). `stability` adds times and shocks.

pub(crate) mod fractions;
pub(crate) mod image_fractions;
pub(crate) mod low_discrepancy;
pub(crate) mod region_fractions;
pub(crate) mod sampling;
pub(crate) mod stability;
