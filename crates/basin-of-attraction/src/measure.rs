//! Measures of basins by equally spaced points.

use crate::Interval;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The shares of `window` that `label` gives to each label, by `count` equally spaced points, the
/// middles of `count` equal parts.
///
/// ```
/// use basin_of_attraction::{Interval, equally_spaced_shares};
/// let window = Interval::new(-1.0, 3.0)?;
/// let shares = equally_spaced_shares(window, 1000, |x| u16::from(x > 0.0));
/// assert_eq!(shares, [(0, 0.25), (1, 0.75)].into());
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
pub fn equally_spaced_shares(
    window: Interval,
    count: usize,
    label: impl Fn(f64) -> u16 + Sync,
) -> BTreeMap<u16, f64> {
    let at = |k: usize| window.left + window.length() * ((k as f64 + 0.5) / count as f64);
    let labels: Vec<u16> = (0..count).into_par_iter().map(|k| label(at(k))).collect();
    let mut counts = BTreeMap::new();
    for label in labels {
        *counts.entry(label).or_insert(0usize) += 1;
    }
    counts.into_iter().map(|(label, hits)| (label, hits as f64 / count as f64)).collect()
}
