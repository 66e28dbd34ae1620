//! Many hops: in blocks of the kernel, or one by one if they are few.

use crate::error::Error;
use crate::kernel::batch::hop_block::HopBlock;
use crate::kernel::batch::rows::BLOCK;
use crate::kernel::scalar::hop::kernel_hop;
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
        images(speeds, |_| *self, |&speed| speed, |speed| speed)
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
        images(hops, |hop| *hop.0, |hop| hop.1, |hop| &mut hop.1)
    }

    /// Replaces each `Next` by its hop under the map beside it, with the bits of [`hop_within`](Self::hop_within). All other
    /// entries stay as they are.
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

/// Replaces the speed of each entry by its image, and returns the first error. `map` and `speed` read an entry. `image`
/// gives access to the speed that is replaced.
fn images<H>(
    entries: &mut [H],
    map: impl Fn(&H) -> LiftOffMap,
    speed: impl Fn(&H) -> Option<f64>,
    image: impl Fn(&mut H) -> &mut Option<f64>,
) -> Result<(), Error> {
    let mut first_error = Ok(());
    let mut careful = |entry: &mut H| {
        let Some(alpha) = speed(entry) else { return };
        match map(entry).careful_image(alpha) {
            Ok(next) => *image(entry) = next,
            Err(error) if first_error.is_ok() => first_error = Err(error),
            Err(_) => {}
        }
    };
    if entries.len() < FEW {
        for entry in entries {
            let Some(alpha) = speed(entry) else { continue };
            match kernel_hop(alpha, map(entry).factors) {
                Some(decided) => *image(entry) = decided.next(),
                None => careful(entry),
            }
        }
        return first_error;
    }
    HopBlock::of_this_thread(|block| {
        for entries in entries.chunks_mut(BLOCK) {
            // An entry without a speed enters the block with 0, which is not a valid speed. The block leaves it
            // undecided, and `careful` then skips the entry.
            let from = |entry: &H| (speed(entry).unwrap_or(0.0), map(entry).factors);
            block.hop(entries, from, |entry, next| {
                if next > 0.0 {
                    *image(entry) = Some(next);
                } else if next < 0.0 {
                    *image(entry) = None;
                } else {
                    careful(entry);
                }
            });
        }
    });
    first_error
}
