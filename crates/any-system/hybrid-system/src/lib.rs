//! Hybrid dynamical systems: flows interrupted by events, followed without missing an event.
//!
//! ```text
//!    mode m:  x(t) = φ_m(t; x₀)   until   g(x) = 0   then   (m, x) ← reset(m, x)
//!
//!    hybrid time (t, j):   arc ──event──► arc ──event──► arc …      j counts the events
//! ```
//!
//! | item | role |
//! |---|---|
//! | `Equations` | a model by its equations, written once: events, exact derivatives, JSON (feature `ode`) |
//! | `Along`, `ExecutionJet` | derivatives of a whole execution, to any order (feature `ode`) |
//! | `SavedRun` | an execution of equations as a file, which another program goes on with (features `ode` and `serde`) |
//! | `ModeParts`, `GuardParts` | the formulas of equations, for programs that compute with other numbers (feature `ode`) |
//! | `Function`, `Label` | a function that equations call and a user brings; the name of a mode or a surface (feature `ode`) |
//! | [`Model`] | a model written with closures, in some 20 lines |
//! | [`HybridSystem`], [`System`] | the trait of a model: flow, guards, guard values, reset; a short name for it in signatures |
//! | [`Guard`], [`Direction`] | a switching surface, and the direction in which a crossing counts |
//! | [`Crossing`], [`Certainty`] | the first crossing, and how certain it is: exact, certain, interpolated or sampled |
//! | [`QuasiPolynomial`], [`FirstCrossing`] | guards as sums of polynomials times exponentials, sines and cosines; their first crossing, with certainty |
//! | [`Enclosure`] | bounds on a guard, given by the model |
//! | [`Execution`], [`Limits`], [`Stop`] | arcs one after the other, up to limits on time and events |
//! | [`Arc`], [`Event`], [`ArcEnd`] | the parts of an execution, with the states before and after each event |
//! | [`Trajectory`] | an execution as arrays: states on a grid of times, events in columns |
//! | [`Solution`] | an execution as a function of time, with its limits from both sides |
//! | [`many`], [`Fate`] | many runs at once, and where each one ends |
//! | [`Checkpoint`] | an execution between two arcs, to be restored or saved (feature `serde`) |
//! | [`PeriodicTimes`], [`PresetTimes`] | the times of clock guards |
//! | [`ZenoLimit`] | the limit of infinitely many events in finite time |
//! | [`Sliding`] | a point of a surface at which the fields on both sides point |
//! | `Backward` | a system backward in time (feature `ode`) |
//! | `Filippov` | a system that goes on along such surfaces (feature `ode`) |
//! | `integrated_flow`, `integrated_crossing` | modes given as ẋ = f(x) (feature `ode`) |
//! | `Integration`, `Tolerances` | solutions of ẋ = f(t, x), step by step (feature `ode`) |
//! | [`Differentiable`], [`sensitivity`], [`event_sensitivity`] | derivatives with respect to the start, through arcs and events (saltation) |
//! | [`jacobian_by_differences`], [`gradient_by_differences`], [`reset_by_differences`] | the derivatives of a model that has no formulas for them |
//! | [`Family`], [`Parametric`], [`parameter_sensitivity`], [`event_parameter_sensitivity`] | derivatives with respect to parameters |
//!
//! A ball that loses half of its speed at every bounce:
//!
#![cfg_attr(feature = "ode", doc = "```")]
#![cfg_attr(not(feature = "ode"), doc = "```ignore")]
//! use hybrid_system::{Certainty, Equations, State};
//!
//! let ball = Equations::new(&["height", "speed"], &[("restitution", "0.5")])
//!     .mode("flight", |t, x, _| [x[1], t.number(-1.0)])
//!     .falling("floor", |_, x, _| x[0])
//!     .resets(|t, x, p| [t.number(0.0), -p["restitution"] * x[1]])
//!     .model::<State<2>>()?;
//! let mut times = Vec::new();
//! for arc in ball.start("flight", [0.5, 0.0], 2.8)? {
//!     if let Some(event) = arc?.event() {
//!         assert_eq!(event.certainty, Certainty::Certain);
//!         times.push(event.time);
//!     }
//! }
//! // Dropped from ½ under unit gravity the ball lands after 1. Each flight is half as long as the one before.
//! assert_eq!(times.len(), 4);
//! for (time, exact) in times.iter().zip([1.0, 2.0, 2.5, 2.75]) {
//!     assert!((time - exact).abs() < 1e-14);
//! }
//! # Ok::<(), hybrid_system::Error>(())
//! ```
//!
//! More: [what happens at a surface](semantics), [sliding](sliding_motion), [the mathematics](mathematics), [which
//! certainty do I have?](certainty), [a model of your own in 20 lines](guide), and [models of legs](legged_models). In the examples `bouncing_ball`,
//! `plastic_landing` and `eccentric_cylinder` bodies come to rest on another one and are released; in
//! `dry_friction` a mass sticks to a belt.
//!
//! # Features
//! `ode`: models by their equations, modes given as ẋ = f(x), and sliding modes. `serde`: checkpoints, arcs and events, and with
//! `ode` runs of equations, can be saved and loaded. `parallel`: [`many`] runs on all processors. All are off by default.
//!
//! # Accuracy
//! Crossing times are as accurate as the model's own solution, or accurate to a few ulps by bracketing. A guard given
//! as a [`QuasiPolynomial`] or by [`Enclosure`]s is searched under bounds: no crossing is missed. If a guard starts at
//! zero, its derivatives decide to which side it leaves. If rounding hides the result, the search returns an error.
//! Along integrated flows guards are searched on polynomials, to the tolerances of the flow. The [`Certainty`] of a
//! crossing states whether it was found by sampling.
//!
//! # Speed
//! Executions of fixed dimension whose modes are integrated from closures allocate no memory, up to eight guards a mode, two
//! of them on their surfaces at once. Equations and quasi-polynomials allocate their coefficients. `cargo bench -p
//! hybrid-system --features ode` measures the cost of an event for each kind of guard.
//!
//! # Not here
//! Stiff integrators ([what to do](stiff)), differential-algebraic equations, sliding along several surfaces at
//! once. The sampled search returns an error, not a guess, for a guard that starts at zero and is beyond its
//! surface at the first sample.
//!
//! # References
//! R. Goebel, R. G. Sanfelice, A. R. Teel, *Hybrid Dynamical Systems*, Princeton (2012), for hybrid
//! time (t, j); R. I. Leine, H. Nijmeijer, *Dynamics and Bifurcations of Non-Smooth Mechanical Systems*,
//! Springer (2004), for saltation; J. H. Verner, *Numerically optimal Runge–Kutta pairs with interpolants*,
//! Numer. Algorithms 53 (2010). The pairs of the feature `ode` and their coefficients are his, from his
//! pages of 2024 (<https://www.sfu.ca/~jverner/>).

