//! What is wanted of full branches: images that are disjoint and in the interval.

use crate::error::Error;
use crate::space::interval::Interval;

/// Some units in the last place: what sums of sixty numbers are off by rounding.
pub(crate) const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Images may overlap by this part of the shorter one: branches that touch do so to rounding.
const TOUCH: f64 = 1e-12;

pub(crate) fn refused(name: &'static str, value: f64, remedy: &'static str) -> Error {
    Error::BadSearch { name, value, remedy }
}

/// Tests the ends of the images, in any order of the branches.
pub(crate) fn check(
    branches: usize,
    interval: Interval,
    image: &impl Fn(usize) -> [f64; 2],
) -> Result<(), Error> {
    if branches == 0 {
        return Err(refused("a number of branches", 0.0, ""));
    }
    let (left, right) = (interval.left, interval.right);
    let width = right - left;
    if !(width > 0.0 && width.is_finite()) {
        return Err(refused("the width of an interval", width, ""));
    }
    let mut images: Vec<[f64; 2]> = (0..branches).map(image).collect();
    images.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let rounding = ROUNDING * left.abs().max(right.abs());
    let slack = |image: &[f64; 2]| TOUCH * (image[1] - image[0]) + rounding;
    for image in &images {
        let outside = (left - image[0]).max(image[1] - right);
        // An image as short as its rounding is nowhere.
        if !(outside <= slack(image) && image[1] - image[0] > rounding) {
            let remedy = ": a preimage is so far outside of the interval, or the image of a branch as short as its rounding";
            return Err(refused("a distance", outside, remedy));
        }
    }
    for pair in images.windows(2) {
        let overlap = pair[0][1] - pair[1][0];
        if !(overlap <= slack(&pair[0]).min(slack(&pair[1]))) {
            return Err(refused("the overlap of two branches", overlap, ": they must be disjoint"));
        }
    }
    Ok(())
}
