//! Return maps of hybrid systems: their periodic points, how these are born, change and end with a parameter, and what orbits do.
//!
//! ```text
//!     section ──start──► arc ─event─► arc ─event─► … ─event on the section──► image
//!     x ↦ f(x)                fixed point f(x*) = x*           periodic point fⁿ(x) = x
//! ```
//!
//! | item | role |
//! |---|---|
//! | [`Section`] | coordinates of a section: the state of a point, and which events are returns |
//! | [`ReturnMap`], [`Return`] | image, return time and number of events, in any dimension |
//! | [`SmoothSection`], [`SmoothReturn`] | the derivative of the map, through flows and events |
//! | [`fixed_points`], [`FixedPoint`] | transverse and tangent fixed points of a scalar map |
//! | [`periodic_point`], [`periodic_point_with_derivative`], [`PeriodicPoint`] | fixed and periodic points in any dimension, with their multipliers |
//! | [`one_sided_stability`] | attracting or repelling from the left or right, with its power law |
//! | [`MapFamily`], [`FormulaMap`], [`EquationReturns`] | maps that depend on a parameter: by formulas, as returns of `hybrid_system::Equations` |
//! | [`returns`], [`smooth_returns`], [`family`](fn@family), [`scalar_family`], [`pieces`] | the same as returns of any hybrid system, and by closures of numbers |
//! | [`ReturnEnds`] | the mode and the whole state behind a return: whether a map goes on as the flow does |
//! | [`watched`] | a map that counts its images and can be stopped: progress and interruption of everything below |
//! | [`follow_branch`], [`follow_equilibria`], [`Branch`] | how fixed points, periodic points and equilibria change with the parameter |
//! | [`Bifurcation`], [`BifurcationKind`] | where they are born, change and end, located on the branch, with normal forms |
//! | [`doubled_branch`], [`cascade`], [`bifurcation_curve`] | the branch behind a doubling, cascades, curves in two parameters |
//! | [`follow_behind`] | the branch on the other side of a border |
//! | [`continue_branch`] | goes on with a branch that was stopped, or read from a file (feature `serde`) |
//! | [`bifurcation_diagram`], [`periods`], [`lyapunov_exponents`], [`rotation_number`] | where orbits end over a parameter; how fast neighbours part; how fast orbits turn |
//! | [`orbit_fate`], [`orbit_fates`], [`OrbitEnd`] | how orbits end: on an attractor, at a surface, at a Zeno limit |
//! | [`FormulaSteps`], [`FlowSteps`], [`FamilySteps`], [`ExecutionSteps`] | maps of states for `basin-of-attraction`: of formulas, of a field over some time, of a section, of any hybrid system |
//! | [`PeriodicAttractor`], [`periodic_attractors`] | attracting orbits, each with a neighbourhood that leads to it |
//! | [`UnstableManifold`], [`ManifoldCurve`], [`manifold_crossings`], [`manifold_tangency`] | one-dimensional manifolds of saddles; homoclinic and heteroclinic points and tangencies |
//! | [`map_pieces`], [`MapPiece`], [`Extremum`] | a map of one variable: its domain, smooth pieces, borders, laps |
//! | [`ApproximateMap`] | the same map by polynomials: fast, with inverse branches and compositions |
//! | [`all_periodic_points`], [`all_equilibria`] | all points of a period, or equilibria, in one variable, with proofs |
//!
//! A ball keeps half of its speed at each bounce. The return map maps the speed after a bounce to the speed after the
//! next bounce:
//!
//! ```
//! use hybrid_system::*;
//! use nalgebra::{SVector, Vector2};
//! use return_map::{ReturnMap, Section};
//!
//! # #[derive(Debug, Clone, Copy, PartialEq, Eq)] struct Floor;
//! struct Ball;
//! # impl HybridSystem for Ball {
//! #     type State = State<2>;
//! #     type Mode = ();
//! #     type Surface = Floor;
//! #     fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
//! #         Vector2::new(x[0] + t * (x[1] - t / 2.0), x[1] - t)
//! #     }
//! #     fn guards(&self, _: ()) -> &[Guard<Floor>] { const { &[Guard::falling(Floor)] } }
//! #     fn guard_value(&self, _: Floor, x: &State<2>) -> f64 { x[0] }
//! #     fn reset(&self, _: (), _: Floor, x: &State<2>) -> Reset<(), State<2>> {
//! #         Reset::Jump { mode: (), state: Vector2::new(0.0, -0.5 * x[1]) }
//! #     }
//! # }
//! /// The section is the floor. Its coordinate is the speed after the bounce.
//! struct Bounce;
//! impl Section<Ball, 2, 1> for Bounce {
//!     fn point(&self, speed: &SVector<f64, 1>) -> ((), State<2>) {
//!         ((), Vector2::new(0.0, speed[0]))
//!     }
//!     fn coordinates(&self, event: &Event<(), Floor, State<2>>) -> Option<SVector<f64, 1>> {
//!         event.after.map(|(_, state)| SVector::<f64, 1>::new(state[1]))
//!     }
//! }
//!
//! let map = ReturnMap::new(&Ball, &Bounce, Limits::sampled(10.0, 10, 0.01));
//! let image = map.image(1.0)?.expect("the ball always returns");
//! assert!((image - 0.5).abs() < 1e-14);
//! # Ok::<(), return_map::Error>(())
//! ```
//!
//! # Accuracy
//! A return is as accurate as the crossings that the system computes, and says how certain it is that none was missed. Derivatives of
//! [`FormulaMap`] and [`EquationReturns`] are exact to the tolerance of the motion. Those of closures are differences of order six, which have
//! some twelve digits of the first derivative of a smooth map with values to rounding, and are refused below three.
//!
//! Each multiplier has an estimate of its error ([`BranchPoint::multiplier_errors`]), and each bifurcation one of its parameter
//! ([`Bifurcation::error`]). Near a double multiplier, and for orbits that stay long beside an unstable equilibrium, they are large.
//!
//! [`fixed_points`] and [`map_pieces`] find only what their samples reveal; [`all_periodic_points`] proves that there are no others.
//!
//! # Poincaré sections of plain flows
//! A plain flow is a hybrid system with one mode, and a guard whose reset keeps the state. The example `lorenz`
//! shows it for the Lorenz system, with the derivative.
//!
//! # Branches
//! A runner on a spring leg, by its equations, over the angle at which the leg is put down. The map is that from one apex to the next:
//!
//! ```
//! use return_map::{BifurcationKind, BranchSteps, EquationReturns, follow_branch};
//! use std::ops::ControlFlow::Continue;
//! let leg = example_systems::spring_leg::spring_leg();
//! // The coordinate is the height of the apex. The energy is that of 5 m/s at 1 m.
//! let apexes = EquationReturns::new(&leg, "attack", ("flight", "apex"), &["h"])?
//!     .starting_text(&["0", "h", "sqrt(25 + 2*gravity*(1 - h))", "0"])?
//!     .coordinates_text(&["height"])?;
//! let steps = BranchSteps { longest: 0.1, ..BranchSteps::default() };
//! let branch = follow_branch(&apexes, 1, (&[0.94], 68.0), (67.0, 69.0), steps, |_| Continue(()))?;
//! // Up to 68.85° the run is stable without any control.
//! let doubling = &branch.bifurcations[0];
//! assert_eq!(doubling.kind, BifurcationKind::Doubling);
//! assert!((doubling.at.parameter - 68.85).abs() < 0.01);
//! # Ok::<(), return_map::Error>(())
//! ```
//!
//! A step never passes to other pieces of the map. At a grazing, or where two events come at one instant, the branch ends in
//! [`BranchEnd::Border`] with the surface, and [`border_curve`] follows this end in a second parameter. For [`EquationReturns`] surfaces
//! that are touched and left again within one step are found, too: those of smooth guards, not the ticks of clocks. The example
//! `bifurcation_diagram` goes from equations to a picture.
//!
//! # Not here
//! - Manifolds of more than one dimension, invariant circles and tori; cycles of flows without a section.
//! - Proofs in more than one variable.

