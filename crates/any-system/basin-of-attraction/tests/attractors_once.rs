//! Each attractor is found once: slow ones, long ones, ones beside a basin's boundary or cut by the region.

use basin_of_attraction::{
    Attractors, Hyperrectangle, Interval, Label, RecurrenceLimits, Remedy, SplitMix64, StateGrid,
    UnmatchedReason, array_map, region_fractions,
};
use std::f64::consts::{PI, TAU};

fn region(sides: &[(f64, f64)]) -> Hyperrectangle {
    let side = |&(left, right): &(f64, f64)| Interval::new(left, right).unwrap();
    Hyperrectangle::new(sides.iter().map(side).collect()).unwrap()
}

fn grid(region: &Hyperrectangle, cells: usize) -> StateGrid {
    StateGrid::uniform(region.clone(), cells).unwrap()
}

fn starts(region: &Hyperrectangle, count: u64) -> Vec<Vec<f64>> {
    let random = SplitMix64::from_seed(7);
    (0..count).map(|k| region.random_point(&random, k)).collect()
}

/// A turn by an angle, and a contraction by a factor.
fn spiral(factor: f64, angle: f64) -> impl Fn(&[f64]) -> Option<Vec<f64>> {
    let (sine, cosine) = (factor * angle.sin(), factor * angle.cos());
    move |x| Some(vec![cosine * x[0] - sine * x[1], sine * x[0] + cosine * x[1]])
}

/// One fixed point, for factors from fast to slow, turns that are rational and irrational parts of a circle, and
/// cells whose corner is the fixed point or not. All starts belong to it.
#[test]
fn a_fixed_point_that_is_approached_slowly_is_one_attractor() {
    let square = region(&[(-1.0, 1.0), (-1.0, 1.0)]);
    for (factor, tests) in [(0.9, 200), (0.99, 200), (0.997, 200), (0.999, 50), (0.9999, 50)] {
        for angle in [0.0, TAU / 3.0, 0.3, 0.3 * TAU] {
            for cells in [20, 100, 101, 1000] {
                let limits = RecurrenceLimits { tests, ..RecurrenceLimits::default() };
                let map = spiral(factor, angle);
                let points = starts(&square, 4);
                let found =
                    Attractors::search(&map, grid(&square, cells), &points, limits).unwrap();
                let counts = (found.attractors().len(), found.unmatched().len());
                assert_eq!(counts, (1, 0), "{factor} {angle} {cells}: {:?}", found.unmatched());
                assert_eq!(found.label(&map, &[0.9, -0.9]), Label::from(1));
                assert_eq!(found.remedy(), None);
            }
        }
    }
}

/// The scene of the suite: 500 points of a slow spiral have one label.
#[test]
fn all_points_of_a_slow_spiral_have_one_label() {
    let square = region(&[(-1.0, 1.0), (-1.0, 1.0)]);
    let map = spiral(0.997, 0.3);
    let found = Attractors::search(
        &map,
        grid(&square, 100),
        &starts(&square, 20),
        RecurrenceLimits::default(),
    )
    .unwrap();
    let counts = region_fractions(&square, 500, 3, |x| found.label(&map, x)).unwrap();
    assert_eq!(found.attractors().len(), 1);
    assert_eq!((counts.undecided(), counts.fraction(Label::from(1)).unwrap().value), (0, 1.0));
}

/// What is too slow for the budget is not settled, with the speed at which it moves, and never an attractor.
#[test]
fn an_approach_that_is_too_slow_is_not_settled() {
    let square = region(&[(-1.0, 1.0), (-1.0, 1.0)]);
    for angle in [0.0, 0.3] {
        let map = spiral(1.0 - 1e-6, angle);
        let limits = RecurrenceLimits { budget: 20_000, ..RecurrenceLimits::default() };
        let found =
            Attractors::search(&map, grid(&square, 100), &[vec![0.7, 0.4]], limits).unwrap();
        assert!(found.attractors().is_empty());
        let reason = found.unmatched()[0].reason;
        let UnmatchedReason::NotSettled { drift } = reason else { panic!("{reason:?}") };
        assert!((1e-8..1e-5).contains(&drift), "{drift}");
        let Some(Remedy::LongerOrbits { budget, .. }) = found.remedy() else { panic!() };
        assert_eq!(budget, 20_000);
        assert!(reason.to_string().contains("not settled"), "{reason}");
    }
}

