//! The terms 1/(A x) and c ln x of a Fatou coordinate to any number of digits, in integers.
//!
//! With A = 10λ/3 on the left and λ/3 on the right, λ = ¾ β μ · 2α³/(1+α²), β³ = 12α²/(1+α²) and μ = M/(1+M)², α = α*_n
//! (docs/theory.md, Section 16):
//!
//! ```text
//!   1/(A |δ|^{1/3}) = [(1+α²)⁴ (1+M)⁶/(1500 α¹¹ M³ |δ|)]^{1/3}       on the left; ten times as much on the right
//! ```
//!
//! and c = ∓(2 + v), where v = (1+α²) (1+M)²/(5 M α⁴) on the left, and ten times as much on the right. M and δ are
//! rational numbers. Only α*_n is not, and comes from tan α = α as α = q − arctan(1/α), q = (n+½)π.

use crate::fatou::local_hop_model::Side;
use crate::fatou::offset::Offset;
use crate::fatou::quotient::rational;
use num_bigint::{BigInt, BigUint};

/// The two terms: integers of any size, and fractions.
pub(crate) struct ExactTerms {
    pub(crate) whole: BigInt,
    /// The sum of the two fractions.
    pub(crate) fraction: f64,
}

/// Bits of the result after the point. 64 are kept; the others hold the errors of α*_n and of the truncated
/// quotient and root.
const FRACTION_BITS: u64 = 96;

/// Bits of α*_n beyond those that the result has, for the errors of its series: one unit for each of up to 10⁵ terms.
const GUARD_BITS: u64 = 32;

/// Bits of c after the point: ln |δ| has 15 bits before the point at most, and a fraction keeps 64.
const LOGARITHM_BITS: u64 = 128;

/// 1/(A x) + c ln x at |`delta`| = x³, not zero, where 1/(A x) is about 2^`size`. The error is that of the rounded
/// sum of the fractions, below 2ε, and |c|/3 times that of [`Offset::logarithm_in_units`].
pub(crate) fn exact_terms(
    n: u64,
    mass_ratio: f64,
    side: Side,
    delta: Offset,
    size: f64,
) -> ExactTerms {
    // A relative error of α*_n is at most its own size in the result: 11/3 − 8/3 = 1.
    let bits = size.max(0.0) as u64 + FRACTION_BITS + GUARD_BITS;
    let alpha = fixed_point(n, bits);
    let unit = BigUint::from(1u32) << bits;
    // (1+α²)⁴/α¹¹ = (u² + a²)⁴ u³/a¹¹ with α = a/u.
    let squares = &unit * &unit + &alpha * &alpha;
    let mut numerator = squares.pow(4) * unit.pow(3);
    let mut denominator = alpha.pow(11) * 1500u32;
    // (1+M)⁶/M³ = (p + q)⁶/(p q)³ with M = p/q.
    let (p, q) = rational(mass_ratio);
    let (sum, product) = (&p + &q, p * q);
    numerator *= sum.pow(6);
    denominator *= product.pow(3);
    // c = ∓(2 + v), in units 2^−LOGARITHM_BITS.
    let varying = (&squares * &unit * &unit * sum.pow(2)) << LOGARITHM_BITS;
    let varying = varying / (alpha.pow(4) * product * 5u32);
    let (tenfold, cube) = if side == Side::Left { (1u32, 1u32) } else { (10, 1000) };
    let c = BigInt::from((BigUint::from(2u32) << LOGARITHM_BITS) + varying * tenfold);
    let logarithms = if side == Side::Left { -c } else { c } * delta.logarithm_in_units() / 3;
    let (p, q) = rational(delta.mantissa().abs());
    numerator *= q;
    denominator *= p;
    let power = BigUint::from(10u32).pow(delta.exponent().unsigned_abs() as u32);
    if delta.exponent() < 0 {
        numerator *= power;
    } else {
        denominator *= power;
    }
    let scaled = ((numerator * cube) << (3 * FRACTION_BITS)) / denominator;
    let root = scaled.cbrt();
    let (whole, fraction) = parts(&root.into(), FRACTION_BITS);
    let (other, rest) = parts(&logarithms, LOGARITHM_BITS + Offset::LOGARITHM_BITS);
    ExactTerms { whole: whole + other, fraction: fraction + rest }
}

