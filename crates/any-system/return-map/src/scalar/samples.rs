//! Equally spaced samples of a window.

use crate::error::Error;

/// The place of each of some samples of a window, from end to end.
///
/// # Errors
/// [`Error::BadWindow`] for a window that is empty or not finite, for fewer than three samples, and for more than `most`.
pub(super) fn samples_of(
    (left, right): (f64, f64),
    samples: usize,
    most: usize,
) -> Result<impl Fn(usize) -> f64, Error> {
    if !(left < right) || !(right - left).is_finite() || !(3..=most).contains(&samples) {
        return Err(Error::BadWindow { left, right, samples, most });
    }
    let last = samples - 1;
    // The sum may round to a place beyond the right end, where the map may not be defined.
    Ok(move |k: usize| {
        if k == last {
            right
        } else {
            (left + (right - left) * (k as f64 / last as f64)).min(right)
        }
    })
}
