//! Minimal fatal shocks and points of the boundary with known answers.

use basin_of_attraction::{
    Error, Fate, Grid, Interval, Label, ShockSearch, TrapSet, boundary_between, classify,
    minimal_fatal_shock, minimal_fatal_shock_watched, value_raster,
};
use std::f64::consts::TAU;
use std::ops::ControlFlow::{Break, Continue};
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

/// The root of z³ = 1 to which Newton's method takes a start.
fn newton(start: &[f64]) -> Label {
    let (mut x, mut y) = (start[0], start[1]);
    for _ in 0..200 {
        // z − (z³ − 1)/(3z²) = 2z/3 + 1/(3z²)
        let square = (x * x - y * y, 2.0 * x * y);
        let norm = 3.0 * (square.0 * square.0 + square.1 * square.1);
        (x, y) = (2.0 / 3.0 * x + square.0 / norm, 2.0 / 3.0 * y - square.1 / norm);
        for k in 0..3u8 {
            let angle = TAU * f64::from(k) / 3.0;
            if (x - angle.cos()).hypot(y - angle.sin()) < 0.1 {
                return Label::from(k);
            }
        }
    }
    Label::UNDECIDED
}

/// 0.622046 is the value that Attractors.jl finds.
#[test]
fn newtons_fractal_has_a_minimal_fatal_shock_of_0_622046_from_the_root_1() {
    let found = minimal_fatal_shock(&[1.0, 0.0], ShockSearch::up_to(1.2), newton).unwrap().unwrap();
    assert!((found.size - 0.622_046).abs() < 1e-6, "{found:?}");
    // The witness.
    let shocked = [1.0 + found.shock[0], found.shock[1]];
    assert!(newton(&shocked) == found.label && found.label != newton(&[1.0, 0.0]));
    assert!((found.shock[0].hypot(found.shock[1]) - found.size).abs() < 1e-15);
    // Other seeds find the same.
    for seed in 2..5 {
        let search = ShockSearch { seed, ..ShockSearch::up_to(1.2) };
        let other = minimal_fatal_shock(&[1.0, 0.0], search, newton).unwrap().unwrap();
        assert!((other.size - found.size).abs() < 1e-7, "{seed} {other:?}");
    }
}

/// A search that is stopped has the smallest shock so far, with a witness; the number of labels is that of the defaults.
#[test]
fn a_search_of_shocks_shows_progress_and_can_be_stopped() {
    let search = ShockSearch::up_to(1.2);
    assert_eq!((search.labels(2), search.labels(1)), (112_000, 400));
    let seen = AtomicUsize::new(0);
    let watch = |stop: usize| {
        let progress = |labels: usize| {
            seen.fetch_max(labels, Relaxed);
            if labels < stop { Continue(()) } else { Break(()) }
        };
        minimal_fatal_shock_watched(&[1.0, 0.0], search, newton, progress).unwrap()
    };
    assert_eq!(watch(1), None);
    let early = watch(60_000).unwrap();
    assert!(early.is_stopped && early.size >= 0.622_046 && early.size < 0.7, "{early:?}");
    assert_eq!(newton(&[1.0 + early.shock[0], early.shock[1]]), early.label);
    let all = watch(usize::MAX).unwrap();
    assert!(!all.is_stopped && (all.size - 0.622_046).abs() < 1e-6);
    // With the bisections it is not much more.
    assert!((72_000..250_000).contains(&seen.load(Relaxed)), "{seen:?}");
}

