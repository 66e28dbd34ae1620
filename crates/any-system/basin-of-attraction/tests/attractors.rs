//! Attractors found by recurrences: known ones are found, and slow passages are not attractors.

use basin_of_attraction::{
    Attractor, Attractors, Error, Hyperrectangle, Interval, Label, RecurrenceLimits, SplitMix64,
    StateGrid, UnmatchedReason, array_map, box_dimension, region_fractions,
};

fn region(sides: &[(f64, f64)]) -> Hyperrectangle {
    let side = |&(left, right): &(f64, f64)| Interval::new(left, right).unwrap();
    Hyperrectangle::new(sides.iter().map(side).collect()).unwrap()
}

fn grid(region: &Hyperrectangle, cells: usize) -> StateGrid {
    StateGrid::uniform(region.clone(), cells).unwrap()
}

fn starts(region: &Hyperrectangle, count: u64) -> Vec<Vec<f64>> {
    let random = SplitMix64::from_seed(5);
    (0..count).map(|k| region.random_point(&random, k)).collect()
}

/// The fixed point 0 of x + x² attracts [−1, 0] and no point on its right. Orbits pass it in 10⁴ and more steps.
#[test]
fn a_slow_passage_is_no_attractor() {
    let map = |x: &[f64]| Some(vec![x[0] + x[0] * x[0]]);
    let line = region(&[(-1.5, 0.5)]);
    let limits = RecurrenceLimits { escape: Some(10.0), ..RecurrenceLimits::default() };
    for cells in [10, 100, 999, 10_000] {
        let mut points = starts(&line, 25);
        points.extend([vec![1e-3], vec![1e-4], vec![-0.5], vec![-1e-3]]);
        let found = Attractors::search(&map, grid(&line, cells), &points, limits).unwrap();
        assert!(found.attractors().is_empty(), "{cells}");
        // No start of [−1, 0] is called escaped, and each is reported.
        for point in &points {
            let label = found.label(&map, point);
            let attracted = (-1.0..=0.0).contains(&point[0]);
            let reported = found.unmatched().iter().any(|orbit| orbit.start == *point);
            assert_eq!(reported, label.is_undecided());
            assert!(!attracted || label.is_undecided(), "{cells} {point:?}");
            assert!(label.is_undecided() || label == Attractors::ESCAPED);
        }
        let slow = |reason| matches!(reason, UnmatchedReason::NotSettled { drift } if drift < 1e-9);
        assert!(found.unmatched().iter().any(|orbit| slow(orbit.reason)));
    }
}

#[test]
fn fixed_points_cycles_and_chaotic_attractors_are_found() {
    // x → 3x/2 − x³/2 has the attractors ±1.
    let cubic = |x: &[f64]| Some(vec![1.5 * x[0] - 0.5 * x[0] * x[0] * x[0]]);
    let line = region(&[(-1.7, 1.6)]);
    let limits = RecurrenceLimits::default();
    let found = Attractors::search(&cubic, grid(&line, 100), &starts(&line, 50), limits).unwrap();
    assert_eq!((found.attractors().len(), found.unmatched().len()), (2, 0));
    for attractor in found.attractors() {
        let sign = attractor.points[0][0].signum();
        assert!((attractor.points[0][0] - sign).abs() < 1e-9);
        assert_eq!(found.label(&cubic, &[0.3 * sign]), attractor.label);
    }
    // The logistic map at 3.2 has a cycle of two points, at 3.9 a chaotic attractor.
    for (r, least) in [(3.2, 2), (3.9, 60)] {
        let logistic = move |x: &[f64]| Some(vec![r * x[0] * (1.0 - x[0])]);
        let unit = region(&[(0.0, 1.0)]);
        let found =
            Attractors::search(&logistic, grid(&unit, 100), &starts(&unit, 20), limits).unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (1, 0), "{r}");
        let mut cells: Vec<i64> =
            found.attractors()[0].points.iter().map(|x| (100.0 * x[0]) as i64).collect();
        cells.sort_unstable();
        cells.dedup();
        assert!(cells.len() >= least, "{r} {}", cells.len());
    }
}

/// Hénon's map has one attractor in the square, with the area of `known_planes.rs`.
#[test]
fn henons_attractor_is_found_and_other_orbits_escape() {
    let henon = |p: &[f64]| Some(vec![1.0 - 1.4 * p[0] * p[0] + p[1], 0.3 * p[0]]);
    let square = region(&[(-2.0, 2.0), (-2.0, 2.0)]);
    let limits = RecurrenceLimits { escape: Some(100.0), ..RecurrenceLimits::default() };
    let found =
        Attractors::search(&henon, grid(&square, 400), &starts(&square, 100), limits).unwrap();
    assert_eq!((found.attractors().len(), found.unmatched().len()), (1, 0));
    let counts = region_fractions(&square, 20_000, 3, |x| found.label(&henon, x)).unwrap();
    let area = counts.fraction(Label::from(1)).unwrap();
    assert!(area.covers(0.432_495) && counts.undecided() == 0, "{area:?}");
}

