//! The size of the first step of an integration.

use super::tolerances::Tolerances;

// The constants of the book. They trade a rejected first step for a few short ones, and never accuracy.

/// Change of the state, relative to its size, by the explicit Euler step; and the first and the second derivative times
/// the power of the step, in units of the tolerance.
const CHANGE: f64 = 0.01;

/// A state or a rate below this, in units of the tolerance, gives no scale. The Euler step is then [`SMALL_STEP`].
const NO_SCALE: f64 = 1e-5;

/// The step if there is no scale, in the unit of time.
const SMALL_STEP: f64 = 1e-6;

/// Both derivatives below this, in units of the tolerance: the field is almost zero, and the step is
/// [`SHARE_OF_EULER`] of the Euler step, or [`SMALL_STEP`].
const ALMOST_ZERO: f64 = 1e-15;

/// See [`ALMOST_ZERO`].
const SHARE_OF_EULER: f64 = 1e-3;

/// Largest first step, in Euler steps.
const MOST_EULER_STEPS: f64 = 100.0;

/// Part of an Euler step that is tried next after one that ends where the field is not finite.
const SHORTER: f64 = 0.1;

/// Tries of an Euler step. The last is 10⁻¹⁶ of the first: a field that is not finite there has no first step.
const TRIES: usize = 17;

/// A first step for which the first and the second derivative change the state by little, in units of the tolerance
/// (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, II.4, "Starting Step Size").
///
/// The constants are those of the book; only the norm is not divided by the dimension. A first step that is too long is
/// rejected and shortened. After a first step that is too short the integration needs a few more steps. Neither costs
/// accuracy. `order` is the higher order of the pair: the lower order plus 1, as in the book's exponent.
///
/// `slope_after` writes the slope after an explicit Euler step of a length, and returns whether the field is finite
/// there. The Euler step is shortened then, as the steps of the integration would be. No step is longer than
/// `longest`.
pub(super) fn first_step(
    start: &[f64],
    slope: &[f64],
    longest: f64,
    tolerances: &Tolerances,
    order: u32,
    mut slope_after: impl FnMut(f64, &mut [f64]) -> bool,
    // Space for a slope.
    bend: &mut [f64],
) -> f64 {
    let in_tolerances = |vector: &[f64]| {
        let components = vector.iter().zip(start).enumerate();
        let squares = components.map(|(axis, (v, x))| (v / tolerances.of(axis, x.abs())).powi(2));
        squares.sum::<f64>().sqrt()
    };
    let (size, rate) = (in_tolerances(start), in_tolerances(slope));
    // An explicit Euler step that changes the state by a hundredth of its size. A state or a rate near zero gives no
    // scale: then the step is small.
    let euler = if size > NO_SCALE && rate > NO_SCALE { CHANGE * size / rate } else { SMALL_STEP };
    let mut euler = euler.min(longest);
    for _ in 0..TRIES {
        if slope_after(euler, bend) {
            break;
        }
        euler *= SHORTER;
    }
    // |x″| ≈ |f(x + h f) − f(x)|/h.
    for (bend, slope) in bend.iter_mut().zip(slope) {
        *bend -= slope;
    }
    let worst = rate.max(in_tolerances(bend) / euler);
    // hᵖ max(|x′|, |x″|) = CHANGE with p = `order`. A field that is almost zero gives no scale.
    let refined = if worst > ALMOST_ZERO {
        pxfm::f_pow(CHANGE / worst, 1.0 / f64::from(order))
    } else {
        (SHARE_OF_EULER * euler).max(SMALL_STEP)
    };
    let step = refined.min(MOST_EULER_STEPS * euler).min(longest);
    // A field that is not finite even at the shortest Euler step: the integration itself will return the error.
    if step > 0.0 && step.is_finite() { step } else { euler.max(f64::MIN_POSITIVE) }
}
