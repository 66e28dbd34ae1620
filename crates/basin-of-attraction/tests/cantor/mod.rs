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
