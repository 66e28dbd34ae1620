//! Which maps depend on a parameter, and what are their derivatives?
//!
//! A [`MapFamily`] gives images, and the images of curves to third order (`family`). `closures` are functions of numbers,
//! whose derivatives are `differences`. `formula_map` has exact ones, and so have the
//! return maps of equations, `equation_returns`, which `equation_ways` computes and `equation_family` makes a family. `system_returns` are those of
//! any hybrid system. `derivatives` are results with errors. `iterated` applies a map several times, `watched` counts its images and stops it.
//! `border` says what lies between pieces of a map,
//! and `equation_borders` finds it for equations, whose arcs `return_arcs` reads and whose formulas `formula_values` evaluates.

mod border;
mod closures;
mod derivatives;
mod differences;
mod equation_borders;
mod equation_family;
mod equation_returns;
mod equation_ways;
mod family;
mod formula_map;
mod formula_values;
mod iterated;
mod return_arcs;
mod return_ends;
mod system_returns;
mod watched;

pub use border::{Border, BorderSite, Clearance};
pub use closures::{Closure, family, pieces, scalar_family};
pub use derivatives::{Linearized, Pushed};
pub(crate) use differences::differences;
pub use equation_returns::EquationReturns;
pub use family::{Image, MapFamily};
pub use formula_map::FormulaMap;
pub(crate) use formula_map::check_without_time;
pub(crate) use iterated::{
    curve_after, first_difference, image_of, orbit_after, orbit_end, point_after,
};
pub use return_ends::ReturnEnds;
pub use system_returns::{SmoothReturns, SystemReturns, returns, smooth_returns};
pub use watched::watched;
