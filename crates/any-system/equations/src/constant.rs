//! Numbers in formulas: decimals as they are written, doubles, π and e.

use interval_arithmetic::Enclosure;
use std::cmp::Ordering;
use std::fmt;

/// A number of a formula.
///
/// A number in text is the decimal that is written: 0.2 is 1/5, and an enclosure of it contains 1/5. A number from a
/// closure is its `f64`, exactly.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Constant {
    /// A decimal, such as `0.2` or `1.5e-3`, that is meant exactly.
    Decimal(Decimal),
    /// An `f64`, by its bits.
    Double(u64),
    /// π.
    Pi,
    /// e, the base of the natural logarithm.
    Euler,
}

/// A decimal as it was written: digits, perhaps with a sign, a point and an exponent.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Decimal {
    text: String,
    /// The bits of the nearest `f64`, and how its size compares with that of the decimal. Found once: it takes
    /// microseconds.
    nearest: u64,
    size: Ordering,
}

/// The largest number of characters of a decimal. Exact decimals of `f64` have at most 1077.
const LONGEST: usize = 1100;

impl Decimal {
    /// The decimal that is written; `None` unless it has the form `-12.5e-3`, at most 1100 characters, and a
    /// nearest `f64` that is finite.
    pub fn new(text: &str) -> Option<Decimal> {
        let digits = text.bytes().all(|b| b.is_ascii_digit() || b".eE+-".contains(&b));
        let size = text.strip_prefix('-').unwrap_or(text);
        let begins = size.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let fits = text.len() <= LONGEST;
        (digits && begins && fits).then_some(())?;
        let nearest = text.parse::<f64>().ok().filter(|nearest| nearest.is_finite())?;
        let size = compared(size, nearest.abs());
        Some(Decimal { text: text.to_owned(), nearest: nearest.to_bits(), size })
    }

    /// What was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The nearest `f64` is the decimal.
    fn is_double(&self) -> bool {
        self.size.is_eq()
    }
}

/// The size of a decimal compared with an `f64`, exactly.
fn compared(size: &str, number: f64) -> Ordering {
    // All digits of the `f64`: its last one is at most 1074 places behind the point, and 767 are not zero.
    let exact = format!("{number:.1100e}");
    let (own, other) = (significand(size), significand(&exact));
    match (own.0.is_empty(), other.0.is_empty()) {
        (true, true) => Ordering::Equal,
        (true, false) => Ordering::Less,
        (false, true) => Ordering::Greater,
        // Digits without zeros at their ends: a longer one with the same beginning is larger.
        (false, false) => own.1.cmp(&other.1).then_with(|| own.0.cmp(&other.0)),
    }
}

/// The digits of a decimal without zeros at both ends, and the power of ten of the first one.
fn significand(text: &str) -> (String, i64) {
    let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let all = format!("{whole}{fraction}");
    let zeros = all.len() - all.trim_start_matches('0').len();
    let first = whole.len() as i64 - 1 - zeros as i64;
    // An exponent that is no `i64` belongs to a number that is 0 or not finite.
    let exponent: i64 = exponent.parse().unwrap_or(i64::MIN / 2);
    (all.trim_matches('0').to_owned(), first.saturating_add(exponent))
}

impl Constant {
    /// The nearest `f64`.
    pub fn value(&self) -> f64 {
        match self {
            Constant::Decimal(decimal) => f64::from_bits(decimal.nearest),
            Constant::Double(bits) => f64::from_bits(*bits),
            Constant::Pi => std::f64::consts::PI,
            Constant::Euler => std::f64::consts::E,
        }
    }

    /// The number, enclosed: a point if an `f64` is it, else two neighbours.
    pub fn enclosure(&self) -> Enclosure {
        let value = self.value();
        match self {
            Constant::Decimal(decimal) => {
                let size = value.abs();
                let size = match decimal.size {
                    Ordering::Less => Enclosure::new(size.next_down(), size),
                    Ordering::Equal => Enclosure::from(size),
                    Ordering::Greater => Enclosure::new(size, size.next_up()),
                };
                if decimal.text.starts_with('-') { -size } else { size }
            }
            Constant::Double(_) => Enclosure::from(value),
            Constant::Pi => interval_arithmetic::PI,
            // The `f64` is below e by 1.4e-16, less than an ulp.
            Constant::Euler => Enclosure::new(value, value.next_up()),
        }
    }
}

impl From<f64> for Constant {
    fn from(value: f64) -> Self {
        // There is one zero: 0 − x and −x differ for no reader.
        Constant::Double((value + 0.0).to_bits())
    }
}

impl fmt::Display for Constant {
    /// Decimals as they were written. A double that is a short decimal exactly is that decimal; another one is marked,
    /// with the 17 digits that name it: `f64(1.0000000000000001e-1)`.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Constant::Decimal(decimal) => out.write_str(&decimal.text),
            Constant::Double(bits) => {
                let value = f64::from_bits(*bits);
                let short = Decimal::new(&format!("{value:?}"));
                match short.filter(Decimal::is_double) {
                    Some(short) => out.write_str(short.text.trim_end_matches(".0")),
                    None => write!(out, "f64({value:.16e})"),
                }
            }
            Constant::Pi => out.write_str("pi"),
            Constant::Euler => out.write_str("e"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimal(text: &str) -> Constant {
        Constant::Decimal(Decimal::new(text).unwrap())
    }

    #[test]
    fn decimals_are_enclosed_by_neighbours() {
        for text in
            ["0.2", "0.1", "1e-5", "123456789.123456789", "1e300", "3e-320", "0.30000000000000004"]
        {
            let found = decimal(text).enclosure();
            assert_eq!(found.low().next_up(), found.high(), "{text}");
            assert!(found.contains(text.parse().unwrap()), "{text}");
        }
        // 0.2 is below its f64, 0.1 below, 0.3 above: their doubles end on …0111, …55, …9889.
        assert_eq!(decimal("0.2").enclosure().high(), 0.2);
        assert_eq!(decimal("0.1").enclosure().high(), 0.1);
        assert_eq!(decimal("0.3").enclosure().low(), 0.3);
        for text in ["0", "0.0", "0.5", "1", "1.50", "2e3", "0.25e1", "9007199254740993e0"] {
            let exact = !text.starts_with("9007199254740993");
            assert_eq!(decimal(text).enclosure().width() == 0.0, exact, "{text}");
        }
        assert_eq!(decimal("1e-400").enclosure(), Enclosure::new(0.0, 5e-324));
        assert_eq!(decimal("-0.2").enclosure(), -decimal("0.2").enclosure());
    }

    #[test]
    fn what_is_no_decimal_is_refused() {
        for text in ["", ".", "--1", "1e", "1e999", "0x10", "inf", "nan", "1_000", "1.2.3", "e5"] {
            assert_eq!(Decimal::new(text), None, "{text}");
        }
        assert_eq!(Decimal::new(&"1".repeat(LONGEST + 1)), None);
    }
}
