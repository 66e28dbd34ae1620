//! The local map: the map about a fixed point, to leading order on both sides.
//!
//! Proof: docs/theory.md, Theorem 35 and Theorem 36.

use crate::coefficients::Coefficients;

/// The loss of a hop on the left of a fixed point, relative to the loss on the right at the same |δ|.
///
/// On the right a hop has one landing. On the left the first landing is followed by a sudden lift-off, and the second
/// landing has three times the closing speed of the first. The losses are proportional to the squares: 1 + 3² = 10.
pub const LEFT_FACTOR: f64 = 10.0;

impl Coefficients {
    /// δ′ for δ by the leading-order map about α*_n. The right side is the paper's Eq. 19; the left side is not in
    /// the paper.
    ///
    /// ```text
    ///   δ ≥ 0:   δ' = δ − λ δ^{4/3}            next term −λ (β/α*) δ^{5/3}
    ///   δ < 0:   δ' = δ − 10 λ |δ|^{4/3}       next term +10 λ (β/α*) |δ|^{5/3}
    /// ```
    ///
    /// The relative error of δ − δ′ is therefore about (β/α*)|δ|^{1/3}: 5 % at |δ| = 10⁻³ for n = 1. With
    /// [`Form::Printed`](crate::Form::Printed) it is 1/3 however small δ is.
    pub fn displacement(&self, delta: f64) -> f64 {
        let root = pxfm::f_cbrt(delta.abs());
        let loss = self.lambda * delta.abs() * root;
        if delta >= 0.0 { delta - loss } else { delta - LEFT_FACTOR * loss }
    }

    /// The leading-order f(α) (paper, Eq. 19).
    pub fn image(&self, alpha: f64) -> f64 {
        self.alpha_star + self.displacement(alpha - self.alpha_star)
    }

    /// t = β δ^{1/3}, by which the first flight takes longer than 2α* (Eq. 14); negative for δ < 0.
    pub fn flight_time_shift(&self, delta: f64) -> f64 {
        self.beta * pxfm::f_cbrt(delta)
    }
}
