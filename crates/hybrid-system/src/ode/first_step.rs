//! The size of the first step of an integration.

use super::Tolerances;
use crate::State;

/// The order that the first step is chosen for.
const ORDER: f64 = 9.0;

/// A first step whose terms of lowest and of second order are small against the tolerance (Hairer, Nørsett,
/// Wanner, *Solving Ordinary Differential Equations I*, II.4). Allocates nothing, as the integrator's own
/// choice does.
pub(super) fn first_step<const N: usize>(
    field: &impl Fn(f64, &State<N>) -> State<N>,
    start: &State<N>,
    tolerances: Tolerances,
) -> f64 {
    let scale = start.map(|x| tolerances.absolute + tolerances.relative * x.abs());
    let slope = field(0.0, start);
    let (size, rate) = (start.component_div(&scale).norm(), slope.component_div(&scale).norm());
    let euler = if size > 1e-5 && rate > 1e-5 { 0.01 * size / rate } else { 1e-6 };
    let bend = (field(euler, &(start + slope * euler)) - slope).component_div(&scale).norm() / euler;
    let worst = rate.max(bend);
    let refined = if worst > 1e-15 {
        pxfm::f_pow(0.01 / worst, 1.0 / ORDER)
    } else {
        (1e-3 * euler).max(1e-6)
    };
    let step = refined.min(100.0 * euler);
    // A field that is not finite there: the steps will say so.
    if step > 0.0 && step.is_finite() { step } else { euler.max(f64::MIN_POSITIVE) }
}
