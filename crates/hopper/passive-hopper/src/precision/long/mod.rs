//! Binary floating point with `W` words of 64 bits, for hops that magnify an error beyond 106 bits.
//!
//! Every operation is truncated to 64 W bits. Quotients and roots, by Newton's method, lose two bits more.
//! Exponents have 64 bits: they do not overflow.
//!
//! # Why not a crate
//! dashu-float 0.6 has every function needed here, correctly rounded at any length. One operation takes (one core,
//! release build, ns; dashu-float with its constants cached):
//!
//! ```text
//!                        256 bits              512 bits              1024 bits
//!                   Long    dashu-float    Long    dashu-float    Long    dashu-float
//!   sum               33            178      46            185      115           270
//!   product           25            233      63            255      212           392
//!   quotient         415            410    1209            430     3254           800
//!   root            1271            383    4480            509    18240           962
//!   sin and cos     3900          74000   14100         134000    71500        278000
//! ```
//!
//! A flight takes five sines and cosines in 256 bits, and seven in 1024 bits, which take most of the time. By these
//! figures a flight takes some 30 µs instead of 380 µs in 256 bits, and 0.6 ms instead of 2 ms in 1024 bits. Users
//! would notice the difference in long chains: at M = 10⁴ a hop may have a thousand sudden lift-offs. The crate would
//! also add five other crates, and its numbers are not `Copy`. Therefore this arithmetic is used, and dashu-float is
//! the reference of its tests: a million arguments of every function, in `against_dashu.rs`.

mod against_dashu;
mod functions;

use crate::precision::double_double::DoubleDouble;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Most words of any [`Long`]: 1024 bits. Buffers on the stack have this size for every W, because the size of an array
/// cannot be computed from W. A hop that is inconclusive in 1024 bits is reported as uncertain.
const MOST: usize = 16;

/// π/4 to 1024 bits, the least significant word first.
const QUARTER_PI: [u64; MOST] = [
    0x98da48361c55d39a,
    0xc2007cb8a163bf05,
    0x49286651ece45b3d,
    0xae9f24117c4b1fe6,
    0xee386bfb5a899fa5,
    0x0bff5cb6f406b7ed,
    0xf44c42e9a637ed6b,
    0xe485b576625e7ec6,
    0x4fe1356d6d51c245,
    0x302b0a6df25f1437,
    0xef9519b3cd3a431b,
    0x514a08798e3404dd,
    0x020bbea63b139b22,
    0x29024e088a67cc74,
    0xc4c6628b80dc1cd1,
    0xc90fdaa22168c234,
];

/// ± 0.w…w × 2^exponent with the top bit of the fraction set, or zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Long<const W: usize> {
    negative: bool,
    exponent: i64,
    /// The least significant word first; all zero for zero.
    words: [u64; W],
}

impl<const W: usize> Long<W> {
    const ZERO: Self = Long { negative: false, exponent: 0, words: [0; W] };

    fn pi() -> Self {
        let mut words = [0; W];
        words.copy_from_slice(&QUARTER_PI[MOST - W..]);
        Long { negative: false, exponent: 2, words }
    }

    fn is_zero(&self) -> bool {
        self.words[W - 1] == 0
    }

    /// The `W` leading words of the fraction `wide`, times 2^exponent.
    fn normalised(negative: bool, exponent: i64, wide: &[u64]) -> Self {
        let Some(top) = wide.iter().rposition(|&word| word != 0) else { return Self::ZERO };
        let shift = wide[top].leading_zeros();
        let word = |down: usize| if down <= top { wide[top - down] } else { 0 };
        let mut words = [0; W];
        for (down, out) in words.iter_mut().rev().enumerate() {
            let next = if shift == 0 { 0 } else { word(down + 1) >> (64 - shift) };
            *out = (word(down) << shift) | next;
        }
        let lost = 64 * (wide.len() - 1 - top) as i64 + i64::from(shift);
        Long { negative, exponent: exponent - lost, words }
    }

