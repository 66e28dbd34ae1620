//! States, points and feature vectors as lists of numbers: their checks, and the Euclidean distance.

use crate::error::Error;

/// An error unless the number of coordinates, or of things given for them, is that expected.
pub(crate) fn check_dimension(dimension: usize, expected: usize) -> Result<(), Error> {
    if dimension == expected {
        return Ok(());
    }
    Err(Error::WrongDimension { dimension, expected })
}

/// Checks that all coordinates are finite.
pub(crate) fn check_point(point: &[f64]) -> Result<(), Error> {
    let bad = point.iter().enumerate().find(|(_, x)| !x.is_finite());
    bad.map_or(Ok(()), |(coordinate, &value)| Err(Error::BadPoint { coordinate, value }))
}

/// The Euclidean distance.
pub(crate) fn distance(one: &[f64], other: &[f64]) -> f64 {
    let differences = || one.iter().zip(other).map(|(a, b)| a - b);
    let square: f64 = differences().map(|x| x * x).sum();
    if square.is_normal() || square.is_nan() {
        return square.sqrt();
    }
    // The squares are too large or too small, or all are 0.
    let largest = differences().fold(0.0f64, |most, x| most.max(x.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * differences().map(|x| (x / largest) * (x / largest)).sum::<f64>().sqrt()
}
