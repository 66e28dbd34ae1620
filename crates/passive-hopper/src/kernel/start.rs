//! Where the search for a later landing starts: polynomials fitted to true landings.
//!
//! Their coefficients decide how fast the search is, not what it finds.

use std::f64::consts::PI;

/// By powers of a, then of q.
const SLOW: [[f64; 5]; 5] = [
    [3.894587, -0.050390, 0.063813, -0.009699, -0.041907],
    [6.352252, 0.685032, -0.501031, 0.014033, 0.0],
    [-17.007439, 1.419803, 1.846877, 0.0, 0.0],
    [12.847678, -0.718750, 0.0, 0.0, 0.0],
    [-2.665816, 0.0, 0.0, 0.0, 0.0],
];

/// By powers of the quadratic's root, then of q; to be multiplied by b⁰ and b¹.
const FAST: [[[f64; 5]; 5]; 2] = [
    [
        [1.007936, 0.068245, 0.124808, 0.123929, 0.214718],
        [-0.356464, -1.528721, -2.183957, -0.833889, 0.0],
        [3.382140, 7.322871, 4.340733, 0.0, 0.0],
        [-8.615713, -9.220475, 0.0, 0.0, 0.0],
        [7.902117, 0.0, 0.0, 0.0, 0.0],
    ],
    [
        [-0.017303, -0.307394, -0.550819, -0.871569, 0.0],
        [0.983945, 5.929563, 2.772852, 0.0, 0.0],
        [-2.215785, -11.822482, 0.0, 0.0, 0.0],
        [2.675684, 0.0, 0.0, 0.0, 0.0],
        [0.0; 5],
    ],
];

/// Σ cᵢⱼ aⁱ qʲ over i + j ≤ `degree`.
#[inline(always)]
fn polynomial(c: &[[f64; 5]; 5], degree: usize, a: f64, q: f64) -> f64 {
    let mut sum = 0.0;
    for i in (0..=degree).rev() {
        let mut row = c[i][degree - i];
        for j in (0..degree - i).rev() {
            row = row * q + c[i][j];
        }
        sum = sum * a + row;
    }
    sum
}

/// h for V < π and x > 0, to some percent.
///
/// For short flights V ≈ h/2 − 3x/(2h), with the root h₀ = 3x/(√(V²+3x) − V); the rest is a polynomial in
/// a = h₀/(4 + h₀) and q = V/√(V²+3x).
#[inline(always)]
pub(crate) fn slow(excess: f64, velocity: f64) -> f64 {
    let three = 3.0 * excess;
    let root = (velocity * velocity + three).sqrt();
    let a = three / (4.0 * (root - velocity) + three);
    a * polynomial(&SLOW, 4, a, velocity / root)
}

/// h for V ≥ π, to some percent of the distance e from the end B of its branch: B = mπ if the flight lands
/// before the maximum of branch m (`sign` = −1), else (m+1)π (`sign` = +1).
///
/// With h = B ∓ e and d = |B − V|, d = e + [hsc ± Ys²]/(h ± sc) ≈ 2e + (±Y/B) e², s = sin e, c = cos e: a
/// quadratic, and a polynomial in its root, in q = Q/(1+|Q|), Q = ±Y/B, and in b = ±1/B.
#[inline(always)]
pub(crate) fn fast(excess: f64, velocity: f64, m: f64, sign: f64) -> f64 {
    let end = (if sign > 0.0 { m + 1.0 } else { m }) * PI;
    let distance = sign * (end - velocity);
    let b = sign / end;
    let big = (1.0 + excess) * b;
    let inside = 1.0 + big * distance;
    let a = distance / (1.0 + (if inside > 0.02 { inside } else { 0.02 }).sqrt());
    let q = big / (1.0 + big.abs());
    let e = a * (polynomial(&FAST[0], 4, a, q) + b * polynomial(&FAST[1], 3, a, q));
    end - sign * e
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LiftOffMap, MassRatio};

    /// On the flights of random hops: near enough for one step of order four.
    #[test]
    fn near_the_landings() {
        let mut far = [0usize; 2];
        let mut all = [0usize; 2];
        for k in 0..4000u32 {
            let part = |step: f64| (f64::from(k) * step).fract();
            let m = 0.05 * pxfm::f_pow(400.0, part(0.618_033_988_749_895));
            let alpha = 4.5 + 16.0 * part(0.754_877_666_246_693);
            let map = LiftOffMap::new(MassRatio::new(m).unwrap());
            let landings: Vec<_> = map.landings(alpha).unwrap().map(Result::unwrap).collect();
            for pair in landings.windows(2) {
                let (x, v, h) = (pair[0].excess, pair[0].velocity, 0.5 * pair[1].time);
                let turns = (v / PI).floor();
                let is_fast = v >= PI;
                let start = if is_fast {
                    fast(x, v, turns, if h > v { 1.0 } else { -1.0 })
                } else {
                    slow(x, v)
                };
                all[usize::from(is_fast)] += 1;
                far[usize::from(is_fast)] += usize::from((start - h).abs() > 0.03);
            }
        }
        assert!(all[0] > 1000 && all[1] > 500, "{all:?}");
        assert!(far[0] * 50 < all[0] && far[1] * 8 < all[1], "{far:?} of {all:?}");
    }
}
