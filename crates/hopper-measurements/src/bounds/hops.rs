//! The error bounds of hops.

use super::measured::Measured;
use crate::error::Error;

/// Measures the bounds of hops on about `count` inputs a class.
pub(crate) fn measure(_count: u64) -> Result<Vec<Measured>, Error> {
    Ok(Vec::new())
}
