//! Bounds with few digits, rounded outwards: what is printed is proved too.

/// The largest decimal with `digits` ≤ 15 digits after the point that is not above `value`, |`value`| < 10¹⁵⁻ᵈⁱᵍⁱᵗˢ.
pub(crate) fn at_least(value: f64, digits: usize) -> String {
    decimal(floor_of(value, digits), digits)
}

/// The smallest decimal with so many digits that is not below `value`.
pub(crate) fn at_most(value: f64, digits: usize) -> String {
    decimal(-floor_of(-value, digits), digits)
}

fn power_of_ten(digits: usize) -> f64 {
    10f64.powi(i32::try_from(digits).unwrap_or(0))
}

/// The largest integer that is not above `value` times the power of ten.
fn floor_of(value: f64, digits: usize) -> f64 {
    let power = power_of_ten(digits);
    let whole = (value * power).floor();
    // The product may have been rounded up to an integer. A fused product has the exact sign.
    if value.mul_add(power, -whole) < 0.0 { whole - 1.0 } else { whole }
}

fn decimal(whole: f64, digits: usize) -> String {
    // The sum makes zero of −0.
    format!("{:.digits$}", whole / power_of_ten(digits) + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_rounded_outwards() {
        assert_eq!(
            (at_least(0.123_46, 4), at_most(0.123_46, 4)),
            ("0.1234".into(), "0.1235".into())
        );
        assert_eq!((at_least(0.25, 4), at_most(0.25, 4)), ("0.2500".into(), "0.2500".into()));
        assert_eq!((at_least(0.0, 4), at_most(-0.0, 4)), ("0.0000".into(), "0.0000".into()));
        // The f64 next to 0.3 is below it, and that next to 0.1 above.
        assert_eq!((at_least(0.3, 1), at_most(0.3, 1)), ("0.2".into(), "0.3".into()));
        assert_eq!((at_least(0.1, 1), at_most(0.1, 1)), ("0.1".into(), "0.2".into()));
        assert_eq!(at_least(0.905_619_101_548_377_4, 15), "0.905619101548377");
    }
}
