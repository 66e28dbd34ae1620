//! Which speeds near a given one come to a fixed point exactly?
//!
//! The orbit of the given speed tells after how many hops it is near a fixed point, and Newton's method finds the
//! speed.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use passive_hopper::{FixedPointSpeed, index_below};

/// Largest distance of the boundary point from the guess.
pub(crate) const NEAR: f64 = 1e-3;

/// Most hops to the fixed point. Each of them is a place where a search may begin, and costs its hops.
pub(crate) const MOST_HOPS: usize = 256;

/// Most steps of Newton's method in `f64`.
const NEWTON_STEPS: usize = 30;

/// A place where the orbit of a speed comes near a fixed point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Approach {
    pub(crate) n: u64,
    pub(crate) hops: usize,
    /// The zero of f^k − α*_n, in `f64`.
    pub(crate) point: f64,
}

/// The zeros of f^k − α*_n near `guess`, for each k at which its orbit comes near an α*_n, until `see` returns
/// `None`. It returns the distance from which on zeros are of interest.
pub(crate) fn approaches(
    fates: &Fates,
    guess: f64,
    mut see: impl FnMut(Approach) -> Option<f64>,
) -> Result<(), Error> {
    fates.map().check_speed(guess)?;
    let (mut speed, mut slope, mut within) = (guess, 1.0, NEAR);
    // The fixed point near which the orbit has been since its last zero: the same point again is no other zero.
    let mut stays_at = None;
    for hops in 0..=MOST_HOPS {
        let low = index_below(speed)?;
        if stays_at.is_some_and(|n| n != low && n != low + 1) {
            stays_at = None;
        }
        for n in [low, low + 1] {
            // To first order; a factor 4 for the next orders.
            let estimate = (FixedPointSpeed::new(n).offset_of(speed) / slope).abs();
            if n >= 1
                && stays_at != Some(n)
                && estimate <= NEAR.min(4.0 * within)
                && let Some(point) = newton(fates, n, hops, guess)
            {
                let Some(next) = see(Approach { n, hops, point }) else { return Ok(()) };
                within = next;
                stays_at = Some(n);
            }
        }
        let Some((next, factor)) = hop(fates, speed) else { break };
        (speed, slope) = (next, slope * factor);
        if !(slope != 0.0 && slope.is_finite()) {
            break;
        }
    }
    Ok(())
}

/// One hop and its slope.
fn hop(fates: &Fates, speed: f64) -> Option<(f64, f64)> {
    let next = fates.map().image(speed).ok()??;
    let slopes = fates.map().slopes(speed).ok()??;
    Some((next, slopes.by_speed))
}

/// The zero of f^k − α*_n near `guess`, by Newton's method in `f64`.
fn newton(fates: &Fates, n: u64, hops: usize, guess: f64) -> Option<f64> {
    let star = FixedPointSpeed::new(n);
    let mut point = guess;
    for _ in 0..NEWTON_STEPS {
        let (mut speed, mut slope) = (point, 1.0);
        for _ in 0..hops {
            let (next, factor) = hop(fates, speed)?;
            (speed, slope) = (next, slope * factor);
        }
        let step = star.offset_of(speed) / slope;
        point -= step;
        if !((point - guess).abs() <= NEAR) {
            return None;
        }
        if step.abs() <= 4.0 * f64::EPSILON * point {
            return Some(point);
        }
    }
    None
}
