//! Measures of basins by equally spaced points.

use crate::Interval;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// How many of `count` equally spaced points of `window`, the middles of `count` equal parts, have
/// each label.
///
/// ```
/// use basin_of_attraction::{Interval, equally_spaced_counts};
/// let window = Interval::new(-1.0, 3.0)?;
/// let counts = equally_spaced_counts(window, 1000, |x| u16::from(x > 0.0));
/// assert_eq!(counts, [(0, 250), (1, 750)].into());
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
pub fn equally_spaced_counts(
    window: Interval,
    count: usize,
    label: impl Fn(f64) -> u16 + Sync,
) -> BTreeMap<u16, usize> {
    let at = |k: usize| window.left + window.length() * ((k as f64 + 0.5) / count as f64);
    let labels: Vec<u16> = (0..count).into_par_iter().map(|k| label(at(k))).collect();
    let mut counts = BTreeMap::new();
    for label in labels {
        *counts.entry(label).or_insert(0) += 1;
    }
    counts
}
