//! Attractors that are known by points: fixed points, cycles, clouds.

use basin_of_attraction::{Error, KnownAttractors, KnownLimits, Label};
use std::collections::BTreeMap;

fn points(all: &[&[[f64; 2]]]) -> BTreeMap<Label, Vec<Vec<f64>>> {
    let own = |(k, points): (usize, &&[[f64; 2]])| {
        (Label::from(k as u8 + 1), points.iter().map(|point| point.to_vec()).collect())
    };
    all.iter().enumerate().map(own).collect()
}

/// Newton's method for z³ = 1: the root of each start by long iteration, and the steps of a start beside a root.
#[test]
fn newton_s_roots() {
    let newton = |z: &[f64]| {
        let (x, y) = (z[0], z[1]);
        let (a, b) = (x * x - y * y, 2.0 * x * y);
        let size = a * a + b * b;
        // z ← 2z/3 + 1/(3 z²).
        (size > 0.0).then(|| vec![2.0 * x / 3.0 + a / size / 3.0, 2.0 * y / 3.0 - b / size / 3.0])
    };
    let height = 0.75f64.sqrt();
    let roots = [[1.0, 0.0], [-0.5, height], [-0.5, -height]];
    let all = points(&[&roots[..1], &roots[1..2], &roots[2..]]);
    let known = KnownAttractors::suggested(&newton, &all, KnownLimits::default()).unwrap();
    // Half of √3 is too far: of the ball of this radius a part leads to other roots.
    assert!(known.distance() < 0.5 && known.distance() > 0.05, "{}", known.distance());
    for k in 0..400 {
        let start =
            [-2.0 + 0.2 * f64::from(k % 20) + 0.013, -2.0 + 0.2 * f64::from(k / 20) + 0.017];
        let mut at = start.to_vec();
        let mut first = None;
        for step in 0..200 {
            let near = roots
                .iter()
                .any(|root| (at[0] - root[0]).hypot(at[1] - root[1]) <= known.distance());
            if near && first.is_none() {
                first = Some(step);
            }
            at = newton(&at).unwrap();
        }
        let root = roots.iter().position(|root| (at[0] - root[0]).hypot(at[1] - root[1]) < 1e-9);
        let (label, steps) = known.convergence(&newton, &start).unwrap();
        assert_eq!(label, Label::from(root.unwrap() as u8 + 1), "{start:?}");
        assert_eq!(Some(steps), first, "{start:?}");
    }
    // The pole has no image, and a point of another dimension no label.
    assert_eq!(known.convergence(&newton, &[0.0, 0.0]).unwrap(), (Label::UNDECIDED_MAP, 0));
    assert_eq!(known.label(&newton, &[0.0]), Label::UNDECIDED);
}

/// A cycle beside a fixed point, and Hénon's attractor as a cloud.
#[test]
fn cycles_and_clouds() {
    let henon = |p: &[f64]| Some(vec![1.0 - 1.4 * p[0] * p[0] + p[1], 0.3 * p[0]]);
    let mut at = vec![0.1, 0.1];
    let mut cloud = Vec::new();
    for k in 0..3000 {
        at = henon(&at).unwrap();
        if k >= 1000 {
            cloud.push(at.clone());
        }
    }
    let known = KnownAttractors::new(
        &henon,
        &BTreeMap::from([(Label::from(1), cloud)]),
        0.02,
        KnownLimits::default(),
    )
    .unwrap();
    assert_eq!(known.label(&henon, &[0.0, 0.0]), Label::from(1));
    let (label, _) = known.convergence(&henon, &[2.0, 2.0]).unwrap();
    assert!(label.is_undecided());
    // x ↦ r x (1 − x) at 3.2: a cycle of two points.
    let logistic = |x: &[f64]| Some(vec![3.2 * x[0] * (1.0 - x[0])]);
    let root = (4.2f64 * 0.2).sqrt();
    let cycle = [(4.2 - root) / 6.4, (4.2 + root) / 6.4].map(|x| vec![x]).to_vec();
    let known = KnownAttractors::suggested(
        &logistic,
        &BTreeMap::from([(Label::from(1), cycle)]),
        KnownLimits::default(),
    )
    .unwrap();
    assert_eq!(known.label(&logistic, &[0.1]), Label::from(1));
    // The fixed point 0 repels, and is outside of all distances that pass.
    assert!(known.label(&logistic, &[0.0]).is_undecided(), "{}", known.distance());
}

/// What attracts nothing is refused: a repelling fixed point, a point of a circle of a rotation, a fixed point with one attracting side.
#[test]
fn what_is_no_attractor_is_refused() {
    let limits = KnownLimits { tests: 50, ..KnownLimits::default() };
    let refused = |map: &dyn basin_of_attraction::StateMap, point: [f64; 2]| {
        let found = KnownAttractors::suggested(map, &points(&[&[point]]), limits);
        assert!(matches!(found, Err(Error::BadSearch { .. })), "{found:?}");
    };
    refused(&|x: &[f64]| Some(vec![1.5 * x[0], 0.5 * x[1]]), [0.0, 0.0]);
    let (sin, cos) = 1.0f64.sin_cos();
    refused(&|x: &[f64]| Some(vec![cos * x[0] - sin * x[1], sin * x[0] + cos * x[1]]), [0.0, 0.0]);
    refused(&|x: &[f64]| Some(vec![x[0] + x[0] * x[0], 0.5 * x[1]]), [0.0, 0.0]);
}