    /// The words moved right by `shift` bits, in a fraction with a free word above for a carry and
    /// a guard word below.
    fn spread(&self, shift: u64) -> [u64; MOST + 2] {
        let mut wide = [0; MOST + 2];
        let (skip, bits) = ((shift / 64) as usize, (shift % 64) as u32);
        for (down, &word) in self.words.iter().rev().enumerate() {
            let Some(place) = MOST.checked_sub(down + skip) else { break };
            wide[place] |= word >> bits;
            if bits > 0 && place > 0 {
                wide[place - 1] |= word << (64 - bits);
            }
        }
        wide
    }

    /// Compares |self| with |other|, neither zero.
    fn compare_size(&self, other: &Self) -> Ordering {
        let words = self.words.iter().rev().cmp(other.words.iter().rev());
        self.exponent.cmp(&other.exponent).then(words)
    }

    /// The nearest `f64`.
    fn nearest(self) -> f64 {
        // The 64 leading bits are rounded to 53 bits. Their last bit is set if any lower bit is: the result is then the
        // rounding of the whole number.
        let rest = self.words[..W - 1].iter().any(|&word| word != 0);
        let leading = self.words[W - 1] | u64::from(rest);
        // Below 2⁻¹⁰²² an f64 has fewer than 53 bits. The number is rounded to this length here, because rounding to 53
        // bits first would round twice.
        let kept = (self.exponent + 1074).clamp(-1, 64);
        let size = if kept >= 53 {
            scale(leading as f64, self.exponent - 64)
        } else if kept < 0 {
            0.0
        } else {
            let (leading, half) = (u128::from(leading), 1u128 << (63 - kept));
            let (whole, part) = (leading >> (64 - kept), leading & (2 * half - 1));
            let up = part > half || (part == half && whole % 2 == 1);
            scale((whole + u128::from(up)) as f64, -1074)
        };
        if self.negative { -size } else { size }
    }

    /// self / `divisor`, word by word.
    fn over(self, divisor: u32) -> Self {
        if self.is_zero() {
            return self;
        }
        let mut wide = [0; MOST + 1];
        let mut rest: u64 = 0;
        for (place, word) in wide[..=W].iter_mut().enumerate().rev() {
            let digit = if place == 0 { 0 } else { self.words[place - 1] };
            let dividend = (u128::from(rest) << 64) | u128::from(digit);
            *word = (dividend / u128::from(divisor)) as u64;
            rest = (dividend % u128::from(divisor)) as u64;
        }
        Self::normalised(self.negative, self.exponent, &wide[..=W])
    }

    fn quotient(self, divisor: Self) -> Self {
        self * divisor.reciprocal()
    }

    /// 1/self, by Newton's x ← x + x (1 − self x). The `f64` start has 50 right bits, and a step doubles their number.
    fn reciprocal(self) -> Self {
        let mantissa = Long { exponent: 0, ..self };
        let mut inverse = Self::from(1.0 / mantissa.nearest());
        for _ in 0..doublings(W) {
            inverse = inverse + inverse * (Self::from(1.0) - mantissa * inverse);
        }
        Long { exponent: inverse.exponent - self.exponent, ..inverse }
    }
}

/// Newton steps from 50 bits to 64 `words` bits.
const fn doublings(words: usize) -> u32 {
    (64 * words).div_ceil(50).next_power_of_two().trailing_zeros()
}

impl<const W: usize> From<f64> for Long<W> {
    /// Exact for finite numbers. There is no infinity and no NaN in this format: both give zero.
    ///
    /// Speeds, mass ratios and the `f64` roots that start a search are finite. Only the reciprocal of zero passes an
    /// infinity; the quotient is then zero.
    fn from(value: f64) -> Self {
        if value == 0.0 || !value.is_finite() {
            return Self::ZERO;
        }
        let bits = value.to_bits();
        let field = (bits >> 52 & 0x7ff) as i64;
        let fraction = bits & ((1 << 52) - 1);
        let mantissa = if field == 0 { fraction } else { fraction | 1 << 52 };
        // value = mantissa · 2^(field − 1075), the mantissa a fraction of 2⁶⁴.
        Self::normalised(value < 0.0, field.max(1) - 1075 + 64, &[mantissa])
    }
}

