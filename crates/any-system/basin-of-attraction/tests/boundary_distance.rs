//! Distances from the boundary of basins whose intervals are given.

use super::planted_intervals::basins;
use basin_of_attraction::{Bounds, Label};

#[test]
fn gaps_are_boundary_for_the_lower_bound_and_other_basins_for_the_upper() {
    let found = basins(&[(0.0, 2.0, 1), (2.5, 3.0, 1), (4.0, 6.0, 2), (6.5, 9.0, 1)]);
    let at = |x: f64, resolution: f64| found.distance_to_boundary(x, resolution).unwrap();
    let two = at(5.5, 0.0);
    assert_eq!((two.below.lower, two.below.upper), (1.5, 2.5));
    assert_eq!((two.above.lower, two.above.upper), (0.5, 1.0));
    assert_eq!(two.nearest(), Bounds { lower: 0.5, upper: 1.0 });
    // The first basin: no other one below, and the end of the window is not known to be boundary.
    let one = at(0.5, 0.0);
    assert_eq!(one.below, Bounds { lower: 0.5, upper: f64::INFINITY });
    assert_eq!(one.above, Bounds { lower: 1.5, upper: 3.5 });
    // Across a gap that counts as rounding.
    assert_eq!(at(0.5, 0.5).above.lower, 2.5);
    assert_eq!(at(2.6, 0.0).below, Bounds { lower: 2.6 - 2.5, upper: f64::INFINITY });
    assert_eq!(found.distance_to_boundary(3.5, 0.0), None);
    assert_eq!(found.distance_to_boundary(f64::NAN, 0.0), None);
}

/// The fraction within a distance is the share of equally spaced states whose distance is as small.
#[test]
fn the_distribution_of_distances_is_that_of_single_states() {
    let found =
        basins(&[(0.0, 2.0, 1), (2.5, 3.0, 1), (4.0, 6.0, 2), (6.5, 9.0, 1), (9.0001, 9.9, 2)]);
    let label = Label::from(1);
    let distances = found.distances_to_boundary(label, 0.0);
    assert!((distances.length() - 5.0).abs() < 1e-15);
    let states: Vec<f64> = (0..10_000).map(|k| (f64::from(k) + 0.5) * 1e-3).collect();
    let own: Vec<Bounds> = states
        .iter()
        .filter(|&&x| found.label(x) == Some(label))
        .map(|&x| found.distance_to_boundary(x, 0.0).unwrap().nearest())
        .collect();
    for distance in [0.0, 0.1, 0.3, 0.77, 1.0, 2.0] {
        let share = |condition: &dyn Fn(&Bounds) -> bool| {
            own.iter().filter(|bounds| condition(bounds)).count() as f64 / own.len() as f64
        };
        let part = distances.fraction_within(distance).unwrap();
        assert!((part.upper - share(&|d| d.lower <= distance)).abs() < 1e-3, "{distance}");
        assert!((part.lower - share(&|d| d.upper <= distance)).abs() < 1e-3, "{distance}");
    }
    let (safest, largest) = distances.largest().unwrap();
    let most = |end: fn(&Bounds) -> f64| own.iter().map(end).fold(0.0, f64::max);
    assert!((safest - 7.75).abs() < 1e-12);
    assert!((largest.lower - most(|d| d.lower)).abs() < 1e-3);
    assert!((largest.upper - most(|d| d.upper)).abs() < 1e-3);
    assert_eq!(distances.fraction_within(f64::NAN), None);
    assert!(found.distances_to_boundary(Label::from(7), 0.0).largest().is_none());
}
