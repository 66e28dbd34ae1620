//! The basins of a line of speeds, proved for all mass ratios of a strip.

use crate::cell::Cell;
use crate::error::Error;
use crate::hop::proved_images::ProvedImages;
use crate::hop::strip::Strip;
use crate::traps::proved_trap;
use basin_of_attraction::{Interval, Label, PixelShares};
use hopper_basin::{HopperFate, LapsSweep, Resolution};
use passive_hopper::{alpha_star, index_below};

/// The share that may stay open on a hump, over that of the hump above it. What is open below is open again at each
/// of its preimages above. With a larger factor the upper humps do not reach their share; with a smaller one the
/// lower humps cost more.
const FINER_BELOW: f64 = 0.2;

/// Passes over a part. The gaps that are left have then the size of an ulp.
const PASSES: usize = 40;

/// The smallest width that is resolved, over what may stay open of a part.
const FINEST: f64 = 1e-3;

/// Most parts of a hump below the window. More affect the time only.
const MOST_PARTS_BELOW: f64 = 64.0;

/// Disjoint intervals of speeds, each with the fate that all its speeds have, at all mass ratios of a strip.
/// Between them nothing is proved.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvedLine {
    intervals: Vec<(Interval, Label)>,
}

impl ProvedLine {
    /// The basins in a window of speeds. Of each of `parts` equal parts of it at most the share `open` is left
    /// without a label, if `speeds` speeds inside a part suffice for that.
    ///
    /// A sweep goes upwards from 0, since images lie below their speeds. So the intervals begin below the window.
    ///
    /// # Errors
    /// [`Error::Speeds`] unless the window is from 0 to α*_n of the largest label; [`Error::Share`] unless `open` is
    /// above 0 and at most 1, and there are parts.
    pub fn new(
        strip: Strip,
        window: Interval,
        parts: usize,
        open: f64,
        speeds: usize,
    ) -> Result<Self, Error> {
        Self::finer_at_fixed_points(strip, window, parts, open, speeds, f64::INFINITY)
    }

    /// As [`Self::new`], in parts that are halved towards the ends of each trap down to `shortest`: of each of them
    /// at most the share `open` is left as well.
    pub(crate) fn finer_at_fixed_points(
        strip: Strip,
        window: Interval,
        parts: usize,
        open: f64,
        speeds: usize,
        shortest: f64,
    ) -> Result<Self, Error> {
        let largest = alpha_star(HopperFate::LARGEST_LABEL);
        let Interval { left: low, right: high } = window;
        if !(low >= 0.0 && low < high && high <= largest) {
            return Err(Error::Speeds { low, high, largest });
        }
        if !(open > 0.0 && open <= 1.0 && parts >= 1) {
            return Err(Error::Share { open, parts });
        }
        let last = index_below(high)?;
        let traps = traps_up_to(&strip, high)?;
        let finer = edges_at_traps(&traps, high, shortest);
        let mut sweep = LapsSweep::new(ProvedImages::new(strip, high)?, traps);
        let mut add = |range: Interval, parts: usize| -> Result<(), Error> {
            let mut edges = PixelShares::edges(range, parts).map_err(hopper_basin::Error::from)?;
            edges.extend(finer.iter().filter(|&&edge| range.left < edge && edge < range.right));
            edges.sort_by(f64::total_cmp);
            edges.dedup();
            for pair in edges.windows(2) {
                let below = last - index_below(pair[0])?;
                let tolerance = open * FINER_BELOW.powi(i32::try_from(below).unwrap_or(i32::MAX));
                let resolution = Resolution { tolerance, speeds, passes: PASSES, finest: FINEST };
                sweep.add_pixel(pair[0], pair[1], resolution);
            }
            Ok(())
        };
        // Below the window: the humps, in parts of a similar height.
        let height = window.length() / parts as f64;
        for n in 0..=index_below(low)? {
            let (left, right) = (alpha_star(n), alpha_star(n + 1).min(low));
            if left < right {
                let count = ((right - left) / height).ceil().clamp(1.0, MOST_PARTS_BELOW);
                add(Interval { left, right }, count as usize)?;
            }
        }
        add(window, parts)?;
        Ok(ProvedLine { intervals: sweep.into_known() })
    }

    /// The label of all speeds from `low` to `high`, if one interval contains them.
    pub fn label_of_all(&self, low: f64, high: f64) -> Option<Label> {
        let at = self.intervals.partition_point(|(own, _)| own.right < low);
        let (own, label) = self.intervals.get(at)?;
        (own.left <= low && high <= own.right).then_some(*label)
    }

    /// What is proved of the speeds from `low` to `high`.
    pub fn cell(&self, low: f64, high: f64) -> Cell {
        if let Some(label) = self.label_of_all(low, high) {
            return Cell::Basin(label);
        }
        let first = self.intervals.partition_point(|(own, _)| own.right < low);
        let mut inside = self.intervals[first..].iter().take_while(|(own, _)| own.left <= high);
        let Some((_, label)) = inside.next() else { return Cell::Open };
        if inside.any(|(_, other)| other != label) { Cell::Cut } else { Cell::Open }
    }

    /// A line that was stored: the [`intervals`](Self::intervals) of an earlier one.
    pub fn restored(intervals: Vec<(Interval, Label)>) -> Self {
        ProvedLine { intervals }
    }

    /// The intervals, without the line.
    pub(crate) fn into_intervals(self) -> Vec<(Interval, Label)> {
        self.intervals
    }

    /// The intervals from the lowest up.
    pub fn intervals(&self) -> &[(Interval, Label)] {
        &self.intervals
    }
}

/// Edges of parts on both sides of the traps, the nearest ones at most `shortest` away, each next one at twice the
/// distance.
fn edges_at_traps(traps: &[(Interval, Label)], top: f64, shortest: f64) -> Vec<f64> {
    let mut edges = Vec::new();
    let last = Interval { left: top, right: top };
    for trap in traps.iter().map(|(trap, _)| trap).chain([&last]) {
        let mut distance = shortest;
        while distance < std::f64::consts::PI {
            edges.extend([trap.left - distance, trap.right + distance]);
            distance *= 2.0;
        }
    }
    edges
}

/// The traps that are proved, from α*_0 up to a speed.
pub(crate) fn traps_up_to(strip: &Strip, top: f64) -> Result<Vec<(Interval, Label)>, Error> {
    let mut traps = Vec::new();
    for n in 0..=index_below(top)? {
        // A trap that is not proved is left out; then more stays open.
        match proved_trap(n, strip) {
            Ok(trap) => traps.push((trap, HopperFate::label_of_fixed_point(n))),
            Err(Error::Open { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(traps)
}
