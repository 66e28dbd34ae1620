//! What happens on a surface at which the fields of both sides point?
//!
//! An execution recognises such a surface by the signs of two `rates` (`detection`), and its arc ends in a
//! `sliding_point`. [`Filippov`] makes a mode for the motion along the surface (feature `ode`):
//!
//! | question | file |
//! |---|---|
//! | What is ġ, and is its sign certain? | `rates`, by differences in `directional` |
//! | Which field is tangent to the surface? | `sliding_field` |
//! | Which point of the surface is next to a state? | `projection` |
//! | Which modes and surfaces does the wrapped system have? | `filippov_modes` |
//! | How does it move? | `filippov`, as a hybrid system `filippov_system`; its first event: `sliding_search` |
//! | What happens at other surfaces? | `crossing_while_sliding` |
//! | To which side does a free mode start at an exit? | `exit` |
//! | What are its derivatives? | `filippov_sensitivity` |

mod detection;
mod directional;
mod rates;
mod sliding_field;
mod sliding_point;

#[cfg(feature = "ode")]
mod crossing_while_sliding;
#[cfg(feature = "ode")]
mod exit;
#[cfg(feature = "ode")]
mod filippov;
#[cfg(feature = "ode")]
mod filippov_modes;
#[cfg(feature = "ode")]
mod filippov_sensitivity;
#[cfg(feature = "ode")]
mod filippov_system;
#[cfg(feature = "ode")]
mod projection;
#[cfg(feature = "ode")]
mod sliding_search;

pub(crate) use detection::{AtOnce, is_unchanged, sliding_point};
#[cfg(feature = "ode")]
pub(crate) use directional::slope_along;
#[cfg(feature = "ode")]
pub use filippov::Filippov;
#[cfg(feature = "ode")]
pub use filippov_modes::{FilippovMode, FilippovSurface};
pub use sliding_point::Sliding;
