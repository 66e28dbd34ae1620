//! How is a flow computed that is only given as ẋ = f(t, x)? (feature `ode`)
//!
//! [`Integration`] takes the steps of a Runge–Kutta pair of Verner (`schemes`). Inside each step the state is a
//! polynomial (`step`, through values at the nodes of `chebyshev`). `search` follows all guards of a mode from step to
//! step, with one `followed_guard` for each. A `followed_guard` decides by `polynomial_test` whether a step contains a
//! crossing. A model calls `flow` and `variation`.
//!
//! A field that is a formula is followed by `taylor`. Both kinds of integration are a [`Stepping`](stepping::Stepping), and
//! the search knows no other difference than that guards along Taylor's polynomials are polynomials (`power_test`). Where many motions are followed side by side,
//! the first steps of an arc are known before (`ahead`).

mod ahead;
mod chebyshev;
mod first_step;
mod flow;
mod followed_guard;
mod inside_step;
mod integration;
mod inverse_root;
mod pass;
mod polish;
mod polynomial_test;
mod power_test;
mod rows;
mod schemes;
mod search;
mod special_steps;
mod step;
mod stepping;
mod steps;
mod taylor;
mod tolerances;
mod variation;
mod vector;

pub(crate) use ahead::Ahead;
pub(crate) use flow::last_time;
pub use flow::{integrated_crossing, integrated_flow, integrated_states};
pub use integration::Integration;
pub(crate) use taylor::{taylor_crossing, taylor_flow, taylor_states};
pub use tolerances::Tolerances;
pub use variation::{Linearized, integrated_jacobian, integrated_parameter_jacobian};
