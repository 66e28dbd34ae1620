//! Basins whose intervals are given.

use basin_of_attraction::{
    Interval, IntervalBasins, Label, Refinement, interval_basins_from_known,
};

/// Basins on [0, 10] with these intervals and labels; all between them is undecided.
pub(crate) fn basins(parts: &[(f64, f64, u8)]) -> IntervalBasins {
    let known: Vec<_> = parts
        .iter()
        .map(|&(left, right, label)| (Interval { left, right }, Label::from(label)))
        .collect();
    let window = Interval { left: 0.0, right: 10.0 };
    let map = |x: f64| Some(x);
    interval_basins_from_known(&map, &known, &[], window, Refinement::default()).unwrap()
}
