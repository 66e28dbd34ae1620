//! The mass ratios from which orbits of a hump fall below its fixed point, or to the ground.
//!
//! Proofs: docs/theory.md, Theorem 29 and Theorem 31.

use crate::error::Error;
use crate::traps::hump::{Hump, LARGEST_HUMP, Target};
use passive_hopper::{Enclosed, enclosed_touch};

/// The mass ratio at which the map's minimum on the contact part of a hump touches α*_n, or zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crisis {
    /// The index of the hump.
    pub n: u64,
    /// μ = M/(1+M)² at the touch, to an ulp.
    pub mu: f64,
    /// The mass ratio M ≤ 1 at the touch. The touch happens at 1/M as well, since μ is the same.
    pub mass_ratio: f64,
    /// Bound on the error of `mass_ratio`: an ulp at most.
    pub error: f64,
    /// The lift-off speed of the minimum at the touch, to an ulp.
    pub alpha: f64,
}

/// The crisis M_c(n) of α*_n.
///
/// While min(M, 1/M) ≤ M_c(n), the map stays above α*_n on the whole contact part of hump n. For mass
/// ratios between M_c(n) and 1/M_c(n), orbits of the hump fall below α*_n.
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
    // For n = 0 the fixed point is 0, and f(α) > 0 wherever the hopper hops again: hump 0 has a grounding, but no
    // crisis.
    if n == 0 {
        return Err(Error::Index { n, smallest: 1, largest: LARGEST_HUMP });
    }
    touch(n, Target::FixedPoint)
}

/// The mass ratio at which a gap of grounding opens on the contact part of hump n ≥ 0.
///
/// While min(M, 1/M) is less than this, every hop from the contact part is followed by another hop. At equality one
/// speed has F = 0, and the hopper is grounded from it (docs/theory.md, Theorem 31).
///
/// # Errors
/// [`Error::Index`] for humps beyond the largest lift-off speed.
pub fn grounding(n: u64) -> Result<Crisis, Error> {
    touch(n, Target::Ground)
}

fn touch(n: u64, target: Target) -> Result<Crisis, Error> {
    let hump = Hump::new(n)?;
    let near = hump.time_of(hump.touch(target)?);
    let touch = enclosed_touch(n, target == Target::Ground, near)?;
    let Enclosed { value: mass_ratio, error } = touch.mass_ratio;
    Ok(Crisis { n, mu: touch.mu.value, mass_ratio, error, alpha: touch.alpha.value })
}
