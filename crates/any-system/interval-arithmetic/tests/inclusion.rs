//! The result of an operation holds the exact one, for numbers of any size.
#![allow(clippy::unwrap_used)]

use interval_arithmetic::{Enclosure, Error, PI};
use proptest::prelude::*;

/// A rounded number and the rest of the exact one are together inside: `low` − `rounded` is exact, as both are
/// neighbours.
fn holds(found: Enclosure, rounded: f64, rest: f64) -> bool {
    found.low() - rounded <= rest && rest <= found.high() - rounded
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
        let end = if exact { sharp.low() } else { sharp.low().next_up() };
        prop_assert_eq!(sharp.high(), end);
        let product = a * b;
        prop_assert!(holds(point(a) * point(b), product, a.mul_add(b, -product)));
        if b != 0.0 {
            // a = q b: the ends bracket a, exactly, by the sign of a fused product.
            let quotient = point(a) / point(b);
            let (low, high) = (quotient.low().mul_add(b, -a), quotient.high().mul_add(b, -a));
            prop_assert!(low.min(high) <= 0.0 && low.max(high) >= 0.0);
        }
        let root = point(a.abs()).sqrt().unwrap();
        prop_assert!(root.low().mul_add(root.low(), -a.abs()) <= 0.0);
        prop_assert!(root.high().mul_add(root.high(), -a.abs()) >= 0.0);
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
            (x.tan(), u.tan()), (x.exp(), u.exp()), (x.sinh(), u.sinh()), (x.cosh(), u.cosh()), (x.tanh(), u.tanh()),
            (x.asinh(), u.asinh()), (x.powi(3), u.powi(3)), (x.powi(-3), u.powi(-3)), (x.powi(-2), u.powi(-2)),
            (x.powi(4), u.powi(4)), (x.atan2(y), u.atan2(v)),
        ] {
            prop_assert!(one.is_inside(&all), "{one:?} {all:?}");
        }
        let (part, point) = (y * (1.0 / 6.0), v * (1.0 / 6.0));
        for (all, one) in [
            (x.ln(), u.ln()), (x.sqrt(), u.sqrt()), (x.acosh(), u.acosh()), (x.powf(y), u.powf(v)),
            (part.asin(), point.asin()), (part.acos(), point.acos()), (part.atanh(), point.atanh()),
        ] {
            // What is refused at one number is refused for all.
            prop_assert!(all.is_none_or(|all| one.is_some_and(|one| one.is_inside(&all))), "{one:?} {all:?}");
        }
        // A function and its inverse.
        prop_assert!(v.sinh().asinh().contains(v.low()) && v.exp().ln().unwrap().contains(v.low()));
        prop_assert!(point.asin().unwrap().sin().contains(point.low()) && v.arctan().tan().contains(v.low()));
        let power = v.abs().powf(point).and_then(Enclosure::ln);
        let product = v.abs().ln().map(|logarithm| logarithm * point);
        let agree = power.zip(product).is_none_or(|(a, b)| a.intersection(&b).is_some());
        prop_assert!(agree, "{power:?} {product:?}");
    }
}

/// The extrema of sine and cosine are found at every multiple of ½π, also far away.
#[test]
fn an_extremum_inside_is_a_value() {
    for k in -2000i32..2000 {
        let place = (PI * (f64::from(k) + 0.5)).middle();
        let around = Enclosure::between(place - 1e-7, place + 1e-7).unwrap().sin();
        assert!(if k % 2 == 0 { around.high() == 1.0 } else { around.low() == -1.0 }, "{k}");
        let beside = Enclosure::between(place + 1e-6, place + 2e-6).unwrap().sin();
        assert!(beside.high() < 1.0 && beside.low() > -1.0, "{k}");
        let cosine = Enclosure::around(PI.middle() * f64::from(k), 1e-7).cos();
        assert!(if k % 2 == 0 { cosine.high() == 1.0 } else { cosine.low() == -1.0 }, "{k}");
    }
}

/// The `f64` of π is below π by 1.2246467991473532e-16 (its next digits).
#[test]
fn pi_is_inside() {
    assert_eq!(PI.low(), std::f64::consts::PI);
    assert_eq!(PI.high(), std::f64::consts::PI.next_up());
    assert!(pxfm::f_sin(PI.low()) > 1e-16 && pxfm::f_sin(PI.high()) < -1e-16);
}

/// Zero as an end of a divisor has a bound on one side.
#[test]
fn quotients_by_an_end_at_zero_have_one_bound() {
    let (one, beyond) = (Enclosure::ONE, Enclosure::new(0.0, 0.5));
    let near = one / beyond;
    assert!(near.low() <= 2.0 && near.low() > 1.999 && near.high() == f64::INFINITY);
    assert_eq!(one / -beyond, -near);
    assert_eq!(-one / beyond, -near);
    assert_eq!(Enclosure::ZERO / beyond, Enclosure::new(0.0, f64::INFINITY));
    assert_eq!(Enclosure::new(-1.0, 1.0) / beyond, Enclosure::WHOLE);
    assert_eq!(one / Enclosure::new(-0.0, 0.5), near);
}

