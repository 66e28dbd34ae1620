//! The tests of this crate are one program: what they share is compiled once, and the tests of all files run side by
//! side.

#![allow(
    missing_docs,
    unreachable_pub,
    clippy::disallowed_methods,
    clippy::panic,
    clippy::unwrap_used
)]

mod against_reference;
mod any_bits;
mod circle;
mod coverage;
mod crisis_fates;
mod edge_charts;
mod edge_fates;
mod edge_paths;
mod edge_windows;
mod fractions_over_mass_ratio;
mod gap_counts;
mod interval_basins;
mod many_fates;
mod raster;
mod share_rasters;
mod true_fates;
mod versions;
mod zooms;
