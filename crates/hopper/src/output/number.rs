//! Numbers as text.

use std::fmt::Write;

/// Smaller numbers are shorter with an exponent: 1e-5 and not 0.00001.
const SMALLEST_WITHOUT_EXPONENT: f64 = 1e-4;

/// The shortest decimal form that reads back as the same number: with an exponent below 10⁻⁴ and from 10¹⁶ on.
pub(crate) fn number(value: f64) -> String {
    let mut text = String::new();
    append_number(value, &mut text);
    text
}

/// Appends [`number`].
pub(crate) fn append_number(value: f64, text: &mut String) {
    // Several times as fast as the formatter of the standard library, which a filter notices.
    let mut buffer = zmij::Buffer::new();
    if value != 0.0 && value.abs() < SMALLEST_WITHOUT_EXPONENT {
        // Writing to a string does not fail.
        let _ = write!(text, "{value:e}");
        return;
    }
    let digits = buffer.format(value);
    match digits.split_once('+') {
        Some((mantissa, exponent)) => text.extend([mantissa, exponent]),
        None => *text += digits.strip_suffix(".0").unwrap_or(digits),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_and_are_short() {
        let texts = [(7.0, "7"), (0.1, "0.1"), (1e-300, "1e-300"), (1e300, "1e300"), (-0.0, "-0")];
        for (value, text) in texts {
            assert_eq!(number(value), text);
        }
        let mut bits = 1u64;
        for _ in 0..10_000 {
            // A multiplicative generator: any bits will do.
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let value = f64::from_bits(bits);
            if value.is_finite() {
                let text = number(value);
                // Another formatter of shortest digits needs no fewer.
                let shortest = format!("{value:?}");
                assert!(text.len() <= shortest.len(), "{text} {shortest}");
                assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
                assert!(text.len() <= 24, "{text}");
            }
        }
    }
}
