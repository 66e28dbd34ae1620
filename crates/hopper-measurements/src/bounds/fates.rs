//! The error bounds of traps and of orbits.

use super::measured::Measured;
use crate::error::Error;

/// Measures the bounds of traps and of orbits on about `count` inputs a class.
pub(crate) fn measure(_count: u64) -> Result<Vec<Measured>, Error> {
    Ok(Vec::new())
}
