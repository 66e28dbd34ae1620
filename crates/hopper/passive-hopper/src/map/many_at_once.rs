//! Many hops: in blocks of the kernel, or one by one if they are few.

use crate::error::Error;
use crate::kernel::batch::hop_block::HopBlock;
use crate::kernel::batch::rows::BLOCK;
use crate::map::hop_within::HopWithin;
use crate::map::lift_off_map::LiftOffMap;

/// Fewer hops than this are computed one by one.
///
/// A block has costs that do not depend on the number of hops: the array of tables, and passes over nearly empty lists.
/// With AVX-512 a block takes as long as single hops at 8 to 12 hops, and is a quarter faster at 16. Narrower vectors
/// need more hops. The results do not depend on this number.
const FEW: usize = 16;

impl LiftOffMap {
    /// Replaces each of `speeds` by its image, with the bits of [`image`](Self::image). A grounded hopper gives
    /// `None`, and `None` stays `None`.
    ///
    /// This is several times as fast as one hop after the other: flights of different hops share the lanes of the
    /// processor's vector unit (AVX-512, AVX2, or narrower).
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::new(0.2)?);
    /// let mut speeds = [Some(5.5), Some(7.0), None];
    /// map.images(&mut speeds)?;
    /// assert_eq!(speeds, [map.image(5.5)?, map.image(7.0)?, None]);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// The first error that [`image`](Self::image) gives for one of the speeds. A speed with an error stays as it is;
    /// all other speeds are replaced.
    pub fn images(&self, speeds: &mut [Option<f64>]) -> Result<(), Error> {
        let mut first = Ok(());
        images(speeds, |_| *self, |&speed| speed, |speed, next| replace(speed, next, &mut first));
        first
    }

    /// Writes the images of `speeds` into `images`, with the bits of [`image`](Self::image). A grounded hopper
    /// gives NaN, and NaN stays NaN. For callers whose numbers lie in plain arrays.
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::new(0.5)?);
    /// let mut images = [0.0; 3];
    /// map.images_into(&[5.5, 3.0, f64::NAN], &mut images)?;
    /// assert_eq!(Some(images[0]), map.image(5.5)?);
    /// assert_eq!(Some(images[1]).filter(|next| next.is_finite()), map.image(3.0)?);
    /// assert!(images[2].is_nan());
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Lengths`] for slices of different lengths; else the first error that [`image`](Self::image) gives
    /// for one of the speeds. The image of such a speed is NaN, and all other images are written.
    pub fn images_into(&self, speeds: &[f64], images: &mut [f64]) -> Result<(), Error> {
        let mut first = Ok(());
        self.each_image(speeds, images, |_, result| {
            result.unwrap_or_else(|error| {
                if first.is_ok() {
                    first = Err(error);
                }
                None
            })
        })?;
        first
    }

    /// As [`images_into`](Self::images_into), with the reason of each NaN: a hop that cannot be decided is a
    /// status, and no error.
    ///
    /// # Errors
    /// [`Error::Lengths`] for slices of different lengths; else the first error other than an undecided hop, after
    /// all images are written.
    pub fn images_with_status(
        &self,
        speeds: &[f64],
        images: &mut [f64],
        status: &mut [HopStatus],
    ) -> Result<(), Error> {
        check_lengths(speeds, status)?;
        status.fill(HopStatus::NoSpeed);
        let mut first = Ok(());
        self.each_image(speeds, images, |at, result| {
            status[at] = match &result {
                Ok(Some(_)) => HopStatus::LiftsOff,
                Ok(None) => HopStatus::Grounded,
                Err(Error::Undecided { .. } | Error::SuddenLiftOffBudget { .. }) => {
                    HopStatus::Undecided
                }
                Err(error) => {
                    if first.is_ok() {
                        first = Err(error.clone());
                    }
                    HopStatus::NoSpeed
                }
            };
            result.ok().flatten()
        })?;
        first
    }

    /// Writes the image of each speed, which `end` makes of the result at its place.
    fn each_image(
        &self,
        speeds: &[f64],
        images: &mut [f64],
        mut end: impl FnMut(usize, Result<Option<f64>, Error>) -> Option<f64>,
    ) -> Result<(), Error> {
        check_lengths(speeds, images)?;
        let mut block = [(0, 0.0); BLOCK];
        for (k, (speeds, written)) in speeds.chunks(BLOCK).zip(images.chunks_mut(BLOCK)).enumerate()
        {
            let entries = &mut block[..speeds.len()];
            for (at, (entry, &speed)) in entries.iter_mut().zip(speeds).enumerate() {
                *entry = (k * BLOCK + at, speed);
            }
            let speed = |entry: &(usize, f64)| (!entry.1.is_nan()).then_some(entry.1);
            self::images(
                entries,
                |_| *self,
                speed,
                |entry, next| {
                    entry.1 = end(entry.0, next).unwrap_or(f64::NAN);
                },
            );
            for (image, entry) in written.iter_mut().zip(entries) {
                *image = entry.1;
            }
        }
        Ok(())
    }

    /// Replaces each speed by its image under the map beside it, as [`images`](Self::images) does for one map. For
    /// many mass ratios with few speeds each.
    ///
    /// ```
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let [light, heavy] = [0.2, 0.8].map(|m| MassRatio::new(m).map(LiftOffMap::new));
    /// let (light, heavy) = (light?, heavy?);
    /// let mut hops = [(&light, Some(5.5)), (&heavy, Some(5.5)), (&heavy, None)];
    /// LiftOffMap::images_of_pairs(&mut hops)?;
    /// assert_eq!(hops.map(|hop| hop.1), [light.image(5.5)?, heavy.image(5.5)?, None]);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`images`](Self::images).
    pub fn images_of_pairs(hops: &mut [(&LiftOffMap, Option<f64>)]) -> Result<(), Error> {
        let mut first = Ok(());
        images(hops, |hop| *hop.0, |hop| hop.1, |hop, next| replace(&mut hop.1, next, &mut first));
        first
    }

    /// Replaces each `Next` by its hop under the map beside it, with the bits of [`hop_within`](Self::hop_within).
    /// All other entries stay as they are.
    ///
    /// ```
    /// use passive_hopper::{HopWithin, LiftOffMap, MassRatio};
    /// let map = LiftOffMap::new(MassRatio::new(0.2)?);
    /// let start = HopWithin::Next { speed: 5.5, error: 1e-12 };
    /// let mut hops = [(&map, start), (&map, HopWithin::Grounded)];
    /// LiftOffMap::hops_within(&mut hops);
    /// assert_eq!(hops.map(|hop| hop.1), [map.hop_within(5.5, 1e-12), HopWithin::Grounded]);
    /// # Ok::<(), passive_hopper::Error>(())
    /// ```
    pub fn hops_within(hops: &mut [(&LiftOffMap, HopWithin)]) {
        if hops.len() < FEW {
            for (map, hop) in hops {
                if let HopWithin::Next { speed, error } = *hop {
                    *hop = map.hop_within(speed, error);
                }
            }
            return;
        }
        HopBlock::of_this_thread(|block| {
            for entries in hops.chunks_mut(BLOCK) {
                // An entry without a speed enters the block with 0, as in `images`.
                let from = |&(map, hop): &(&LiftOffMap, HopWithin)| match hop {
                    HopWithin::Next { speed, error } => (speed, error, map.factors),
                    _ => (0.0, 0.0, map.factors),
                };
                block.hop_within(entries, from, |(map, hop), found| {
                    if let HopWithin::Next { speed, error } = *hop {
                        *hop = HopWithin::from_kernel(found)
                            .unwrap_or_else(|| map.signed_hop_within(speed, error));
                    }
                });
            }
        });
    }
}

