//! Proofs for hybrid systems, from their equations alone: flows, events, periodic orbits, basins.
//!
//! A result of this crate is a theorem, up to the arithmetic of the processor and the crates below it. What is not proved is
//! [`Undecided`], with the reason, the time and the states.
//!
//! ```
//! use hybrid_system::Equations;
//! use validated_dynamics::{SectionMap, ValidatedSystem, fixed_point};
//!
//! // A forced oscillator that hits a stop: x is at most 0.5, and the stop gives back 0.8 of the speed.
//! let oscillator = Equations::new(&["x", "v"], &[])
//!     .mode_text("free", &["v", "cos(1.3*t) - 0.1*v - x"])
//!     .rising_text("stop", "x - 0.5")
//!     .resets_text(&["x", "-0.8*v"]);
//! let system = ValidatedSystem::new(&oscillator)?;
//! // From the speed after an impact at the time s to those of the next impact, one period later.
//! let after = system.chart("free", &["v", "s"], &["0.5", "v", "s"])?;
//! let returns = SectionMap::new(&system, after, "stop", 1, &["v", "t - 2*pi/1.3"])?;
//! let orbit = fixed_point(&returns, &[-1.5, 0.16], &[])?;
//! assert!(orbit.is_attracting() && orbit.point[0].width() < 1e-12);
//! # Ok::<(), validated_dynamics::Error>(())
//! ```
//!
//! There is exactly one orbit with one impact a period in the box `orbit.unique_in`, and it is stable.
//!
//! | item | role |
//! |---|---|
//! | [`ValidatedSystem`] | a system by its [`Equations`](hybrid_system::Equations), with parameters that may be intervals |
//! | [`Chart`] | where runs begin: states as formulas of some variables |
//! | [`ValidatedRun`], [`ProvedEvent`], [`Limits`] | all states of a set, from event to event, with derivatives |
//! | [`Piece`] | a step of a run: the states at all times of it |
//! | [`EnclosedMap`]: [`SectionMap`], [`FormulaMap`] | maps of boxes: from a chart to an event, and formulas |
//! | [`fixed_point`], [`ProvedFixedPoint`], [`multipliers`] | fixed points that exist, and their multipliers in discs |
//! | [`Trap`] | a set that is led into itself, all of whose points converge to a fixed point |
//! | [`ProvedBasins`], [`ProvedCell`], [`ProvedFate`], [`Division`] | basins cell by cell |
//! | [`Certificate`] | a file of statements and of the numbers of their proofs, which another program confirms |
//! | [`divided`], [`halves`], [`Budget`] | any statement about a box, part by part |
//! | [`AffineSet`], [`Matrix`] | sets c + C r₀ + B r, and matrices of enclosures |
//!
//! # How
//! A step has a Taylor polynomial from the middle of the set, the derivatives of the polynomials on the whole set, and a remainder from a
//! box that is shown to hold all solutions of the step. The derivatives carry a set c + C r₀ + B r to the next one, so that a
//! box that turns and stretches stays narrow (R. J. Lohner, 1987). Derivatives with respect to the start are carried in the same way (P. Zgliczyński, *C¹ Lohner
//! algorithm*, 2002).
//!
//! Along a step each guard has such a polynomial too. All states cross a surface if the guard has one sign at a time, the other one at a later time, and a rate
//! of one sign between. The image on the surface is enclosed by its value from the middle and its derivatives, (I − f ∇g/(∇g·f)) V. An event is returned only if no
//! other guard can be zero before it.
//!
//! A mode flows on one side of a guard that resets, stops or leads to another mode. States on such a surface are known to be on it if this follows from how the
//! formulas are written: x is 0.5 on a chart whose x is 0.5, and stays so in a reset that leaves x alone.
//!
//! # Not here
//! Clocks (write a guard of the time), sliding modes, stiff systems, functions with kinks. Sets that are too wide: a box whose image folds is undecided until it is
//! divided. Bounds of second order, which would allow wider boxes.

mod basins;
mod cell_images;
mod cells;
mod certificate;
mod division;
mod enclosed_map;
mod event;
mod expansion;
mod fixed_point;
mod formula_map;
mod frame;
mod limits;
mod matrix;
mod mode_series;
mod multipliers;
mod oriented_box;
mod piece;
mod run;
mod section_map;
mod set;
mod start;
mod surface_image;
mod system;
mod trap;
mod tube;
mod undecided;
mod window;
mod windows;

pub use basins::{Progress, ProvedBasins, ProvedCell, ProvedFate};
pub use cells::MOST_SIDES;
pub use certificate::{Certificate, Target};
pub use division::{Budget, Divided, divided, halves};
pub use enclosed_map::{Carried, EnclosedMap, MapImage, StartSet};
pub use event::ProvedEvent;
pub use fixed_point::{ProvedFixedPoint, fixed_point};
pub use formula_map::FormulaMap;
pub use interval_arithmetic::Enclosure;
pub use limits::Limits;
pub use matrix::Matrix;
pub use multipliers::{Multiplier, multipliers};
pub use piece::Piece;
pub use run::ValidatedRun;
pub use section_map::SectionMap;
pub use set::AffineSet;
pub use start::Chart;
pub use system::ValidatedSystem;
pub use trap::Trap;
pub use undecided::{Error, Reason, Undecided};
pub use windows::Division;
