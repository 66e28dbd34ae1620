//! Initial guesses of a later landing: polynomials fitted to solved landings.
//!
//! The coefficients decide how many steps the search takes, not which landing it finds: the search stays inside its
//! bracket (I3) and a landing is accepted by its own tests (I5).

use std::f64::consts::PI;

/// Coefficients cᵢⱼ of aⁱ qʲ with i + j ≤ 4, row by row.
struct Quartic([f64; 5], [f64; 4], [f64; 3], [f64; 2], [f64; 1]);

// The 45 coefficients below were fitted to solved landings; the script is not in the repository yet. Degree 4 trades
// the cost of a guess against the share of flights that one step of order four does not bring close enough: those
// are searched for once more, one by one (the tests below bound that share). Seven digits are far more than the fit
// needs.

/// For V < π, see [`below_pi`].
const BELOW_PI: Quartic = Quartic(
    [3.894587, -0.050390, 0.063813, -0.009699, -0.041907],
    [6.352252, 0.685032, -0.501031, 0.014033],
    [-17.007439, 1.419803, 1.846877],
    [12.847678, -0.718750],
    [-2.665816],
);

/// For V ≥ π, see [`from_pi`]: the part that does not depend on b.
const FROM_PI: Quartic = Quartic(
    [1.007936, 0.068245, 0.124808, 0.123929, 0.214718],
    [-0.356464, -1.528721, -2.183957, -0.833889],
    [3.382140, 7.322871, 4.340733],
    [-8.615713, -9.220475],
    [7.902117],
);

/// For V ≥ π: the factor of b. It has degree 3, so that the last coefficient of each row is zero.
const FROM_PI_TIMES_B: Quartic = Quartic(
    [-0.017303, -0.307394, -0.550819, -0.871569, 0.0],
    [0.983945, 5.929563, 2.772852, 0.0],
    [-2.215785, -11.822482, 0.0],
    [2.675684, 0.0],
    [0.0],
);

/// Lower limit of 1 + Q d, whose root is taken in [`from_pi`].
///
/// It is negative where the quadratic has no real root, near the maximum of V(h) on its branch. The limit gives a
/// guess there too. Its value came with the fit.
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
/// A short flight has V ≈ h/2 − 3x/(2h), from V(h) = h + Sρ − xσ with ρ → −½ and σ → 3/(2h). The positive root is
/// h₀ = V + √(V²+3x) = 3x/(√(V²+3x) − V); the second form does not cancel for V < 0. The guess is a polynomial in
/// a = h₀/(4 + h₀) and q = V/√(V²+3x), times a. The 4 maps h₀ ∈ (0, ∞) to a ∈ (0, 1) and came with the fit.
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

    /// Over the later flights of 4000 hops: below π all guesses but 2 % are close, from π all but 12.5 %.
    #[test]
    fn most_guesses_are_close_to_the_landing() {
        // Flights with V < π, then those with V ≥ π.
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
                let is_from_pi = v >= PI;
                let guess = if is_from_pi {
                    from_pi(x, v, (v / PI).floor(), if h > v { 1.0 } else { -1.0 })
                } else {
                    below_pi(x, v)
                };
                all[usize::from(is_from_pi)] += 1;
                far[usize::from(is_from_pi)] += usize::from((guess - h).abs() > CLOSE);
            }
        }
        assert!(all[0] > 1000 && all[1] > 500, "{all:?}");
        assert!(far[0] * 50 < all[0] && far[1] * 8 < all[1], "{far:?} of {all:?}");
    }
}
