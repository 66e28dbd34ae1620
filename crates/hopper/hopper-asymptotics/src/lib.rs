//! The passive hopper's lift-off map f near its fixed points α*_n, in powers of δ^{1/3} with δ = α − α*_n.
//!
//! ```text
//!   f(α* + δ) = α* + δ −    λ  δ^{4/3} + …       δ > 0: attracts, algebraically
//!   f(α* + δ) = α* + δ − 10 λ |δ|^{4/3} + …      δ < 0: repels
//!   λ = ¾ β μ (2α* − sin 2α*),   β = [6 (2α* − sin 2α*)/α*]^{1/3},   Δ ≈ λ⁻³
//! ```
//!
//! Δ is the length of the trap [α*, α* + Δ], from which no orbit escapes. The paper calls it the interval of
//! attraction; the usual name is trapping region. All numbers are dimensionless, as in `passive-hopper`.
//!
//! | item | role |
//! |---|---|
//! | [`Coefficients`] | β, λ, Δ and the leading-order map of a fixed point at a mass ratio |
//! | [`Form`] | the printed λ, or the corrected one |
//! | [`LEFT_FACTOR`] | the factor 10 |
//! | [`RightExpansion`], [`LeftExpansion`] | the map to higher orders on either side |
//! | [`ExpansionValue`] | a value of an expansion, with a bound on its error |
//! | [`Decay`] | the law of the algebraic approach, and the number of hops that it takes |
//! | [`FatouCoordinate`], [`Side`] | the number of hops along the slow side, counted continuously, with a bound |
//! | [`Phase`], [`Offset`] | its value, an integer of any size with a fraction; an offset such as 10⁻¹⁰⁰⁰ |
//! | [`Escape`] | the law of the escape to the left, the twin of [`Decay`] |
//! | [`SlowJump`], [`OutwardWalk`], [`HopCount`] | many hops jumped over, and single hops, in `f64` with bounds |
//! | [`fixed_point_series`], [`trap_length_series`] | α*_n for large n, and Δ_n for large λ |
//! | [`small_hop_loss`] | the map about α*_0 = 0 |
//!
//! ```
//! use hopper_asymptotics::{Coefficients, Form};
//! use passive_hopper::MassRatio;
//!
//! let printed = Coefficients::new(1, MassRatio::ONE, Form::Printed)?;
//! let corrected = Coefficients::new(1, MassRatio::ONE, Form::Corrected)?;
//! assert!((corrected.lambda - 3.616949794602146).abs() < 1e-14);
//! assert!((printed.trap_length() / corrected.trap_length() - 27.0 / 64.0).abs() < 1e-14);
//! # Ok::<(), hopper_asymptotics::Error>(())
//! ```
//!
//! # Accuracy
//! The coefficients are right to seven ulps. Every [`ExpansionValue`] has a bound on its error, which is proved in
//! `docs/theory.md`, section 14, for every fixed point and mass ratio. Input outside the range of that proof is an
//! error. The leading-order map of [`Coefficients`] has no range; its documentation states the next term.
//!
//! # Not here
//! - Values where no expansion holds: the exact map is in `passive-hopper`, the exact Δ in `hopper-basin`.
//!
//! # References
//! C. K. Reddy, R. Pratap, *Multimodal map and complex basin of attraction of a simple hopper*,
//! Phys. Rev. E, Sec. IV (cited as "paper"). The factor ¾ and the left side are derived in `docs/theory.md`, Theorem 35
//! and Theorem 36.

mod coefficients;
mod decay;
mod error;
mod expansion_value;
mod fatou;
mod fixed_point_series;
mod left_expansion;
mod local_map;
mod right_expansion;
mod small_alpha;
mod trap_length_series;

pub use coefficients::{Coefficients, Form};
pub use decay::Decay;
pub use error::Error;
pub use expansion_value::ExpansionValue;
pub use fatou::escape::Escape;
pub use fatou::fatou_coordinate::FatouCoordinate;
pub use fatou::hop_count::HopCount;
pub use fatou::local_hop_model::Side;
pub use fatou::offset::Offset;
pub use fatou::outward_walk::OutwardWalk;
pub use fatou::phase::Phase;
pub use fatou::slow_jump::SlowJump;
pub use fixed_point_series::{FIXED_POINT_REMAINDER, fixed_point_series};
pub use left_expansion::{LEFT_RANGE, LeftExpansion};
pub use local_map::LEFT_FACTOR;
/// An integer of any size, of the crate `num-bigint`.
pub use num_bigint::BigInt;
pub use right_expansion::{RIGHT_RANGE, RightExpansion};
pub use small_alpha::{SMALL_ALPHA_RANGE, SMALL_HOP_REMAINDER, small_hop_loss};
pub use trap_length_series::{SMALLEST_LAMBDA, TRAP_LENGTH_REMAINDER, trap_length_series};
