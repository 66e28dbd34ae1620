//! The riddled basin of J. C. Sommerer and E. Ott, Nature 365, 138 (1993): every box has starts of both fates, and
//! the uncertainty exponent is near 0.
//!
//! ```text
//!   ẍ = −γ ẋ − ∂V/∂x + f₀ sin ωt        V(x, y) = (1 − x²)² + (x + x̄) y²
//!   ÿ = −γ ẏ − ∂V/∂y                    γ = 0.05, x̄ = 1.9, f₀ = 2.3, ω = 3.5
//! ```

use basin_of_attraction::{Hyperrectangle, Interval, Label, region_boxes, uncertainty_exponent};
use std::sync::LazyLock;

/// Steps of Runge and Kutta's method in a period of the forcing. An orbit is chaotic: with other steps its fate is
/// that of another start nearby.
const STEPS: usize = 60;

/// The forcing at the ends and the middles of the steps.
static FORCING: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / (2 * STEPS) as f64;
    (0..=2 * STEPS).map(|k| 2.3 * angle(k).sin()).collect()
});

fn slope(force: f64, [x, u, y, v]: [f64; 4]) -> [f64; 4] {
    [u, -0.05 * u + 4.0 * x * (1.0 - x * x) - y * y + force, v, -0.05 * v - 2.0 * (x + 1.9) * y]
}

/// The fate of a start at rest: 1 on the attractor in the plane y = 0, 0 at infinity.
fn fate(start: &[f64]) -> Label {
    /// So close to the plane an orbit stays near it for longer than any run.
    const REACHED: f64 = 1e-9;
    /// The orbits of the chaotic sea stay below |y| = 5.
    const FAR: f64 = 20.0;
    let h = std::f64::consts::TAU / 3.5 / STEPS as f64;
    let mut z = [start[0], 0.0, start[1], 0.0];
    for _ in 0..20_000 {
        for k in 0..STEPS {
            let step = |slope: [f64; 4], part: f64| -> [f64; 4] {
                std::array::from_fn(|i| z[i] + part * h * slope[i])
            };
            let a = slope(FORCING[2 * k], z);
            let b = slope(FORCING[2 * k + 1], step(a, 0.5));
            let c = slope(FORCING[2 * k + 1], step(b, 0.5));
            let d = slope(FORCING[2 * k + 2], step(c, 1.0));
            z = std::array::from_fn(|i| z[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
            if !z[2].is_finite() || z[2].abs() > FAR {
                return Label::from(0);
            }
        }
        if z[2].abs() + z[3].abs() < REACHED {
            return Label::from(1);
        }
    }
    Label::UNDECIDED
}

#[test]
fn every_box_of_a_riddled_basin_is_mixed_and_its_exponent_is_near_zero() {
    let side = |left: f64, right: f64| Interval::new(left, right).unwrap();
    let region = Hyperrectangle::new(vec![side(-1.2, 1.2), side(0.1, 1.3)]).unwrap();
    let boxes = region_boxes(&region, 6, 20, 1, fate).unwrap();
    assert!(boxes.boxes == 36 && boxes.open == 0 && boxes.mixed >= 31, "{boxes:?}");
    // Over six decades of ε the fraction of uncertain pairs halves: here the exponent was 0.039, from 0.025 to 0.054.
    let epsilons = [1e-2, 1e-4, 1e-6, 1e-8];
    let found = uncertainty_exponent(&region, &epsilons, 500, 1, fate).unwrap();
    assert!(found.follows_a_power_law(), "{found:?}");
    assert!(found.exponent.lower > 0.0 && found.exponent.upper < 0.08, "{found:?}");
}
