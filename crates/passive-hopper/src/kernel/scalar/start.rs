//! Where the search for a later landing starts: polynomials fitted to true landings.
//!
//! Their coefficients decide how fast the search is, not what it finds.

use std::f64::consts::PI;

/// Coefficients cᵢⱼ of aⁱ qʲ with i + j ≤ 4, row by row.
struct Quartic([f64; 5], [f64; 4], [f64; 3], [f64; 2], [f64; 1]);

const SLOW: Quartic = Quartic(
    [3.894587, -0.050390, 0.063813, -0.009699, -0.041907],
    [6.352252, 0.685032, -0.501031, 0.014033],
    [-17.007439, 1.419803, 1.846877],
    [12.847678, -0.718750],
    [-2.665816],
);

const FAST: Quartic = Quartic(
    [1.007936, 0.068245, 0.124808, 0.123929, 0.214718],
    [-0.356464, -1.528721, -2.183957, -0.833889],
    [3.382140, 7.322871, 4.340733],
    [-8.615713, -9.220475],
    [7.902117],
);

/// The part to be multiplied by b.
const FAST_BY_END: Quartic = Quartic(
    [-0.017303, -0.307394, -0.550819, -0.871569, 0.0],
    [0.983945, 5.929563, 2.772852, 0.0],
    [-2.215785, -11.822482, 0.0],
    [2.675684, 0.0],
    [0.0],
);

impl Quartic {
    #[inline(always)]
    fn at(&self, a: f64, q: f64) -> f64 {
        let rows = (row(&self.0, q), row(&self.1, q), row(&self.2, q), row(&self.3, q), self.4[0]);
        let square = a * a;
        (rows.0 + a * rows.1) + square * ((rows.2 + a * rows.3) + square * rows.4)
    }
}

/// Σ cⱼ qʲ.
#[inline(always)]
fn row<const N: usize>(c: &[f64; N], q: f64) -> f64 {
    let mut sum = c[N - 1];
    for j in (0..N - 1).rev() {
        sum = sum * q + c[j];
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
    a * SLOW.at(a, velocity / root)
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
    let e = a * (FAST.at(a, q) + b * FAST_BY_END.at(a, q));
    end - sign * e
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::lift_off_map::LiftOffMap;
    use crate::model::mass_ratio::MassRatio;

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
