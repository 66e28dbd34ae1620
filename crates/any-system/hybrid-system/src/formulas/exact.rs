//! Sums and products of enclosures, exact where both are numbers and the result is one: zero stays zero, and a double root
//! is found.

use interval_arithmetic::Enclosure;

/// Below it the error of a product may underflow, so that a product that looks exact may not be.
const SMALLEST_EXACT: f64 = 1e-290;

fn numbers(a: Enclosure, b: Enclosure) -> Option<(f64, f64)> {
    (a.low() == a.high() && b.low() == b.high()).then_some((a.low(), b.low()))
}

/// a + b.
pub(super) fn sum(a: Enclosure, b: Enclosure) -> Enclosure {
    if let Some((x, y)) = numbers(a, b) {
        let sum = x + y;
        // The rounding of a sum, exactly (Knuth).
        let moved = sum - x;
        if (x - (sum - moved)) + (y - moved) == 0.0 && sum.is_finite() {
            return Enclosure::from(sum);
        }
    }
    a + b
}

/// a − b.
pub(super) fn difference(a: Enclosure, b: Enclosure) -> Enclosure {
    sum(a, -b)
}

/// a b.
pub(super) fn product(a: Enclosure, b: Enclosure) -> Enclosure {
    if a == Enclosure::ZERO || b == Enclosure::ZERO {
        return Enclosure::ZERO;
    }
    if let Some((x, y)) = numbers(a, b) {
        let product = x * y;
        // `mul_add` rounds once: it gives the rounding of the product.
        if product.abs() > SMALLEST_EXACT && product.is_finite() && x.mul_add(y, -product) == 0.0 {
            return Enclosure::from(product);
        }
    }
    a * b
}

/// a / b, of a b that holds no zero.
pub(super) fn quotient(a: Enclosure, b: Enclosure) -> Enclosure {
    if a == Enclosure::ZERO {
        return a;
    }
    if let Some((x, y)) = numbers(a, b) {
        let quotient = x / y;
        let back = product(Enclosure::from(quotient), b);
        if back.low() == back.high() && back.low() == x {
            return Enclosure::from(quotient);
        }
    }
    a / b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_exact_where_they_are_numbers() {
        let n = Enclosure::from;
        assert_eq!(sum(n(0.25), n(-2.0)), n(-1.75));
        assert_eq!(product(n(0.0), Enclosure::new(-1.0, 2.0)), Enclosure::ZERO);
        assert_eq!(product(n(3.0), n(-0.5)), n(-1.5));
        assert_eq!(quotient(n(1.0), n(-4.0)), n(-0.25));
        for inexact in [sum(n(1.0), n(1e-20)), product(n(0.1), n(0.1)), quotient(n(1.0), n(3.0))] {
            assert!(inexact.low() < inexact.high(), "{inexact:?}");
        }
    }
}
