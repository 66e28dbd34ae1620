//! The size of the first step of an integration.

use super::tolerances::Tolerances;
use super::vector::Vector;

/// A first step for which the first and the second derivative change the state by little, in units of the tolerance
/// (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, II.4, "Starting Step Size").
///
/// The constants are those of the book; only the norm is not divided by the dimension. A first step that is too long is
/// rejected and shortened. After a first step that is too short the integration needs a few more steps. Neither costs
/// accuracy. `order` is the higher order of the pair: the lower order plus 1, as in the book's exponent.
pub(super) fn first_step<V: Vector>(
    field: &impl Fn(f64, &V) -> V,
    start: &V,
    slope: &V,
    tolerances: Tolerances,
    order: u32,
) -> f64 {
    let (size, rate) =
        (in_tolerances(start, start, tolerances), in_tolerances(slope, start, tolerances));
    // An explicit Euler step that changes the state by a hundredth of its size. A state or a rate near zero gives no
    // scale: then the step is small.
    let euler = if size > 1e-5 && rate > 1e-5 { 0.01 * size / rate } else { 1e-6 };
    let mut ahead = *start;
    ahead.add(euler, slope);
    // |x″| ≈ |f(x + h f) − f(x)|/h.
    let mut bend = field(euler, &ahead);
    bend.add(-1.0, slope);
    let worst = rate.max(in_tolerances(&bend, start, tolerances) / euler);
    // hᵖ max(|x′|, |x″|) = 0.01 with p = `order`. A field that is almost zero gives no scale.
    let refined = if worst > 1e-15 {
        pxfm::f_pow(0.01 / worst, 1.0 / f64::from(order))
    } else {
        (1e-3 * euler).max(1e-6)
    };
    let step = refined.min(100.0 * euler);
    // A field that is not finite at the Euler step: the integration itself will return the error.
    if step > 0.0 && step.is_finite() { step } else { euler.max(f64::MIN_POSITIVE) }
}

/// The Euclidean length of a vector whose components are measured in units of their tolerances.
fn in_tolerances<V: Vector>(vector: &V, state: &V, tolerances: Tolerances) -> f64 {
    let unit = |x: f64| tolerances.absolute + tolerances.relative * x.abs();
    let squares = vector.components().zip(state.components()).map(|(v, x)| (v / unit(x)).powi(2));
    squares.sum::<f64>().sqrt()
}
