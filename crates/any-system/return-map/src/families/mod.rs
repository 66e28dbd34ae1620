//! Which maps depend on a parameter, and what are their derivatives?
//!
//! A [`MapFamily`] gives images, and the images of curves to third order (`family`). `closures` are functions of numbers,
//! whose derivatives are `differences`. `formula_map` has exact ones, and so have the
//! return maps of equations, `equation_returns`. `iterated` applies a map several times.

mod closures;
mod differences;
mod equation_returns;
mod family;
mod formula_map;
mod iterated;

pub use closures::{Closure, family, pieces, scalar_family};
pub use equation_returns::EquationReturns;
pub use family::{Image, MapFamily};
pub use formula_map::FormulaMap;
pub(crate) use formula_map::check_without_time;
pub(crate) use iterated::{curve_after, first_difference, orbit_after, point_after};
