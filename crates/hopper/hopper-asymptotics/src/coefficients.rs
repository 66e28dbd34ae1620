//! β, λ and Δ of the leading-order map, as printed in the paper and as corrected.

use crate::error::Error;
use crate::local_map::LEFT_FACTOR;
use passive_hopper::{MassRatio, alpha_star};

/// The λ of the paper, or the corrected λ.
///
/// The paper's Eqs. (18)–(20) drop a term of the same order as the term they keep. With t = β δ^{1/3},
///
/// ```text
///   α'² − α² = 2αμ [α t⁴/24 − (2α − sin 2α) δ t]
/// ```
///
/// By the definition of β, (2α − sin 2α) δ t = α t⁴/6. The first term is a quarter of the second, and the paper
/// drops it. The printed λ is therefore 4/3 of the true one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Form {
    /// λ = β μ (2α* − sin 2α*), as printed. Use it only to reproduce the paper's numbers.
    Printed,
    /// λ = ¾ β μ (2α* − sin 2α*), as the exact map has it.
    Corrected,
}

/// The local constants of a fixed point at a mass ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    /// Index n ≥ 1 of the fixed point.
    pub n: u64,
    /// α*_n.
    pub alpha_star: f64,
    /// β = [6 (2α* − sin 2α*)/α*]^{1/3}: the first flight from α* + δ takes longer than 2α* by t ≈ β δ^{1/3}
    /// (Eq. 14).
    pub beta: f64,
    /// λ of f(α* + δ) ≈ α* + δ − λ δ^{4/3} (Eqs. 18, 19).
    pub lambda: f64,
}

impl Coefficients {
    /// The constants at α*_n, in the given form.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0.
    pub fn new(n: u64, mass_ratio: MassRatio, form: Form) -> Result<Self, Error> {
        if n == 0 {
            return Err(Error::Index { n });
        }
        // From tan α* = α* follows sin 2α* = 2α*/(1+α*²), and therefore
        //   2α* − sin 2α* = 2α*³/(1+α*²)      β³ = 12α*²/(1+α*²)
        // Both forms need no sine and do not cancel.
        let alpha_star = alpha_star(n);
        let square = alpha_star * alpha_star;
        let double_minus_sine = 2.0 * alpha_star * (square / (1.0 + square));
        let beta = pxfm::f_cbrt(12.0 * (square / (1.0 + square)));
        let printed = beta * mass_ratio.mu() * double_minus_sine;
        let lambda = match form {
            Form::Printed => printed,
            Form::Corrected => 0.75 * printed,
        };
        Ok(Coefficients { n, alpha_star, beta, lambda })
    }

    /// A on the left of α*_n: a hop moves |δ|^{−1/3} by about A = 10λ/3. On the right it moves by λ/3.
    pub fn left_drift(&self) -> f64 {
        LEFT_FACTOR * self.lambda / 3.0
    }

    /// Δ = λ⁻³, the leading estimate of the length of the trap (Eq. 20).
    ///
    /// It is the δ at which the leading-order map gives δ′ = δ − λ δ^{4/3} = 0.
    pub fn trap_length(&self) -> f64 {
        1.0 / (self.lambda * self.lambda * self.lambda)
    }
}
