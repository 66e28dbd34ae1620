//! Hybrid dynamical systems: flows interrupted by events, followed without missing one.
//!
//! ```text
//!    mode m:  x(t) = φ_m(t; x₀)   until   g(x) = 0   then   (m, x) ← reset(m, x)
//!
//!    hybrid time (t, j):   arc ──event──► arc ──event──► arc …      j counts the events
//! ```
//!
//! | item | role |
//! |---|---|
//! | [`HybridSystem`] | the trait: flow, guards, guard values, reset |
//! | [`Guard`], [`Direction`] | a switching surface, and the side from which a crossing counts |
//! | [`Crossing`], [`Certainty`] | the first crossing, and how sure it is: exact, certain or sampled |
//! | [`Signal`], [`FirstCrossing`] | guards as sums of polynomials times sines: the first crossing with certainty, grazings told |
//! | [`Execution`], [`Limits`], [`Stop`] | arcs one after the other, bounded in time and events |
//! | [`Arc`], [`Event`], [`ArcEnd`] | what an execution consists of, with both one-sided states |
//! | [`Accumulation`] | infinitely many events in finite time (Zeno): the limit, and what follows |
//! | `Integration`, `Tolerances` | flows given as ẋ = f(t, x), step by step (feature `ode`) |
//! | [`Differentiable`], [`sensitivity`] | small changes of the start, through arcs and events (saltation) |
//! | [`bracketed_root`] | Brent's method on a bracket that is certain |
//!
//! A ball that loses half of its speed at every bounce:
//!
//! ```
//! use hybrid_system::*;
//! use nalgebra::Vector2;
//!
//! #[derive(Debug, Clone, Copy, PartialEq, Eq)]
//! struct Floor;
//!
//! struct Ball { restitution: f64 }
//!
//! impl HybridSystem<2> for Ball {
//!     type Mode = ();
//!     type Surface = Floor;
//!     fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
//!         Vector2::new(x[0] + t * (x[1] - t / 2.0), x[1] - t)
//!     }
//!     fn guards(&self, _: ()) -> &[Guard<Floor>] {
//!         const { &[Guard::falling(Floor)] }
//!     }
//!     fn guard_value(&self, _: Floor, x: &State<2>) -> f64 {
//!         x[0]
//!     }
//!     fn reset(&self, _: (), _: Floor, x: &State<2>) -> Reset<(), 2> {
//!         Reset::Jump { mode: (), state: Vector2::new(0.0, -self.restitution * x[1]) }
//!     }
//! }
//!
//! let ball = Ball { restitution: 0.5 };
//! let limits = Limits::sampled(100.0, 3, 1e-2);
//! let mut times = Vec::new();
//! for arc in Execution::new(&ball, (), Vector2::new(0.5, 0.0), limits) {
//!     if let Some(event) = arc?.event() {
//!         times.push(event.time);
//!     }
//! }
//! // Dropped from ½ under unit gravity it lands after 1, and each flight is half as long.
//! for (time, exact) in times.iter().zip([1.0, 2.0, 2.5]) {
//!     assert!((time - exact).abs() < 1e-14);
//! }
//! # Ok::<(), Error>(())
//! ```
//!
//! # Accuracy
//! Crossing times are as exact as the model's own solution, or to about two ulps by bracketing. A guard
//! given as a [`Signal`] is searched under bounds on its derivatives: no crossing is missed, a start at
//! zero is left by its derivatives, and what rounding hides is an error. A crossing found by sampling
//! says so in its [`Certainty`].
//!
//! # Not here
//! Guards along integrated flows. In the sampled search a start exactly on a surface that the flow then
//! crosses within the first sample is an error, not a guess.
//!
//! # References
//! R. Goebel, R. G. Sanfelice, A. R. Teel, *Hybrid Dynamical Systems*, Princeton (2012), for hybrid
//! time (t, j); R. I. Leine, H. Nijmeijer, *Dynamics and Bifurcations of Non-Smooth Mechanical Systems*,
//! Springer (2004), for saltation.

mod accumulation;
mod arc;
mod bracketed_root;
mod certain_crossing;
mod crossing;
mod enclosure;
mod error;
mod execution;
mod guard;
#[cfg(feature = "ode")]
mod ode;
mod sensitivity;
mod signal;
mod system;

pub use accumulation::Accumulation;
pub use arc::{Arc, ArcEnd, Event};
pub use bracketed_root::bracketed_root;
pub use certain_crossing::FirstCrossing;
pub use crossing::{Certainty, Crossing};
pub use enclosure::Enclosure;
pub use error::Error;
pub use execution::{Execution, Limits, Stop};
pub use guard::{Direction, Guard};
#[cfg(feature = "ode")]
pub use ode::{
    Integration, Linearized, Tolerances, integrated_crossing, integrated_flow, integrated_jacobian,
};
pub use sensitivity::{Differentiable, arc_sensitivity, event_sensitivity, sensitivity};
pub use signal::Signal;
pub use system::{HybridSystem, Reset, State, VectorField};
