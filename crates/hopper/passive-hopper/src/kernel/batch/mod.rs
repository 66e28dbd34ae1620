//! Many hops at once, with the same bits as single hops.
//!
//! ```text
//!   hop_block.rs       a block of hops, step by step
//!   simd.rs            the loops, compiled for AVX-512, AVX2 and plain instructions
//!   hop_rows.rs        arrays of hops: positions in the tables, first flights, sums, decisions
//!   later_flights.rs   lists of later flights, and the loops that land them
//!   rows.rs            sizes of the arrays
//! ```

pub(crate) mod hop_block;
pub(crate) mod hop_rows;
pub(crate) mod later_flights;
pub(crate) mod rows;
pub(crate) mod simd;
