//! The left side of a fixed point, to three orders.

use crate::{Coefficients, Error, ExpansionValue, Form, LEFT_FACTOR};
use passive_hopper::MassRatio;

/// δ′ = δ − 10λ|δ|^{4/3} [1 + c₁|δ|^{1/3} + c₂|δ|^{2/3}] + O(|δ|^{7/3}), δ < 0.
///
/// The first landing has stretch 1 + x, x ≈ α*β|δ|^{1/3}, and speed V ≈ −α*: the spring pulls the
/// lower mass off for a flight of τ = 3x/α*, which ends at 1 − 2x with three times the closing speed.
/// So 1 + 3² = 10 times as much is lost as on the right. To the next orders, with a = α*,
/// κ = M/(1+M):
///
/// ```text
///   c₁ = −β/a        c₂ = −β² (34/25 + 31/(80a²) − 9κ/10)
/// ```
///
/// c₁ mirrors ℓ₅ of the right side. With the exact local forms of `passive_hopper::LocalFlight` for the
/// first landing and h₂ = 3x/(2a) + … from (h − V) D + S u = x S² for the second, both as series in
/// t = τ − 2a,
///
/// ```text
///   Γ₁² + Γ₂² = (5/2) a² t⁴ [1 + (9κ/10 − 107/75 − 283/(240a²)) t² + O(t³)]
///   t = −s [1 − s/(4a) + (4a² + 25) s²/(240a²) − …],   s = β|δ|^{1/3}
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftExpansion {
    /// λ, corrected; the leading coefficient is ten times it.
    pub lambda: f64,
    /// c₁, c₂.
    pub c: [f64; 2],
}

/// Largest |δ| (1 + λ³) at which the error was measured: beyond, the second flight is no longer short.
pub const LEFT_RANGE: f64 = 1e-3;

/// |c₃| and what follows, for n = 1…100, M = 10⁻³…10³.
const NEGLECTED: f64 = 12.0;

impl LeftExpansion {
    /// Exponent of the first neglected term of δ′.
    pub const NEGLECTED_EXPONENT: f64 = 7.0 / 3.0;

    /// The expansion about α*_n.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0.
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        let local = Coefficients::new(n, mass_ratio, Form::Corrected)?;
        let (a, b, kappa) = (local.alpha_star, local.beta, mass_ratio.kappa());
        let second = -b * b * (34.0 / 25.0 + 31.0 / (80.0 * a * a) - 0.9 * kappa);
        Ok(LeftExpansion { lambda: local.lambda, c: [-b / a, second] })
    }

    /// The largest |δ| that is answered: [`LEFT_RANGE`]/(1 + λ³).
    pub fn range(&self) -> f64 {
        LEFT_RANGE / (1.0 + self.lambda * self.lambda * self.lambda)
    }

    /// δ′ for −[`range`](Self::range) ≤ δ ≤ 0.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] elsewhere.
    pub fn displacement(&self, delta: f64) -> Result<ExpansionValue, Error> {
        let loss = self.loss(delta)?;
        let error = loss.error + f64::EPSILON * delta.abs();
        Ok(ExpansionValue { value: delta - loss.value, error, ..loss })
    }

    /// The loss δ − δ′ for −[`range`](Self::range) ≤ δ ≤ 0, without cancellation.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] elsewhere.
    pub fn loss(&self, delta: f64) -> Result<ExpansionValue, Error> {
        let range = self.range();
        if !(-range..=0.0).contains(&delta) {
            return Err(Error::OutsideRange { value: delta, left: -range, right: 0.0 });
        }
        let size = delta.abs();
        let root = pxfm::f_cbrt(size);
        let leading = LEFT_FACTOR * self.lambda * size * root;
        let series = (self.c[0] + self.c[1] * root) * root;
        let rounding = 8.0 * f64::EPSILON * leading;
        let neglected = NEGLECTED * (1.0 + self.lambda) * leading * size;
        Ok(ExpansionValue {
            value: leading * (1.0 + series),
            error: neglected + rounding,
            neglected_exponent: Self::NEGLECTED_EXPONENT,
        })
    }
}
