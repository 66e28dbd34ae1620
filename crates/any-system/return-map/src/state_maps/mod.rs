//! How does a model become a map of states, whose attractors and basins `basin-of-attraction` finds?
//!
//! `formula_steps` is a map by formulas, `flow_steps` the motion of a field over some time, such as a period of a forcing. `family_steps` takes
//! any family of maps at a parameter, so also a section, and `execution_steps` any hybrid system over some time.

use crate::orbits::OrbitEnd;
use basin_of_attraction::Label;

mod execution_steps;
mod family_steps;
mod flow_steps;
mod formula_steps;

pub use execution_steps::ExecutionSteps;
pub use family_steps::FamilySteps;
pub use flow_steps::FlowSteps;
pub use formula_steps::FormulaSteps;

/// The label of an end, unless the caller says another one: a surface that ends the run is a fate that is known.
fn label_of_end(end: &OrbitEnd) -> Label {
    match end {
        OrbitEnd::Terminal(_) => Label::ESCAPED,
        _ => Label::UNDECIDED_MAP,
    }
}
