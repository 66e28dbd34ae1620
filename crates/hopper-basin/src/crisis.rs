//! The mass ratios at which a hump falls through its fixed point, or to the ground.

use crate::Error;
use crate::hump::{Hump, Touch};

/// A touch of the map's minimum on the contact part of a hump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crisis {
    /// Index of the hump.
    pub n: u64,
    /// μ = M/(1+M)² at the touch.
    pub mu: f64,
    /// The mass ratio below one at the touch; the other is its inverse.
    pub mass_ratio: f64,
    /// Where the hump touches.
    pub alpha: f64,
}

/// The crisis of α*_n: for min(M, 1/M) up to M_c(n) the whole contact part of hump n stays above
/// α*_n, beyond it orbits fall through.
///
/// ```
/// let crisis = hopper_basin::crisis(1)?;
/// assert!((crisis.mass_ratio - 0.10345775533613707).abs() < 1e-15);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// [`Error::Index`] for n = 0, and for humps beyond the largest lift-off speed.
pub fn crisis(n: u64) -> Result<Crisis, Error> {
    if n == 0 {
        return Err(Error::Index { n, smallest: 1, largest: crate::hump::LARGEST });
    }
    touch(n, false)
}

/// The opening of a gap of grounding on the contact part of hump n ≥ 0: for min(M, 1/M) up to this
/// every hop from there is followed by another.
///
/// # Errors
/// [`Error::Index`] for humps beyond the largest lift-off speed.
pub fn grounding(n: u64) -> Result<Crisis, Error> {
    touch(n, true)
}

fn touch(n: u64, target_is_zero: bool) -> Result<Crisis, Error> {
    let Touch { mu, alpha, .. } = Hump::new(n)?.touch(target_is_zero)?;
    // M/(1+M)² = μ, the root below one, without cancellation.
    let mass_ratio = 2.0 * mu / (1.0 - 2.0 * mu + (1.0 - 4.0 * mu).sqrt());
    Ok(Crisis { n, mu, mass_ratio, alpha })
}
