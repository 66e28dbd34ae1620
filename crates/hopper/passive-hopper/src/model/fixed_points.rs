//! The lossless hops: the fixed points α*_n of the map, the same for every mass ratio.

use crate::error::Error;
use crate::model::motion::LARGEST_LIFT_OFF_SPEED;
use crate::precision::double_double::DoubleDouble;
use crate::precision::real::Extended;
use std::cmp::Ordering;
use std::sync::OnceLock;

/// α*_n, the n-th positive root of tan α = α (paper, Eq. 3); α*_0 = 0.
///
/// The hop with this lift-off speed lands after τ = 2α*_n with closing speed zero, and repeats for ever. The value is
/// the `f64` nearest to the root; [`FixedPointSpeed`] has 100 bits of it.
///
/// From cot e = α with α = q − e, q = (n+½)π: α = q − arctan(1/α), a contraction by 1/(1+α²) (docs/theory.md, Lemma 6).
///
/// ```
/// use passive_hopper::alpha_star;
/// assert_eq!(alpha_star(1), 4.493409457909064);
/// assert_eq!(alpha_star(2), 7.725251836937707);
/// ```
pub fn alpha_star(n: u64) -> f64 {
    exact_alpha_star(n).high
}

/// α*_n to 100 bits. These bits decide on which side of α*_n a speed lies, and how far away it is, where the 53 bits of
/// an `f64` do not suffice.
///
/// ```
/// use passive_hopper::{FixedPointSpeed, alpha_star};
/// use std::cmp::Ordering;
/// let star = FixedPointSpeed::new(1);
/// assert_eq!(star.value(), alpha_star(1));
/// // The nearest f64 lies above α*_1, by far less than the spacing of f64 there, 8.9e-16.
/// assert_eq!(star.compare(star.value()), Ordering::Greater);
/// assert!(star.offset_of(star.value()) < 4e-17);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FixedPointSpeed(DoubleDouble);

/// Bound on the error of the 100 bits of α*_n, relative to α*_n: 2⁻¹⁰⁰. The theorem gives 2⁻¹⁰¹ (docs/theory.md,
/// Lemma 65).
const RELATIVE_ERROR: f64 = 7.9e-31;

impl FixedPointSpeed {
    /// α*_n; zero for n = 0.
    pub fn new(n: u64) -> Self {
        FixedPointSpeed(exact_alpha_star(n))
    }

    /// The `f64` nearest to α*_n.
    pub fn value(self) -> f64 {
        self.0.high
    }

    /// α*_n − [`value`](Self::value), at most half an ulp of it.
    pub fn rest(self) -> f64 {
        self.0.low
    }

    /// Bound on the error of [`value`](Self::value): half an ulp.
    pub fn error(self) -> f64 {
        self.0.low.abs() + RELATIVE_ERROR * self.0.high
    }

    /// [`offset_of`](Self::offset_of) `alpha`, with a bound on its error.
    pub fn bounded_offset_of(self, alpha: f64) -> (f64, f64) {
        let offset = self.offset_of(alpha);
        // Two sums round.
        (offset, f64::EPSILON * offset.abs() + RELATIVE_ERROR * self.0.high)
    }

    /// Compares the speed `alpha` with α*_n: `Less` if `alpha` lies below α*_n.
    pub fn compare(self, alpha: f64) -> Ordering {
        self.0.compare(alpha)
    }

    /// `alpha` − α*_n, rounded once.
    pub fn offset_of(self, alpha: f64) -> f64 {
        self.0.offset_of(alpha)
    }

    /// The smallest `f64` that is not below α*_n.
    pub fn smallest_not_below(self) -> f64 {
        if self.0.low > 0.0 { self.0.high.next_up() } else { self.0.high }
    }

    /// The largest `f64` below α*_n.
    pub fn largest_below(self) -> f64 {
        if self.0.low > 0.0 { self.0.high } else { self.0.high.next_down() }
    }
}

