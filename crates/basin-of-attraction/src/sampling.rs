//! Measures of basins from points, each with an interval.

use crate::statistics::{Estimate, student_interval, wilson_interval};
use crate::{Error, Interval};
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
    tally(&labels(count, |k| middle(window, count, k), label))
}

/// The shares of the labels among equally spaced points, with the interval that they leave open.
///
/// Between neighbours with equal labels the label is taken to hold; a step between two labels may lie
/// anywhere. So the interval is certain for a basin without parts narrower than the spacing, and says
/// nothing about narrower ones.
///
/// # Errors
/// [`Error::BadTrials`] without points.
pub fn equally_spaced_fractions(
    window: Interval,
    count: usize,
    label: impl Fn(f64) -> u16 + Sync,
) -> Result<BTreeMap<u16, Estimate>, Error> {
    if count == 0 {
        return Err(Error::BadTrials { successes: 0, trials: 0 });
    }
    let labels = labels(count, |k| middle(window, count, k), label);
    let mut steps: BTreeMap<u16, usize> = BTreeMap::new();
    for pair in labels.windows(2).filter(|pair| pair[0] != pair[1]) {
        pair.iter().for_each(|&label| *steps.entry(label).or_insert(0) += 1);
    }
    // The half cells at the ends of the window are beyond any point.
    for end in [labels.first(), labels.last()].into_iter().flatten() {
        *steps.entry(*end).or_insert(0) += 1;
    }
    let estimate = |(label, found): (u16, usize)| {
        let value = found as f64 / count as f64;
        // Each step may be half a cell off.
        let open = 0.5 * steps.get(&label).copied().unwrap_or(0) as f64 / count as f64;
        let (lower, upper) = ((value - open).max(0.0), (value + open).min(1.0));
        (label, Estimate { value, lower, upper })
    };
    Ok(tally(&labels).into_iter().map(estimate).collect())
}

/// The shares of the labels among independent uniform points, with Wilson's 95 % intervals.
///
/// The same seed gives the same points, with any number of threads. A label that no point has is not in the
/// result: its share is [`wilson_interval`]`(0, count)`.
///
/// # Errors
/// [`Error::BadTrials`] without points.
pub fn random_fractions(
    window: Interval,
    count: usize,
    seed: u64,
    label: impl Fn(f64) -> u16 + Sync,
) -> Result<BTreeMap<u16, Estimate>, Error> {
    let at = |k| window.left + window.length() * uniform(seed, k as u64);
    let counts = tally(&labels(count, at, label));
    counts.into_iter().map(|(label, found)| Ok((label, wilson_interval(found, count)?))).collect()
}

/// The shares of the labels among `replicates` low-discrepancy sets of `count` points each: golden
/// rotations with random starts, with Student's 95 % intervals over the replicates.
///
/// For basins of few intervals the error falls like 1/`count` instead of its square root. Labels with few
/// points are given Wilson's interval if that is wider; one that no point has is not in the result: its share
/// is [`wilson_interval`]`(0, count * replicates)`.
///
/// # Errors
/// [`Error::TooFewReplicates`] for fewer than two, [`Error::BadTrials`] without points.
pub fn low_discrepancy_fractions(
    window: Interval,
    count: usize,
    replicates: usize,
    seed: u64,
    label: impl Fn(f64) -> u16 + Sync,
) -> Result<BTreeMap<u16, Estimate>, Error> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    if count == 0 {
        return Err(Error::BadTrials { successes: 0, trials: 0 });
    }
    if replicates < 2 {
        return Err(Error::TooFewReplicates { replicates });
    }
    let tallies: Vec<BTreeMap<u16, usize>> = (0..replicates)
        .map(|replicate| {
            let start = uniform(seed, replicate as u64);
            let at = |k| {
                let turn = start + GOLDEN * k as f64;
                window.left + window.length() * (turn - turn.floor())
            };
            tally(&labels(count, at, &label))
        })
        .collect();
    let mut shares = BTreeMap::new();
    for label in tallies.iter().flat_map(BTreeMap::keys) {
        let share = |tally: &BTreeMap<u16, usize>| {
            tally.get(label).map_or(0.0, |&n| n as f64 / count as f64)
        };
        let estimate = student_interval(&tallies.iter().map(share).collect::<Vec<_>>())?;
        let found: usize = tallies.iter().filter_map(|tally| tally.get(label)).sum();
        shares.insert(*label, with_few(estimate, found, count * replicates)?);
    }
    Ok(shares)
}

/// Hits, or misses, from which on a spread over replicates tells an error.
const ENOUGH: usize = 100;

/// An estimate over replicates, widened to Wilson's interval where a label has few hits or few misses: then
/// replicates may all agree by chance.
fn with_few(estimate: Estimate, found: usize, all: usize) -> Result<Estimate, Error> {
    let Estimate { value, mut lower, mut upper } = estimate;
    if found.min(all - found) < ENOUGH {
        let few = wilson_interval(found, all)?;
        (lower, upper) = (lower.min(few.lower), upper.max(few.upper));
    }
    Ok(Estimate { value, lower: lower.max(0.0), upper: upper.min(1.0) })
}

/// The k-th of a sequence of uniform numbers in [0, 1), by the SplitMix64 mixer.
pub(crate) fn uniform(seed: u64, k: u64) -> f64 {
    let mut z = mix(seed).wrapping_add(k.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = mix(z);
    (z >> 11) as f64 / (1u64 << 53) as f64
}

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn middle(window: Interval, count: usize, k: usize) -> f64 {
    window.left + window.length() * ((k as f64 + 0.5) / count as f64)
}

fn labels(
    count: usize,
    at: impl Fn(usize) -> f64 + Sync,
    label: impl Fn(f64) -> u16 + Sync,
) -> Vec<u16> {
    (0..count).into_par_iter().map(|k| label(at(k))).collect()
}

fn tally(labels: &[u16]) -> BTreeMap<u16, usize> {
    let mut counts = BTreeMap::new();
    for &label in labels {
        *counts.entry(label).or_insert(0) += 1;
    }
    counts
}
