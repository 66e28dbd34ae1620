//! The values of options: numbers, mass ratios, lift-off speeds.
//!
//! Each function gives the value, or the reason why the text is none: the limit and the remedy. The argument parser
//! puts the option and the text before it.

use crate::error::Error;
use crate::output::number;
use passive_hopper::{LARGEST_LIFT_OFF_SPEED, LiftOffMap, MassRatio};
use std::ops::RangeInclusive;

/// A finite number.
pub(crate) fn finite(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err("it is not a finite number; give a number such as 7.5 or 1e-3".into()),
        Err(_) if text.contains(',') => {
            Err("it is not a number; write a point instead of the comma, as in 7.5".into())
        }
        Err(_) => Err("it is not a number; give a number such as 7.5 or 1e-3".into()),
    }
}

/// A whole number in a range.
pub(crate) fn whole(range: RangeInclusive<u64>) -> impl Fn(&str) -> Result<u64, String> + Clone {
    move |text| match text.parse::<u64>() {
        Ok(value) if range.contains(&value) => Ok(value),
        _ => {
            let (from, to) = (range.start(), range.end());
            Err(format!(
                "it is not a whole number from {from} to {to}; give such a number, in digits only"
            ))
        }
    }
}

/// A number of pixels or frames. Its limit depends on other options.
pub(crate) fn count(text: &str) -> Result<usize, String> {
    text.parse()
        .map_err(|_| "it is not a whole number; give one such as 64, in digits only".to_owned())
}

/// A mass ratio.
pub(crate) fn mass_ratio(text: &str) -> Result<MassRatio, String> {
    let value = finite(text)?;
    MassRatio::new(value).map_err(|_| {
        let largest = number(1.0 / f64::MIN_POSITIVE);
        let smallest = number(f64::MIN_POSITIVE);
        format!("a mass ratio M = m₂/m₁ is from {smallest} to {largest}; give a positive number such as 0.2")
    })
}

/// A lift-off speed.
pub(crate) fn speed(text: &str) -> Result<f64, String> {
    let value = finite(text)?;
    // The limits of a speed do not depend on the mass ratio.
    match LiftOffMap::new(MassRatio::ONE).check_speed(value) {
        Ok(()) => Ok(value),
        Err(_) => {
            let largest = number(LARGEST_LIFT_OFF_SPEED);
            Err(format!(
                "a lift-off speed is positive and at most {largest}, in units of m₂gω/k; give a number such as 7"
            ))
        }
    }
}

/// A lift-off speed, or 0 as the end of a window.
pub(crate) fn speed_or_zero(text: &str) -> Result<f64, String> {
    if finite(text)? == 0.0 { Ok(0.0) } else { speed(text) }
}

/// A number that is positive or zero.
pub(crate) fn not_negative(text: &str) -> Result<f64, String> {
    let value = finite(text)?;
    if value < 0.0 {
        return Err("it must not be negative; give 0 or a positive number such as 1e-6".into());
    }
    Ok(value)
}

/// A speed, or "-" for those of standard input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SpeedOrInput {
    Speed(f64),
    Input,
}

/// A lift-off speed, or "-".
pub(crate) fn speed_or_input(text: &str) -> Result<SpeedOrInput, String> {
    if text == "-" { Ok(SpeedOrInput::Input) } else { speed(text).map(SpeedOrInput::Speed) }
}

/// Whether the speeds come from standard input: none is given, or "-" alone.
///
/// # Errors
/// [`Error::Misuse`] for "-" beside speeds.
pub(crate) fn from_input(name: &str, given: &[SpeedOrInput]) -> Result<bool, Error> {
    let inputs = given.iter().filter(|given| **given == SpeedOrInput::Input).count();
    if inputs > 0 && given.len() > 1 {
        let reason = "- stands for the speeds of standard input, and is given alone; leave it out, or the speeds";
        return Err(Error::misuse(name, "-", reason));
    }
    Ok(inputs == given.len())
}

/// The speeds among these.
pub(crate) fn speeds(given: &[SpeedOrInput]) -> impl Iterator<Item = f64> {
    given.iter().filter_map(|given| match given {
        SpeedOrInput::Speed(speed) => Some(*speed),
        SpeedOrInput::Input => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_that_are_no_values_have_a_reason() {
        for text in ["", "x", "7,5", "inf", "-inf", "nan", "1e999", "0x10", "--7"] {
            assert!(finite(text).is_err(), "{text}");
        }
        for text in ["0", "-1", "1e-310", "1e308"] {
            assert!(mass_ratio(text).unwrap_err().contains("2.2250738585072014e-308"), "{text}");
        }
        for text in ["0", "-7", "8796093022209"] {
            assert!(speed(text).unwrap_err().contains("8796093022208"), "{text}");
        }
        assert_eq!(speed("8796093022208"), Ok(LARGEST_LIFT_OFF_SPEED));
        assert!(speed("5e-324").is_ok() && mass_ratio("1e300").is_ok());
    }
}
