//! Quantities with units, such as 80g or 1.2m/s, in kilograms, metres and seconds.
//!
//! A unit that differs from the basic one by a power of ten shifts the decimal exponent before the number is read.
//! So 80g is the `f64` nearest to 0.08 kg, without the rounding of a product.

use crate::output::number;
use crate::refusal::shortened;

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Mass,
    Stiffness,
    Acceleration,
    Length,
    Time,
    Speed,
    Energy,
}

/// A value in kilograms, metres and seconds, with the text that it was read from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Quantity {
    pub(crate) kind: Kind,
    pub(crate) value: f64,
    pub(crate) text: String,
}

/// The units: their text, what they measure, the power of ten to the basic unit, and a divisor for the one that has
/// none.
const UNITS: [(&str, Kind, i32, f64); 43] = [
    ("kg", Kind::Mass, 0, 1.0),
    ("g", Kind::Mass, -3, 1.0),
    ("mg", Kind::Mass, -6, 1.0),
    ("t", Kind::Mass, 3, 1.0),
    ("N/m", Kind::Stiffness, 0, 1.0),
    ("mN/m", Kind::Stiffness, -3, 1.0),
    ("kN/m", Kind::Stiffness, 3, 1.0),
    ("N/cm", Kind::Stiffness, 2, 1.0),
    ("N/mm", Kind::Stiffness, 3, 1.0),
    ("kg/s²", Kind::Stiffness, 0, 1.0),
    ("kg/s^2", Kind::Stiffness, 0, 1.0),
    ("kg/s2", Kind::Stiffness, 0, 1.0),
    ("m/s²", Kind::Acceleration, 0, 1.0),
    ("m/s^2", Kind::Acceleration, 0, 1.0),
    ("m/s2", Kind::Acceleration, 0, 1.0),
    ("cm/s²", Kind::Acceleration, -2, 1.0),
    ("cm/s^2", Kind::Acceleration, -2, 1.0),
    ("cm/s2", Kind::Acceleration, -2, 1.0),
    ("N/kg", Kind::Acceleration, 0, 1.0),
    ("m", Kind::Length, 0, 1.0),
    ("km", Kind::Length, 3, 1.0),
    ("cm", Kind::Length, -2, 1.0),
    ("mm", Kind::Length, -3, 1.0),
    ("µm", Kind::Length, -6, 1.0),
    ("\u{3bc}m", Kind::Length, -6, 1.0),
    ("um", Kind::Length, -6, 1.0),
    ("s", Kind::Time, 0, 1.0),
    ("ms", Kind::Time, -3, 1.0),
    ("µs", Kind::Time, -6, 1.0),
    ("\u{3bc}s", Kind::Time, -6, 1.0),
    ("us", Kind::Time, -6, 1.0),
    ("m/s", Kind::Speed, 0, 1.0),
    ("cm/s", Kind::Speed, -2, 1.0),
    ("mm/s", Kind::Speed, -3, 1.0),
    ("km/s", Kind::Speed, 3, 1.0),
    // 1 km/h is 1/3.6 m/s.
    ("km/h", Kind::Speed, 0, 3.6),
    ("J", Kind::Energy, 0, 1.0),
    ("mJ", Kind::Energy, -3, 1.0),
    ("µJ", Kind::Energy, -6, 1.0),
    ("\u{3bc}J", Kind::Energy, -6, 1.0),
    ("uJ", Kind::Energy, -6, 1.0),
    ("kJ", Kind::Energy, 3, 1.0),
    ("Nm", Kind::Energy, 0, 1.0),
];

/// Bound on the relative error of a value that was read: half an ulp of the decimal number. For km/h the divisor
/// 3.6 and the quotient are rounded too.
pub(crate) const RELATIVE_ERROR: f64 = 1.51 * f64::EPSILON;

impl Kind {
    /// Its name, with an article.
    fn name(self) -> &'static str {
        match self {
            Kind::Mass => "a mass",
            Kind::Stiffness => "a stiffness",
            Kind::Acceleration => "an acceleration",
            Kind::Length => "a length",
            Kind::Time => "a time",
            Kind::Speed => "a speed",
            Kind::Energy => "an energy",
        }
    }

    /// Its basic unit.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Kind::Mass => "kg",
            Kind::Stiffness => "N/m",
            Kind::Acceleration => "m/s²",
            Kind::Length => "m",
            Kind::Time => "s",
            Kind::Speed => "m/s",
            Kind::Energy => "J",
        }
    }

    /// Its units, for a message.
    fn units(self) -> String {
        let own = UNITS.iter().filter(|unit| unit.1 == self && unit.0.is_ascii());
        own.map(|unit| unit.0).collect::<Vec<_>>().join(", ")
    }

    /// The positive quantity of this kind that a text says.
    pub(crate) fn read(self, text: &str) -> Result<f64, String> {
        let quantity = quantity(text, Some(self))?;
        if quantity.kind != self {
            let (own, other, units) = (self.name(), quantity.kind.name(), self.units());
            return Err(format!("it is {other}, not {own}; the units of {own} are {units}"));
        }
        // A value too small for an f64 reads as zero.
        if !(quantity.value > 0.0) {
            return Err(format!(
                "{} must be positive; it is {}",
                self.name(),
                number(quantity.value)
            ));
        }
        Ok(quantity.value)
    }
}

