//! Quotients of integers of any size, rounded to `f64`.

use num_bigint::BigUint;

/// A positive `f64` as a quotient of integers.
pub(crate) fn rational(value: f64) -> (BigUint, BigUint) {
    let bits = value.to_bits();
    let field = bits >> 52 & 0x7ff;
    let fraction = bits & ((1 << 52) - 1);
    let mantissa = if field == 0 { fraction } else { fraction | 1 << 52 };
    let exponent = field.max(1) as i64 - 1075;
    let (one, mantissa) = (BigUint::from(1u32), BigUint::from(mantissa));
    if exponent < 0 {
        (mantissa, one << exponent.unsigned_abs())
    } else {
        (mantissa << exponent.unsigned_abs(), one)
    }
}

/// The `f64` nearest to p/q, or one next to it if that is below the smallest normal number; ∞ above the largest
/// one, 0 for p = 0. q is not zero.
pub(crate) fn nearest_quotient(p: &BigUint, q: &BigUint) -> f64 {
    // p/q = digits · 2^−shift with 64 or 65 bits before the point of the digits.
    let shift = q.bits() as i64 - p.bits() as i64 + 64;
    let size = shift.unsigned_abs();
    let (p, q) = if shift < 0 { (p.clone(), q << size) } else { (p << size, q.clone()) };
    let whole = &p / &q;
    // One more bit says whether there is a rest: the rounding to 53 bits then knows on which side of a tie the
    // quotient is.
    let rest = u128::from(&whole * q != p);
    let digits = u128::try_from(whole).unwrap_or(u128::MAX) << 1 | rest;
    times_power_of_two(digits as f64, -shift - 1)
}

/// In two steps: each power is an `f64` where the product is one.
fn times_power_of_two(value: f64, power: i64) -> f64 {
    let power = power.clamp(-2000, 2000) as i32;
    let half = power / 2;
    value * 2f64.powi(half) * 2f64.powi(power - half)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_the_quotient_of_its_integers() {
        for value in [1.0, 0.1, 3e300, f64::MIN_POSITIVE, 5e-324, f64::MAX, 1.0 / 3.0] {
            let (p, q) = rational(value);
            assert_eq!(nearest_quotient(&p, &q).to_bits(), value.to_bits(), "{value:e}");
        }
    }

    #[test]
    fn a_quotient_is_rounded_once() {
        let big = |value: u64| BigUint::from(value);
        let third = nearest_quotient(&big(1), &big(3));
        assert_eq!(third.to_bits(), (1.0f64 / 3.0).to_bits());
        // Halfway between two neighbours the even one; a little above it the upper one.
        let tie = (BigUint::from((1u64 << 53) + 1)) << 200u32;
        assert_eq!(nearest_quotient(&tie, &(big(1) << 200u32)), 2f64.powi(53));
        let above = tie + 1u32;
        assert_eq!(nearest_quotient(&above, &(big(1) << 200u32)), 2f64.powi(53) + 2.0);
        // The reader of numbers rounds decimals once.
        for (digits, power) in [(123_456_789_u64, -320_i32), (7, 300), (987_654_321, -45)] {
            let text: f64 = format!("{digits}e{power}").parse().unwrap();
            let tenfold = BigUint::from(10u32).pow(power.unsigned_abs());
            let (p, q) = (big(digits), big(1));
            let (p, q) = if power < 0 { (p, tenfold) } else { (p * tenfold, q) };
            let found = nearest_quotient(&p, &q);
            assert!((found - text).abs() <= 5e-324 && (found == text || text < 1e-300));
        }
    }

    #[test]
    fn what_no_number_holds_is_infinite_or_zero() {
        let huge = BigUint::from(10u32).pow(400);
        let one = BigUint::from(1u32);
        assert_eq!(nearest_quotient(&huge, &one), f64::INFINITY);
        assert_eq!(nearest_quotient(&one, &huge), 0.0);
        assert_eq!(nearest_quotient(&BigUint::ZERO, &huge), 0.0);
    }
}
