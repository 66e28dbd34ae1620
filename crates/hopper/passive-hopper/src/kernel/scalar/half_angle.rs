//! The half-angle functions of a flight: the sine and cosine of h = τ/2, half its time, and D and u.
//!
//! Invariant I1 of the kernel's README: additions and multiplications only, and selections instead of branches.

use crate::precision::nearest_integer::nearest_integer;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// S = sin h, C = cos h, D = h − SC, u = hC − S.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HalfAngle {
    pub(crate) h: f64,
    pub(crate) sin: f64,
    pub(crate) cos: f64,
    pub(crate) d: f64,
    pub(crate) u: f64,
}

/// π/2 as the sum of three numbers (Cody and Waite's reduction; the values are those of fdlibm).
///
/// The first two numbers end in 21 zero bits, so that their products with an integer below 2²⁰ are exact. The third is
/// the remainder, rounded. The error of the sum is 10⁻³⁷. Beyond h = 2²⁰ the products round and the reduction loses
/// digits. The speeds of the kernel stay below, see `LARGEST_VELOCITY` in `landing_bracket.rs`.
const HALF_PI: [f64; 3] =
    [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// (sin r − r)/r³ in powers of z = r².
///
/// The polynomial interpolates at the six Chebyshev nodes of 0 ≤ z ≤ (1.0005 π/4)². The interval is a little longer
/// than |r| ≤ π/4, because the rounded quotient h/(π/2) may put r just outside. Interpolation in longer arithmetic on
/// this interval reproduces these coefficients to the last bit. The error is 2·10⁻¹⁷ of r. With five terms it would be
/// 2·10⁻¹⁴.
const SIN: [f64; 6] = [
    -0.166_666_666_666_666_66,
    0.008_333_333_333_330_936,
    -0.000_198_412_698_367_405_27,
    2.755_731_609_319_606_6e-6,
    -2.505_112_989_596_280_7e-8,
    1.591_798_894_431_871_6e-10,
];

/// (½ − (1 − cos r)/r²)/r² in powers of z = r², from the same interpolation. Error in cos r: 10⁻¹⁸.
const COS: [f64; 6] = [
    0.041_666_666_666_666_664,
    -0.001_388_888_888_888_738_9,
    2.480_158_729_875_44e-5,
    -2.755_731_726_587_661_5e-7,
    2.087_614_504_910_828e-9,
    -1.138_254_462_340_429_1e-11,
];

/// `x`, negated if the last bit of `integer` is set: (−1)^m x for the integer m.
#[inline(always)]
pub(crate) fn negated_if_odd(x: f64, integer: u64) -> f64 {
    f64::from_bits(x.to_bits() ^ (integer << 63))
}

/// Σ cⱼ zʲ with j < 6, by pairs. Its chains of dependent operations are shorter than in Horner's scheme.
#[inline(always)]
fn six_terms(c: &[f64; 6], z: f64) -> f64 {
    let square = z * z;
    let low = (c[0] + c[1] * z) + square * (c[2] + c[3] * z);
    low + (square * square) * (c[4] + c[5] * z)
}

/// The first four terms of the sum. The omitted terms are below 1.8·10⁻⁹ (docs/theory.md, Lemma 57).
#[inline(always)]
fn four_terms(c: &[f64; 6], z: f64) -> f64 {
    (c[0] + c[1] * z) + (z * z) * (c[2] + c[3] * z)
}

/// Bound on the errors of S and C in units of ε = 2⁻⁵² of the value (docs/theory.md, Lemma 57). The largest error
/// measured is 1.2.
pub(crate) const SINE_ULPS: f64 = 2.0;

impl HalfAngle {
    /// The functions of `h`, 0 < h < 2²⁰: S and C to [`SINE_ULPS`], D and u without cancellation at small h.
    #[inline(always)]
    pub(crate) fn at(h: f64) -> Self {
        let (quarters, bits) = nearest_integer(h * FRAC_2_PI);
        let [a, b, c] = HALF_PI;
        let r = ((h - quarters * a) - quarters * b) - quarters * c; // the products and the first difference are exact
        let z = r * r;
        HalfAngle::reduced(h, (quarters, bits, r), six_terms(&SIN, z), six_terms(&COS, z))
    }

    /// The functions of `h` to eight digits, for a first step of the search: one product instead of three in the
    /// reduction, four terms instead of six.
    #[inline(always)]
    pub(crate) fn to_eight_digits(h: f64) -> Self {
        let (quarters, bits) = nearest_integer(h * FRAC_2_PI);
        let r = h - quarters * FRAC_PI_2;
        let z = r * r;
        HalfAngle::reduced(h, (quarters, bits, r), four_terms(&SIN, z), four_terms(&COS, z))
    }

    /// The functions of h = r + quarters·π/2, from (sin r − r)/r³ and (½ − (1 − cos r)/r²)/r².
    #[inline(always)]
    fn reduced(h: f64, (quarters, bits, r): (f64, u64, f64), of_sin: f64, of_cos: f64) -> Self {
        let z = r * r;
        let s = (r * z) * of_sin; // sin r − r
        let versine = z * (0.5 - z * of_cos); // 1 − cos r
        let (sin_r, cos_r) = (r + s, 1.0 - versine);
        // An odd number of quarters exchanges sine and cosine. Their signs, for quarters mod 4:
        //            0         1         2         3
        //   sin h    sin r     cos r    −sin r    −cos r        − where bit 1 is set
        //   cos h    cos r    −sin r    −cos r     sin r        − where bits 0 and 1 differ
        let exchanged = bits & 1 == 1;
        let sin = negated_if_odd(if exchanged { cos_r } else { sin_r }, bits >> 1);
        let cos = negated_if_odd(if exchanged { sin_r } else { cos_r }, (bits >> 1) ^ bits);
        // For h ≤ π/4 both differences cancel (D ~ h³, u ~ h³). But there r = h, and D = h(1−C) − (S−h)C and u =
        // −h(1−C) − (S−h) do not cancel.
        let small = quarters < 0.5;
        let d = if small { h * versine - s * cos_r } else { h - sin * cos };
        let u = if small { -(h * versine + s) } else { h * cos - sin };
        HalfAngle { h, sin, cos, d, u }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landing::half_time::HalfTime;
    use proptest::prelude::*;

    fn ulps(found: f64, exact: f64) -> f64 {
        (found - exact).abs() / (exact.abs() * f64::EPSILON)
    }

    /// 400 numbers on either side of each zero of sine and cosine, where an inexact reduction would be visible.
    #[test]
    fn sine_and_cosine_are_right_near_their_zeros() {
        for k in 1..128u32 {
            let zero = f64::from(k) * std::f64::consts::FRAC_PI_2;
            for step in -400..=400i64 {
                let h = f64::from_bits((zero.to_bits() as i64 + step) as u64);
                let found = HalfAngle::at(h);
                let (sin, cos) = pxfm::f_sincos(h);
                assert!(ulps(found.sin, sin) <= 1.0 && ulps(found.cos, cos) <= 1.0, "{h:e}");
            }
        }
    }

    proptest! {
        #[test]
        fn half_angle_functions_agree_with_correctly_rounded_ones(h in 0.0..200f64, exponent in -8.0..0.0f64) {
            for h in [h, h * pxfm::f_exp10(exponent)] {
                let (found, exact) = (HalfAngle::at(h), HalfTime::at(h));
                prop_assert!(ulps(found.sin, exact.sin) <= 1.2 && ulps(found.cos, exact.cos) <= 1.2);
                let rough = HalfAngle::to_eight_digits(h);
                prop_assert!((rough.sin - exact.sin).abs() < 1.8e-9 && (rough.cos - exact.cos).abs() < 1.8e-9);
                prop_assert!((rough.d / exact.d - 1.0).abs() < 1e-7);
                prop_assert!((found.d / exact.d - 1.0).abs() < 4e-15);
                prop_assert!((found.u - exact.u).abs() < 4e-15 * exact.u.abs() + 4e-16 * h * h.min(1.0));
            }
        }
    }
}
