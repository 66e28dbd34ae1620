//! Which Runge–Kutta scheme takes the steps?
//!
//! [`scheme_for`] chooses between J. H. Verner's "efficient" pairs of orders 9(8) (`nine.in`), with an interpolant of
//! order 8, and 6(5) (`six.in`), with one of order 6. `scheme` is the layout of their coefficients. The coefficients
//! are not copied: they are Verner's published digits, polished on the order conditions with 120 digits
//! (`xtask/generators/verner.py`).
//!
//! # Rounding
//! Sums of slopes are computed from differences, with Σⱼ aᵢⱼ = cᵢ and Σ bᵢ = 1:
//!
//! ```text
//!   Σⱼ aᵢⱼ kⱼ = cᵢ k₀ + Σ aᵢⱼ (kⱼ − k₀)        Σ bᵢ kᵢ = k₀ + Σ bᵢ (kᵢ − k₀)        i, j ≥ 1
//! ```
//!
//! The differences are as small as the step is short, and with them the roundings of their products with the factors.
//! The factors a₁₀, b₀ are not needed, and the sums are right, however the other factors are rounded. The table stores
//! cᵢ, 1, 0 and s in their places.
//!
//! More digits of the other factors would not help. A factor rounded to the nearest double is wrong by at most ε/2 of
//! itself, ε = 2⁻⁵², and its product with a difference is rounded by as much.
#[cfg(test)]
mod order_tests;
mod scheme;
mod scheme_for;

pub(super) use scheme::{ALL_STAGES, Scheme};
pub(super) use scheme_for::scheme_for;
