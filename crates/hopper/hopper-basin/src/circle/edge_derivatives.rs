//! The derivatives of f^k at a speed, from differences of orbits in 256 bits.
//!
//! ```text
//!   g_j = f^k(p + jh) − α*_n,   a_j = (g_j − g_{−j})/2,   s_j = (g_j + g_{−j})/2 − g_0
//!
//!   g′  = (3/2 a₁ − 3/10 a₂ + 1/30 a₃)/h + O(h⁶)
//!   g″  = (3 s₁ − 3/10 s₂ + 1/45 s₃)/h² + O(h⁶)
//! ```
//!
//! With 256 bits a difference of nearly equal numbers keeps all digits of an `f64`, so that h may be small.

use crate::fates::fates_at_mass_ratio::Fates;
use passive_hopper::{Arithmetic, ExtendedOrbit, ExtendedStep};

/// A number as the sum of two `f64`.
type Pair = (f64, f64);

/// f^k near a speed p: f^k(p + y) − α*_n = `value` + `slope` · y (1 + `curvature` y/2) + R.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EdgeDerivatives {
    /// f^k(p) − α*_n.
    pub(crate) value: Pair,
    /// Bound on its error.
    pub(crate) value_error: f64,
    pub(crate) slope: f64,
    /// Estimate of its relative error, from two step lengths.
    pub(crate) slope_error: f64,
    /// g″/g′.
    pub(crate) curvature: f64,
    /// |y| for which `remainder` was seen.
    pub(crate) radius: f64,
    /// |R| ≤ `remainder` |y|³: twice the largest quotient at six points, an estimate.
    pub(crate) remainder: f64,
}

/// Largest and smallest exponent of two of the step h. Wider steps meet other laps; narrower ones are as near to
/// the next boundary point as a chart in `f64` would ever be.
const STEPS: std::ops::RangeInclusive<i32> = 8..=36;

/// Two derivatives from steps h and h/4 agree to this part, or h is divided further: a few ulps.
const AGREEMENT: f64 = 1e-15;

/// f^k(`start`) − α*_n in two parts, and a bound on the error; `None` if the orbit ends, or 256 bits do not decide it.
fn after(fates: &Fates, n: u64, hops: usize, start: f64) -> Option<(Pair, f64)> {
    let mut orbit = ExtendedOrbit::new(fates.map(), start, Arithmetic::Bits256).ok()?;
    for _ in 0..hops {
        if orbit.hop().ok()? != ExtendedStep::LiftsOff {
            return None;
        }
    }
    let (offset, rest, error) = orbit.long_offset_from(n);
    Some(((offset, rest), error))
}

/// a + b, with the rounding error of the sum of the first parts.
fn sum(a: Pair, b: Pair) -> f64 {
    let high = a.0 + b.0;
    let part = high - a.0;
    let low = (a.0 - (high - part)) + (b.0 - part);
    high + (low + (a.1 + b.1))
}

/// As [`sum`], in two parts.
fn long_sum(a: Pair, b: Pair) -> Pair {
    let high = a.0 + b.0;
    let part = high - a.0;
    let low = (a.0 - (high - part)) + (b.0 - part) + (a.1 + b.1);
    (high, low)
}

/// The derivatives of `hops` hops at `point`, whose orbit comes near α*_n; `None` if no step is small enough.
pub(crate) fn edge_derivatives(
    fates: &Fates,
    n: u64,
    hops: usize,
    point: f64,
) -> Option<EdgeDerivatives> {
    let (value, value_error) = after(fates, n, hops, point)?;
    let mut wider: Option<(f64, Differences)> = None;
    for exponent in STEPS.step_by(2) {
        let step = 2f64.powi(-exponent);
        let Some(here) = Differences::new(fates, (n, hops), point, step, value) else {
            wider = None;
            continue;
        };
        if let Some((wide_step, wide)) = wider {
            let difference = (here.slope - wide.slope).abs();
            if difference <= AGREEMENT * here.slope.abs() {
                return Some(EdgeDerivatives {
                    value,
                    value_error,
                    slope: here.slope,
                    slope_error: difference / here.slope.abs() + 4.0 * f64::EPSILON,
                    curvature: here.second / here.slope,
                    radius: 3.0 * wide_step,
                    remainder: 2.0 * wide.remainder(&here, wide_step),
                });
            }
        }
        wider = Some((step, here));
    }
    None
}

/// Derivatives from one step, and the values that they come from.
#[derive(Debug, Clone, Copy)]
struct Differences {
    slope: f64,
    second: f64,
    /// g_j − g_0 and g_{−j} − g_0 for j = 1, 2, 3.
    values: [[f64; 2]; 3],
}

impl Differences {
    fn new(
        fates: &Fates,
        (n, hops): (u64, usize),
        point: f64,
        step: f64,
        value: Pair,
    ) -> Option<Self> {
        let minus = (-value.0, -value.1);
        let (mut odd, mut even, mut values) = ([0.0; 3], [0.0; 3], [[0.0; 2]; 3]);
        for j in 0..3 {
            let y = (j + 1) as f64 * step;
            let (right, _) = after(fates, n, hops, point + y)?;
            let (left, _) = after(fates, n, hops, point - y)?;
            odd[j] = 0.5 * sum(right, (-left.0, -left.1));
            // g_j − g_0 and g_{−j} − g_0 nearly cancel each other.
            let (right, left) = (long_sum(right, minus), long_sum(left, minus));
            even[j] = 0.5 * sum(right, left);
            values[j] = [right.0 + right.1, left.0 + left.1];
        }
        let slope = (1.5 * odd[0] - 0.3 * odd[1] + odd[2] / 30.0) / step;
        let second = (3.0 * even[0] - 0.3 * even[1] + even[2] / 45.0) / (step * step);
        (slope != 0.0 && slope.is_finite()).then_some(Differences { slope, second, values })
    }

    /// The largest |R|/|y|³ at the six points, with the derivatives from a smaller step.
    fn remainder(&self, exact: &Differences, step: f64) -> f64 {
        let mut largest: f64 = 0.0;
        for (j, values) in self.values.iter().enumerate() {
            for (sign, value) in [1.0, -1.0].into_iter().zip(values) {
                let y = sign * (j + 1) as f64 * step;
                let rest = value - y * exact.slope - 0.5 * exact.second * y * y;
                largest = largest.max((rest / (y * y * y)).abs());
            }
        }
        largest
    }
}
