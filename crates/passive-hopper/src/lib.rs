//! The passive hopper: two masses on one spring, plastic landings, no motor — and it can hop for ever.
//!
//! ```text
//!      ┌────┐ m₁      flight     (1+M) ÿ₁ = −M (y₁−y₂) − 1,   (1+M) ÿ₂ = (y₁−y₂) − 1
//!      └─┬──┘         landing    y₂ = 0, ẏ₂ < 0:  ẏ₂ → 0
//!        ⌇  k         contact    (1+M) ÿ₁ = −M y₁ − 1         until y₁ = 1
//!      ┌─┴──┐ m₂
//!      └────┘         lift-off at (1, α, 0, 0):   α′² = α² − μ Σ Γᵢ²,   μ = M/(1+M)²,  M = m₂/m₁
//!   ▔▔▔▔▔▔▔▔▔▔▔▔
//! ```
//!
//! All dynamics fall into the map α′ = f(α; M) from one gradual lift-off speed to the next. Lengths
//! are in units of m₂g/k, times of 1/ω with ω² = k(1+M)/m₂.
//!
//! | item | role |
//! |---|---|
//! | [`MassRatio`] | M = m₂/m₁, validated; μ, κ, 1/M |
//! | [`LiftOffMap`], [`Hop`], [`Landings`], [`Landing`] | the exact map in its stable form, hop by hop or landing by landing |
//! | [`LiftOffMap::images`], [`LiftOffMap::images_of_pairs`] | many hops at once, four times as fast, to the same bits |
//! | [`LocalHop`], [`LocalFlight`], [`Slopes`] | the hop in (n, δ), α = α*_n + δ; derivatives |
//! | [`printed_image`] | the same by the paper's Eqs. (6)–(8), for comparison |
//! | [`alpha_star`], [`FixedPointSpeed`], [`index_below`] | the fixed points tan α* = α*; to 100 bits; the one below a speed |
//! | [`Hopper`], [`Phase`], [`HopperSurface`], [`HopperState`] | both masses, as a [`hybrid_system::HybridSystem`] |
//! | [`Flight`], [`HalfFlight`], [`contact_flow`], [`contact_time`], [`lift_off_energy`] | the closed forms behind it |
//! | [`energy`], [`landing_loss`] | energy, and what a landing takes |
//! | [`PhysicalHopper`] | kilograms, metres and seconds to dimensionless and back |
//!
//! ```
//! use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
//!
//! let map = LiftOffMap::new(MassRatio::new(0.5)?);
//! let star = alpha_star(1);                  // 4.493409457909064
//! // Just above the lossless hop the loss is tiny, and the next hop still above it ...
//! let next = map.image(star + 0.01)?.expect("it hops again");
//! assert!(star < next && next < star + 0.01);
//! // ... just below it a sudden lift-off takes ten times as much.
//! assert_eq!(map.hop(star - 0.01)?.sudden, 1);
//! # Ok::<(), passive_hopper::Error>(())
//! ```
//!
//! # Accuracy
//! Every landing is bracketed by theory and solved in half its time of flight, to about an ulp as a
//! backward error in the speed. Against 3222 reference hops of 40 digits, random ones, extreme ones and
//! ones within 2⁻⁴⁸ of a change of branch, the error of α′ is at most 4 (1 + sudden lift-offs) of the unit
//! ε (|α′| + |∂α′/∂α| α + |∂α′/∂M| M + α²/|α′|), ε = 2⁻⁵³ (`cargo xtask check-reference`). Verdicts
//! (sudden or not, grounded or not) that 53 bits cannot give are computed with 106 to 1024; a hop that
//! needs more says so ([`Hop::certain`]). Near a fixed point [`LiftOffMap::hop_near_fixed_point`] keeps 8 ulps of δ
//! itself. Sines and cosines are correctly rounded, or our own to 1.2 ulps: the same bits on every x86-64 machine.
//!
//! # Speed
//! A hop of the paper's window takes as long as eight `f64::sin_cos`, or a quarter of that among many; `cargo xtask speed`
//! measures it. The first hop in a cell (nπ, (n+1)π) takes some milliseconds more: it makes the cell's table.
//!
//! # Not here
//! Integrators (every phase is closed-form), basins (`hopper-basin`), expansions
//! (`hopper-asymptotics`), lift-off speeds above 2⁴³, where an ulp of α is too coarse to name a phase.
//!
//! # References
//! C. K. Reddy, R. Pratap, *Multimodal map and complex basin of attraction of a simple hopper*,
//! Phys. Rev. E; A. Chatterjee, R. Pratap, C. K. Reddy, A. Ruina, *Persistent passive hopping and
//! juggling is possible even with plastic collisions*, Int. J. Robotics Res. 21 (2002).

mod error;
mod hopper;
mod kernel;
mod landing;
mod map;
mod model;
mod precision;

pub use error::Error;
pub use hopper::{Hopper, HopperSurface, Phase};
pub use landing::from_ground::{LARGEST_LIFT_OFF_SPEED, Landing, TakeOff};
pub use landing::half_flight::HalfFlight;
pub use map::lift_off_map::{Hop, Landings, LiftOffMap, SUDDEN_LIFT_OFF_BUDGET};
pub use map::near_fixed_point::{LocalFlight, LocalHop};
pub use map::printed::printed_image;
pub use map::slopes::Slopes;
pub use model::contact::{contact_flow, contact_time, lift_off_energy};
pub use model::energy::{energy, landing_loss};
pub use model::fixed_points::{FixedPointSpeed, alpha_star, index_below};
pub use model::mass_ratio::MassRatio;
pub use model::motion::Flight;
pub use model::state::HopperState;
pub use model::units::PhysicalHopper;