#[test]
fn shocks_are_found_in_one_and_in_five_dimensions() {
    let line = |x: &[f64]| Label::from(!(-0.3..0.7).contains(&x[0]));
    let found = minimal_fatal_shock(&[0.1], ShockSearch::up_to(1.0), line).unwrap().unwrap();
    assert!((found.shock[0] + 0.4).abs() < 1e-9 && (found.size - 0.4).abs() < 1e-9);
    // Half of space beyond a plane at the distance 0.8.
    let normal = [0.5, -0.5, 0.5, 0.4, -0.3];
    let plane = |x: &[f64]| {
        let inside: f64 = x.iter().zip(normal).map(|(x, n)| x * n).sum();
        Label::from(inside < 0.8)
    };
    let found = minimal_fatal_shock(&[0.0; 5], ShockSearch::up_to(2.0), plane).unwrap().unwrap();
    assert!((found.size - 0.8).abs() < 1e-6, "{found:?}");
    // No shock, only undecided states, or nothing but the state's own basin.
    let none = |x: &[f64]| if x[0] < 0.5 { Label::from(0) } else { Label::UNDECIDED };
    assert_eq!(minimal_fatal_shock(&[0.0, 0.0], ShockSearch::up_to(1.0), none).unwrap(), None);
    let error = minimal_fatal_shock(&[1.0, 0.0], ShockSearch::up_to(1.0), none).unwrap_err();
    assert_eq!(error, Error::NoBasin { label: Label::UNDECIDED });
    for farthest in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(minimal_fatal_shock(&[0.0], ShockSearch::up_to(farthest), none).is_err());
    }
    let many = ShockSearch { directions: usize::MAX, ..ShockSearch::up_to(1.0) };
    assert!(minimal_fatal_shock(&[0.0, 0.0], many, none).is_err());
    assert!(minimal_fatal_shock(&[], ShockSearch::up_to(1.0), none).is_err());
    assert!(minimal_fatal_shock(&[f64::NAN], ShockSearch::up_to(1.0), none).is_err());
}

/// Each point of the boundary of Newton's fractal lies beside all three basins.
#[test]
fn bisection_between_two_roots_ends_at_the_boundary() {
    let root = |k: f64| [(TAU * k / 3.0).cos(), (TAU * k / 3.0).sin()];
    let found = boundary_between(&root(0.0), &root(1.0), 1e-12, newton).unwrap();
    assert!(found.undecided.is_none() && found.distance() <= 1e-12);
    assert_eq!(newton(&found.first.0), found.first.1);
    assert_eq!(newton(&found.second.0), found.second.1);
    let middle = found.middle();
    let around: std::collections::BTreeSet<Label> = (0..40)
        .map(|k| {
            let angle = TAU * f64::from(k) / 40.0;
            newton(&[middle[0] + 1e-4 * angle.cos(), middle[1] + 1e-4 * angle.sin()])
        })
        .collect();
    assert!([0, 1, 2].map(Label::from).iter().all(|label| around.contains(label)), "{around:?}");
}

/// Steps of x → c x to [−0.1, 0.1]: the smallest k with |x| c^k ≤ 0.1.
#[test]
fn a_raster_of_steps_has_the_time_to_the_trap() {
    let trap = Interval::new(-0.1, 0.1).unwrap();
    let traps = TrapSet::new(vec![(trap, Label::from(1))]).unwrap();
    let grid = Grid {
        x: Interval::new(0.1, 0.9).unwrap(),
        y: Interval::new(0.01, 1.0).unwrap(),
        columns: 37,
        rows: 23,
    };
    let steps = |&c: &f64, x: f64| match classify(&|x: f64| Some(c * x), &traps, x, 1000) {
        (Fate::Trapped(_), steps) => Some(steps),
        _ => None,
    };
    let image = value_raster(grid, |c| c, steps, |_| Continue(())).unwrap();
    for column in 0..37 {
        for row in 0..23 {
            let (c, x) = (grid.x_at(column), grid.y_at(row));
            let exact = ((0.1 / x).ln() / c.ln()).ceil().max(0.0) as usize;
            assert_eq!(image.at(column, row), Some(&Some(exact)), "{c} {x}");
        }
    }
    assert_eq!((image.at(37, 0), image.at(0, 23)), (None, None));
    let empty = Grid { rows: 0, ..grid };
    assert!(value_raster(empty, |c| c, steps, |_| Continue(())).is_err());
}
