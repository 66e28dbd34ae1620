//! Initial guesses of a later landing: polynomials fitted to solved landings.
//!
//! The coefficients influence how many steps the search takes, but not which landing it finds: the search stays inside
//! its bracket (I3), and the tests of I5 accept the landing.

use std::f64::consts::PI;

/// Coefficients cᵢⱼ of aⁱ qʲ with i + j ≤ 4, row by row.
struct Quartic([f64; 5], [f64; 4], [f64; 3], [f64; 2], [f64; 1]);

// The 45 coefficients below are made by xtask/generators/guesses.py, a weighted fit to the later flights of 5500
// hops: 5000 with M from 0.05 to 20 and α from 4.5 to 20.5, and 500 with M from 0.05 to 200 and α from 20 to 100. A
// higher degree makes a guess more expensive. A lower degree leaves more flights for which one step of order four
// is not enough: such flights are searched again, one by one (the tests below bound their fraction). Six decimals
// are far more than the fit needs.

/// For V < π, see [`below_pi`].
const BELOW_PI: Quartic = Quartic(
    [3.341804, 0.408296, 0.752441, -0.279034, -0.119266],
    [11.321417, -0.903229, -3.721708, 0.619377],
    [-32.211518, 2.699709, 5.571966],
    [32.288459, -0.823804],
    [-11.641337],
);

/// For V ≥ π, see [`from_pi`]: the part that does not depend on b.
const FROM_PI: Quartic = Quartic(
    [0.969146, 0.384565, 0.745798, 0.098718, 0.267907],
    [0.116861, -3.923384, -5.083311, -0.941413],
    [2.154667, 13.187942, 7.108884],
    [-7.839789, -13.599937],
    [8.092626],
);

/// For V ≥ π: the factor of b. It has degree 3, so that the last coefficient of each row is zero.
const FROM_PI_TIMES_B: Quartic = Quartic(
    [0.724399, -2.608268, -1.542433, -0.676732, 0.0],
    [-5.225165, 15.569222, 5.425213, 0.0],
    [11.420461, -20.983902, 0.0],
    [-6.269313, 0.0],
    [0.0],
);

/// Lower limit of 1 + Q d, whose root is taken in [`from_pi`].
///
/// The radicand is negative where the quadratic has no real root, near the maximum of V(h) on its branch. With the
/// limit there is a guess also there. The value is chosen; the fit uses it.
const SMALLEST_RADICAND: f64 = 0.02;

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

/// A guess of h for V < π and x > 0, to a few percent.
///
/// A short flight has V ≈ h/2 − 3x/(2h), from V(h) = h + Sρ − xσ with ρ → −½ and σ → 3/(2h). The positive root is h₀ =
/// V + √(V²+3x) = 3x/(√(V²+3x) − V). The second form does not cancel for V < 0. The guess is a times a polynomial in a
/// = h₀/(4 + h₀) and q = V/√(V²+3x). This maps h₀ ∈ (0, ∞) to a ∈ (0, 1). The 4 is chosen; the fit uses it.
#[inline(always)]
pub(crate) fn below_pi(excess: f64, velocity: f64) -> f64 {
    let three = 3.0 * excess;
    let root = (velocity * velocity + three).sqrt();
    let a = three / (4.0 * (root - velocity) + three);
    a * BELOW_PI.at(a, velocity / root)
}

/// A guess of h for V ≥ π, to a few percent of the distance e from the end B of the bracket: B = mπ if the flight
/// lands before the maximum of branch m (`sign` = −1), else B = (m+1)π (`sign` = +1).
///
/// With h = B ∓ e and d = |B − V|, d = e + [hsc ± Ys²]/(h ± sc) ≈ 2e + Q e², s = sin e, c = cos e, Q = ±Y/B. The
/// root of this quadratic is a = d/(1 + √(1 + Q d)). The guess of e is a times a polynomial in a,
/// q = Q/(1+|Q|) ∈ (−1, 1) and b = ±1/B.
#[inline(always)]
pub(crate) fn from_pi(excess: f64, velocity: f64, m: f64, sign: f64) -> f64 {
    let end = (if sign > 0.0 { m + 1.0 } else { m }) * PI;
    let distance = sign * (end - velocity);
    let b = sign / end;
    let big_q = (1.0 + excess) * b;
    let radicand = 1.0 + big_q * distance;
    let radicand = if radicand > SMALLEST_RADICAND { radicand } else { SMALLEST_RADICAND };
    let a = distance / (1.0 + radicand.sqrt());
    let q = big_q / (1.0 + big_q.abs());
    let e = a * (FROM_PI.at(a, q) + b * FROM_PI_TIMES_B.at(a, q));
    end - sign * e
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::lift_off_map::LiftOffMap;
    use crate::model::mass_ratio::MassRatio;

    /// A guess this close to the landing needs one step of order four.
    const CLOSE: f64 = 0.03;

    /// Over the later flights of 4000 hops, other ones than those of the fit: below π at most 0.5 % of the guesses
    /// are not close, from π on at most 5 %; the largest errors are 0.036 and 0.103 (measured).
    #[test]
    fn most_guesses_are_close_to_the_landing() {
        // Flights with V < π, then flights with V ≥ π.
        let mut far = [0usize; 2];
        let mut all = [0usize; 2];
        let mut largest = [0.0f64; 2];
        for k in 0..4000u32 {
            let part = |step: f64| (f64::from(k) * step).fract();
            let m = 0.05 * pxfm::f_pow(400.0, part(0.618_033_988_749_895));
            let alpha = 4.5 + 16.0 * part(0.754_877_666_246_693);
            let map = LiftOffMap::new(MassRatio::new(m).unwrap());
            let landings = map.landings(alpha).unwrap();
            for pair in landings.windows(2) {
                let (x, v, h) = (pair[0].excess, pair[0].velocity, 0.5 * pair[1].time);
                let is_from_pi = v >= PI;
                let guess = if is_from_pi {
                    from_pi(x, v, (v / PI).floor(), if h > v { 1.0 } else { -1.0 })
                } else {
                    below_pi(x, v)
                };
                let (kind, error) = (usize::from(is_from_pi), (guess - h).abs());
                all[kind] += 1;
                far[kind] += usize::from(error > CLOSE);
                largest[kind] = largest[kind].max(error);
            }
        }
        assert!(all[0] > 1000 && all[1] > 500, "{all:?}");
        assert!(far[0] * 200 < all[0] && far[1] * 20 < all[1], "{far:?} of {all:?}");
        assert!(largest[0] < 0.04 && largest[1] < 0.107, "{largest:?}");
    }
}
