//! How does a model become a map of states, whose attractors and basins `basin-of-attraction` finds?
//!
//! `formula_steps` is a map by formulas, `flow_steps` the motion of a field over some time, such as a period of a forcing. `family_steps` takes
//! any family of maps at a parameter, so also a section, and `execution_steps` any hybrid system over some time.

use crate::orbits::OrbitEnd;
use basin_of_attraction::Label;
use std::fmt;
use std::sync::Arc;

mod execution_steps;
mod family_steps;
mod flow_steps;
mod formula_steps;

pub use execution_steps::ExecutionSteps;
pub use family_steps::FamilySteps;
pub use flow_steps::FlowSteps;
pub use formula_steps::FormulaSteps;

/// The labels of the ends of orbits.
#[derive(Clone)]
struct EndLabels(Arc<dyn Fn(&OrbitEnd) -> Label + Send + Sync>);

/// Unless the caller says other ones: a surface that ends the run is a fate that is known.
impl Default for EndLabels {
    fn default() -> Self {
        EndLabels(Arc::new(|end| match end {
            OrbitEnd::Terminal(_) => Label::ESCAPED,
            _ => Label::UNDECIDED_MAP,
        }))
    }
}

impl fmt::Debug for EndLabels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("EndLabels")
    }
}
