//! The passive hopper: two masses on one spring with plastic landings. It has no motor, and can hop for ever.
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
//! The motion is described by one map, α′ = f(α; M), from one gradual lift-off speed to the next. Lengths are in
//! units of m₂g/k and times in units of 1/ω, with ω² = k(1+M)/m₂.
//!
//! | item | role |
//! |---|---|
//! | [`MassRatio`] | M = m₂/m₁, validated; μ, κ, 1/M |
//! | [`LiftOffMap`], [`Hop`], [`Landing`] | the exact map in its stable form, hop by hop or landing by landing |
//! | [`LiftOffMap::bounded_hop`], [`BoundedHop`] | a hop with bounds on the errors of its landings and of α′ |
//! | [`LiftOffMap::reference_hop`], [`ReferenceHop`], [`Solver`] | a hop in 106 to 1024 bits, and the errors of shorter ways against it |
//! | [`LiftOffMap::images`], [`LiftOffMap::images_of_pairs`] | many hops at once, four times as fast, to the same bits |
//! | [`LiftOffMap::images_into`], [`LiftOffMap::images_with_status`], [`HopStatus`] | the same for plain arrays, NaN for grounded |
//! | [`LiftOffMap::hop_within`], [`HopWithin`] | the hop of a speed that is known to within an error |
//! | [`ExtendedOrbit`], [`Arithmetic`], [`OrbitTangent`] | an orbit in 106 to 1024 bits, with a bound on its error; the orbits beside it |
//! | [`BoundedOrbit`], [`FollowedOrbit`] | an orbit in the shortest arithmetic that suffices, with a bound on the error of each speed |
//! | [`LocalHop`], [`LocalFlight`], [`Slopes`] | the hop in (n, δ), α = α*_n + δ; derivatives |
//! | [`printed_image`] | the map by the paper's Eqs. (6)–(8), for comparison |
//! | [`alpha_star`], [`FixedPointSpeed`], [`index_below`] | the fixed points tan α* = α*, as `f64` and to 100 bits; the index of the fixed point below a speed |
//! | [`HopperState`], [`Phase`] | positions and velocities of both masses, in flight or in contact |
//! | `Hopper`, `HopperSurface` | both masses as a system of the crate `hybrid-system`, with the feature of that name |
//! | [`Flight`], [`HalfFlight`], [`contact_flow`], [`contact_time`], [`lift_off_energy`] | flight and contact in closed form |
//! | [`energy`], [`landing_loss`] | energy, and the loss of a landing |
//! | [`PhysicalHopper`] | conversion between kilograms, metres, seconds and the dimensionless model |
//!
//! ```
//! use passive_hopper::{LiftOffMap, MassRatio, alpha_star};
//!
//! let map = LiftOffMap::new(MassRatio::new(0.5)?);
//! let star = alpha_star(1);                  // 4.493409457909064
//! // Just above the fixed point α*_1 the loss is small, and the next speed is still above α*_1.
//! let next = map.image(star + 0.01)?.expect("it hops again");
//! assert!(star < next && next < star + 0.01);
//! // Just below α*_1 the hop has a sudden lift-off, and its loss is ten times as large.
//! assert_eq!(map.hop(star - 0.01)?.sudden, 1);
//! # Ok::<(), passive_hopper::Error>(())
//! ```
//!
//! # Accuracy
//! Each landing lies in an interval with no other root (docs/theory.md, Theorem 7 and Theorem 12). The solver finds the
//! landing in half the time of flight, to about an ulp as a backward error in the speed. 3222 reference hops have 40
//! digits: random ones, extreme ones, and ones within 2⁻⁴⁸ of a change of branch. Against these references the error of
//! α′ is at most 4 (1 + sudden lift-offs) units of ε (|α′| + |∂α′/∂α| α + |∂α′/∂M| M + α²/|α′|), ε = 2⁻⁵³
//! (`cargo xtask check-reference`).
//!
//! [`LiftOffMap::bounded_hop`] gives bounds on the errors of a hop. `cargo xtask check-bounds` compares them with
//! the actual errors on ten million hops and fails if one exceeds its bound (docs/accuracy.md has the ratios).
//!
//! # Decisions
//! A *decision* of a hop (sudden or not, on which branch, grounded or not) is the sign of a computed number. The
//! methods of [`LiftOffMap`] return a result only if every decision of the hop is larger than the bound on its
//! error. If 53 bits do not suffice, the hop is computed with 106, and then with up to 1024 bits. If these do not
//! suffice either, or would take too long, the result is [`Error::Undecided`]. This holds for
//! [`hop`](LiftOffMap::hop), [`image`](LiftOffMap::image), [`images`](LiftOffMap::images),
//! [`images_of_pairs`](LiftOffMap::images_of_pairs), [`landings`](LiftOffMap::landings),
//! [`slopes`](LiftOffMap::slopes) and [`hop_near_fixed_point`](LiftOffMap::hop_near_fixed_point). [`printed_image`]
//! has no bounds: next to a change of branch it may decide wrongly.
//!
//! Near a fixed point [`LiftOffMap::hop_near_fixed_point`] gives δ′ to 8 ulps of δ′ itself. Sines and cosines come
//! from `pxfm`, correctly rounded, or from the kernel, to 2 ulps (docs/theory.md, Lemma 57). Results have the same
//! bits on every x86-64 machine.
//!
//! # Speed
//! A hop of the paper's window takes as long as eight `f64::sin_cos`, or a quarter of that among many hops; `cargo
//! xtask speed` measures it. The first hop in an interval (nπ, (n+1)π) takes some milliseconds more, because it
//! computes the table of that interval.
//!
//! # Not here
//! Integrators (every phase has a closed form), basins (`hopper-basin`), expansions (`hopper-asymptotics`),
//! lift-off speeds above [`LARGEST_LIFT_OFF_SPEED`] = 2⁴³, where neighbouring `f64` are too far apart to resolve
//! the spring's phase.
//!
//! # References
//! C. K. Reddy, R. Pratap, *Multimodal map and complex basin of attraction of a simple hopper*,
//! Phys. Rev. E; A. Chatterjee, R. Pratap, C. K. Reddy, A. Ruina, *Persistent passive hopping and
//! juggling is possible even with plastic collisions*, Int. J. Robotics Res. 21 (2002).

