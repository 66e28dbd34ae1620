//! The size of the first step of an integration.

use super::{Tolerances, vector::Vector};

/// A first step whose terms of lowest and of second order are small against the tolerance (Hairer, Nørsett,
/// Wanner, *Solving Ordinary Differential Equations I*, II.4).
pub(super) fn first_step<V: Vector>(
    field: &impl Fn(f64, &V) -> V,
    start: &V,
    slope: &V,
    tolerances: Tolerances,
    order: u32,
) -> f64 {
    let (size, rate) =
        (in_tolerances(start, start, tolerances), in_tolerances(slope, start, tolerances));
    let euler = if size > 1e-5 && rate > 1e-5 { 0.01 * size / rate } else { 1e-6 };
    let mut ahead = *start;
    ahead.add(euler, slope);
    let mut bend = field(euler, &ahead);
    bend.add(-1.0, slope);
    let worst = rate.max(in_tolerances(&bend, start, tolerances) / euler);
    let refined = if worst > 1e-15 {
        pxfm::f_pow(0.01 / worst, 1.0 / f64::from(order))
    } else {
        (1e-3 * euler).max(1e-6)
    };
    let step = refined.min(100.0 * euler);
    // A field that is not finite there: the steps will say so.
    if step > 0.0 && step.is_finite() { step } else { euler.max(f64::MIN_POSITIVE) }
}

/// The length of a vector, each component in units of its tolerance.
fn in_tolerances<V: Vector>(vector: &V, state: &V, tolerances: Tolerances) -> f64 {
    let unit = |x: f64| tolerances.absolute + tolerances.relative * x.abs();
    let squares = vector.components().zip(state.components()).map(|(v, x)| (v / unit(x)).powi(2));
    squares.sum::<f64>().sqrt()
}