#[test]
fn bad_input_is_an_error() {
    let half = |x: &[f64]| Some(x.iter().map(|x| 0.5 * x).collect());
    let limits = KnownLimits::default();
    let one = points(&[&[[0.0, 0.0]]]);
    for distance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let found = KnownAttractors::new(&half, &one, distance, limits);
        assert!(matches!(found, Err(Error::BadSearch { .. })), "{distance}");
    }
    // Two attractors whose neighbourhoods would meet.
    let two = points(&[&[[0.0, 0.0]], &[[1.0, 0.0]]]);
    let found = KnownAttractors::new(&half, &two, 0.6, limits);
    assert!(matches!(found, Err(Error::BadSearch { value: 0.6, .. })), "{found:?}");
    let none = BTreeMap::new();
    assert_eq!(KnownAttractors::suggested(&half, &none, limits), Err(Error::NoDimension));
    let empty = BTreeMap::from([(Label::from(1), Vec::new())]);
    assert_eq!(KnownAttractors::suggested(&half, &empty, limits), Err(Error::NoDimension));
    let mixed = BTreeMap::from([(Label::from(1), vec![vec![0.0], vec![0.0, 1.0]])]);
    let found = KnownAttractors::suggested(&half, &mixed, limits);
    assert!(matches!(found, Err(Error::WrongDimension { dimension: 2, expected: 1 })));
    let endless = BTreeMap::from([(Label::from(1), vec![vec![f64::NAN]])]);
    assert!(KnownAttractors::suggested(&half, &endless, limits).is_err());
    let undecided = BTreeMap::from([(Label::UNDECIDED, vec![vec![0.0]])]);
    assert!(KnownAttractors::suggested(&half, &undecided, limits).is_err());
    for bad in [
        KnownLimits { budget: 0, ..limits },
        KnownLimits { stretch: 0, ..limits },
        KnownLimits { tests: 0, ..limits },
        KnownLimits { tests: usize::MAX, ..limits },
    ] {
        assert!(KnownAttractors::suggested(&half, &one, bad).is_err(), "{bad:?}");
    }
}

/// Slow spirals, long cycles, chaotic and escaping orbits: the limits of a pilot find what is there, on grids from coarse to fine.
#[test]
fn the_limits_of_a_pilot_find_the_attractors() {
    use basin_of_attraction::{
        Attractors, Hyperrectangle, Interval, Pilot, PilotEnd, StateGrid, array_map,
    };
    let square = Hyperrectangle::new(vec![Interval::new(-2.0, 2.0).unwrap(); 2]).unwrap();
    let grid = |cells| StateGrid::uniform(square.clone(), cells).unwrap();
    // A cycle of 300 steps, approached by a tenth a step.
    let (sine, cosine) = (std::f64::consts::TAU / 300.7).sin_cos();
    let cycle = array_map(move |[x, y]: [f64; 2]| {
        let factor = (1.0 + 0.1 * (1.0 - x.hypot(y))).max(0.5);
        let (a, b) = (factor * x, factor * y);
        Some([cosine * a - sine * b, sine * a + cosine * b])
    });
    let half = array_map(|[x, y]: [f64; 2]| Some([0.5 * x, 0.5 * y]));
    let starts = [vec![0.3, 0.1], vec![1.0, -1.5]];
    for cells in [20, 100, 500] {
        let pilot = Pilot::follow(&cycle, &grid(cells), &starts, 10_000).unwrap();
        assert!((200..=2000).contains(&pilot.limits.locate), "{cells} {pilot}");
        let found = Attractors::search(&cycle, grid(cells), &starts, pilot.limits).unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (1, 0), "{cells} {pilot}");
        let pilot = Pilot::follow(&half, &grid(cells), &starts, 1000).unwrap();
        assert!(pilot.limits.locate == 40 && pilot.orbits[0].cells == 1, "{pilot}");
        let found = Attractors::search(&half, grid(cells), &starts, pilot.limits).unwrap();
        assert_eq!((found.attractors().len(), found.unmatched().len()), (1, 0), "{cells} {pilot}");
    }
    // A rotation over few steps does not come back to its cells in time, and says so.
    let slow = array_map(|[x, y]: [f64; 2]| Some([x + 1e-4, y]));
    let pilot = Pilot::follow(&slow, &grid(500), &starts, 1000).unwrap();
    assert!(pilot.to_string().contains("does not visit them again"), "{pilot}");
    let away = array_map(|[x, y]: [f64; 2]| Some([x + 0.1, y]));
    let pilot = Pilot::follow(&away, &grid(50), &starts, 1000).unwrap();
    assert!(pilot.orbits.iter().all(|own| own.end == PilotEnd::Outside));
    assert!(Pilot::follow(&away, &grid(50), &starts, 10).is_err());
    assert!(Pilot::follow(&away, &grid(50), &[vec![0.0]], 1000).is_err());
}