impl<const W: usize> From<DoubleDouble> for Long<W> {
    fn from(value: DoubleDouble) -> Self {
        Self::from(value.high) + value.low
    }
}

impl<const W: usize> Neg for Long<W> {
    type Output = Self;
    fn neg(self) -> Self {
        Long { negative: !self.negative, ..self }
    }
}

impl<const W: usize> Add for Long<W> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        let (large, small) =
            if self.compare_size(&other).is_ge() { (self, other) } else { (other, self) };
        let mut sum = large.spread(0);
        let addend = small.spread(large.exponent.abs_diff(small.exponent));
        let subtract = large.negative != small.negative;
        let mut carry = false;
        for (word, &term) in sum.iter_mut().zip(&addend) {
            let (partial, first) =
                if subtract { word.overflowing_sub(term) } else { word.overflowing_add(term) };
            let (total, second) = if subtract {
                partial.overflowing_sub(u64::from(carry))
            } else {
                partial.overflowing_add(u64::from(carry))
            };
            (*word, carry) = (total, first || second);
        }
        // The free word at the top has the weight 2⁶⁴.
        Self::normalised(large.negative, large.exponent + 64, &sum)
    }
}

impl<const W: usize> Sub for Long<W> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const W: usize> Mul for Long<W> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        let mut product = [0u64; 2 * MOST];
        for (i, &a) in self.words.iter().enumerate() {
            let mut carry = 0;
            for (j, &b) in other.words.iter().enumerate() {
                let total =
                    u128::from(a) * u128::from(b) + u128::from(product[i + j]) + u128::from(carry);
                (product[i + j], carry) = (total as u64, (total >> 64) as u64);
            }
            product[i + W] = carry;
        }
        let negative = self.negative != other.negative;
        Self::normalised(negative, self.exponent + other.exponent, &product[..2 * W])
    }
}

impl<const W: usize> Div for Long<W> {
    type Output = Self;
    fn div(self, divisor: Self) -> Self {
        self.quotient(divisor)
    }
}

impl<const W: usize> Add<f64> for Long<W> {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self + Self::from(other)
    }
}

impl<const W: usize> Mul<f64> for Long<W> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        self * Self::from(factor)
    }
}

/// 2^exponent, for −1022 ≤ exponent ≤ 1023.
const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// x · 2^exponent, exact unless the result itself is out of range.
fn scale(x: f64, exponent: i64) -> f64 {
    // Beyond ±2200 every f64 becomes 0 or ∞. With this limit the loop takes three steps at most.
    let mut left = exponent.clamp(-2200, 2200) as i32;
    let mut result = x;
    while left != 0 {
        let step = left.clamp(-1000, 1000); // an exponent that an f64 has
        result *= power_of_two(step);
        left -= step;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Four = Long<4>;

    proptest! {
        #[test]
        fn f64_to_long_and_back(bits in any::<u64>()) {
            let x = f64::from_bits(bits);
            prop_assume!(x.is_finite());
            prop_assert_eq!(Four::from(x).nearest(), x);
        }

        #[test]
        fn sums_and_products_agree_with_double_double(a in -1e6..1e6f64, b in -1e6..1e6f64) {
            let sum = DoubleDouble::exact_sum(a, b);
            prop_assert_eq!(Four::from(a) + b, Four::from(sum));
            let product = DoubleDouble::exact_product(a, b);
            prop_assert_eq!(Four::from(a) * b, Four::from(product));
            prop_assert_eq!((Four::from(a) * b).nearest(), a * b);
            prop_assert!((Four::from(a) - Four::from(b) + b - Four::from(a)).is_zero());
        }

        /// Subnormal results are rounded once.
        #[test]
        fn small_numbers_round_once(bits in 1u64..1 << 53, shift in 1i64..60) {
            let exact = Long::<4>::from(bits as f64);
            let small = Long { exponent: exact.exponent - 1074 - shift, ..exact };
            let (whole, half) = (bits >> shift, 1u64 << (shift - 1));
            let part = bits & ((1u64 << shift) - 1);
            let up = part > half || (part == half && whole % 2 == 1);
            prop_assert_eq!(small.nearest(), f64::from_bits(whole + u64::from(up)));
        }
    }
}
