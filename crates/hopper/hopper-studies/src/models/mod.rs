//! Figures of the generic crates: how guards are met, what happens at surfaces, and example models.

mod eccentric_cylinder;
mod forced_oscillator;
mod guards;
mod published;
mod scene_panel;
mod semantics;
mod semantics_motion;
mod valve;

use crate::error::Error;
use crate::figure::Figure;
use crate::job::Job;

/// Computes and draws a figure.
pub(crate) type Draw = fn(&Job) -> Result<Figure, Error>;

/// All figures, by name.
pub(crate) const ALL: &[(&str, Draw)] = &[
    ("guards", guards::figure),
    ("semantics_instant", semantics::events_at_one_instant),
    ("semantics_touch", semantics::sliding_and_touches),
    ("semantics_motion", semantics_motion::figure),
    ("eccentric_cylinder", eccentric_cylinder::figure),
    ("forced_oscillator", forced_oscillator::figure),
    ("published", published::figure),
    ("valve", valve::figure),
];