/// The quantity of any kind that a text says.
pub(crate) fn any(text: &str) -> Result<Quantity, String> {
    quantity(text, None)
}

/// A mass in kilograms.
pub(crate) fn mass(text: &str) -> Result<f64, String> {
    Kind::Mass.read(text)
}

/// A stiffness in newtons per metre.
pub(crate) fn stiffness(text: &str) -> Result<f64, String> {
    Kind::Stiffness.read(text)
}

/// An acceleration in metres per second squared.
pub(crate) fn acceleration(text: &str) -> Result<f64, String> {
    Kind::Acceleration.read(text)
}

fn quantity(text: &str, wanted: Option<Kind>) -> Result<Quantity, String> {
    let trimmed = text.trim();
    let (digits, unit) = split(trimmed);
    let example = wanted.unwrap_or(Kind::Speed);
    if digits.is_empty() {
        return Err(format!(
            "it has no number; write a number and a unit, such as 2.5{}",
            example.unit()
        ));
    }
    if unit.starts_with(',') {
        return Err("it has a comma; write a point instead, as in 2.5m".into());
    }
    if unit.is_empty() {
        let (name, units) = (example.name(), example.units());
        return Err(match wanted {
            Some(_) => format!("it has no unit; the units of {name} are {units}"),
            None => {
                "it has no unit; write it behind the number, such as 1.2m/s, 3cm, 0.5s or 2J".into()
            }
        });
    }
    let Some(&(_, kind, exponent, divisor)) = UNITS.iter().find(|known| known.0 == unit) else {
        let unit = shortened(unit);
        return Err(match wanted {
            Some(kind) => {
                format!("'{unit}' is no unit of {}; its units are {}", kind.name(), kind.units())
            }
            None => {
                let all: Vec<_> = UNITS.iter().filter(|u| u.0.is_ascii()).map(|u| u.0).collect();
                format!("'{unit}' is no unit that is known; the units are {}", all.join(", "))
            }
        });
    };
    match shifted(digits, exponent) {
        Some(value) if value.is_finite() => {
            Ok(Quantity { kind, value: value / divisor, text: trimmed.to_owned() })
        }
        Some(_) => Err("it is too large for a number; use a larger unit".into()),
        None => Err(format!(
            "'{}' is not a number; write a number and a unit, such as 2.5{}",
            shortened(digits),
            kind.unit()
        )),
    }
}

/// The number at the start of a text, and the unit after it. An "e" belongs to the number if digits follow.
fn split(text: &str) -> (&str, &str) {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let sign = |at: usize| matches!(bytes.get(at), Some(b'+' | b'-'));
    let mut end = 0;
    while let Some(byte) = bytes.get(end) {
        let in_number = match byte {
            b'0'..=b'9' | b'.' => true,
            b'+' | b'-' => end == 0 || matches!(bytes[end - 1], b'e' | b'E'),
            b'e' | b'E' => digit(end + 1) || (sign(end + 1) && digit(end + 2)),
            _ => false,
        };
        if !in_number {
            break;
        }
        end += 1;
    }
    let (digits, unit) = text.split_at(end);
    (digits, unit.trim_start())
}

/// The number that the digits say, times a power of ten, rounded once.
fn shifted(digits: &str, exponent: i32) -> Option<f64> {
    let (mantissa, own) = match digits.split_once(['e', 'E']) {
        Some((mantissa, own)) => (mantissa, own.parse::<i32>().ok()?),
        None => (digits, 0),
    };
    format!("{mantissa}e{}", own.checked_add(exponent)?).parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_rounded_once() {
        let texts =
            [("80g", 0.08), ("0.1 t", 100.0), ("1.5e2mg", 1.5e-4), ("8e-2kg", 0.08), ("+3kg", 3.0)];
        for (text, kilograms) in texts {
            assert_eq!(mass(text), Ok(kilograms), "{text}");
        }
        assert_eq!(stiffness("2.5N/mm"), Ok(2500.0));
        assert_eq!(acceleration("981cm/s2"), Ok(9.81));
        let speed = any("36km/h").unwrap();
        assert_eq!((speed.kind, speed.value), (Kind::Speed, 10.0));
        // "E" of no exponent is no part of the number.
        assert!(any("3e").unwrap_err().contains("'e' is no unit"));
    }

    #[test]
    fn texts_that_are_no_quantities_have_a_reason() {
        let refused = [
            ("80", "no unit"),
            ("g", "no number"),
            ("", "no number"),
            ("80N", "'N' is no unit of a mass"),
            ("3m", "a length, not a mass"),
            ("-3kg", "must be positive"),
            ("0g", "must be positive"),
            ("1e-400kg", "must be positive"),
            ("1e400kg", "too large"),
            ("1,5kg", "comma"),
            ("1.2.3kg", "not a number"),
            ("nan kg", "no number"),
            ("1e99999999999kg", "not a number"),
            ("3Kg", "no unit of a mass"),
        ];
        for (text, part) in refused {
            let reason = mass(text).unwrap_err();
            assert!(reason.contains(part), "{text}: {reason}");
        }
    }

    #[test]
    fn every_unit_is_read() {
        for (unit, kind, ..) in UNITS {
            let quantity = any(&format!("2{unit}")).unwrap();
            assert!(quantity.kind == kind && quantity.value > 0.0, "{unit}");
        }
    }
}
