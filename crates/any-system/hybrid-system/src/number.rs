//! Numbers in messages.

use std::fmt;

/// The largest number that is printed without an exponent. Sixteen digits are all that a double has; a longer number
/// would end in digits without meaning.
const LARGEST_PLAIN: f64 = 1e16;

/// The smallest number that is printed without an exponent: four zeros behind the point can still be counted.
const SMALLEST_PLAIN: f64 = 1e-5;

/// A number that prints readably at any size: 0.25, 1e-300, 6.02e23, and not 300 zeros.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Number(pub(crate) f64);

impl fmt::Display for Number {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || !size.is_finite() || (SMALLEST_PLAIN..LARGEST_PLAIN).contains(&size) {
            write!(formatter, "{}", self.0)
        } else {
            write!(formatter, "{:e}", self.0)
        }
    }
}

/// Some numbers, separated by commas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Numbers<'a>(pub(crate) &'a [f64]);

impl fmt::Display for Numbers<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, &number) in self.0.iter().enumerate() {
            let comma = if k == 0 { "" } else { ", " };
            write!(formatter, "{comma}{}", Number(number))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_size_prints_readably() {
        for (number, text) in [
            (0.25, "0.25"),
            (-3.0, "-3"),
            (0.0, "0"),
            (1e-300, "1e-300"),
            (-2.5e-6, "-2.5e-6"),
            (6.02e23, "6.02e23"),
            (f64::INFINITY, "inf"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(Number(number).to_string(), text);
        }
        assert_eq!(Numbers(&[1.0, 1e-20]).to_string(), "1, 1e-20");
    }
}
