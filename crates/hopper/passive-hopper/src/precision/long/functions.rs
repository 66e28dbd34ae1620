//! Roots, sines and cosines to 64 W bits.

use super::{Long, doublings, power_of_two};
use crate::precision::real::{Extended, Real, extended_sine_remainders};

impl<const W: usize> Real for Long<W> {
    fn nearest(self) -> f64 {
        Long::nearest(self)
    }

    /// By the Taylor series of the argument reduced to [−π/2, π/2].
    ///
    /// The reduction subtracts a multiple of π of about the size of the argument, whose error is ε |self|. Therefore
    /// the error of the result is ε (1 + |self|). It is relative only if no multiple is subtracted.
    fn sin_cos(self) -> (Self, Self) {
        let multiple = (self.nearest() / std::f64::consts::PI).round();
        let rest = self - Self::pi() * multiple;
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
        // sin(r + kπ) = (−1)^k sin r, and likewise cos.
        if multiple % 2.0 == 0.0 { (sin, cos) } else { (-sin, -cos) }
    }

    fn sine_remainders(self, sin: Self, cos: Self) -> (Self, Self) {
        extended_sine_remainders(self, sin, cos)
    }

    /// Unchanged: an exponent of 64 bits does not overflow.
    fn at_most_largest(self) -> Self {
        self
    }
}

impl<const W: usize> Extended for Long<W> {
    /// 2¹²ω with ω = 2^(−64 W). Sums and products err by 2.01ω, quotients by 6.2ω, roots by 5.2ω, sines by 300ω and 4ω
    /// of the argument (docs/theory.md, Lemmas 56 and 57); `against_dashu.rs` measures 36ω for sines. The rest of the
    /// twelve bits is a margin. They cost no noticeable number of hops: each arithmetic has 256 bits or more.
    const EPSILON: f64 = power_of_two(12 - 64 * W as i32);
    /// 62 500, 15 625 and 3 906 flights in 256, 512 and 1024 bits. A product takes W² steps, and the number of products
    /// of a flight grows with W. These budgets therefore take some seconds each.
    const SUDDEN_BUDGET: usize = 1_000_000 / (W * W);
    /// As many steps as from 50 bits: one more than needed.
    const STEPS_FROM_100_BITS: u32 = doublings(W);

    fn over(self, divisor: u32) -> Self {
        Long::over(self, divisor)
    }

    fn sqrt(self) -> Self {
        if self.negative || self.is_zero() {
            return Self::ZERO;
        }
        // √(m 2^(2k)) = √m 2^k with m in [¼, 2): there the f64 root neither overflows nor underflows.
        // Heron's r ← (r + m/r)/2 doubles the number of right bits, from 50.
        let half = self.exponent.div_euclid(2);
        let mantissa = Long { exponent: self.exponent - 2 * half, ..self };
        let mut root = Self::from(mantissa.nearest().sqrt());
        for _ in 0..doublings(W) {
            root = (root + mantissa / root) * 0.5;
        }
        Long { exponent: root.exponent + half, ..root }
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
        fn quotients_and_roots_invert_products_and_squares(a in 1e-3..1e6f64, b in -1e6..1e6f64, low in -1e-20..1e-20f64) {
            prop_assume!(b != 0.0);
            let (x, y) = (long(a, low), long(b, 1e-3 * low));
            prop_assert!(apart(x / y * y, x) < 16.0);
            prop_assert!(apart(x.sqrt().squared(), x) < 16.0);
            prop_assert!(apart(x.over(7) * 7.0, x) < 16.0);
        }

        #[test]
        fn sines_satisfy_the_circle_and_the_addition_theorem(x in -1e6..1e6f64, y in -3.0..3.0f64) {
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
    fn longer_numbers_agree_with_shorter_ones() {
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
}
