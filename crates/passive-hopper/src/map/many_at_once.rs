//! Many hops: at once if they are many.

use crate::error::Error;
use crate::kernel::batch::bulk::{BLOCK, Block};
use crate::kernel::scalar::hop::hop;
use crate::map::lift_off_map::LiftOffMap;

/// Fewer go one by one.
const FEW: usize = 16;

/// The images of `hops`, whose `map` and `speed` are those of an entry; and the first error.
pub(crate) fn images<H>(
    hops: &mut [H],
    map: impl Fn(&H) -> LiftOffMap,
    speed: impl Fn(&H) -> Option<f64>,
    place: impl Fn(&mut H) -> &mut Option<f64>,
) -> Result<(), Error> {
    let mut first = Ok(());
    let mut careful = |hop: &mut H| {
        let Some(alpha) = speed(hop) else { return };
        match map(hop).careful_image(alpha) {
            Ok(next) => *place(hop) = next,
            Err(error) if first.is_ok() => first = Err(error),
            Err(_) => {}
        }
    };
    if hops.len() < FEW {
        for entry in hops {
            let Some(alpha) = speed(entry) else { continue };
            match hop(alpha, map(entry).masses) {
                Some(decided) => *place(entry) = decided.next(),
                None => careful(entry),
            }
        }
        return first;
    }
    Block::of_this_thread(|block| {
        for some in hops.chunks_mut(BLOCK) {
            let from = |hop: &H| (speed(hop).unwrap_or(0.0), map(hop).masses);
            block.hops(some, from, |hop, next| {
                if next > 0.0 {
                    *place(hop) = Some(next);
                } else if next < 0.0 {
                    *place(hop) = None;
                } else {
                    careful(hop);
                }
            });
        }
    });
    first
}
