//! How do functions of Python become formulas, and what can be done with them?
//!
//! ```text
//!   symbol ─► trace ─► equations ─► solution
//!                          ├──────► fates
//!                          ├──────► returns ─► steps
//!                          └──────► proofs ─► proved_basins
//! ```
//!
//! A `trace` makes `symbols` for the time, the state and the parameters, which `numpy_functions` accept. A function of Python is called once with them, and what it
//! returns are formulas as JSON. The `equations` of a model are made of them; a run of these is a `solution`, and the ends of many
//! runs are `fates`. `returns` are the map from a section to itself, and `steps` any map of states, for attractors and basins. `proofs` shows that a periodic orbit exists, and
//! `proved_basins` which starts come to it. No Python runs
//! meanwhile.

mod equations;
mod fates;
mod numpy_functions;
mod proofs;
mod proved_basins;
mod returns;
mod solution;
mod steps;
mod symbol;
mod trace;

pub(crate) use equations::{_equations, Equations};
pub(crate) use fates::Fates;
pub(crate) use proofs::_proved_orbit;
pub(crate) use proved_basins::{_proved_basins, ProvedBasins};
pub(crate) use returns::ReturnMap;
pub(crate) use solution::{_solution, Solution};
pub(crate) use steps::Steps;
pub(crate) use symbol::Symbol;
pub(crate) use trace::{Formulas, Trace};
