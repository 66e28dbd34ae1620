//! The coefficients of a Runge–Kutta pair with an interpolant, arranged as a step needs them.

use crate::ode::chebyshev::NODES;

/// Stages of a step plus the stages of its interpolant, in the pairs that have most.
pub(in crate::ode) const ALL_STAGES: usize = 21;

/// The coefficients of a pair, arranged as a step needs them.
pub(in crate::ode) struct Scheme {
    /// Order of a step, the higher one of the pair.
    pub(in crate::ode) order: u32,
    /// Stages of a step without the stages of its interpolant.
    pub(in crate::ode) stages: usize,
    /// True if the last of these stages is the end of the step: its slope is the first of the next step.
    pub(in crate::ode) first_same_as_last: bool,
    /// Degree of the interpolant, as a polynomial in time.
    pub(in crate::ode) degree: usize,
    /// A step is x + h Σ bᵢ kᵢ. Here and in all other sums k₀ is the slope at the start, kᵢ for i > 0 the difference of
    /// the slope at stage i and k₀, and the first factor is the sum of all factors of the plain slopes: here it is 1.
    pub(in crate::ode) weights: &'static [f64],
    /// bᵢ minus the weights of the lower order: h Σ eᵢ kᵢ estimates the error of a step. The first is 0.
    pub(in crate::ode) errors: &'static [f64],
    /// The estimate of the error of a step over a kink of the field: the larger one of `kink_ratio` times the usual
    /// estimate, and h Σ wᵢ kᵢ with these weights: bᵢ minus the weights of least squares of a quadrature of degree
    /// three.
    ///
    /// For ẋ = max(0, t − θ) all these sums are h² times a function of the place of the kink in the step. The error
    /// itself can be much larger than the usual estimate. It is at most six times the estimate for kinks.
    pub(in crate::ode) kinks: &'static [f64],
    pub(in crate::ode) kink_ratio: f64,
    /// cᵢ: stage i is at time t + cᵢ h.
    pub(in crate::ode) times: &'static [f64],
    /// Row i: the aᵢⱼ that are not zero, as (j, aᵢⱼ), in pairs; the first is cᵢ. The last pair may be filled with a
    /// zero. A step sums the first and the second terms of the pairs separately.
    pub(in crate::ode) rows: &'static [&'static [[(usize, f64); 2]]],
    /// Row i: the weights of stage i in the interpolant at the Chebyshev nodes of the step; in row 0 the place of the
    /// node in the step, from 0 to 1. The coefficients by powers are as large as 10⁷ and cancel: rounded to doubles,
    /// they would give these weights with errors of 10⁻⁹.
    pub(in crate::ode) nodes: &'static [[f64; NODES]],
}

impl Scheme {
    /// Stages of a step plus the stages of its interpolant.
    pub(in crate::ode) fn all_stages(&self) -> usize {
        self.rows.len()
    }
}
