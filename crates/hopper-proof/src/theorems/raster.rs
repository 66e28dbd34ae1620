//! The basins over a window of mass ratio and lift-off speed: every point of a raster, which is the middle of a pixel.

use crate::error::Error;
use crate::hop::proved_images::ProvedImages;
use crate::hop::strip::Strip;
use crate::line::ProvedLine;
use basin_of_attraction::{Grid, Label, LabelImage, raster_by_strips};
use hopper_basin::{HopperFate, ImagedSpeed, SpeedImage, SpeedImages};
use std::ops::ControlFlow;

/// Parts of a sweep, most speeds of each, and the share of each that may stay open. They affect the time, and how much stays open: points need
/// less than areas, because single points are followed further.
const PARTS: usize = 64;
const SPEEDS: usize = 4000;
const OPEN: f64 = 0.2;

/// Most hops of a single speed until it lies in a known interval.
const MOST_HOPS: usize = 2000;

/// The label of a point without a proof.
const WITHOUT_PROOF: Label = HopperFate::UNDECIDED_PRECISION;

/// The fate of one speed: its interval, or that of one of its images.
fn label_of(line: &ProvedLine, images: &ProvedImages, speed: f64) -> Label {
    let (mut low, mut high) = (speed, speed);
    for _ in 0..MOST_HOPS {
        if let Some(label) = line.label_of_all(low, high) {
            return label;
        }
        let image = if low == high {
            images.of_speed(low)
        } else {
            let end = |speed: f64| ImagedSpeed { speed, reached: images.of_speed(speed) };
            images.of_all_between(&end(low), &end(high))
        };
        match image {
            SpeedImage::Grounded => return HopperFate::GROUNDED,
            SpeedImage::Unknown => return WITHOUT_PROOF,
            SpeedImage::Within(from, to) => (low, high) = (from, to),
        }
    }
    WITHOUT_PROOF
}

/// The fate of every point of a raster that is proved; the others have the label [`HopperFate::UNDECIDED_PRECISION`]. `progress` is as for
/// [`raster_by_strips`].
///
/// # Errors
/// Those of [`ProvedLine::new`] and of [`raster_by_strips`].
pub fn proved_points(
    grid: Grid,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<LabelImage, Error> {
    let columns = |ratios: &[f64], speeds: &[f64]| {
        let column = |&ratio: &f64| {
            let strip = Strip::at(ratio)?;
            let line = ProvedLine::new(strip, grid.y, PARTS, OPEN, SPEEDS)?;
            let images = ProvedImages::new(strip, grid.y.right)?;
            Ok(speeds.iter().map(|&speed| label_of(&line, &images, speed)).collect())
        };
        ratios.iter().map(column).collect()
    };
    raster_by_strips(grid, 1, columns, progress)
}
