//! Basin fractions from sample points.

use crate::error::Error;
use crate::space::interval::Interval;
use crate::space::label::Label;
use crate::statistics::bounds::Bounds;
use crate::statistics::confidence_interval::{ConfidenceInterval, open_proportion};
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Most points of all replicates together: two gigabytes of labels. With a label in a microsecond they take a
/// quarter of an hour on one core, and give fractions to four digits; a count far above this is a mistake, such as
/// one that overflowed, and would end in a lack of memory or never.
const MOST_POINTS: usize = 1_000_000_000;

/// An error for more points than can be labelled.
pub(crate) fn check_count(samples: usize) -> Result<(), Error> {
    if samples <= MOST_POINTS {
        return Ok(());
    }
    let remedy = "take fewer points: the error of a fraction falls like one over the root of their number at least";
    Err(Error::TooManySamples { samples, most: MOST_POINTS, remedy })
}

/// An error for a window that is reversed, or whose length is not finite.
pub(crate) fn check_window(Interval { left, right }: Interval) -> Result<(), Error> {
    Interval::new(left, right)?;
    if (right - left).is_finite() { Ok(()) } else { Err(Error::BadInterval { left, right }) }
}

/// How many of `count` equally spaced points of `window` have each label. The points are the middles of `count`
/// equal parts of the window.
///
/// ```
/// use basin_of_attraction::{Interval, Label, equally_spaced_counts};
/// let window = Interval::new(-1.0, 3.0)?;
/// let counts = equally_spaced_counts(window, 1000, |x| Label::from(x > 0.0))?;
/// assert_eq!(counts, [(Label::from(0), 250), (Label::from(1), 750)].into());
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::TooManySamples`] for more than a billion points; [`Error::BadInterval`] for a window that is reversed or
/// not finite.
pub fn equally_spaced_counts(
    window: Interval,
    count: usize,
    label: impl Fn(f64) -> Label + Sync,
) -> Result<BTreeMap<Label, usize>, Error> {
    check_window(window)?;
    check_count(count)?;
    Ok(tally(&labels(count, |k| middle(window, count, k), label)))
}

/// The fraction of equally spaced points that have a label.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EquallySpacedFraction {
    /// The fraction of the points.
    pub value: f64,
    /// Bounds on the basin fraction. They hold if no part of a basin, and no gap in it, is narrower than the spacing of
    /// the points. Narrower parts may lie between the points.
    pub bounds: Bounds,
}

/// The basin fractions among `count` equally spaced points, with the bounds that the spacing leaves.
///
/// The label is assumed to be constant between neighbouring points with equal labels. Between points with different
/// labels the boundary may lie anywhere. Undecided points may belong to any basin: they raise the upper bound of
/// each.
///
/// # Errors
/// [`Error::BadTrials`] for a `count` of 0, [`Error::TooManySamples`] for more than a billion points,
/// [`Error::BadInterval`] for a window that is reversed or not finite.
pub fn equally_spaced_fractions(
    window: Interval,
    count: usize,
    label: impl Fn(f64) -> Label + Sync,
) -> Result<BTreeMap<Label, EquallySpacedFraction>, Error> {
    if count == 0 {
        return Err(Error::BadTrials { successes: 0, trials: 0 });
    }
    check_window(window)?;
    check_count(count)?;
    let labels = labels(count, |k| middle(window, count, k), label);
    // The number of ends of runs of each label.
    let mut ends: BTreeMap<Label, usize> = BTreeMap::new();
    for pair in labels.windows(2).filter(|pair| pair[0] != pair[1]) {
        pair.iter().for_each(|&label| *ends.entry(label).or_insert(0) += 1);
    }
    // Between an end of the window and its nearest point lies half a spacing without any point.
    for label in [labels.first(), labels.last()].into_iter().flatten() {
        *ends.entry(*label).or_insert(0) += 1;
    }
    let points = |condition: &dyn Fn(Label) -> bool, of: &BTreeMap<Label, usize>| -> f64 {
        let own = of.iter().filter(|(label, _)| condition(**label));
        own.map(|(_, count)| *count).sum::<usize>() as f64 / count as f64
    };
    let counts = tally(&labels);
    let fraction = |(&label, _): (&Label, &usize)| {
        let own = |other: Label| other == label;
        let possible = |other: Label| own(other) || label.is_decided() && other.is_undecided();
        let value = points(&own, &counts);
        // Each end of a run is known to half a spacing on either side.
        let bounds = Bounds {
            lower: (value - 0.5 * points(&own, &ends)).max(0.0),
            upper: (points(&possible, &counts) + 0.5 * points(&possible, &ends)).min(1.0),
        };
        (label, EquallySpacedFraction { value, bounds })
    };
    Ok(counts.iter().map(fraction).collect())
}

/// The basin fractions among `count` independent uniform points, with 95 % intervals.
///
/// The same seed gives the same points, with any number of threads. The intervals are those of
/// [`proportion_interval`](crate::proportion_interval): they contain the fraction in at least 93 % of the samples. Undecided points may belong
/// to any basin: they raise the upper end of each. A label without points is not in the result: its fraction is
/// [`proportion_interval`](crate::proportion_interval)`(0, count)`.
///
/// # Errors
/// [`Error::BadTrials`] for a `count` of 0, [`Error::TooManySamples`] for more than a billion points,
/// [`Error::BadInterval`] for a window that is reversed or not finite.
pub fn random_fractions(
    window: Interval,
    count: usize,
    seed: u64,
    label: impl Fn(f64) -> Label + Sync,
) -> Result<BTreeMap<Label, ConfidenceInterval>, Error> {
    check_window(window)?;
    check_count(count)?;
    let random = SplitMix64::from_seed(seed);
    let at = |k| window.left + window.length() * random.uniform(k as u64);
    let counts = tally(&labels(count, at, label));
    if counts.is_empty() {
        return Err(Error::BadTrials { successes: 0, trials: 0 });
    }
    let undecided: usize =
        counts.iter().filter(|(label, _)| label.is_undecided()).map(|(_, points)| points).sum();
    let fraction = |(&label, &found): (&Label, &usize)| {
        let open = if label.is_decided() { undecided } else { 0 };
        Ok((label, open_proportion(found, open, count)?))
    };
    counts.iter().map(fraction).collect()
}

/// The middle of part k of `count` equal parts of the window.
fn middle(window: Interval, count: usize, k: usize) -> f64 {
    window.left + window.length() * ((k as f64 + 0.5) / count as f64)
}

/// The labels of the points 0 … count − 1.
pub(crate) fn labels(
    count: usize,
    at: impl Fn(usize) -> f64 + Sync,
    label: impl Fn(f64) -> Label + Sync,
) -> Vec<Label> {
    (0..count).into_par_iter().map(|k| label(at(k))).collect()
}

pub(crate) fn tally(labels: &[Label]) -> BTreeMap<Label, usize> {
    let mut counts = BTreeMap::new();
    for &label in labels {
        *counts.entry(label).or_insert(0) += 1;
    }
    counts
}
