//! The fixed points tan α* = α*, enclosed.

use interval_arithmetic::{Enclosure, PI};
use passive_hopper::{FixedPointSpeed, alpha_star};
use std::sync::LazyLock;

/// How far the first enclosure reaches on both sides, over α*_n. The computed α*_n has an error of an ulp.
const FIRST_REACH: f64 = 1e-14;

/// An enclosure of α*_n, n ≥ 1; 0 for n = 0.
///
/// α ↦ (n+½)π − arctan(1/α) contracts, and α*_n is its fixed point (docs/theory.md, Lemma 6). An interval around
/// the computed α*_n that it maps into itself holds a fixed point; its image is narrower.
///
/// ```
/// let star = hopper_proof::fixed_point(1);
/// assert!(star.contains(4.493409457909064) && star.width() < 6e-15);
/// ```
pub fn fixed_point(n: u64) -> Enclosure {
    let stored = usize::try_from(n).ok().and_then(|n| FIRST.get(n));
    stored.copied().unwrap_or_else(|| enclosed(n))
}

/// The first ones are asked for at every hop.
static FIRST: LazyLock<[Enclosure; 64]> =
    LazyLock::new(|| std::array::from_fn(|n| enclosed(n as u64)));

fn enclosed(n: u64) -> Enclosure {
    if n == 0 {
        return Enclosure::ZERO;
    }
    let centre = PI * (n as f64 + 0.5);
    let image = |alpha: Enclosure| centre - (Enclosure::ONE / alpha).arctan();
    let computed = alpha_star(n);
    let first = Enclosure::around(computed, FIRST_REACH * computed);
    let second = image(first);
    // The image of (nπ, (n+½)π] lies in it, so that this always holds the fixed point.
    let safe = Enclosure::new((PI * n as f64).low(), (PI * (n as f64 + 0.5)).high());
    if second.is_inside(&first) { image(second) } else { safe }
}

/// Bound on the error of the 100 bits of α*_n, relative to α*_n (docs/theory.md, Lemma 65).
const ERROR_OF_LONG_VALUE: f64 = 7.9e-31;

/// α − α*_n for one speed: with all its digits, also where α and α*_n nearly coincide.
pub(crate) fn offset_from_fixed_point(alpha: f64, n: u64) -> Enclosure {
    if n == 0 {
        return Enclosure::from(alpha);
    }
    let star = FixedPointSpeed::new(n);
    let first = Enclosure::from(alpha) - star.value();
    // The difference of two doubles within a factor of 2 is exact (Sterbenz).
    let exact = alpha <= 2.0 * star.value() && star.value() <= 2.0 * alpha;
    let difference = alpha - star.value();
    let first = if exact { Enclosure::from(difference) } else { first };
    first - Enclosure::around(star.rest(), ERROR_OF_LONG_VALUE * star.value())
}