/// The integer below `units` · 2^−`bits` and the fraction, for at least 64 bits.
fn parts(units: &BigInt, bits: u64) -> (BigInt, f64) {
    let whole = units >> bits;
    let rest = (units - (&whole << bits)) >> (bits - 64);
    (whole, u64::try_from(rest).unwrap_or(0) as f64 * 0.5f64.powi(64))
}

/// α*_n 2^`bits`, n ≥ 1.
fn fixed_point(n: u64, bits: u64) -> BigUint {
    let unit = BigUint::from(1u32) << bits;
    // (n + ½) π, π = 16 arctan ⅕ − 4 arctan 1/239.
    let arc = |divisor: u32| arc_tangent(&(&unit / divisor), bits);
    let pi = arc(5) * 16u32 - arc(239) * 4u32;
    let q: BigUint = (pi * (2 * u128::from(n) + 1)) >> 1;
    let mut alpha = q.clone();
    // Newton's method on α − q + arctan(1/α), whose slope is α²/(1+α²). The start errs by 1/q < 0.22, and a step
    // squares the error.
    let mut right = 4;
    loop {
        let above = &alpha + arc_tangent(&((&unit << bits) / &alpha), bits);
        // The function is concave, so that α stays at or above the root after the first step.
        let scale = |step: BigUint| {
            let square = (&alpha * &alpha) >> bits;
            (step * (&unit + &square)) / square
        };
        let next =
            if above >= q { &alpha - scale(&above - &q) } else { &alpha + scale(&q - &above) };
        alpha = next;
        right *= 2;
        if right > bits + 4 {
            return alpha;
        }
    }
}

/// arctan x for 0 < x < ½, in units 2^−`bits`.
fn arc_tangent(x: &BigUint, bits: u64) -> BigUint {
    let square = (x * x) >> bits;
    let (mut power, mut odd) = (x.clone(), 1u64);
    let (mut plus, mut minus) = (BigUint::ZERO, BigUint::ZERO);
    while power != BigUint::ZERO {
        let term = &power / odd;
        if odd % 4 == 1 {
            plus += term;
        } else {
            minus += term;
        }
        power = (power * &square) >> bits;
        odd += 2;
    }
    plus - minus
}

#[cfg(test)]
mod tests {
    use super::*;
    use passive_hopper::{FixedPointSpeed, alpha_star};

    #[test]
    fn fixed_points_agree_with_their_first_hundred_bits() {
        for n in [1u64, 2, 10, 1000, 1 << 40] {
            let star = FixedPointSpeed::new(n);
            let long = fixed_point(n, 300);
            let (p, q) = rational(star.value());
            let high = (p << 300u32) / q;
            let (p, q) = rational(star.rest().abs());
            let low = (p << 300u32) / q;
            let stored = if star.rest() < 0.0 { high - low } else { high + low };
            let apart = if stored > long { stored - &long } else { &long - stored };
            // 2⁻⁹⁹ of the value.
            assert!(apart < long >> 99u32, "{n}");
        }
    }

    #[test]
    fn terms_agree_with_f64() {
        for (n, m, delta) in [(1, 1.0f64, 1e-12f64), (3, 0.2, 3e-9), (10, 50.0, 1e-5)] {
            let a = alpha_star(n);
            let mu = m / (1.0 + m).powi(2);
            let beta = pxfm::f_cbrt(12.0 * a * a / (1.0 + a * a));
            let lambda = 1.5 * beta * mu * a * a * a / (1.0 + a * a);
            let share = 3.0 * beta / (lambda * a);
            for (side, part, c) in
                [(Side::Left, 10.0, -2.0 - 0.1 * share), (Side::Right, 1.0, 2.0 + share)]
            {
                let found = exact_terms(n, m, side, Offset::from(delta), 30.0);
                let value = i64::try_from(found.whole).unwrap() as f64 + found.fraction;
                let exact =
                    3.0 / (part * lambda * pxfm::f_cbrt(delta)) + c * pxfm::f_log(delta) / 3.0;
                assert!((value / exact - 1.0).abs() < 2e-14, "{n} {m} {delta}: {value} {exact}");
            }
        }
    }
}
