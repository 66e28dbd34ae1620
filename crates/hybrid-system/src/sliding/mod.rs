//! What happens on a surface at which the fields of both sides point?
//!
//! `detection` decides whether an execution ends at such a surface. `sliding_point` describes the end of an arc at such a surface.

mod detection;
mod sliding_point;

pub(crate) use detection::{AtOnce, sliding_point};
pub use sliding_point::Sliding;