/// The stroboscopic map of ẍ + 0.15 ẋ − x + x³ = 0.2 cos t, by 100 steps of Runge and Kutta's method a period.
fn duffing(start: &[f64]) -> Option<Vec<f64>> {
    let slope = |t: f64, x: f64, v: f64| (v, x - x * x * x - 0.15 * v + 0.2 * t.cos());
    let (mut x, mut v) = (start[0], start[1]);
    let h = std::f64::consts::TAU / 100.0;
    for k in 0..100 {
        let t = h * f64::from(k);
        let a = slope(t, x, v);
        let b = slope(t + 0.5 * h, x + 0.5 * h * a.0, v + 0.5 * h * a.1);
        let c = slope(t + 0.5 * h, x + 0.5 * h * b.0, v + 0.5 * h * b.1);
        let d = slope(t + h, x + h * c.0, v + h * c.1);
        x += h / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * c.0 + d.0);
        v += h / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * c.1 + d.1);
    }
    Some(vec![x, v])
}

/// 1000 points in the literature gave 0.512 and 0.488; three of their standard deviations are 0.047.
#[test]
fn duffings_oscillator_has_its_two_basins() {
    let square = region(&[(-2.2, 2.2), (-2.2, 2.2)]);
    let limits = RecurrenceLimits { locate: 200, budget: 10_000, ..RecurrenceLimits::default() };
    let found =
        Attractors::search(&duffing, grid(&square, 100), &starts(&square, 50), limits).unwrap();
    assert_eq!((found.attractors().len(), found.unmatched().len()), (2, 0), "{found:?}");
    let counts = region_fractions(&square, 5000, 3, |x| found.label(&duffing, x)).unwrap();
    assert_eq!(counts.undecided(), 0);
    let mut shares = [1, 2].map(|n| counts.fraction(Label::from(n)).unwrap().value);
    shares.sort_by(f64::total_cmp);
    assert!((shares[1] - 0.512).abs() < 0.047, "{shares:?}");
}

#[test]
fn points_without_a_value_and_of_another_dimension_are_reported() {
    let stops = |x: &[f64]| (x[0] > 0.0).then(|| vec![x[0] - 0.1]);
    let away = |x: &[f64]| Some(vec![x[0] + 1.0]);
    let line = region(&[(-1.0, 1.0)]);
    let limits = RecurrenceLimits::default();
    let found = Attractors::search(&stops, grid(&line, 100), &[vec![0.5]], limits).unwrap();
    assert_eq!(found.unmatched()[0].reason, UnmatchedReason::Stopped);
    assert_eq!(found.label(&stops, &[0.5]), Label::UNDECIDED_MAP);
    let found = Attractors::search(&away, grid(&line, 100), &[vec![0.5]], limits).unwrap();
    assert!(matches!(found.unmatched()[0].reason, UnmatchedReason::LeftRegion(_)));
    let error = Attractors::search(&away, grid(&line, 100), &[vec![0.5, 0.5]], limits).unwrap_err();
    assert_eq!(error, Error::WrongDimension { dimension: 2, expected: 1 });
    for escape in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        let limits = RecurrenceLimits { escape: Some(escape), ..limits };
        let error = Attractors::search(&away, grid(&line, 100), &[vec![0.5]], limits).unwrap_err();
        assert!(matches!(error, Error::BadSearch { .. }), "{escape}: {error}");
    }
}

/// Published box dimensions of Hénon's attractor are 1.26 to 1.28. A cycle has 0, and an orbit that is not finite is refused.
#[test]
fn attractors_have_known_dimensions() {
    let sizes: Vec<f64> = (0..11).map(|k| 0.5 * 10f64.powf(-0.3 * f64::from(k))).collect();
    let henon = array_map(|[x, y]| Some([1.0 - 1.4 * x * x + y, 0.3 * x]));
    let law = box_dimension(&henon, &[0.1, 0.1], 500_000, &sizes, 1).unwrap();
    assert!((1.2..1.33).contains(&law.exponent), "{law:?}");
    let flip = array_map(|[x]: [f64; 1]| Some([-x]));
    let law = box_dimension(&flip, &[2.0], 1000, &sizes, 1).unwrap();
    assert!(law.exponent.abs() < 1e-12, "{law:?}");
    let away = array_map(|[x]: [f64; 1]| Some([1e10 * x]));
    assert!(box_dimension(&away, &[1.0], 1000, &sizes, 1).is_err());
    assert!(box_dimension(&flip, &[2.0], 1000, &[0.0, 0.1, 0.2], 1).is_err());
}

/// Two attractors at a hundredth of a region of ten: short cells are where they are.
#[test]
fn cells_of_given_ends_are_searched() {
    let map = array_map(|[x]: [f64; 1]| Some([0.01 * (300.0 * x).tanh()]));
    let ends = vec![-5.0, -1.0, -0.02, -0.015, -0.005, 0.0, 0.005, 0.015, 0.02, 1.0, 5.0];
    let given = StateGrid::from_edges(vec![ends]).unwrap();
    let points = starts(&region(&[(-5.0, 5.0)]), 40);
    let found = Attractors::search(&map, given, &points, RecurrenceLimits::default()).unwrap();
    assert_eq!((found.attractors().len(), found.unmatched().len()), (2, 0));
    // y = tanh 3y.
    let root = 0.009_949_015_284_526;
    let of = |sign: f64| {
        let near = |own: &&Attractor| (own.points[0][0] - sign * root).abs() < 1e-12;
        found.attractors().iter().find(near).unwrap().label
    };
    for x in [-4.9, -0.3, -1e-3, -1e-9, 1e-9, 1e-3, 0.3, 4.9f64] {
        assert_eq!(found.label(&map, &[x]), of(x.signum()), "{x}");
    }
}
