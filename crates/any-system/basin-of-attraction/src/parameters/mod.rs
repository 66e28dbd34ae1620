//! What happens to attractors and basins when a parameter changes?
//!
//! `attractor_match` and `matching` recognise attractors, `common_labels` gives each one label. `fractions_along` refines a curve of parameters,
//! `attractors_along` searches along it, and `tipping` says where states go at a change.

pub(crate) mod attractor_match;
pub(crate) mod attractors_along;
pub(crate) mod common_labels;
pub(crate) mod fractions_along;
pub(crate) mod matching;
pub(crate) mod tipping;
