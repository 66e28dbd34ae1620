//! β, λ and Δ of the approximate map, as printed and corrected.

use crate::Error;
use passive_hopper::{MassRatio, alpha_star};

/// Which λ.
///
/// The paper's Eqs. (18)–(20) drop a term of the same order as the one they keep: in
/// α'² − α² = 2αμ [α t⁴/24 − (2α − sin 2α) δ t] the first bracket is a quarter of the second for
/// t = β δ^{1/3}. The printed λ is 4/3 of the true one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Form {
    /// λ = β μ (2α* − sin 2α*), as in the paper.
    Printed,
    /// λ = ¾ β μ (2α* − sin 2α*), what the map has.
    Corrected,
}

/// The local constants of a fixed point at a mass ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    /// Index n ≥ 1 of the fixed point.
    pub n: u64,
    /// α*_n.
    pub alpha_star: f64,
    /// β = [6 (2α* − sin 2α*)/α*]^{1/3}: the flight is longer by t ≈ β δ^{1/3} (Eq. 14).
    pub beta: f64,
    /// λ of f(α* + δ) ≈ α* + δ − λ δ^{4/3} (Eqs. 18, 19).
    pub lambda: f64,
}

impl Coefficients {
    /// The constants at α*_n, in the given form.
    ///
    /// By tan α* = α*: sin 2α* = 2α*/(1+α*²), so 2α* − sin 2α* = 2α*³/(1+α*²).
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0.
    pub fn new(n: u64, mass_ratio: MassRatio, form: Form) -> Result<Self, Error> {
        if n == 0 {
            return Err(Error::Index { n });
        }
        let alpha_star = alpha_star(n);
        let square = alpha_star * alpha_star;
        let gap = 2.0 * alpha_star * (square / (1.0 + square));
        let beta = pxfm::f_cbrt(12.0 * (square / (1.0 + square)));
        let printed = beta * mass_ratio.mu() * gap;
        let lambda = match form {
            Form::Printed => printed,
            Form::Corrected => 0.75 * printed,
        };
        Ok(Coefficients { n, alpha_star, beta, lambda })
    }

    /// Δ = λ⁻³, the leading estimate of the interval of attraction (Eq. 20).
    pub fn delta(&self) -> f64 {
        1.0 / (self.lambda * self.lambda * self.lambda)
    }
}
