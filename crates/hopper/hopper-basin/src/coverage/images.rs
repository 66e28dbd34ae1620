//! Images of speeds, and of intervals of speeds, with rounding outwards.

use crate::error::Error;
use crate::traps::hump::Hump;
use basin_of_attraction::Interval;
use passive_hopper::{FixedPointSpeed, HopWithin, LiftOffMap, MassRatio, index_below};

/// The relative width that is added to an image, beyond its bound: for the rounding of sums, and for a hump whose
/// maximum and minimum coincide within rounding, where the map deviates from a monotone one by some ulps.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The image of a speed, or of all speeds of an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpeedImage {
    /// All images are in this interval.
    Within(f64, f64),
    /// The hopper is grounded from all speeds.
    Grounded,
    /// The hop is not decided, or the hopper is grounded from some speeds and not from others.
    Unknown,
}

impl SpeedImage {
    /// The images of an interval from those of two parts of its ends and extrema.
    pub fn with(self, other: Self) -> Self {
        match (self, other) {
            (SpeedImage::Within(low, high), SpeedImage::Within(other_low, other_high)) => {
                SpeedImage::Within(low.min(other_low), high.max(other_high))
            }
            (SpeedImage::Grounded, SpeedImage::Grounded) => SpeedImage::Grounded,
            _ => SpeedImage::Unknown,
        }
    }

    pub(crate) fn kind(self) -> std::mem::Discriminant<Self> {
        std::mem::discriminant(&self)
    }

    /// The length of the interval; 0 if there is none.
    pub(crate) fn width(self) -> f64 {
        match self {
            SpeedImage::Within(low, high) => high - low,
            _ => 0.0,
        }
    }

    pub(crate) fn middle(self) -> Option<f64> {
        match self {
            SpeedImage::Within(low, high) => Some(low.midpoint(high)),
            _ => None,
        }
    }

    fn of(hop: HopWithin) -> Self {
        match hop {
            HopWithin::Next { speed, error } => {
                let error = error + ROUNDING * speed;
                SpeedImage::Within(speed - error, speed + error)
            }
            HopWithin::Grounded => SpeedImage::Grounded,
            HopWithin::Inconclusive => SpeedImage::Unknown,
        }
    }
}

/// A speed with its image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImagedSpeed {
    /// The lift-off speed.
    pub speed: f64,
    /// Where the hop from it leads.
    pub reached: SpeedImage,
}

/// What a [sweep](crate::LapsSweep) asks of a map: images that hold for certain.
///
/// The map may be that of one mass ratio, or of all mass ratios of an interval: an image then holds for each of them.
pub trait SpeedImages {
    /// The image of one speed, above zero.
    fn of_speed(&self, speed: f64) -> SpeedImage;

    /// The images of all speeds between two speeds of one sweep.
    fn of_all_between(&self, a: &ImagedSpeed, b: &ImagedSpeed) -> SpeedImage;

    /// Images of intervals are bounds, which halving makes sharper. Where they are exact, a gap is divided at
    /// preimages alone.
    fn are_sharper_on_halves(&self) -> bool;

    /// Critical points, increasing: the sweep divides gaps there. With fewer of them more stays open.
    fn critical_points(&self) -> &[f64];

    /// The map is proved to rise from a speed up to the next fixed point.
    fn rises_up_to_fixed_point(&self, speed: f64) -> bool;
}

/// The images of the map at one mass ratio, where all its laps are known.
pub(crate) struct LapImages<'a> {
    map: &'a LiftOffMap,
    critical: Vec<f64>,
    /// The images of the critical points, with all speeds next to them.
    values: Vec<SpeedImage>,
}

/// The relative distance from a computed critical point within which the map may have its extremum, as for the ends
/// of laps: some thousand ulps, far more than their error.
const DISTANCE_FROM_CRITICAL: f64 = 1e-12;

/// For each hump up to the speed `top`, from hump 0: the part on which the map falls after contact, between a
/// maximum and a minimum; `None` where it only rises (docs/theory.md, Corollary 28).
///
/// # Errors
/// [`Error::Index`] for a speed beyond the humps of the library.
pub fn falling_laps(mass_ratio: MassRatio, top: f64) -> Result<Vec<Option<Interval>>, Error> {
    let falling = |n: u64| {
        let ends = Hump::new(n)?.falling(mass_ratio.mu())?;
        Ok(ends.map(|(left, right)| Interval { left, right }))
    };
    (0..=index_below(top)?).map(falling).collect()
}

impl<'a> LapImages<'a> {
    /// The images of speeds up to `top`.
    pub(crate) fn new(map: &'a LiftOffMap, top: f64) -> Result<Self, Error> {
        let falling = falling_laps(map.mass_ratio(), top)?;
        let ends = |lap: Interval| [lap.left, lap.right];
        let critical: Vec<f64> = falling.into_iter().flatten().flat_map(ends).collect();
        let value =
            |&speed: &f64| SpeedImage::of(map.hop_within(speed, DISTANCE_FROM_CRITICAL * speed));
        let values = critical.iter().map(value).collect();
        Ok(LapImages { map, critical, values })
    }
}

impl SpeedImages for LapImages<'_> {
    fn of_speed(&self, speed: f64) -> SpeedImage {
        SpeedImage::of(self.map.hop_within(speed, 0.0))
    }

    fn of_all_between(&self, a: &ImagedSpeed, b: &ImagedSpeed) -> SpeedImage {
        let low = a.speed * (1.0 - DISTANCE_FROM_CRITICAL);
        let high = b.speed * (1.0 + DISTANCE_FROM_CRITICAL);
        let first = self.critical.partition_point(|&speed| speed < low);
        let inside = self.critical[first..].iter().take_while(|&&speed| speed <= high).count();
        let values = &self.values[first..first + inside];
        values.iter().fold(a.reached.with(b.reached), |all, &value| all.with(value))
    }

    fn are_sharper_on_halves(&self) -> bool {
        false
    }

    fn critical_points(&self) -> &[f64] {
        &self.critical
    }

    fn rises_up_to_fixed_point(&self, speed: f64) -> bool {
        let first = speed * (1.0 - DISTANCE_FROM_CRITICAL);
        let Ok(n) = index_below(speed) else { return false };
        let end = FixedPointSpeed::new(n + 1).largest_below();
        !self.critical.iter().any(|&point| point >= first && point <= end)
    }
}
