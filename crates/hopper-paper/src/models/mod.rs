//! Figures of the generic crates: how guards are met, and a published model of a valve.

mod guards;
mod valve;

use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;

/// Computes and draws a figure.
pub type Draw = fn(&Job) -> Result<Figure, Error>;

/// All figures, by name.
pub const ALL: &[(&str, Draw)] = &[("guards", guards::figure), ("valve", valve::figure)];
