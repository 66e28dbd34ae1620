//! (docs below)
mod double_double;
mod error;
mod flight;
mod landing;
mod lift_off_map;
mod lossless;
mod mass_ratio;

pub use double_double::DoubleDouble;
pub use error::Error;
pub use flight::HalfFlight;
pub use landing::{LARGEST_LIFT_OFF_SPEED, Landing, TakeOff};
pub use lift_off_map::{Hop, LiftOffMap, Landings, SUDDEN_LIFT_OFF_BUDGET};
pub use lossless::{alpha_star, index_below};
pub use mass_ratio::MassRatio;
