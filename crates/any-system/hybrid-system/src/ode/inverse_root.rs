//! The power that predicts the size of a step from its error.

/// x^(−1/order), within 3 %. This accuracy suffices for the size of a step. A power function would take longer than the
/// rest of the step control.
pub(super) fn inverse_root(x: f64, order: u32) -> f64 {
    /// The bits of 1.0.
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    // The bits of a double, read as an integer, are a piecewise linear approximation of its logarithm, with 1.0 as
    // zero: log y = −(log x)/order.
    let parts = u64::from(order);
    // Zero and subnormal numbers do not follow that rule.
    let x = x.max(f64::MIN_POSITIVE);
    let guess = f64::from_bits(ONE + ONE / parts - x.to_bits() / parts);
    // One step of Newton's method for y⁻ⁿ = x.
    guess + guess * (1.0 - x * guess.powi(order as i32)) / f64::from(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_roots_are_right_within_three_percent() {
        for (k, order) in (-300..300).flat_map(|k| [(k, 2), (k, 6), (k, 8), (k, 9)]) {
            let x = 1.37f64.powi(k);
            let exact = pxfm::f_pow(x, -1.0 / f64::from(order));
            assert!((inverse_root(x, order) / exact - 1.0).abs() < 0.03, "{x}");
        }
    }
}
