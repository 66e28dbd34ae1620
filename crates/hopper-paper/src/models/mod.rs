//! Figures of the generic crates: how guards are met, and a model of somebody else's.

mod guards;
mod valve;

use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;

/// How a figure is made.
pub type Draw = fn(&Job) -> Result<Figure, Error>;

/// All figures, by name.
pub const ALL: &[(&str, Draw)] = &[("guards", guards::figure), ("valve", valve::figure)];
