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

/// Appends a bound on an error: rounded up to two digits.
pub(crate) fn append_bound(bound: f64, text: &mut String) {
    if bound == 0.0 || !bound.is_finite() {
        return append_number(bound, text);
    }
    let digits = format!("{bound:e}");
    let (mantissa, exponent) = digits.split_once('e').unwrap_or((&digits, "0"));
    let mut two: u32 = mantissa
        .chars()
        .filter(char::is_ascii_digit)
        .take(2)
        .fold(0, |all, digit| 10 * all + digit.to_digit(10).unwrap_or(0));
    match mantissa.len() {
        1 => two *= 10,
        ..=3 => {}
        _ => two += 1, // the shortest digits do not end with 0
    }
    // Writing to a string does not fail.
    let _ = match (two / 10, two % 10) {
        (10, _) => write!(text, "1e{}", exponent.parse().unwrap_or(0) + 1),
        (first, 0) => write!(text, "{first}e{exponent}"),
        (first, second) => write!(text, "{first}.{second}e{exponent}"),
    };
}

/// Appends the digits that are certain: those that all numbers within `error` share after rounding. Without one it
/// appends the first two digits and the bound.
pub(crate) fn append_certain(value: f64, error: f64, text: &mut String) {
    if error == 0.0 {
        return append_number(value, text);
    }
    if !error.is_finite() {
        *text += UNKNOWN;
        return;
    }
    // The exact decimals of both ends, in units of the last of `DIGITS`.
    let exact = format!("{value:.*e}", DIGITS - 1);
    let (mantissa, exponent) = exact.split_once('e').unwrap_or((&exact, "0"));
    let whole: i128 = mantissa.replace('.', "").parse().unwrap_or(0);
    let last = exponent.parse().unwrap_or(0) + 1 - DIGITS as i32;
    // Two more units for what is cut off, and some roundings.
    let off = (ROOM * error / pxfm::f_exp10(f64::from(last))).min(1e36) as i128 + 2;
    for digits in (1..=MOST_CERTAIN).rev() {
        let unit = 10i128.pow((DIGITS - digits) as u32);
        let rounded = |number: i128| (number + number.signum() * (unit / 2)) / unit;
        let own = rounded(whole - off);
        if own == rounded(whole + off) && own != 0 {
            let exponent = last + (DIGITS - digits) as i32;
            let certain: f64 = format!("{own}e{exponent}").parse().unwrap_or(value);
            if exponent > 0 {
                // Zeros before the point would look like digits.
                let _ = write!(text, "{certain:.*e}", digits - 1);
                return;
            }
            return append_number(certain, text);
        }
    }
    let _ = write!(text, "{} ± ", format!("{value:.1e}").parse().map_or(value.to_string(), number));
    append_bound(error, text);
}

/// Decimals with which the certain ones are found: more than an error has that matters.
const DIGITS: usize = 30;

/// Covers the rounding of an error in these units.
const ROOM: f64 = 1.0 + 1e-14;

/// The most digits of a number.
const MOST_CERTAIN: usize = 17;

/// In place of a number of whose error nothing is known: none of its digits is certain. CSV and JSON have it.
const UNKNOWN: &str = "?";

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

    #[test]
    fn bounds_are_rounded_up_to_two_digits() {
        let texts = [
            (4.3639590692056443e-13, "4.4e-13"),
            (4e-13, "4e-13"),
            (0.25, "2.5e-1"),
            (9.91e5, "1e6"),
            (1.01, "1.1e0"),
            (0.0, "0"),
            (9.9e-5, "9.9e-5"),
            (5e-324, "5e-324"),
            (f64::MAX, "1.8e308"),
        ];
        for (bound, expected) in texts {
            let mut text = String::new();
            append_bound(bound, &mut text);
            assert_eq!(text, expected);
        }
    }

    #[test]
    fn texts_have_only_the_digits_that_are_certain() {
        let texts = [
            (5.4319312674983316, 2e-15, "5.43193126749833"),
            (5.4319312674983316, 0.0, "5.4319312674983316"),
            (4.493409457909064, 3.4e-17, "4.493409457909064"),
            (1.5, 1e-13, "1.5"),
            (0.1, 1e-17, "0.1"),
            (2.0, 0.4, "2"),
            (5.5, 0.3, "5.5 ± 3e-1"),
            (1e-22, 3e-20, "1e-22 ± 3e-20"),
            (-8.5e-9, 1e-11, "-8.5e-9"),
            (12345.678, 0.2, "1.235e4"),
            (7.0, f64::INFINITY, "?"),
        ];
        for (value, error, expected) in texts {
            let mut text = String::new();
            append_certain(value, error, &mut text);
            assert_eq!(text, expected, "{value} {error}");
        }
    }
}