mod branches;
mod checks;
mod error;
mod events;
mod families;
mod manifolds;
mod multipliers;
mod orbits;
mod periodic_point;
mod return_map;
mod scalar;
mod section;
mod state_maps;

pub use branches::{
    Bifurcation, BifurcationCurve, BifurcationCurvePoint, BifurcationKind, Branch, BranchEnd,
    BranchPoint, BranchSteps, CurveEnd, bifurcation_curve, border_curve, branch_point, cascade,
    continue_branch, doubled_branch, follow_behind, follow_branch, follow_equilibria,
};
pub use error::Error;
pub use families::{
    Border, BorderSite, Clearance, Closure, EquationReturns, FormulaMap, Image, Linearized,
    MapFamily, Pushed, ReturnEnds, SmoothReturns, SystemReturns, family, pieces, returns,
    scalar_family, smooth_returns, watched,
};
pub use manifolds::{
    ManifoldCrossing, ManifoldCurve, ManifoldCut, ManifoldEnd, ManifoldSteps, ManifoldTangency,
    UnstableManifold, manifold_crossings, manifold_tangency,
};
pub use orbits::{
    DiagramColumn, LyapunovExponents, OrbitEnd, OrbitFate, OrbitLength, OrbitMean,
    PeriodicAttractor, RotationNumber, Seeds, bifurcation_diagram, lyapunov_exponents, orbit_fate,
    orbit_fates, periodic_attractors, periods, rotation_number,
};
pub use periodic_point::{PeriodicPoint, periodic_point, periodic_point_with_derivative};
pub use return_map::{Return, ReturnMap, SmoothReturn};
pub use scalar::{
    AllPeriodicPoints, ApproximateMap, Extremum, FixedPoint, Intersection, MapGap, MapPiece,
    MapPieces, OneSidedStability, ProvedPoint, Side, Stability, all_equilibria,
    all_periodic_points, fixed_points, map_pieces, one_sided_stability,
};
pub use section::{Section, SmoothSection};
pub use state_maps::{ExecutionSteps, FamilySteps, FlowSteps, FormulaSteps};
