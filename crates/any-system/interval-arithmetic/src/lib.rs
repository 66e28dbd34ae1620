//! Intervals that hold a real number for certain, their arithmetic, rounded outwards, and roots on certain brackets.
//!
//! | item | role |
//! |---|---|
//! | [`Enclosure`] | an interval that holds a number, or all values of a function |
//! | `+ − × ÷`, [`Enclosure::squared`], [`Enclosure::sqrt`] | arithmetic: the result holds every value of the operation |
//! | [`Enclosure::sin`], [`Enclosure::cos`], [`Enclosure::tan`], [`Enclosure::arctan`], [`Enclosure::asin`], [`Enclosure::acos`], [`Enclosure::atan2`] | functions of angles |
//! | [`Enclosure::exp`], [`Enclosure::ln`], [`Enclosure::powi`], [`Enclosure::powf`] | exponentials, logarithms and powers |
//! | [`Enclosure::sinh`], [`Enclosure::cosh`], [`Enclosure::tanh`], [`Enclosure::asinh`], [`Enclosure::acosh`], [`Enclosure::atanh`] | hyperbolic functions and their inverses |
//! | [`PI`] | an enclosure of π |
//! | [`exp()`], [`pow`] | of numbers, right also where the results are below 10⁻³⁰⁷ |
//! | [`bracketed_root`], [`root_beyond`] | the root of a function between two values of opposite sign, to about two ulps |
//! | [`golden_section_minimum`] | the minimum of a function of one variable |
//!
//! An operation is computed with rounding to nearest, and each end is then moved outwards by one `f64`. The exact
//! end lies within half an ulp of the rounded one, so the exact range lies inside. No rounding mode is set: the
//! bits are the same on every machine, and other threads are not affected. Functions come from pxfm, which claims half
//! an ulp; sines, cosines and arc tangents are moved by one `f64` as well, all others by two.
//!
//! ```
//! use interval_arithmetic::Enclosure;
//! let tenth = Enclosure::point(1.0)? / Enclosure::point(10.0)?;
//! let sum = (0..10).fold(Enclosure::ZERO, |sum, _| sum + tenth);
//! assert!(sum.contains(1.0)); // the rounded sum is 0.9999999999999999
//! assert!(sum.width() < 4e-15);
//! # Ok::<(), interval_arithmetic::Error>(())
//! ```
//!
//! The width of a result is not the width of the true range: `x − x` is not zero, because the two operands may be
//! different numbers. A narrow result needs narrow operands, a monotone function, or a bound on its derivative:
//! [`Enclosure::mean_value`] uses the last.

//! # Beside IEEE 1788
//! The standard for intervals (IEEE Std 1788-2015) is followed in what results hold, and differs in these:
//!
//! | case | the standard | here |
//! |---|---|---|
//! | an inverted interval | no interval (NaI) | [`Enclosure::between`] refuses it, [`Enclosure::new`] makes [`Enclosure::NONE`] |
//! | the empty set | an interval | there is none: two intervals without a common number have the [`intersection`](Enclosure::intersection) `None` |
//! | x ÷ [0, b] | [x/b, ∞] for x ≥ 0 | the same; and `[−∞, x/b]` for x ≤ 0 |
//! | x ÷ y with 0 inside y | all numbers | the same |
//! | x ÷ [0, 0] | empty | all numbers: nothing is known |
//! | a function of numbers outside of its domain too | of the part inside of it | `None`: no number is left out silently |
//! | tightness of + − × ÷ √ | tightest | accurate: each end is the rounded one, moved by one `f64` |
//! | tightness of sin, cos, arctan | accurate | an enclosure of a point is at most two ulps wide, as measured at 300 000 arguments each |
//! | tightness of other functions | accurate | four ulps, measured in the same way; 14 for powers below 10⁻³⁰⁷ |
//! | decorations, exception flags | yes | none |

mod bracketed_root;
mod elementary;
mod enclosure;
mod error;
mod functions;
mod golden_section;
mod operations;
mod powers;
mod rounding;
mod small_results;

pub use bracketed_root::{bracketed_root, root_beyond};
pub use enclosure::Enclosure;
pub use error::Error;
pub use functions::PI;
pub use golden_section::{INVERSE_GOLDEN_RATIO, golden_section_minimum};
pub use small_results::{exp, pow};