/// Two slow points close to each other stay two, as far as the grid separates them. 2x − x³ has two fixed points
/// that are approached algebraically.
#[test]
fn two_slow_points_are_two_attractors() {
    let line = region(&[(-1.5, 1.5)]);
    for distance in [0.1f64, 1e-2] {
        // x ← x + e (d² x − x³)/d²: fixed points ±d, with the factor 1 − 2e.
        let map = move |x: &[f64]| {
            Some(vec![x[0] + 1e-3 * x[0] * (1.0 - (x[0] / distance).powi(2)).max(-1.0)])
        };
        let points = [vec![0.3 * distance], vec![-0.3 * distance], vec![1.0], vec![-1.0]];
        let limits = RecurrenceLimits { tests: 20, ..RecurrenceLimits::default() };
        let found = Attractors::search(&map, grid(&line, 1001), &points, limits).unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (2, 0), "{distance}");
    }
    let cubic = |x: &[f64]| Some(vec![2.0 * x[0] - x[0] * x[0] * x[0]]);
    let near = region(&[(-1.3, 1.3)]);
    let found = Attractors::search(
        &cubic,
        grid(&near, 100),
        &starts(&near, 20),
        RecurrenceLimits::default(),
    )
    .unwrap();
    assert_eq!(found.attractors().len(), 2, "{:?}", found.unmatched());
}

/// A cycle of more points than `locate` is whole: its points cover the circle.
#[test]
fn a_cycle_longer_than_a_stretch_is_whole() {
    let square = region(&[(-1.5, 1.5), (-1.5, 1.5)]);
    for period in [300.0, 2500.0, 9000.0] {
        let (sine, cosine) = (TAU / period).sin_cos();
        let map = move |x: &[f64]| {
            let size = x[0].hypot(x[1]);
            let factor = (1.0 + 0.1 * (1.0 - size)).max(0.5);
            let (a, b) = (factor * x[0], factor * x[1]);
            Some(vec![cosine * a - sine * b, sine * a + cosine * b])
        };
        let limits = RecurrenceLimits { tests: 20, ..RecurrenceLimits::default() };
        let points = starts(&square, 4);
        let found = Attractors::search(&map, grid(&square, 100), &points, limits).unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (1, 0), "{period}");
        let mut sectors = [false; 40];
        for point in &found.attractors()[0].points {
            let angle = point[1].atan2(point[0]) + PI;
            sectors[((angle / TAU * 40.0) as usize).min(39)] = true;
        }
        assert!(sectors.iter().all(|seen| *seen), "{period}: {sectors:?}");
    }
}

/// The boundary of its basin passes a cell or two beside Hénon's attractor. It is found from 20 to 1000 cells a side.
#[test]
fn henons_attractor_is_found_with_any_cells() {
    let henon = |p: &[f64]| Some(vec![1.0 - 1.4 * p[0] * p[0] + p[1], 0.3 * p[0]]);
    let square = region(&[(-2.0, 2.0), (-2.0, 2.0)]);
    for cells in [20, 50, 100, 120, 150, 200, 250, 300, 1000] {
        let limits = RecurrenceLimits { escape: Some(100.0), ..RecurrenceLimits::default() };
        let points = starts(&square, 20);
        let found = Attractors::search(&henon, grid(&square, cells), &points, limits).unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (1, 0), "{cells}");
        // An orbit that escapes has a known fate, and no basin's number.
        let label = found.label(&henon, &[-2.0, -2.0]);
        assert_eq!((label, label.basin_number()), (Label::ESCAPED, None));
        assert!(!label.is_undecided() && label != Label::from(0));
    }
}

/// The border that cuts an attractor is named, and a larger region is the remedy.
#[test]
fn an_attractor_that_the_border_cuts_is_said_to_be_cut() {
    let henon = |p: &[f64]| Some(vec![1.0 - 1.4 * p[0] * p[0] + p[1], 0.3 * p[0]]);
    let cut = region(&[(-2.0, 1.0), (-2.0, 2.0)]);
    let found =
        Attractors::search(&henon, grid(&cut, 100), &[vec![0.1, 0.1]], RecurrenceLimits::default())
            .unwrap();
    assert!(found.attractors().is_empty());
    let reason = found.unmatched()[0].reason;
    let UnmatchedReason::CutByBorder(border) = reason else { panic!("{reason:?}") };
    assert_eq!((border.coordinate, border.border), (0, 1.0));
    assert!((border.reached - 1.27).abs() < 0.01, "{border:?}");
    assert_eq!(found.remedy(), Some(Remedy::LargerRegion(border)));
    assert!(found.remedy().unwrap().to_string().contains("beyond the border 1"));
}