/// How a hop ended, beside an image that is a plain number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum HopStatus {
    /// The hopper lifts off again: the image is a speed.
    LiftsOff = 0,
    /// The hopper is grounded.
    Grounded = 1,
    /// The hop cannot be decided with 1024 bits.
    Undecided = 2,
    /// There was no valid speed to hop from.
    NoSpeed = 3,
}

fn check_lengths<T>(speeds: &[f64], results: &[T]) -> Result<(), Error> {
    let (speeds, results) = (speeds.len(), results.len());
    if speeds == results { Ok(()) } else { Err(Error::Lengths { speeds, results }) }
}

/// Replaces a speed by its image. A speed with an error stays as it is, and the first error is noted.
fn replace(
    speed: &mut Option<f64>,
    next: Result<Option<f64>, Error>,
    first: &mut Result<(), Error>,
) {
    match next {
        Ok(next) => *speed = next,
        Err(error) if first.is_ok() => *first = Err(error),
        Err(_) => {}
    }
}

/// Gives `end` each entry that has a speed, with the image of this speed. `map` and `speed` read an entry.
fn images<H>(
    entries: &mut [H],
    map: impl Fn(&H) -> LiftOffMap,
    speed: impl Fn(&H) -> Option<f64>,
    mut end: impl FnMut(&mut H, Result<Option<f64>, Error>),
) {
    if entries.len() < FEW {
        for entry in entries {
            let Some(alpha) = speed(entry) else { continue };
            let next = map(entry).image(alpha);
            end(entry, next);
        }
        return;
    }
    HopBlock::of_this_thread(|block| {
        for entries in entries.chunks_mut(BLOCK) {
            // An entry without a speed enters the block with 0, which is not a valid speed. The block leaves it
            // undecided, and it is then skipped.
            let from = |entry: &H| (speed(entry).unwrap_or(0.0), map(entry).factors);
            block.hop(entries, from, |entry, next| {
                if next > 0.0 {
                    end(entry, Ok(Some(next)));
                } else if next < 0.0 {
                    end(entry, Ok(None));
                } else if let Some(alpha) = speed(entry) {
                    let next = map(entry).careful_image(alpha);
                    end(entry, next);
                }
            });
        }
    });
}
