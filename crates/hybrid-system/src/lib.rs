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
//! | [`Crossing`], [`Certainty`] | the first crossing, and how sure it is: exact, certain, interpolated or sampled |
//! | [`Enclosure`] | bounds on a guard that the model gives |
//! | [`Signal`], [`FirstCrossing`] | guards as sums of polynomials times sines: the first crossing with certainty, grazings told |
//! | [`Execution`], [`Limits`], [`Stop`] | arcs one after the other, bounded in time and events |
//! | [`Arc`], [`Event`], [`ArcEnd`] | what an execution consists of, with both one-sided states |
//! | [`Accumulation`] | infinitely many events in finite time (Zeno): the limit, and what follows |
//! | [`VectorField`], `integrated_flow`, `integrated_crossing` | modes given as ẋ = f(x) (feature `ode`) |
//! | `Integration`, `Tolerances` | solutions of ẋ = f(t, x), step by step (feature `ode`) |
//! | [`Differentiable`], [`sensitivity`], [`event_sensitivity`] | small changes of the start, through arcs and events (saltation) |
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
//! To read on: [flow, guard and reset](mathematics), [which certainty do I have?](certainty), and
//! [a model of one's own in 40 lines](guide). The examples `bouncing_ball` and `plastic_landing` have contact that
//! holds and lets go.
//!
//! # Accuracy
//! Crossing times are as exact as the model's own solution, or to a few ulps by bracketing. A guard
//! given as a [`Signal`] or by [`Enclosure`]s is searched under bounds: no crossing is missed, a start at
//! zero is left by its derivatives, and what rounding hides is an error. Along integrated flows guards are searched
//! on polynomials, to the flow's tolerances. A crossing found by sampling says so in its [`Certainty`].
//!
//! # Speed
//! Executions of fixed dimension with integrated modes allocate nothing; closed forms allocate for their signals.
//! `cargo bench -p hybrid-system` measures events by each means.
//!
//! # Not here
//! Stiff integrators, differential-algebraic equations, sliding along surfaces (a mode of its own can do it).
//! In the sampled search a start exactly on a surface that the flow then crosses within the first sample is an
//! error, not a guess.
//!
//! # References
//! R. Goebel, R. G. Sanfelice, A. R. Teel, *Hybrid Dynamical Systems*, Princeton (2012), for hybrid
//! time (t, j); R. I. Leine, H. Nijmeijer, *Dynamics and Bifurcations of Non-Smooth Mechanical Systems*,
//! Springer (2004), for saltation; J. H. Verner, *Numerically optimal Runge–Kutta pairs with interpolants*,
//! Numer. Algorithms 53 (2010).

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
mod searched;
mod sensitivity;
mod signal;
mod simultaneous;
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
pub use searched::Searched;
pub use sensitivity::{Differentiable, arc_sensitivity, event_sensitivity, sensitivity};
pub use signal::Signal;
pub use system::{HybridSystem, Reset, State, VectorField};

#[doc = include_str!("../docs/mathematics.md")]
pub mod mathematics {}

#[doc = include_str!("../docs/certainty.md")]
pub mod certainty {}

#[doc = include_str!("../docs/guide.md")]
pub mod guide {}
