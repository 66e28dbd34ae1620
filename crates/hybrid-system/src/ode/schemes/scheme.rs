//! The coefficients of a Runge–Kutta pair with an interpolant, arranged as a step needs them.

use crate::ode::chebyshev::NODES;

/// Stages of a step plus the stages of its interpolant, in both pairs.
pub(in crate::ode) const ALL_STAGES: usize = 21;

/// The coefficients of a pair, arranged as a step needs them.
pub(in crate::ode) struct Scheme {
    /// Order of a step, the higher one of the pair.
    pub(in crate::ode) order: u32,
    /// Stages of a step without the stages of its interpolant.
    pub(in crate::ode) stages: usize,
    /// bᵢ: a step is x + h Σ bᵢ kᵢ.
    pub(in crate::ode) weights: &'static [f64],
    /// bᵢ minus the weights of the lower order: h Σ eᵢ kᵢ estimates the error of a step.
    pub(in crate::ode) errors: &'static [f64],
    /// cᵢ: stage i is at time t + cᵢ h.
    pub(in crate::ode) times: [f64; ALL_STAGES],
    /// Row i: the aᵢⱼ that are not zero, as (j, aᵢⱼ), in pairs. The last pair may be filled with a zero. A step sums
    /// the first and the second terms of the pairs separately.
    pub(in crate::ode) rows: [&'static [[(usize, f64); 2]]; ALL_STAGES],
    /// Row i: the weights of stage i in the interpolant at the Chebyshev nodes of the step. The coefficients by powers
    /// are as large as 10⁷ and cancel: rounded to doubles, they would give these weights with errors of 10⁻⁹.
    pub(in crate::ode) nodes: [[f64; NODES]; ALL_STAGES],
}
