//! Basins of the passive hopper that are proved.
//!
//! | item | role |
//! |---|---|
//! | [`Strip`] | all mass ratios of an interval |
//! | [`ProvedImages`] | hops from all speeds of an interval, enclosed with rounding outwards |
//! | [`proved_trap`], [`Touch`] | traps and crises, enclosed |
//! | [`ProvedLine`] | the basins of a line of speeds, for all mass ratios of a strip |
//! | [`fixed_point`] | α*_n, enclosed |

mod error;
mod fixed_points;
mod hop;
mod line;
mod traps;

pub use error::Error;
pub use fixed_points::fixed_point;
pub use hop::proved_images::ProvedImages;
pub use hop::strip::Strip;
pub use line::ProvedLine;
pub use traps::{Touch, proved_trap};
