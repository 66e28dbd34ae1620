//! How is a hybrid system given by Python callables, and run?
//!
//! ```text
//!   guards ─► model ─► execution ─► arcs
//!               │          │
//!             names     callables: states to NumPy and back, exceptions
//! ```
//!
//! A `model` is what a user has given, with the `names` of its modes and its `guards`. During one call a `callables` object is the
//! hybrid system of the library: it calls the functions, and keeps the first exception. An `execution` is an iterator over `arcs`.

mod arcs;
mod callables;
mod execution;
mod guards;
mod model;
mod names;
mod quasi_polynomial;
mod vectors;

pub(crate) use arcs::{Event, HybridArc, Sliding, Zeno};
pub(crate) use execution::Execution;
pub(crate) use guards::{Clock, Guard};
pub(crate) use model::HybridSystem;
pub(crate) use quasi_polynomial::QuasiPolynomial;
pub(crate) use vectors::vector;
