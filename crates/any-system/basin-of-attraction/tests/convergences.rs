//! Many starts at once have the labels and times of single ones.

use basin_of_attraction::{
    Attractors, Hyperrectangle, Interval, Label, RecurrenceLimits, SplitMix64, StateGrid, StateMap,
    array_map,
};
use std::collections::BTreeSet;
use std::f64::consts::PI;

fn grid(sides: &[(f64, f64)], cells: usize) -> StateGrid {
    let side = |&(left, right): &(f64, f64)| Interval::new(left, right).unwrap();
    let region = Hyperrectangle::new(sides.iter().map(side).collect()).unwrap();
    StateGrid::uniform(region, cells).unwrap()
}

/// Compares both for starts in the square of this half side, and returns the labels.
fn compare(found: &Attractors, map: &dyn StateMap, half: f64) -> BTreeSet<Label> {
    let random = SplitMix64::from_seed(4);
    let start = |k: usize, state: &mut [f64]| {
        for (axis, x) in (0..).zip(state.iter_mut()) {
            *x = half * (2.0 * random.uniform(2 * k as u64 + axis) - 1.0);
        }
    };
    let all = found.convergences(map, 3000, start).unwrap();
    let mut state = vec![0.0; 2];
    for (k, many) in all.iter().enumerate() {
        start(k, &mut state);
        assert_eq!(found.convergence(map, &state), Ok(*many), "{state:?}");
        assert_eq!(found.label(map, &state), many.0);
    }
    all.into_iter().map(|(label, _)| label).collect()
}

/// Hénon's map, by arrays and by vectors; where it has no value; with few steps, few steps outside, and an escape inside the region.
#[test]
fn many_starts_have_the_labels_of_single_ones() {
    let henon = array_map(|[x, y]| Some([1.0 - 1.4 * x * x + y, 0.3 * x]));
    let by_vectors = |p: &[f64]| Some(vec![1.0 - 1.4 * p[0] * p[0] + p[1], 0.3 * p[0]]);
    let partly = array_map(|[x, y]| (x < 1.9).then_some([1.0 - 1.4 * x * x + y, 0.3 * x]));
    let limits = RecurrenceLimits { escape: Some(50.0), ..RecurrenceLimits::default() };
    let square = grid(&[(-2.0, 2.0); 2], 100);
    let found = |limits| Attractors::search(&henon, square.clone(), &[vec![0.1, 0.1]], limits);
    let found = |limits| found(limits).unwrap();
    let known = [Label::from(1), Label::ESCAPED].into();
    assert_eq!(compare(&found(limits), &henon, 2.2), known);
    assert_eq!(compare(&found(limits), &by_vectors, 2.2), known);
    assert!(compare(&found(limits), &partly, 2.2).contains(&Label::UNDECIDED_MAP));
    let lost = RecurrenceLimits { lost: 1, escape: None, ..limits };
    assert_eq!(compare(&found(lost), &henon, 2.2), [Label::from(1), Label::UNDECIDED].into());
    let near = RecurrenceLimits { escape: Some(1.5), ..limits };
    assert_eq!(compare(&found(near), &henon, 2.2), known);
}

/// A coordinate that is periodic, and slow orbits.
#[test]
fn the_same_with_a_periodic_coordinate() {
    // The angle settles at ±π, where the period ends, and the other coordinate slowly.
    let map = array_map(|[angle, x]: [f64; 2]| Some([angle + 0.9 * angle.sin(), 0.97 * x]));
    let angles = grid(&[(-PI, PI), (-1.0, 1.0)], 60).periodic(0).unwrap();
    let starts = [vec![0.3, 0.5], vec![-0.3, -0.5], vec![100.0, 0.2]];
    let found = Attractors::search(&map, angles, &starts, RecurrenceLimits::default()).unwrap();
    assert_eq!((found.attractors().len(), found.unmatched().len()), (1, 0));
    assert_eq!(found.attractors()[0].period, Some(1));
    assert_eq!(compare(&found, &map, 20.0), [Label::from(1)].into());
}
