//! Sizes of a block, and its arrays.

/// Number of hops that are computed together.
///
/// One array of a block is 4 KiB and all of them about 120 KiB, so that they stay in the second-level cache. In smaller
/// blocks the last vector of each list is emptier; larger blocks leave the cache. The value was chosen by measurement.
/// Indices into a block are stored as `u16`, and 512 is a power of two, so that `% BLOCK` is a mask (I8).
pub(crate) const BLOCK: usize = 512;

/// `f64` lanes of the widest vectors (AVX-512). Loops over a part of a block run up to a multiple of this number (I6).
pub(crate) const LANES: usize = 8;

/// One quantity of all hops, or of all flights, of a block.
pub(crate) type Row = [f64; BLOCK];

pub(crate) const ZERO: Row = [0.0; BLOCK];
