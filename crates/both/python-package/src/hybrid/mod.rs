//! How is a hybrid system given by Python callables, and run?
//!
//! ```text
//!   guards, names ─► model ─► callables ─► arcs ─► execution ─► system
//! ```
//!
//! A `model` is what a user has given to a `system`, with the `names` of its modes and its `guards`. During one
//! call a `callables` object is the hybrid system of the library: it calls the functions, turns `vectors` to arrays
//! of NumPy and back, calls a `c_function` without the interpreter, and keeps the first exception. A `c_system`, all of whose functions are of C, is a hybrid system
//! without Python. An `execution` is an iterator over `arcs`; a `trajectory` has them as arrays, also of an
//! `arc_list`. `derivatives` go
//! through arcs and events. A `sliding` point is one of a surface at which the fields on both sides point, and a
//! `sliding_mode` the motion along it.

mod arc_list;
mod arcs;
mod c_function;
mod c_system;
mod callables;
mod derivatives;
mod execution;
mod guards;
mod model;
mod names;
mod quasi_polynomial;
mod sliding;
mod sliding_mode;
mod system;
mod trajectory;
mod vectors;

pub(crate) use arc_list::{arc_states, arc_trajectory};
pub(crate) use arcs::{Event, HybridArc, Zeno, certainty};
pub(crate) use c_function::{CField, CFunction, CGuard};
pub(crate) use c_system::CSystem;
pub(crate) use derivatives::{event_sensitivity, sensitivity};
pub(crate) use execution::Execution;
pub(crate) use guards::{Clock, Guard};
pub(crate) use quasi_polynomial::QuasiPolynomial;
pub(crate) use sliding::Sliding;
pub(crate) use sliding_mode::SlidingMode;
pub(crate) use system::HybridSystem;
pub(crate) use trajectory::{stop_name, trajectory_arrays};
pub(crate) use vectors::{numbers, state_rows, vector};
