//! Which Runge–Kutta scheme takes the steps?
//!
//! [`scheme_for`] chooses between J. H. Verner's "efficient" pairs of orders 9(8) (`nine`) and 8(7) (`eight`), both with
//! interpolants of order 8. `scheme` is the layout of their coefficients. The coefficients are not copied: they are
//! Verner's published digits, polished on the order conditions with 120 digits (`xtask/generators/verner.py`).
//!
//! # Rounding
//! A coefficient that is rounded to the nearest double is wrong by at most ε/2 of itself, ε = 2⁻⁵². The product of the
//! coefficient with a slope, which a step computes, is rounded by at most as much. More digits of the coefficients
//! therefore do not make a step more accurate, as long as products are rounded to doubles. There is one exception: the
//! rounding of a coefficient is the same in each step, so that its effects add up, while the roundings of products
//! change from step to step. The largest effect is that of a sum: rounded weights with Σ bᵢ ≠ 1 move even ẋ = const at
//! the wrong speed, and Σⱼ aᵢⱼ ≠ cᵢ puts a stage at the wrong place. Therefore the factor of the first stage is not
//! rounded from its own digits. It is the difference of the sum and all other rounded factors. No other condition
//! contains the weight b₁ of the first stage.
//!
//! The largest residuals of the order conditions, over all rooted trees:
//!
//! | pair | order | each number rounded | the first from the sum |
//! |---|---:|---:|---:|
//! | 9(8) | 9 | 3e-16 | 1e-16 |
//! | 9(8) | 8 | 4e-15 | 4e-16 |
//! | 8(7) | 8 | 8e-10 | 3e-11 |
//! | 8(7) | 7 | 8e-12 | 3e-13 |

mod eight;
mod nine;
mod scheme;
mod scheme_for;
#[cfg(test)]
mod order_tests;

pub(super) use scheme::{ALL_STAGES, Scheme};
pub(super) use scheme_for::scheme_for;