/// Ends of domains, infinite ends, and the size at which pxfm 0.1.30 is wrong.
#[test]
fn functions_hold_their_values_at_ends_of_domains() {
    let infinity = f64::INFINITY;
    let at = |low, high| Enclosure::new(low, high);
    assert_eq!(Enclosure::WHOLE.exp(), at(0.0, infinity));
    assert_eq!(Enclosure::WHOLE.cosh(), at(1.0, infinity));
    assert_eq!(Enclosure::WHOLE.tanh(), at(-1.0, 1.0));
    assert_eq!(at(0.0, infinity).ln(), Some(Enclosure::WHOLE));
    assert_eq!((Enclosure::ZERO.ln(), at(-1e-300, 1.0).ln()), (None, None));
    assert_eq!(at(-1.0, 1.0).atanh(), Some(Enclosure::WHOLE));
    assert_eq!(at(-1.0, 1.0f64.next_up()).asin(), None);
    assert_eq!(at(1.0f64.next_down(), 2.0).acosh(), None);
    assert_eq!(at(-1.0, 1.0).acos(), Some(at(0.0, PI.high())));
    // The exact values, from mpmath.
    assert!(point(-709.7411184795164).exp().contains(5.798_940_657_683_22e-309));
    assert!(point(-745.2).exp().contains(0.0) && point(-800.0).exp().high() > 0.0);
    assert!(point(1e160).powi(-2).contains(1e-320) && point(-1e107).powi(-3).contains(-1e-321));
    assert!(point(1e160).powf(point(-2.0)).is_some_and(|power| power.contains(1e-320)));
    assert!(point(800.0).exp().low() < infinity && point(800.0).exp().high() == infinity);
    assert_eq!(at(0.0, 0.5).powf(at(-1.0, 1.0)), Some(at(0.0, infinity)));
    assert_eq!(at(0.0, 0.5).powi(-2).high(), infinity);
    assert_eq!((at(-0.5, 0.5).powi(-1), at(-0.5, 0.5).powi(0)), (Enclosure::WHOLE, Enclosure::ONE));
    assert!(at(-2.0, 0.5).powi(i32::MIN).contains(0.0));
}

/// The angle of a box with points on both sides of the cut, or with the origin, may be each.
#[test]
fn angles_know_their_cut() {
    let at = |low, high| Enclosure::new(low, high);
    let all = at(-PI.high(), PI.high());
    assert_eq!(at(-1.0, 1.0).atan2(at(-2.0, -1.0)), all);
    assert_eq!(at(-1.0, 0.0).atan2(at(-2.0, -1.0)), all);
    assert_eq!(at(-1.0, 1.0).atan2(at(-1.0, 1.0)), all);
    assert_eq!(at(0.0, 1.0).atan2(at(-1.0, 1.0)), at(0.0, PI.high()));
    let above = at(0.0, 1.0).atan2(at(-2.0, -1.0));
    assert_eq!(above.high(), PI.high());
    assert!(above.low() > 2.35);
    // −0 is zero.
    assert!(point(-0.0).atan2(point(-1.0)).contains(std::f64::consts::PI));
    assert!(at(-1.0, 1.0).atan2(at(1.0, 2.0)).magnitude() < 0.79);
    assert_eq!(at(f64::NAN, 1.0).atan2(Enclosure::ONE), all);
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
        assert_eq!((wrong.abs().low(), wrong.squared().high()), (0.0, f64::INFINITY), "{wrong:?}");
        for all in [wrong.hull(&one), one.hull(&wrong)] {
            assert!(!low.is_nan() || all.low() == f64::NEG_INFINITY, "{all:?}");
            assert!(!high.is_nan() || all.high() == f64::INFINITY, "{all:?}");
        }
    }
    assert_eq!(one / Enclosure::new(-1.0, 1.0), Enclosure::WHOLE);
    assert_eq!(one / Enclosure::ZERO, Enclosure::WHOLE);
    assert_eq!(wrong.sqrt(), None);
    assert_eq!(
        (wrong.ln(), wrong.asin(), wrong.acosh(), wrong.powf(one)),
        (None, None, None, None)
    );
    for found in [wrong.tan(), wrong.sinh(), wrong.asinh(), wrong.powi(3), wrong.atan2(one)] {
        assert_eq!(found.sign(), None, "{found:?}");
    }
    assert!(one.powf(wrong).is_some_and(|found| found.high() == f64::INFINITY));
    assert_eq!(wrong.sin(), Enclosure::new(-1.0, 1.0));
    assert_eq!(Enclosure::WHOLE.cos(), Enclosure::new(-1.0, 1.0));
    let infinite = Enclosure::new(f64::MAX, f64::MAX) * 2.0;
    assert!(infinite.low().is_finite() && infinite.high() == f64::INFINITY);
    assert_eq!((infinite - infinite).sign(), None);
    assert_eq!(infinite.sharp_difference(infinite).sign(), None);
    assert_eq!(one.sharp_difference(wrong).sign(), None);
    assert_eq!(one.sharp_difference(Enclosure::WHOLE), Enclosure::WHOLE);
    let beyond = Enclosure::from(f64::MAX).sharp_difference(Enclosure::from(f64::MIN));
    assert_eq!(beyond, Enclosure::new(f64::MAX, f64::INFINITY));
}
