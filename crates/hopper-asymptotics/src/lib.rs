//! The passive hopper's lift-off map near its lossless hops, in powers of δ^{1/3}.
//!
//! ```text
//!   f(α* + δ) = α* + δ −    λ  δ^{4/3} + …       δ > 0: attracts, algebraically
//!   f(α* + δ) = α* + δ − 10 λ |δ|^{4/3} + …      δ < 0: repels
//!   λ = ¾ β μ (2α* − sin 2α*),   β = [6 (2α* − sin 2α*)/α*]^{1/3},   Δ ≈ λ⁻³
//! ```
//!
//! | item | role |
//! |---|---|
//! | [`Coefficients`] | β, λ, Δ and the approximate map of a fixed point at a mass ratio |
//! | [`Form`] | the paper's λ, or the corrected one |
//! | [`LEFT_FACTOR`] | the 10 |
//! | [`RightExpansion`], [`LeftExpansion`], [`ExpansionValue`] | the map to higher orders on either side, with its error |
//! | [`Decay`] | the law of the algebraic approach, and the number of hops it takes |
//! | [`fixed_point_series`], [`trap_length_series`] | α*_n and Δ_n for large n |
//! | [`small_hop_loss`] | the map about α*_0 = 0 |
//!
//! ```
//! use hopper_asymptotics::{Coefficients, Form};
//! use passive_hopper::MassRatio;
//!
//! let printed = Coefficients::new(1, MassRatio::ONE, Form::Printed)?;
//! let corrected = Coefficients::new(1, MassRatio::ONE, Form::Corrected)?;
//! assert!((corrected.lambda - 3.616949794602146).abs() < 1e-14);
//! assert!((printed.delta() / corrected.delta() - 27.0 / 64.0).abs() < 1e-14);
//! # Ok::<(), hopper_asymptotics::Error>(())
//! ```
//!
//! # Accuracy
//! The coefficients are right to a few ulps. [`RightExpansion`] and [`LeftExpansion`] give every value with a bound on its
//! error, measured against the exact map in (n, δ), and refuse what lies outside the range of that
//! measurement; the leading-order map of [`Coefficients`] errs by the next term, which it states.
//!
//! # Not here
//! Values where no expansion holds: the exact map is in `passive-hopper`, exact Δ in `hopper-basin`.
//!
//! # References
//! C. K. Reddy, R. Pratap, *Multimodal map and complex basin of attraction of a simple hopper*,
//! Phys. Rev. E, Sec. IV; the factor ¾ and the left side are derived in `docs/model.md`.

mod coefficients;
mod decay;
mod error;
mod ladder;
mod left;
mod local_map;
mod right;
mod small_alpha;

pub use coefficients::{Coefficients, Form};
pub use decay::Decay;
pub use error::Error;
pub use ladder::{SMALLEST_LAMBDA, fixed_point_series, trap_length_series};
pub use left::{LEFT_RANGE, LeftExpansion};
pub use local_map::LEFT_FACTOR;
pub use right::{ExpansionValue, RIGHT_RANGE, RightExpansion};
pub use small_alpha::{SMALL_ALPHA_RANGE, small_hop_loss};
