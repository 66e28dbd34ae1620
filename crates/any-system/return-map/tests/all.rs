//! All tests of the crate, in one program.

mod beside_borders;
mod borders;
mod branch_ends;
mod branches;
mod broken_promises;
mod curve_ends;
mod example_picture;
mod flows;
mod known_answers;
mod manifolds;
mod manifolds_of_flows;
mod multiplier_errors;
mod orbits;
mod scalar_maps;
mod scalar_tools;
mod sections;
mod starts_on_the_section;
mod state_maps;
mod system_returns;
mod walkers;
mod watched;
