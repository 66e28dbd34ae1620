//! Roots, sines and fixed points to 64 W bits.

use super::{Long, doublings, power_of_two};
use crate::precision::real::Real;

impl<const W: usize> Real for Long<W> {
    /// 2^(12 − 64 W).
    const EPSILON: f64 = power_of_two(12 - 64 * W as i32);
    const SUDDEN_BUDGET: usize = 1_000_000 / (W * W);

    fn nearest(self) -> f64 {
        Long::nearest(self)
    }

    fn over(self, divisor: u32) -> Self {
        Long::over(self, divisor)
    }

    fn sqrt(self) -> Self {
        if self.negative || self.is_zero() {
            return Self::ZERO;
        }
        // An even exponent outside; r ← (r + x/r)/2 from 50 bits.
        let half = self.exponent.div_euclid(2);
        let mantissa = Long { exponent: self.exponent - 2 * half, ..self };
        let mut root = Self::from(mantissa.nearest().sqrt());
        for _ in 0..doublings(W) {
            root = (root + mantissa / root) * 0.5;
        }
        Long { exponent: root.exponent + half, ..root }
    }

    fn sin_cos(self) -> (Self, Self) {
        let turns = (self.nearest() / std::f64::consts::PI).round();
        let rest = self - Self::pi() * turns;
        let minus_square = -rest.squared();
        let (mut sin, mut cos) = (rest, Self::from(1.0));
        let (mut odd, mut even) = (sin, cos);
        for k in 1.. {
            even = (even * minus_square).over((2 * k - 1) * 2 * k);
            odd = (odd * minus_square).over(2 * k * (2 * k + 1));
            (sin, cos) = (sin + odd, cos + even);
            if even.is_zero() || even.exponent < -64 * W as i64 {
                break;
            }
        }
        if turns % 2.0 == 0.0 { (sin, cos) } else { (-sin, -cos) }
    }

    /// Newton's method on sin a = a cos a, whose slope is a sin a, from 106 bits.
    fn alpha_star(n: u64) -> Self {
        let mut a = Self::from(crate::model::fixed_points::exact_alpha_star(n));
        if n == 0 {
            return a;
        }
        for _ in 0..doublings(W) {
            let (sin, cos) = a.sin_cos();
            a = a - (sin - a * cos) / (a * sin);
        }
        a
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Four = Long<4>;

    fn long(high: f64, low: f64) -> Four {
        Four::from(high) + low
    }

    /// |a − b| relative to |b|, in units of 2^−256.
    fn apart(a: Four, b: Four) -> f64 {
        let difference = a - b;
        if difference.is_zero() { 0.0 } else { ((difference / b) * 2f64.powi(256)).nearest().abs() }
    }

    proptest! {
        #[test]
        fn quotients_and_roots_go_back(a in 1e-3..1e6f64, b in -1e6..1e6f64, low in -1e-20..1e-20f64) {
            prop_assume!(b != 0.0);
            let (x, y) = (long(a, low), long(b, 1e-3 * low));
            prop_assert!(apart(x / y * y, x) < 16.0);
            prop_assert!(apart(x.sqrt().squared(), x) < 16.0);
            prop_assert!(apart(x.over(7) * 7.0, x) < 16.0);
        }

        #[test]
        fn sines_are_on_the_circle_and_add(x in -1e6..1e6f64, y in -3.0..3.0f64) {
            let (sin, cos) = Four::from(x).sin_cos();
            prop_assert!(apart(sin.squared() + cos.squared(), Four::from(1.0)) < 256.0);
            prop_assert!((sin.nearest() - pxfm::f_sin(x)).abs() <= f64::EPSILON);
            let (sin_y, cos_y) = Four::from(y).sin_cos();
            let sum = (Four::from(x) + y).sin_cos().0;
            let error = sum - (sin * cos_y + cos * sin_y);
            prop_assert!(error.nearest().abs() < 1e-76 * (1.0 + x.abs()));
        }
    }

    #[test]
    fn more_words_agree_with_fewer() {
        for x in [0.3, 4.5, 1e5 + 0.7, 8e12] {
            let (few, many) = (Long::<4>::from(x).sin_cos(), Long::<16>::from(x).sin_cos());
            let error = |a: Long<4>, b: Long<16>| -> f64 {
                let mut words = [0; 16];
                words[12..].copy_from_slice(&a.words);
                (Long::<16> { negative: a.negative, exponent: a.exponent, words } - b).nearest()
            };
            assert!(error(few.0, many.0).abs() < 1e-74 * (1.0 + x), "{x}");
            assert!(error(few.1, many.1).abs() < 1e-74 * (1.0 + x), "{x}");
        }
    }

    /// tan α* = α* to the last digits of 1024 bits.
    #[test]
    fn fixed_points_to_a_thousand_bits() {
        for n in [1, 2, 1000, 1 << 40] {
            let a = Long::<16>::alpha_star(n);
            let (sin, cos) = a.sin_cos();
            let rest = ((sin - a * cos) / (a * a)).nearest().abs();
            assert!(rest < Long::<16>::EPSILON, "{n}: {rest:e}");
            assert_eq!(a.nearest(), crate::model::fixed_points::alpha_star(n));
        }
    }
}
