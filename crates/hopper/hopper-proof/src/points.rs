//! The fates of single speeds at one mass ratio.

use crate::error::Error;
use crate::hop::proved_images::ProvedImages;
use crate::hop::strip::Strip;
use crate::traps::proved_trap;
use basin_of_attraction::{Interval, Label};
use hopper_basin::{HopperFate, ImagedSpeed, SpeedImage, SpeedImages};
use passive_hopper::{alpha_star, index_below};

/// Most hops of a speed until it lies in a trap. In 16 columns of each of Figs 6 and 9 no point needs more than 23.
/// With fewer, more speeds next to fixed points stay without a proof; with more, these take longer.
const MOST_HOPS: usize = 500;

/// The label of a speed without a proof.
const WITHOUT_PROOF: Label = HopperFate::UNDECIDED_PRECISION;

/// The fate of one speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointFate {
    /// Its label; [`HopperFate::UNDECIDED_PRECISION`] without a proof.
    pub label: Label,
    /// The width of the last enclosure of the orbit, as a part of its speed: 10⁻¹⁶ has all digits, and 1 has none. In the trap itself it is 0.
    pub spread: f64,
}

/// Proves the fates of single speeds at one mass ratio: the orbit is enclosed hop by hop until a proved trap
/// contains it.
///
/// ```
/// use hopper_basin::HopperFate;
/// use hopper_proof::ProvedPoints;
/// let mut points = ProvedPoints::new(0.2)?;
/// assert_eq!(points.label(7.0)?, HopperFate::Decaying.label());
/// assert_eq!(points.label(4.55)?, HopperFate::label_of_fixed_point(1));
/// # Ok::<(), hopper_proof::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct ProvedPoints {
    images: ProvedImages,
    /// The traps that an orbit came to, by humps; `None` for one that is not proved.
    traps: Vec<(u64, Option<Interval>)>,
}

impl ProvedPoints {
    /// For the speeds at one mass ratio.
    ///
    /// # Errors
    /// [`Error::MassRatios`] unless it is positive and finite.
    pub fn new(mass_ratio: f64) -> Result<Self, Error> {
        let images = ProvedImages::of_points(Strip::at(mass_ratio)?);
        Ok(ProvedPoints { images, traps: Vec::new() })
    }

    /// The fate of one speed, the same in any order of the speeds. [`HopperFate::UNDECIDED_PRECISION`] if no proof
    /// is found in 500 hops, or with 53 bits.
    ///
    /// # Errors
    /// [`Error::Speeds`] unless the speed is from 0 to α*_n of the largest label.
    pub fn label(&mut self, speed: f64) -> Result<Label, Error> {
        Ok(self.fate(speed)?.label)
    }

    /// The fate of one speed, and how wide the enclosure of its orbit is in the end.
    ///
    /// # Errors
    /// As [`label`](Self::label).
    pub fn fate(&mut self, speed: f64) -> Result<PointFate, Error> {
        let largest = alpha_star(HopperFate::LARGEST_LABEL);
        let (mut low, mut high) = (speed, speed);
        if !(speed >= 0.0 && speed <= largest) {
            return Err(Error::Speeds { low, high, largest });
        }
        for _ in 0..MOST_HOPS {
            let n = index_below(low)?;
            let fate =
                |label| Ok(PointFate { label, spread: (high - low) / high.max(f64::MIN_POSITIVE) });
            if self.trap(n)?.is_some_and(|trap| trap.left <= low && high <= trap.right) {
                return fate(HopperFate::label_of_fixed_point(n));
            }
            let image = if low == high {
                self.images.of_speed(low)
            } else {
                let end = |speed: f64| ImagedSpeed { speed, reached: self.images.of_speed(speed) };
                self.images.of_all_between(&end(low), &end(high))
            };
            match image {
                SpeedImage::Grounded => return fate(HopperFate::GROUNDED),
                SpeedImage::Unknown => return fate(WITHOUT_PROOF),
                SpeedImage::Within(from, to) => (low, high) = (from, to),
            }
        }
        Ok(PointFate { label: WITHOUT_PROOF, spread: f64::INFINITY })
    }

    /// The trap of hump n, if it is proved.
    fn trap(&mut self, n: u64) -> Result<Option<Interval>, Error> {
        if let Some((_, known)) = self.traps.iter().find(|(own, _)| *own == n) {
            return Ok(*known);
        }
        let found = match proved_trap(n, self.images.strip()) {
            Ok(trap) => Some(trap),
            Err(Error::Open { .. }) => None,
            Err(error) => return Err(error),
        };
        self.traps.push((n, found));
        Ok(found)
    }
}