/// Orbits that leave a region for good have left it, with the border; a larger region, or a distance of escape, is
/// the remedy.
#[test]
fn a_search_that_finds_none_says_what_would_help() {
    let away = |x: &[f64]| Some(vec![2.0 * x[0]]);
    let line = region(&[(-1.0, 1.0)]);
    let found =
        Attractors::search(&away, grid(&line, 100), &[vec![0.5]], RecurrenceLimits::default())
            .unwrap();
    let Some(Remedy::LargerRegion(border)) = found.remedy() else { panic!("{found:?}") };
    assert_eq!((border.coordinate, border.border), (0, 1.0));
    // On a coarse grid the boundary of the basin lies in every cell of the attractor.
    let narrow = |x: &[f64]| Some(vec![if x[0].abs() < 1e-4 { 0.5 * x[0] } else { x[0] * 2.0 }]);
    let found =
        Attractors::search(&narrow, grid(&line, 100), &[vec![1e-5]], RecurrenceLimits::default())
            .unwrap();
    assert!(matches!(found.remedy(), Some(Remedy::MoreCells { tried: 1615 })), "{found:?}");
    // A region with no remedy: all orbits escape.
    let limits = RecurrenceLimits { escape: Some(10.0), ..RecurrenceLimits::default() };
    let found = Attractors::search(&away, grid(&line, 100), &[vec![0.5]], limits).unwrap();
    assert_eq!((found.remedy(), found.unmatched().len()), (None, 0));
}

/// A chaotic band with a hole of 4·10⁻⁶ leads to a fixed point. The band passes the tests of few orbits,
/// and its orbit then enters the point: both are one, in both orders of starts, and the label is that of the point.
#[test]
fn attractors_whose_orbits_enter_each_other_are_one() {
    let map = |x: &[f64]| {
        Some(vec![match x[0] {
            y if (0.4..0.4 + 4e-6).contains(&y) || y > 3.0 => 5.0,
            y if y > 1.0 => 0.3,
            y => 3.99 * y * (1.0 - y),
        }])
    };
    let line = region(&[(0.0, 6.0)]);
    for order in [[0.3, 5.0], [5.0, 0.3]] {
        let limits = RecurrenceLimits {
            budget: 3_000_000,
            tests: 1,
            locate: 100,
            ..RecurrenceLimits::default()
        };
        let points = order.map(|x| vec![x]);
        let found = Attractors::search(&map, grid(&line, 100), &points, limits).unwrap();
        assert_eq!(found.attractors().len(), 1, "{order:?}: {:?}", found.attractors().len());
        let attractor = &found.attractors()[0];
        assert_eq!(attractor.label, Label::from(1));
        assert!(attractor.points.iter().all(|point| point[0] == 5.0), "{order:?}");
        assert_eq!(found.label(&map, &[0.3]), Label::from(1));
    }
}

/// A fixed point just outside, to which orbits come slowly, and a slow drift out of the last cell: no attractor,
/// and the reason.
#[test]
fn what_moves_slowly_to_the_border_is_no_attractor() {
    let unit = region(&[(0.0, 1.0)]);
    for beyond in [1e-4, 1e-5, 1e-6, 1e-9] {
        let map = move |x: &[f64]| Some(vec![-beyond + 0.9999 * (x[0] + beyond)]);
        let found = Attractors::search(
            &map,
            grid(&unit, 100),
            &[vec![0.5], vec![0.9]],
            RecurrenceLimits::default(),
        )
        .unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (0, 2), "{beyond}");
        assert!(found.remedy().is_some());
    }
    let line = region(&[(-1.0, 1.0)]);
    for step in [1e-5, 1e-6, 1e-7, 1e-8] {
        let map = move |x: &[f64]| {
            Some(vec![match x[0] {
                y if y < 0.985 => y + (0.986 - y).min(0.01),
                y if y < 1.2 => y + step,
                y => 100.0 + 0.5 * (y - 100.0),
            }])
        };
        let found = Attractors::search(
            &map,
            grid(&line, 100),
            &[vec![0.5], vec![-0.3]],
            RecurrenceLimits::default(),
        )
        .unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (0, 2), "{step}");
        assert!(found.label(&map, &[0.5]).is_undecided());
    }
}

