//! Numbers that may be infinite, in a file that was written by serde (feature `serde`): JSON has no infinity.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Writes a number, none for infinity.
pub(crate) fn serialize<W: Serializer>(value: &f64, writer: W) -> Result<W::Ok, W::Error> {
    value.is_finite().then_some(*value).serialize(writer)
}

/// Reads a number, infinity for none.
pub(crate) fn deserialize<'de, R: Deserializer<'de>>(reader: R) -> Result<f64, R::Error> {
    Ok(Option::deserialize(reader)?.unwrap_or(f64::INFINITY))
}
