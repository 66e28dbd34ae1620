//! Numbers that may be infinite, in a file that was written by serde (feature `serde`): JSON has no infinity.

use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Writes a number, none for infinity.
///
/// # Errors
/// Those of the writer, and one for NaN and for −∞, which no such number is.
pub(crate) fn serialize<W: Serializer>(value: &f64, writer: W) -> Result<W::Ok, W::Error> {
    if value.is_nan() || *value == f64::NEG_INFINITY {
        return Err(W::Error::custom(format!("{value} cannot be written")));
    }
    value.is_finite().then_some(*value).serialize(writer)
}

/// Reads a number, infinity for none.
pub(crate) fn deserialize<'de, R: Deserializer<'de>>(reader: R) -> Result<f64, R::Error> {
    Ok(Option::deserialize(reader)?.unwrap_or(f64::INFINITY))
}