mod error;
mod evidence;
#[cfg(feature = "hybrid-system")]
mod hopper;
mod kernel;
mod landing;
mod map;
mod model;
mod precision;

pub use error::Error;
pub use evidence::bounded_hop::{BoundedHop, BoundedLanding, StateError};
pub use evidence::compared::Compared;
pub use evidence::enclosed::Enclosed;
pub use evidence::enclosed_hop::{EnclosedHop, EnclosedLanding};
pub use evidence::enclosed_state::{EnclosedStart, EnclosedState};
pub use evidence::enclosed_touch::{EnclosedTouch, enclosed_touch};
pub use evidence::function_errors::{SineErrors, sine_errors};
pub use evidence::reference_hop::{FirstFlightErrors, HopErrors, LandingErrors, ReferenceHop};
pub use evidence::reference_local_hop::{ReferenceLocalHop, ReferenceNumber};
pub use evidence::solver::Solver;
#[cfg(feature = "hybrid-system")]
pub use hopper::{Hopper, HopperSurface};
pub use landing::flight_ends::{Landing, TakeOff};
pub use landing::half_flight::HalfFlight;
pub use landing::local_flight::LocalFlight;
pub use landing::next_landing::MaximumTest;
pub use map::bounded_orbit::{BoundedOrbit, FollowedOrbit};
pub use map::extended_orbit::{Arithmetic, ExtendedOrbit, ExtendedStep, OrbitTangent};
pub use map::hop_within::HopWithin;
pub use map::lift_off_map::{Hop, LiftOffMap};
pub use map::limits::SUDDEN_LIFT_OFF_BUDGET;
pub use map::many_at_once::HopStatus;
pub use map::near_fixed_point::LocalHop;
pub use map::printed::printed_image;
pub use map::slopes::Slopes;
pub use model::contact::{contact_flow, contact_time, lift_off_energy};
pub use model::energy::{energy, landing_loss};
pub use model::fixed_points::{
    FixedPointSpeed, alpha_star, compare_with_multiple_of_pi, index_below,
};
pub use model::mass_ratio::MassRatio;
pub use model::motion::{Flight, LARGEST_LIFT_OFF_SPEED};
pub use model::phase::Phase;
pub use model::state::HopperState;
pub use model::units::{PhysicalHopper, UnitErrors};