/// α*_n to 100 bits. The first 128 values, speeds up to 400, are computed once and stored.
pub(crate) fn exact_alpha_star(n: u64) -> DoubleDouble {
    static FIRST: OnceLock<[DoubleDouble; 128]> = OnceLock::new();
    let first = FIRST.get_or_init(|| std::array::from_fn(|n| solve(n as u64)));
    first.get(n as usize).copied().unwrap_or_else(|| solve(n))
}

fn solve(n: u64) -> DoubleDouble {
    if n == 0 {
        return DoubleDouble::ZERO;
    }
    // n + ½ in two parts, each exact as an f64: the lowest 26 bits with the ½, and the bits above them, of which an f64
    // holds 53. From 2⁷⁹ on two parts would not suffice; a u64 is smaller.
    let low = n & ((1 << 26) - 1);
    let q = DoubleDouble::multiple_of_pi((n - low) as f64)
        + DoubleDouble::multiple_of_pi(low as f64 + 0.5);
    let mut alpha = q;
    // A step shrinks the error by 1 + α² ≥ 21. From q, whose error is below 0.22, 24 steps reach 21⁻²⁴ · 0.22 < 2⁻¹⁰⁶.
    for _ in 0..24 {
        let next = q - arc_tangent(DoubleDouble::ONE / alpha);
        if next == alpha {
            break;
        }
        alpha = next;
    }
    alpha
}

/// arctan x = x − x³/3 + x⁵/5 − …, for 0 < x < ¼; 1/α*_n < 0.223.
fn arc_tangent(x: DoubleDouble) -> DoubleDouble {
    let minus_square = -x.squared();
    let (mut power, mut sum, mut odd) = (x, x, 1.0);
    // 10⁻³⁴ < 2⁻¹¹²: terms below it do not change the 106 bits of the sum.
    while power.high.abs() > 1e-34 * x.high {
        power = power * minus_square;
        odd += 2.0;
        sum = sum + power / DoubleDouble::from(odd);
    }
    sum
}

/// α*_n in the arithmetic `R`, by Newton's method on sin a = a cos a from 100 bits. At the root the slope of sin a − a
/// cos a is a sin a.
pub(crate) fn fixed_point_in<R: Extended>(n: u64) -> R {
    let exact = exact_alpha_star(n);
    let mut a = R::from(exact.high) + exact.low;
    if n == 0 {
        return a; // the slope is 0
    }
    for _ in 0..R::STEPS_FROM_100_BITS {
        let (sin, cos) = a.sin_cos();
        a = a - (sin - a * cos) / (a * sin);
    }
    a
}

/// n π to 100 bits. A first flight from this speed lasts n periods of the spring and lands at stretch one.
pub(crate) fn n_pi(n: u64) -> DoubleDouble {
    DoubleDouble::multiple_of_pi(n as f64)
}

/// Compares the speed `alpha` with nπ, in 100 bits: `Less` if `alpha` lies below it; `None` if these bits do not tell.
pub fn compare_with_multiple_of_pi(alpha: f64, n: u64) -> Option<Ordering> {
    let offset = n_pi(n).offset_of(alpha);
    (offset.abs() > RELATIVE_ERROR * alpha).then(|| offset.total_cmp(&0.0))
}

