//! Bounds from basins as intervals, of which a gap around the boundary is undecided.

use super::tally::{Promise, Row, Trial, repeat};
use crate::error::Error;
use basin_of_attraction::{
    Bounds, Interval, IntervalBasins, Label, Refinement, SplitMix64, interval_basins_from_known,
};

const ZERO: Label = Label::numbered::<0>();
const ONE: Label = Label::numbered::<1>();

/// Two basins of [0, 1] that meet at `boundary`, somewhere in an undecided gap.
struct TwoBasins {
    boundary: f64,
    /// The right end of the known part of basin 0.
    left_end: f64,
    basins: IntervalBasins,
}

/// The boundary between `from` and `to`, in a gap of 10⁻⁶ to 10⁻³.
fn two_basins(random: &SplitMix64, (from, to): (f64, f64)) -> Result<TwoBasins, Error> {
    let boundary = from + (to - from) * random.uniform(0);
    let gap = 1e-6 + 1e-3 * random.uniform(1);
    let left_end = boundary - gap * random.uniform(2);
    let known = [
        (Interval::new(0.0, left_end)?, ZERO),
        (Interval::new((left_end + gap).min(1.0), 1.0)?, ONE),
    ];
    let (window, no_map) = (Interval::new(0.0, 1.0)?, |_: f64| None);
    let basins = interval_basins_from_known(&no_map, &known, &[], window, Refinement::default())?;
    Ok(TwoBasins { boundary, left_end, basins })
}

/// Bounds and the truth of one trial.
type Measured = Result<Option<(Bounds, f64)>, Error>;

/// The share of basin 0 in the pixel of 64 that contains the boundary, or in one beside it.
fn share(scene: &TwoBasins, random: &SplitMix64) -> Measured {
    const PIXELS: usize = 64;
    let pixel = (scene.boundary * PIXELS as f64 + 2.0 * random.uniform(10) - 1.0) as usize;
    let left = pixel as f64 / PIXELS as f64;
    let truth = (PIXELS as f64 * (scene.boundary - left)).clamp(0.0, 1.0);
    Ok(Some((scene.basins.pixel_shares(PIXELS)?.of(ZERO, pixel), truth)))
}

fn distance(scene: &TwoBasins, random: &SplitMix64) -> Measured {
    let x = scene.left_end * (0.6 + 0.4 * random.uniform(10));
    let found = scene.basins.distance_to_boundary(x, 1e-9);
    Ok(found.map(|found| (found.above, scene.boundary - x)))
}

/// Of the known part of basin 0.
fn within(scene: &TwoBasins, random: &SplitMix64) -> Measured {
    let size = 1e-4 + 0.1 * random.uniform(10);
    let truth = ((scene.left_end - (scene.boundary - size)) / scene.left_end).clamp(0.0, 1.0);
    let found = scene.basins.distances_to_boundary(ZERO, 1e-9).fraction_within(size);
    Ok(found.map(|bounds| (bounds, truth)))
}

/// The farthest state of basin 0 from the boundary is 0.
fn largest(scene: &TwoBasins, _: &SplitMix64) -> Measured {
    let found = scene.basins.distances_to_boundary(ZERO, 1e-9).largest();
    Ok(found.map(|(_, bounds)| (bounds, scene.boundary)))
}

/// From basin 0 to basin 1 of another boundary, as a fraction of the window.
fn tipping_fraction(scene: &TwoBasins, random: &SplitMix64) -> Measured {
    let after = two_basins(&SplitMix64::from_seed(random.bits(20)), (0.05, 0.95))?;
    let truth = (scene.boundary - after.boundary).max(0.0);
    Ok(Some((scene.basins.tipping_to(&after.basins)?.fraction(ZERO, ONE), truth)))
}

/// From basin 0 to basin 1 of another boundary.
fn tipping(scene: &TwoBasins, random: &SplitMix64) -> Measured {
    let after = two_basins(&SplitMix64::from_seed(random.bits(20)), (0.05, 0.95))?;
    let truth = (scene.boundary - after.boundary).max(0.0) / scene.boundary;
    let found = scene.basins.tipping_to(&after.basins)?.probability(ZERO, ONE);
    Ok(found.map(|bounds| (bounds, truth)))
}

/// All of them.
pub(crate) fn measure(trials: u64) -> Result<Vec<Row>, Error> {
    type Measure = fn(&TwoBasins, &SplitMix64) -> Measured;
    let all: [(&str, &str, Measure); 6] = [
        ("PixelShares::of", "pixels about the boundary", share),
        ("IntervalBasins::distance_to_boundary", "states of random places", distance),
        ("BoundaryDistances::fraction_within", "shocks of random size", within),
        ("BoundaryDistances::largest", "the whole basin", largest),
        ("Tipping::fraction", "to a boundary of random place", tipping_fraction),
        ("Tipping::probability", "to a boundary of random place", tipping),
    ];
    let row = |(name, scene, measure): (&'static str, &str, Measure)| {
        let scene = format!("boundary in an undecided gap, {scene}");
        repeat(name, scene, Promise::Certain, trials, |seed| {
            let random = SplitMix64::from_seed(seed);
            let found = measure(&two_basins(&random, (0.2, 0.8))?, &random)?;
            Ok(found.map(|(bounds, truth)| Trial::of_bounds(bounds, truth)))
        })
    };
    all.into_iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_from_intervals_always_contain_the_truth() {
        for row in measure(300).unwrap() {
            assert!(row.holds() && row.given == 300, "{row:?}");
            assert!(row.mean_half_width > 1e-5 && row.mean_half_width < 0.5, "{row:?}");
        }
    }
}