mod advance;
mod after_event;
mod arc;
mod arc_ends;
mod arrival;
#[cfg(feature = "ode")]
mod backward;
mod before_limit;
mod chain;
mod checkpoint;
#[cfg(feature = "serde")]
mod checkpoint_file;
mod clock;
mod condition;
mod condition_error;
#[cfg(feature = "serde")]
mod count;
mod crossing;
mod delay;
mod durations;
mod error;
mod execution;
mod fate;
#[cfg(feature = "ode")]
mod formulas;
mod guard;
#[cfg(feature = "ode")]
mod guard_table;
#[cfg(feature = "serde")]
mod infinite;
mod lands_beyond;
mod limits;
mod looked;
mod missed;
mod model;
mod next_event;
mod number;
#[cfg(feature = "ode")]
mod ode;
mod parameter_sensitivity;
mod point;
mod residues;
mod searched;
mod sensitivity;
mod series_fit;
mod sliding;
mod solution;
mod start_rule;
mod state;
mod system;
mod time_sum;
mod trajectory;
mod zeno;

pub use arc::{Arc, ArcEnd, Event};
#[cfg(feature = "ode")]
pub use backward::{Backward, BackwardSurface};
pub use checkpoint::Checkpoint;
pub use clock::{PeriodicTimes, PresetTimes};
pub use condition_error::ConditionError;
pub use crossing::{
    Certainty, Crossing, EventKind, FirstCrossing, Leaving, NextEvent, QuasiPolynomial,
    QuasiPolynomialPart, Search,
};
#[cfg(feature = "ode")]
pub use equations::{Expression, Function, Parameters, States};
pub use error::Error;
pub use execution::Execution;
pub use fate::{End, Fate, FateOf, many};
#[cfg(all(feature = "ode", feature = "serde"))]
pub use formulas::SavedRun;
#[cfg(feature = "ode")]
pub use formulas::{
    Along, Equations, EquationsModel, ExecutionJet, GuardParts, Label, ModeParts, Start, Turn,
};
pub use guard::{Direction, Guard, Role, Touch};
pub use interval_arithmetic::Enclosure;
pub use lands_beyond::LandsBeyond;
pub use limits::{Limits, Stop};
pub use looked::Looked;
pub use model::{
    Autonomous, Family, InTime, Model, OutcomeInTime, Untimed, gradient_by_differences,
    jacobian_by_differences, reset_by_differences,
};
#[cfg(feature = "ode")]
pub use ode::{
    Integration, Linearized, Tolerances, integrated_crossing, integrated_flow, integrated_jacobian,
    integrated_parameter_jacobian, integrated_states,
};
pub use parameter_sensitivity::{Parametric, event_parameter_sensitivity, parameter_sensitivity};
pub use searched::Searched;
pub use sensitivity::{Differentiable, arc_sensitivity, event_sensitivity, sensitivity};
pub use sliding::Sliding;
#[cfg(feature = "ode")]
pub use sliding::{Filippov, FilippovMode, FilippovSurface};
pub use solution::{Place, Solution};
pub use state::{State, StateVector};
pub use system::{HybridSystem, Reset, System, default_search};
pub use trajectory::{EventColumns, Trajectory};
pub use zeno::ZenoLimit;

/// The parts of a [`Model`]: each method of it adds one. A type of a model is seldom written, and `impl
/// HybridSystem` or a generic parameter does.
pub mod model_parts {
    #[cfg(feature = "ode")]
    pub use crate::formulas::{FormulaPart, TaylorMotion};
    #[cfg(feature = "ode")]
    pub use crate::model::Integrated;
    pub use crate::model::{
        Clock, ClosedForm, Condition, Field, GuardEnclosure, Jump, JumpEverywhere, ModelPart,
        Motion, Outcome, Rest, Signal, Slide, Terminal, Watch,
    };
}

#[doc = include_str!("../docs/mathematics.md")]
pub mod mathematics {}

#[doc = include_str!("../docs/semantics.md")]
pub mod semantics {}

#[doc = include_str!("../docs/certainty.md")]
pub mod certainty {}

#[doc = include_str!("../docs/sliding.md")]
pub mod sliding_motion {}

#[doc = include_str!("../docs/stiff.md")]
pub mod stiff {}

#[cfg_attr(feature = "ode", doc = include_str!("../docs/legged.md"))]
#[cfg_attr(not(feature = "ode"), doc = "Models of legs, with the feature `ode`.")]
pub mod legged_models {}

#[doc = include_str!("../docs/guide.md")]
pub mod guide {}
