//! Counts in a file that was written by serde (feature `serde`).

use serde::de::{Deserialize, Deserializer, Error};

/// No execution has 2⁵³ events. A file with a larger count is damaged, and sums of such counts would overflow.
const LARGEST: usize = 1 << 53;

/// Reads a count.
///
/// # Errors
/// An error of the reader for a number above 2⁵³.
pub(crate) fn read_count<'de, D: Deserializer<'de>>(reader: D) -> Result<usize, D::Error> {
    let count = usize::deserialize(reader)?;
    if count <= LARGEST {
        return Ok(count);
    }
    Err(D::Error::custom(format!("a checkpoint with the count {count} is damaged")))
}
