//! Sizes of a block, and its arrays.

/// Hops that go through the steps together.
///
/// One array of a block is 4 KiB and all of them about 120 KiB, so that they stay in the second-level cache. Smaller
/// blocks fill the last vector of a list worse; larger ones leave the cache. Chosen by measurement. Indices into a
/// block are stored as `u16`, and 512 is a power of two, so that `% BLOCK` is a mask (I8).
pub(crate) const BLOCK: usize = 512;

/// `f64` lanes of the widest vectors, those of AVX-512. Loops over a part of a block run up to a multiple of it (I6).
pub(crate) const LANES: usize = 8;

/// One quantity of all hops, or of all flights, of a block.
pub(crate) type Row = [f64; BLOCK];

pub(crate) const ZERO: Row = [0.0; BLOCK];
