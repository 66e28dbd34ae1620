//! Escape rates and orbits on chaotic saddles with known answers.

use basin_of_attraction::{
    EscapeTimes, Hyperrectangle, Interval, SaddleSearch, array_map, repeller, saddle_orbit,
};

fn cube(sides: &[(f64, f64)]) -> Hyperrectangle {
    let side = |&(left, right): &(f64, f64)| Interval::new(left, right).unwrap();
    Hyperrectangle::new(sides.iter().map(side).collect()).unwrap()
}

/// The logistic map at r = 5: the rate of Bowen's equation, from random starts and with a settled law.
#[test]
fn random_orbits_escape_at_the_rate_of_the_operator() {
    let map = array_map(|[x]: [f64; 1]| Some([5.0 * x * (1.0 - x)]));
    let inside = |x: &[f64]| (0.0..=1.0).contains(&x[0]);
    let unit = cube(&[(0.0, 1.0)]);
    let times = EscapeTimes::of_random_points(&map, &inside, &unit, 400_000, 12, 5).unwrap();
    let known = repeller(2, Interval::new(0.0, 1.0).unwrap(), |k, y| {
        let root = (0.25 - y / 5.0).sqrt();
        (if k == 0 { 0.5 - root } else { 0.5 + root }, 0.1 / root)
    })
    .unwrap();
    for (from, to) in [(4, 8), (4, 12), (6, 10)] {
        let rate = times.rate(from, to).unwrap();
        assert!(rate.covers(known.escape_rate) && rate.half_width() < 0.02, "{rate:?} {known:?}");
    }
    assert_eq!(times.survivors()[0], 400_000);
    assert!(times.rate(5, 5).is_err() && times.rate(5, 13).is_err());
    // Starts outside do not count; a state without an image has left.
    let half = array_map(|[x]: [f64; 1]| (x < 0.5).then_some([x]));
    let all = EscapeTimes::of_random_points(&half, &inside, &cube(&[(-1.0, 1.0)]), 10_000, 3, 5);
    let survivors = all.unwrap().survivors().to_vec();
    assert!((4800..5200).contains(&survivors[0]) && (2300..2700).contains(&survivors[1]));
    assert_eq!(survivors[1], survivors[3]);
    let nowhere = |_: &[f64]| false;
    assert!(EscapeTimes::of_random_points(&half, &nowhere, &unit, 10, 3, 5).is_err());
    let plane = cube(&[(0.0, 1.0); 2]);
    assert!(EscapeTimes::of_random_points(&half, &inside, &plane, 10, 3, 5).is_err());
}

/// Hénon's map with a = 6 is a horseshoe: its saddle is that of two symbols, uniformly visited. Fixed points are on it.
#[test]
fn stagger_and_step_follows_the_saddle_of_a_horseshoe() {
    let (a, b) = (6.0, 0.4);
    let map = array_map(move |[x, y]: [f64; 2]| Some([a - x * x + b * y, x]));
    let inside = |p: &[f64]| p.iter().all(|x| x.abs() <= 4.0);
    let square = cube(&[(-4.0, 4.0); 2]);
    let search = SaddleSearch::staying(12);
    let found = saddle_orbit(&map, &inside, &square, 4000, search).unwrap();
    assert!(found.lost.is_none() && found.points.len() == 4000 && found.largest <= 0.1);
    // Each point stays as long as was asked for.
    for point in &found.points {
        let mut at = [point[0], point[1]];
        for _ in 0..=12 {
            at = [a - at[0] * at[0] + b * at[1], at[0]];
            assert!(inside(&at), "{point:?}");
        }
    }
    // x² + (1 − b) x = a.
    let root = (0.25 * (1.0 - b) * (1.0 - b) + a).sqrt();
    for fixed in [-0.5 * (1.0 - b) + root, -0.5 * (1.0 - b) - root] {
        let near = |p: &Vec<f64>| (p[0] - fixed).abs().max((p[1] - fixed).abs());
        let nearest = found.points.iter().map(near).fold(f64::INFINITY, f64::min);
        assert!(nearest < 0.1, "{fixed} {nearest}");
    }
    // Both symbols, the sides of x = 0, occur after both.
    let mut pairs = [0; 4];
    for pair in found.points.windows(2) {
        pairs[usize::from(pair[0][0] > 0.0) + 2 * usize::from(pair[1][0] > 0.0)] += 1;
    }
    assert!(pairs.iter().all(|count| *count > 200), "{pairs:?}");
    let bad = SaddleSearch { smallest: 1.0, ..search };
    assert!(saddle_orbit(&map, &inside, &square, 10, bad).is_err());
    let nowhere = |_: &[f64]| false;
    let few = SaddleSearch { budget: 100, ..search };
    assert!(saddle_orbit(&map, &nowhere, &square, 10, few).is_err());
}
