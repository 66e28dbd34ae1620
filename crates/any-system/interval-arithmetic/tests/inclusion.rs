//! The result of an operation holds the exact one, for numbers of any size.
#![allow(clippy::unwrap_used)]

use interval_arithmetic::{Enclosure, Error, PI};
use proptest::prelude::*;

/// A rounded number and the rest of the exact one are together inside: `low` − `rounded` is exact, as both are
/// neighbours.
fn holds(found: Enclosure, rounded: f64, rest: f64) -> bool {
    found.low - rounded <= rest && rest <= found.high - rounded
}

/// The rest of a sum after rounding (Knuth).
fn rest_of_sum(a: f64, b: f64) -> f64 {
    let sum = a + b;
    let part = sum - a;
    (a - (sum - part)) + (b - part)
}

fn moderate() -> impl Strategy<Value = f64> {
    (-1.0f64..1.0, -40i32..40).prop_map(|(part, power)| part * 2f64.powi(power))
}

fn point(value: f64) -> Enclosure {
    Enclosure::point(value).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn sums_products_quotients_and_roots_hold_the_exact_numbers(a in moderate(), b in moderate()) {
        prop_assert!(holds(point(a) + point(b), a + b, rest_of_sum(a, b)));
        prop_assert!(holds(point(a) - point(b), a - b, rest_of_sum(a, -b)));
        let sharp = point(a).sharp_difference(point(b));
        let exact = rest_of_sum(a, -b) == 0.0;
        prop_assert!(holds(sharp, a - b, rest_of_sum(a, -b)));
        let end = if exact { sharp.low } else { sharp.low.next_up() };
        prop_assert_eq!(sharp.high, end);
        let product = a * b;
        prop_assert!(holds(point(a) * point(b), product, a.mul_add(b, -product)));
        if b != 0.0 {
            // a = q b: the ends bracket a, exactly, by the sign of a fused product.
            let quotient = point(a) / point(b);
            let (low, high) = (quotient.low.mul_add(b, -a), quotient.high.mul_add(b, -a));
            prop_assert!(low.min(high) <= 0.0 && low.max(high) >= 0.0);
        }
        let root = point(a.abs()).sqrt().unwrap();
        prop_assert!(root.low.mul_add(root.low, -a.abs()) <= 0.0);
        prop_assert!(root.high.mul_add(root.high, -a.abs()) >= 0.0);
    }

    /// Every value at a point of an interval lies in the value of the interval.
    #[test]
    fn functions_of_intervals_hold_those_of_their_numbers(
        a in -50.0f64..50.0, width in 0.0f64..9.0, part in 0.0f64..1.0, c in -3.0f64..3.0, other in 0.0f64..2.0,
    ) {
        let x = Enclosure::between(a, a + width).unwrap();
        let y = Enclosure::between(c, c + other).unwrap();
        let (u, v) = ((a + part * width).min(a + width), (c + part * other).min(c + other));
        let (u, v) = (point(u), point(v));
        for (all, one) in [
            (x + y, u + v), (x - y, u - v), (x * y, u * v), (x / y, u / v), (x.squared(), u.squared()),
            (x.sin(), u.sin()), (x.cos(), u.cos()), (x.arctan(), u.arctan()), (x.abs(), u.abs()), (-x, -u),
        ] {
            prop_assert!(one.is_inside(&all), "{one:?} {all:?}");
        }
        // sin² + cos² = 1, at one number.
        prop_assert!((u.sin().squared() + u.cos().squared()).contains(1.0));
    }
}

/// The extrema of sine and cosine are found at every multiple of ½π, also far away.
#[test]
fn an_extremum_inside_is_a_value() {
    for k in -2000i32..2000 {
        let place = (PI * (f64::from(k) + 0.5)).middle();
        let around = Enclosure::between(place - 1e-7, place + 1e-7).unwrap().sin();
        assert!(if k % 2 == 0 { around.high == 1.0 } else { around.low == -1.0 }, "{k}");
        let beside = Enclosure::between(place + 1e-6, place + 2e-6).unwrap().sin();
        assert!(beside.high < 1.0 && beside.low > -1.0, "{k}");
        let cosine = Enclosure::around(PI.middle() * f64::from(k), 1e-7).cos();
        assert!(if k % 2 == 0 { cosine.high == 1.0 } else { cosine.low == -1.0 }, "{k}");
    }
}

/// The `f64` of π is below π by 1.2246467991473532e-16 (its next digits).
#[test]
fn pi_is_inside() {
    assert_eq!(PI.low, std::f64::consts::PI);
    assert_eq!(PI.high, std::f64::consts::PI.next_up());
    assert!(pxfm::f_sin(PI.low) > 1e-16 && pxfm::f_sin(PI.high) < -1e-16);
}

/// What is no interval is refused, and never becomes a certain statement.
#[test]
fn no_interval_says_anything_certain() {
    for (low, high) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::NAN), (0.0, f64::INFINITY)] {
        assert!(matches!(Enclosure::between(low, high), Err(Error::Ends { .. })));
    }
    let wrong = Enclosure::new(f64::NAN, 1.0);
    let one = Enclosure::ONE;
    for found in [wrong + one, wrong * one, one / wrong, one - wrong, wrong * wrong] {
        assert_eq!(found.sign(), None, "{found:?}");
    }
    for (low, high) in [(f64::NAN, 1.0), (f64::NAN, -1.0), (1.0, f64::NAN), (f64::NAN, f64::NAN)] {
        let wrong = Enclosure::new(low, high);
        assert!(!wrong.is_positive() && !wrong.is_negative() && !wrong.contains(0.5), "{wrong:?}");
        assert_eq!(wrong.magnitude(), f64::INFINITY);
        assert_eq!((wrong.abs().low, wrong.squared().high), (0.0, f64::INFINITY), "{wrong:?}");
        for all in [wrong.hull(&one), one.hull(&wrong)] {
            assert!(!low.is_nan() || all.low == f64::NEG_INFINITY, "{all:?}");
            assert!(!high.is_nan() || all.high == f64::INFINITY, "{all:?}");
        }
    }
    assert_eq!(one / Enclosure::new(-1.0, 1.0), Enclosure::WHOLE);
    assert_eq!(one / Enclosure::ZERO, Enclosure::WHOLE);
    assert_eq!(wrong.sqrt(), None);
    assert_eq!(wrong.sin(), Enclosure::new(-1.0, 1.0));
    assert_eq!(Enclosure::WHOLE.cos(), Enclosure::new(-1.0, 1.0));
    let infinite = Enclosure::new(f64::MAX, f64::MAX) * 2.0;
    assert!(infinite.low.is_finite() && infinite.high == f64::INFINITY);
    assert_eq!((infinite - infinite).sign(), None);
    assert_eq!(infinite.sharp_difference(infinite).sign(), None);
    assert_eq!(one.sharp_difference(wrong).sign(), None);
    assert_eq!(one.sharp_difference(Enclosure::WHOLE), Enclosure::WHOLE);
    let beyond = Enclosure::from(f64::MAX).sharp_difference(Enclosure::from(f64::MIN));
    assert_eq!(beyond, Enclosure::new(f64::MAX, f64::INFINITY));
}
