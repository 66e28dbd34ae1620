//! Which maps depend on a parameter, and what are their derivatives?
//!
//! A [`MapFamily`] gives images, and the images of curves to third order (`family`). `closures` are functions of numbers,
//! whose derivatives are `differences`. `formula_map` has exact ones, and so have the
//! return maps of equations, `equation_returns`.

mod closures;
mod differences;
mod equation_returns;
mod family;
mod formula_map;

pub use closures::{Closure, family, pieces, scalar_family};
pub use equation_returns::EquationReturns;
pub use family::{Image, MapFamily};
pub use formula_map::FormulaMap;
