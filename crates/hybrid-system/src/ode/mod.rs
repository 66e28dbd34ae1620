//! Flows given as ẋ = f(t, x) (feature `ode`).

mod chebyshev;
mod first_step;
mod flow;
mod integration;
mod scheme;
mod search;
mod step;
mod variation;
mod vector;
mod watch;

use first_step::first_step;
pub use flow::{integrated_crossing, integrated_flow};
pub use integration::{Integration, Tolerances};
pub use variation::{Linearized, integrated_jacobian};