/// The largest n with α*_n ≤ `alpha`.
///
/// The decision uses 100 bits: an `alpha` one ulp below α*_n belongs to n − 1.
///
/// # Errors
/// [`Error::LiftOffSpeed`] unless `alpha` is zero or positive and finite,
/// [`Error::LiftOffSpeedTooLarge`] above 2⁴³.
pub fn index_below(alpha: f64) -> Result<u64, Error> {
    if !(alpha >= 0.0) || !alpha.is_finite() {
        return Err(Error::LiftOffSpeed { value: alpha });
    }
    if alpha > LARGEST_LIFT_OFF_SPEED {
        return Err(Error::LiftOffSpeedTooLarge { value: alpha, largest: LARGEST_LIFT_OFF_SPEED });
    }
    // α*_n ∈ (nπ, (n+½)π): the result is ⌊α/π⌋ or one less. The rounded quotient may be one too small, hence + 1.
    let mut n = (alpha / std::f64::consts::PI) as u64 + 1;
    while n > 0 && exact_alpha_star(n).compare(alpha) == Ordering::Less {
        n -= 1;
    }
    Ok(n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::long::Long;
    use crate::precision::real::Real;

    /// α*_n to 50 digits, computed independently (mpmath).
    const REFERENCE: &str = include_str!("../../tests/data/fixed_points.json");

    #[test]
    fn agrees_with_fifty_digits() {
        let rows: Vec<serde_json::Value> = serde_json::from_str(REFERENCE).unwrap();
        assert!(rows.len() >= 33);
        for row in rows {
            let n = row["n"].as_u64().unwrap();
            let text = row["alpha_star"].as_str().unwrap();
            let ours = exact_alpha_star(n);
            assert_eq!(ours.high, text.parse::<f64>().unwrap(), "n = {n}");
            // The whole number, from the decimal digits: integer part and 40 digits of the fraction.
            let (whole, fraction) = text.split_once('.').unwrap();
            let mut exact = DoubleDouble::from(whole.parse::<f64>().unwrap());
            for (place, chunk) in fraction.as_bytes().chunks(10).take(4).enumerate() {
                let digits: f64 = std::str::from_utf8(chunk).unwrap().parse().unwrap();
                let mut term = DoubleDouble::from(digits);
                let digits_so_far = 10 * place + chunk.len();
                for _ in 0..digits_so_far {
                    term = term / DoubleDouble::from(10.0);
                }
                exact = exact + term;
            }
            let error = ours - exact;
            assert!(error.high.abs() < 1e-29 * ours.high, "n = {n}: off by {:e}", error.high);
        }
    }

    #[test]
    fn index_is_right_on_both_sides_of_every_fixed_point() {
        for n in 1..2000 {
            let star = exact_alpha_star(n);
            let (below, above) = if star.low < 0.0 {
                (star.high.next_down(), star.high)
            } else {
                (star.high, star.high.next_up())
            };
            assert_eq!(index_below(below), Ok(n - 1));
            assert_eq!(index_below(above), Ok(n));
        }
        assert_eq!(index_below(0.0), Ok(0));
        assert_eq!(index_below(4.0), Ok(0));
        assert!(index_below(f64::NAN).is_err() && index_below(1e300).is_err());
    }

    /// tan α* = α*, with α* computed in another way (arctangents), to 30 digits.
    #[test]
    fn sines_at_the_fixed_points() {
        for n in [1, 2, 10, 1000] {
            let star = exact_alpha_star(n);
            let (sin, cos) = star.sin_cos();
            let rest = sin - star * cos;
            assert!(rest.high.abs() < 1e-28 * star.high, "{n}: {}", rest.high);
        }
    }

    /// tan α* = α* to the last digits of 1024 bits.
    #[test]
    fn fixed_points_to_a_thousand_bits() {
        for n in [1, 2, 1000, 1 << 40] {
            let a: Long<16> = fixed_point_in(n);
            let (sin, cos) = a.sin_cos();
            let rest = ((sin - a * cos) / (a * a)).nearest().abs();
            assert!(rest < Long::<16>::EPSILON, "{n}: {rest:e}");
            assert_eq!(a.nearest(), alpha_star(n));
        }
    }

    #[test]
    fn multiples_of_pi_are_compared_beyond_their_last_bit() {
        let pi = std::f64::consts::PI;
        assert_eq!(compare_with_multiple_of_pi(pi, 1), Some(Ordering::Less));
        assert_eq!(compare_with_multiple_of_pi(pi.next_up(), 1), Some(Ordering::Greater));
        assert_eq!(compare_with_multiple_of_pi(0.0, 0), None);
    }

    #[test]
    fn huge_indices_give_finite_values() {
        for n in [1 << 40, 1 << 50, u64::MAX] {
            assert!(alpha_star(n).is_finite());
        }
    }
}