/// A spiral onto a corner of the region: it leaves the region at each turn, less and less far.
#[test]
fn a_slow_spiral_onto_the_border_is_cut_by_it() {
    let quarter = region(&[(0.0, 1.0), (0.0, 1.0)]);
    let map = spiral(0.997, 0.3);
    let found = Attractors::search(
        &map,
        grid(&quarter, 100),
        &[vec![0.5, 0.4]],
        RecurrenceLimits::default(),
    )
    .unwrap();
    let reason = &found.unmatched()[0].reason;
    assert!(matches!(reason, UnmatchedReason::CutByBorder(_)), "{reason}");
    assert!(matches!(found.remedy(), Some(Remedy::LargerRegion { .. })), "{:?}", found.remedy());
}

#[test]
fn fewer_than_three_cells_are_refused() {
    let square = region(&[(-1.0, 1.0), (-1.0, 1.0)]);
    for cells in [1, 2] {
        let error = StateGrid::uniform(square.clone(), cells).unwrap_err();
        assert!(error.to_string().contains("3 or more"), "{error}");
    }
}

/// Two fixed points in one cell of the grid, and a third far away: a finer grid separates them, whatever cell they are in.
#[test]
fn attractors_in_one_cell_are_separated() {
    let line = region(&[(-3.0, 3.0)]);
    for (gap, cells) in [(0.5, 5), (0.05, 50), (0.02, 100), (0.4, 4)] {
        let map = move |x: &[f64]| {
            let x = x[0];
            // Fixed points at 1 ± gap/2, and at −2.
            let near = 1.0 + (x - 1.0) * (1.5 - 2.0 * ((x - 1.0) / gap).powi(2)).max(0.5);
            Some(vec![if x < 0.0 { -2.0 + 0.5 * (x + 2.0) } else { near }])
        };
        let points = starts(&line, 20);
        let limits = RecurrenceLimits::default();
        let found = Attractors::search(&map, grid(&line, cells), &points, limits).unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (3, 0), "{gap} {cells}");
        for (at, own) in [(1.0 - 0.5 * gap, 0.95), (1.0 + 0.5 * gap, 1.05), (-2.0, -1.0)] {
            let label = found.label(&map, &[own]);
            let attractor = found.attractors().iter().find(|other| other.label == label).unwrap();
            assert!((attractor.points[0][0] - at).abs() < 1e-9, "{at} {:?}", attractor.points);
            assert_eq!(attractor.period, Some(1));
        }
        let starts: usize = found.attractors().iter().map(|attractor| attractor.starts).sum();
        assert_eq!(starts, 20);
    }
}

/// The multistable map of the tests of Attractors.jl: each eighth of the plane has a fixed point at the radius 0.1; for r ≥ ½ one at 0.01 and one at 3. Its
/// grid of 100 cells a side finds 4 and 12 of them. There are 8 and 16.
#[test]
fn the_multistable_map_has_8_and_16_attractors() {
    let map = |r: f64| {
        array_map(move |[x, y]: [f64; 2]| {
            let eighth = (y.atan2(x).rem_euclid(TAU) / (PI / 4.0)).floor();
            let radius = match (r < 0.5, x.hypot(y) > 1.0) {
                (true, _) => 0.1,
                (false, true) => 3.0,
                (false, false) => 0.01,
            };
            let angle = (eighth + 0.5) * PI / 4.0;
            Some([radius * angle.cos(), radius * angle.sin()])
        })
    };
    let square = region(&[(-10.0, 10.0), (-10.0, 10.0)]);
    let mut points = starts(&square, 400);
    points.extend(starts(&region(&[(-1.0, 1.0), (-1.0, 1.0)]), 100));
    for (r, cells, count) in [(0.3, 100, 8), (0.7, 1000, 16)] {
        let limits = RecurrenceLimits { tests: 50, ..RecurrenceLimits::default() };
        let found = Attractors::search(&map(r), grid(&square, cells), &points, limits).unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (count, 0), "{r}");
        assert!(found.attractors().iter().all(|own| own.period == Some(1)));
    }
}
