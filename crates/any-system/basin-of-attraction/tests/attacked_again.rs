//! Promises that were false once: distances, periods, hidden coordinates, gaps, files.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use basin_of_attraction::{
    Attractors, FeatureGroups, GapLengths, Hyperrectangle, Interval, Metric, RecurrenceLimits,
    StateGrid, array_map, suggested_radius_by,
};

/// A spiral that turns by a rational part and shrinks by 10⁻⁶ a step, once it is near its centre: one turn of its points, or two, do not show that they go on.
#[test]
fn slow_spirals_have_no_long_periods() {
    for (p, q, near) in [(1, 401, 1e-6), (40, 401, 1e-6), (3, 350, 1e-6), (100, 401, 2e-6)] {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(p) / f64::from(q)).sin_cos();
        let map = array_map(move |[x, y]: [f64; 2]| {
            let r = x.hypot(y);
            let shorter = if r > near { (near + 0.5 * (r - near)) / r } else { 1.0 };
            let f = (1.0 - 1e-6) * shorter;
            Some([f * (cosine * x - sine * y), f * (sine * x + cosine * y)])
        });
        let square = Hyperrectangle::new(vec![Interval::new(-1.03, 1.0).unwrap(); 2]).unwrap();
        let grid = StateGrid::uniform(square, 100).unwrap();
        let found = Attractors::search(&map, grid, &[vec![0.5, 0.3]], RecurrenceLimits::default());
        let period = found.unwrap().attractors()[0].period;
        assert!(matches!(period, None | Some(1)), "{p}/{q}: {period:?}");
    }
}

/// Two cycles whose x is in the same cell at every second step, and whose y is hidden: neither enters the other one.
#[test]
fn cycles_that_cross_cells_of_each_other_are_two() {
    let map = array_map(|[x, y]: [f64; 2]| {
        let side = y.signum();
        let to = if side * x < 0.25 { 0.5 * side } else { 0.01 * f64::from(side < 0.0) };
        let near = y + 0.5 * y * (1.0 - y * y) / (1.0 + y * y);
        Some([to + 0.001 * x.clamp(-1.0, 1.0), near])
    });
    let line = Interval::new(-2.0, 2.0).unwrap().try_into().unwrap();
    let grid = StateGrid::uniform(line, 101).unwrap().of_coordinates(&[0], 2).unwrap();
    let starts = [vec![0.1, 1.0], vec![0.1, -1.0]];
    let found = Attractors::search(&map, grid, &starts, RecurrenceLimits::default()).unwrap();
    assert_eq!(found.attractors().len(), 2);
    let [one, two] = [1.0, -1.0].map(|y| found.label(&map, &[0.0, y]));
    assert!(one.is_decided() && two.is_decided() && one != two, "{one} {two}");
}

/// Vectors of two kinds without a distance between them; kinds that only few others reach; distances that no number holds.
#[test]
fn radii_and_silhouettes_of_distances_that_are_missing_or_too_large() {
    let far = |limit: f64| {
        Metric::by(move |a, b| {
            let apart = (a[0] - b[0]).abs();
            if apart > limit { f64::NAN } else { apart }
        })
    };
    let numbers = [2.0, 22.0, 14.0, 6.0, 4.0, 20.0, 2.0, 4.0, 7.0].map(|x| vec![x]);
    let found = suggested_radius_by(&far(6.0), &numbers, 3).unwrap();
    let groups = |radius: f64| {
        let groups = FeatureGroups::dense_by(far(6.0), &numbers, radius, 3).unwrap();
        groups.labels().into_iter().map(|label| groups.vectors(label).count()).collect::<Vec<_>>()
    };
    assert_eq!((groups(found.from), groups(1e6)), (groups(found.radius), groups(found.radius)));
    let same = Metric::by(|a, b| if a == b { 0.0 } else { 1e10 });
    let tiny = [1e-300, 1e-300, 2e-300, 2e-300].map(|x| vec![x]);
    let found = suggested_radius_by(&same, &tiny, 2).unwrap();
    assert!(found.radius.is_finite() && found.from < found.radius, "{found:?}");
    let large = [1.0, 1.1, -1.0, -1.1].map(|x| vec![8e307 * x]);
    let groups = FeatureGroups::dense(&large, 4e307, 2).unwrap();
    assert!(groups.silhouettes().values().all(|own| *own == 1.0), "{:?}", groups.silhouettes());
}

/// A strip between two joined gaps may belong to the set, or not; windows may be as wide as numbers are.
#[test]
fn what_lies_between_joined_gaps_is_in_no_lower_bound() {
    let interval = |left, right| Interval::new(left, right).unwrap();
    let halves = [interval(0.0, 0.5), interval(0.5 + 1e-9, 1.0)];
    let lengths = GapLengths::new(&halves, interval(0.0, 1.0), 1e-8).unwrap();
    let bounds = lengths.length_of_set(0.0, 0.0).unwrap();
    assert!(bounds.lower == 0.0 && (bounds.upper - 1e-9).abs() < 1e-15, "{bounds:?}");
    let wide = [interval(-1e308, 0.0), interval(1e307, 1e308)];
    let lengths = GapLengths::new(&wide, interval(-1e308, 1e308), 0.0).unwrap();
    assert_eq!(lengths.left(), 1e307);
}

/// Images of another size than their grid have no files.
#[test]
#[cfg(feature = "figures")]
fn images_of_another_size_have_no_files() {
    use basin_of_attraction::{Grid, Label, LabelImage, ValueImage};
    let side = Interval::new(0.0, 1.0).unwrap();
    let grid = |columns, rows| Grid { x: side, y: side, columns, rows };
    let one = LabelImage { grid: grid(3, 2), labels: vec![Label::from(1)] };
    assert!(one.files("a").is_err());
    let none = ValueImage { grid: grid(0, 0), values: vec![] };
    assert!(none.files("a", "numbers").is_err());
}
