//! What is refused before any work begins.

use crate::error::Error;

/// The longest period. The error of fᵖ grows with p, and every Newton step evaluates f some p times: a million
/// steps of a return map take a minute. A period far above this is a mistake, and the search would not end in a
/// usable time.
const LONGEST_PERIOD: usize = 1_000_000;

/// An error for a period that is not positive, or too long to be iterated.
pub(crate) fn check_period(period: usize) -> Result<(), Error> {
    match (1..=LONGEST_PERIOD).contains(&period) {
        true => Ok(()),
        false => Err(Error::BadPeriod { period, most: LONGEST_PERIOD }),
    }
}

/// An error for something whose number of components is another one than that of the map.
pub(crate) fn check_dimension(
    what: &'static str,
    expected: usize,
    found: usize,
) -> Result<(), Error> {
    match expected == found {
        true => Ok(()),
        false => Err(hybrid_system::Error::Dimension { what, expected, found }.into()),
    }
}

/// An error for a number that is not positive and finite.
pub(crate) fn check_positive(what: &'static str, value: f64) -> Result<(), Error> {
    match value > 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(Error::BadArgument { what, value }),
    }
}

/// An error for a window that is empty or not finite.
pub(crate) fn check_window((left, right): (f64, f64)) -> Result<(), Error> {
    match left < right && (right - left).is_finite() {
        true => Ok(()),
        false => Err(Error::BadArgument { what: "the width of a window", value: right - left }),
    }
}

/// An error for a parameter outside of a window.
pub(crate) fn check_inside(parameter: f64, (left, right): (f64, f64)) -> Result<(), Error> {
    match left <= parameter && parameter <= right {
        true => Ok(()),
        false => {
            let what = "a parameter outside of the window";
            Err(Error::BadArgument { what, value: parameter })
        }
    }
}
