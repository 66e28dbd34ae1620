//! The approximate map on both sides of a fixed point, to leading order.

use crate::Coefficients;

/// On the left a hop has one sudden lift-off whose second landing has three times the first one's
/// closing speed: it loses 1 + 3² times as much.
pub const LEFT_FACTOR: f64 = 10.0;

impl Coefficients {
    /// δ' for δ: the approximate map about α*_n (paper, Eq. 19, on the right; the left is not in
    /// the paper).
    ///
    /// ```text
    ///   δ ≥ 0:   δ' = δ − λ δ^{4/3}            next term −λ (β/α*) δ^{5/3}
    ///   δ < 0:   δ' = δ − 10 λ |δ|^{4/3}       next term +10 λ (β/α*) |δ|^{5/3}
    /// ```
    ///
    /// The relative error of δ − δ' is therefore about (β/α*)|δ|^{1/3}: 5 % at |δ| = 10⁻³ for
    /// n = 1. With [`Form::Printed`](crate::Form::Printed) it is 1/3 however small δ is.
    pub fn displacement(&self, delta: f64) -> f64 {
        let root = pxfm::f_cbrt(delta.abs());
        let loss = self.lambda * delta.abs() * root;
        if delta >= 0.0 { delta - loss } else { delta - LEFT_FACTOR * loss }
    }

    /// The approximate f(α) (paper, Eq. 19).
    pub fn image(&self, alpha: f64) -> f64 {
        self.alpha_star + self.displacement(alpha - self.alpha_star)
    }

    /// t = β δ^{1/3}: by how much the first flight is longer than 2α* (Eq. 14).
    pub fn flight_time_shift(&self, delta: f64) -> f64 {
        self.beta * pxfm::f_cbrt(delta)
    }
}
