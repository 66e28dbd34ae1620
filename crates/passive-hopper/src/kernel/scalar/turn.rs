//! Sine and cosine of half a flight's time, and what is made of them, without a branch.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// S = sin h, C = cos h, D = h − SC, u = hC − S.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    pub(crate) h: f64,
    pub(crate) sin: f64,
    pub(crate) cos: f64,
    pub(crate) d: f64,
    pub(crate) u: f64,
}

/// Adding and taking it away rounds to a whole number, which stands in the last bits of the sum.
const ROUNDER: f64 = 6_755_399_441_055_744.0; // 1.5 · 2⁵²

/// π/2 in three parts; the first two have 33 bits, so that their products with up to 2²⁰ are exact.
const HALF_PI: [f64; 3] =
    [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// (sin r − r)/r³ in powers of r², for |r| ≤ π/4: through Chebyshev nodes, to 2·10⁻¹⁷ of r.
const SIN: [f64; 6] = [
    -0.166_666_666_666_666_66,
    0.008_333_333_333_330_936,
    -0.000_198_412_698_367_405_27,
    2.755_731_609_319_606_6e-6,
    -2.505_112_989_596_280_7e-8,
    1.591_798_894_431_871_6e-10,
];

/// (½ − (1 − cos r)/r²)/r² in powers of r², likewise.
const COS: [f64; 6] = [
    0.041_666_666_666_666_664,
    -0.001_388_888_888_888_738_9,
    2.480_158_729_875_44e-5,
    -2.755_731_726_587_661_5e-7,
    2.087_614_504_910_828e-9,
    -1.138_254_462_340_429_1e-11,
];

/// The whole number nearest to `x`, and its last bits; |x| < 2⁵⁰.
#[inline(always)]
pub(crate) fn nearest(x: f64) -> (f64, u64) {
    let sum = x + ROUNDER;
    (sum - ROUNDER, sum.to_bits())
}

/// `x` with its sign turned if the last bit of `odd` is set.
#[inline(always)]
pub(crate) fn turned(x: f64, odd: u64) -> f64 {
    f64::from_bits(x.to_bits() ^ (odd << 63))
}

#[inline(always)]
fn polynomial(c: &[f64; 6], z: f64) -> f64 {
    let square = z * z;
    let low = (c[0] + c[1] * z) + square * (c[2] + c[3] * z);
    low + (square * square) * (c[4] + c[5] * z)
}

/// Its first four terms.
#[inline(always)]
fn cubic(c: &[f64; 6], z: f64) -> f64 {
    (c[0] + c[1] * z) + (z * z) * (c[2] + c[3] * z)
}

impl Turn {
    /// The functions of `h`, 0 < h < 2²⁰: S and C to 1.2 ulps, D and u without the cancellation at small h.
    #[inline(always)]
    pub(crate) fn at(h: f64) -> Self {
        let (quarters, bits) = nearest(h * FRAC_2_PI);
        let [a, b, c] = HALF_PI;
        let r = ((h - quarters * a) - quarters * b) - quarters * c; // the products and the first difference are exact
        let z = r * r;
        Turn::reduced(h, (quarters, bits, r), polynomial(&SIN, z), polynomial(&COS, z))
    }

    /// The same to eight digits: enough for a first step.
    #[inline(always)]
    pub(crate) fn near(h: f64) -> Self {
        let (quarters, bits) = nearest(h * FRAC_2_PI);
        let r = h - quarters * FRAC_PI_2;
        let z = r * r;
        Turn::reduced(h, (quarters, bits, r), cubic(&SIN, z), cubic(&COS, z))
    }

    /// From h = r + quarters·π/2, with (sin r − r)/r³ and (½ − (1 − cos r)/r²)/r².
    #[inline(always)]
    fn reduced(h: f64, (quarters, bits, r): (f64, u64, f64), of_sin: f64, of_cos: f64) -> Self {
        let z = r * r;
        let s = (r * z) * of_sin; // sin r − r
        let versine = z * (0.5 - z * of_cos); // 1 − cos r
        let (sin_r, cos_r) = (r + s, 1.0 - versine);
        let swapped = bits & 1 == 1;
        let sin = turned(if swapped { cos_r } else { sin_r }, bits >> 1);
        let cos = turned(if swapped { sin_r } else { cos_r }, (bits >> 1) ^ bits);
        // On the first quarter r = h: D = h(1−C) − (S−h)C and u = −h(1−C) − (S−h).
        let small = quarters < 0.5;
        let d = if small { h * versine - s * cos_r } else { h - sin * cos };
        let u = if small { -(h * versine + s) } else { h * cos - sin };
        Turn { h, sin, cos, d, u }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::landing::half_flight::HalfFlight;
    use proptest::prelude::*;

    fn ulps(found: f64, exact: f64) -> f64 {
        (found - exact).abs() / (exact.abs() * f64::EPSILON)
    }

    /// All around the zeros of sine and cosine, where a reduction would show its faults.
    #[test]
    fn sines_near_their_zeros() {
        for k in 1..128u32 {
            let zero = f64::from(k) * std::f64::consts::FRAC_PI_2;
            for step in -400..=400i64 {
                let h = f64::from_bits((zero.to_bits() as i64 + step) as u64);
                let turn = Turn::at(h);
                let (sin, cos) = pxfm::f_sincos(h);
                assert!(ulps(turn.sin, sin) <= 1.0 && ulps(turn.cos, cos) <= 1.0, "{h:e}");
            }
        }
    }

    proptest! {
        #[test]
        fn as_the_correctly_rounded(h in 0.0..200f64, exponent in -8.0..0.0f64) {
            for h in [h, h * pxfm::f_exp10(exponent)] {
                let (turn, exact) = (Turn::at(h), HalfFlight::at(h));
                prop_assert!(ulps(turn.sin, exact.sin) <= 1.2 && ulps(turn.cos, exact.cos) <= 1.2);
                let near = Turn::near(h);
                prop_assert!((near.sin - exact.sin).abs() < 1e-8 && (near.cos - exact.cos).abs() < 1e-8);
                prop_assert!((near.d / exact.d - 1.0).abs() < 1e-7);
                prop_assert!((turn.d / exact.d - 1.0).abs() < 4e-15);
                prop_assert!((turn.u - exact.u).abs() < 4e-15 * exact.u.abs() + 4e-16 * h * h.min(1.0));
            }
        }
    }
}
