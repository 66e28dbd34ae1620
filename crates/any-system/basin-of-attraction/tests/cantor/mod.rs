//! The Cantor basin, whose fractions are known exactly.

use basin_of_attraction::{Interval, Label};

pub(crate) fn interval(left: f64, right: f64) -> Interval {
    Interval::new(left, right).unwrap()
}

pub(crate) const THIRD: f64 = 1.0 / 3.0;

/// The colour of the gap in which x falls, by the number of steps of x → 3x mod 1 to the middle one.
pub(crate) fn cantor_label(x: f64, colours: u8) -> Label {
    let mut x = x;
    for step in 0..60 {
        if x > THIRD && x < 2.0 * THIRD {
            return Label::from(step % colours);
        }
        x = if x <= THIRD { 3.0 * x } else { 3.0 * x - 2.0 };
    }
    Label::UNDECIDED
}

/// The number of boxes [x + kε, x + (k+1)ε) with a point of the Cantor set in [0, 1] of two copies with these ratios.
#[allow(dead_code)] // Each test file is compiled alone, and not every one counts boxes.
pub(crate) fn cantor_boxes(ratios: (f64, f64), epsilon: f64, x: f64) -> f64 {
    /// Boxes from left to right in this part of the set; `last` is the last box that was counted.
    fn count(
        part: (f64, f64),
        ratios: (f64, f64),
        index: &dyn Fn(f64) -> f64,
        last: &mut f64,
    ) -> f64 {
        let (left, length) = part;
        let (first, end) = (index(left), index(left + length));
        if first < end && length > 1e-13 {
            let right = length * ratios.1;
            return count((left, length * ratios.0), ratios, index, last)
                + count((left + length - right, right), ratios, index, last);
        }
        let new = [first, end].into_iter().filter(|own| {
            let new = *own != *last;
            *last = *own;
            new
        });
        new.count() as f64
    }
    let mut last = f64::NAN;
    count((0.0, 1.0), ratios, &|point| ((point - x) / epsilon).floor(), &mut last)
}
