//! Windows whose ends are finite, and whose length is not.

use basin_of_attraction::{
    Error, Interval, IntervalBasins, Label, Refinement, StopReason, interval_basins_from_known,
    monotone_branches,
};

/// Their lengths and fractions would be NaN, and a search that follows the longest intervals first would never end.
#[test]
fn a_window_of_infinite_length_is_refused() {
    let (left, right) = (f64::MIN, f64::MAX);
    let endless = Interval { left, right };
    let bad = Error::BadInterval { left, right };
    let (map, known) =
        (|x: f64| Some(0.5 * x), [(Interval { left: 0.0, right: 1.0 }, Label::from(1))]);
    let basins = IntervalBasins::from_known(endless, &known, StopReason::AllFollowed);
    assert_eq!(basins, Err(bad.clone()));
    let found = interval_basins_from_known(&map, &known, &[], endless, Refinement::default());
    assert_eq!(found, Err(bad.clone()));
    assert_eq!(monotone_branches(&map, endless, 100).map(|found| found.len()), Err(bad));
}
