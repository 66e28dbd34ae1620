//! Manifolds of saddles: over basins, and where they cross.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use return_map::{
    Error, ManifoldCrossing, ManifoldEnd, ManifoldSteps, MapFamily, UnstableManifold, family,
    manifold_crossings, manifold_tangency, pieces,
};
use std::ops::ControlFlow::{Break, Continue};

const B: f64 = 0.3;

fn henon() -> impl MapFamily {
    family(2, |x: &[f64], a| Ok(vec![1.0 - a * x[0] * x[0] + x[1], B * x[0]]))
}

fn inverse_henon() -> impl MapFamily {
    family(2, |x: &[f64], a| {
        let before = x[1] / B;
        Ok(vec![before, x[0] - 1.0 + a * before * before])
    })
}

/// x ↦ x/2, y ↦ 2y + x²·c with the unstable manifold x = 0, and in bent coordinates an exact curve.
#[test]
fn a_known_manifold() {
    // u ↦ 2u, w ↦ w/2 with x = u, y = w + u²: the unstable manifold is y = x².
    let map = family(2, |x: &[f64], _| {
        let (u, w) = (2.0 * x[0], 0.5 * (x[1] - x[0] * x[0]));
        Ok(vec![u, w + u * u])
    });
    for side in [1.0, -1.0] {
        let manifold = UnstableManifold::new(&map, 1, (&[0.0, 0.0], 0.0), side).unwrap();
        assert!((manifold.multiplier() - 2.0).abs() < 1e-12);
        let steps = ManifoldSteps { length: 30.0, ..ManifoldSteps::default() };
        let curve = manifold.curve(&steps, |_| Continue(())).unwrap();
        assert_eq!(curve.end, ManifoldEnd::Length);
        for point in &curve.points {
            assert!((point[1] - point[0] * point[0]).abs() < 1e-10 * (1.0 + point[1]), "{point:?}");
            assert!(point[0] * side >= 0.0);
        }
        let apart = curve.points.windows(2).skip(1);
        let longest = apart.map(|p| (p[0][0] - p[1][0]).hypot(p[0][1] - p[1][1]));
        assert!(longest.fold(0.0, f64::max) <= 0.02);
    }
    let stop = |point: &[f64]| if point[0] > 1.0 { Break(()) } else { Continue(()) };
    let manifold = UnstableManifold::new(&map, 1, (&[0.0, 0.0], 0.0), 1.0).unwrap();
    assert_eq!(manifold.curve(&ManifoldSteps::default(), stop).unwrap().end, ManifoldEnd::Stopped);
    assert!(UnstableManifold::new(&map, 1, (&[0.0, 0.0], 0.0), 0.0).is_err());
    // No saddle.
    let sink = family(2, |x: &[f64], _| Ok(vec![0.5 * x[0], 0.3 * x[1]]));
    let none = UnstableManifold::new(&sink, 1, (&[0.0, 0.0], 0.0), 1.0);
    assert!(matches!(none, Err(Error::NoSaddle { unstable: 0, .. })));
}

/// The stable manifold of the left fixed point of Hénon's map bounds the basin of infinity: on a raster the edges of the basin are
/// within a pixel of it.
#[test]
fn the_boundary_of_henon_s_basin() {
    let a = 1.4;
    let back = inverse_henon();
    let x = (-(1.0 - B) - ((1.0 - B) * (1.0 - B) + 4.0 * a).sqrt()) / (2.0 * a);
    let steps = ManifoldSteps {
        length: 10.0,
        region: vec![(-1.5, 1.5); 2],
        longest: 0.005,
        points: 200_000,
        ..ManifoldSteps::default()
    };
    let mut points = Vec::new();
    for side in [1.0, -1.0] {
        let manifold = UnstableManifold::new(&back, 1, (&[x, B * x], a), side).unwrap();
        points.extend(manifold.curve(&steps, |_| Continue(())).unwrap().points);
    }
    let escapes = |mut x: f64, mut y: f64| {
        for _ in 0..200 {
            (x, y) = (1.0 - a * x * x + y, B * x);
            if x.abs() > 100.0 {
                return true;
            }
        }
        false
    };
    let edges = edges_beside(&points, escapes);
    assert!(edges > 100, "{edges}");
}

/// The number of pixels of [−1.5, 1.5]² at which a label changes along a row. Each of them is within a pixel of the points.
fn edges_beside(points: &[Vec<f64>], label: impl Fn(f64, f64) -> bool) -> usize {
    const N: usize = 120;
    let pixel = 3.0 / N as f64;
    let at = |k: usize| -1.5 + (k as f64 + 0.5) * pixel;
    let mut edges = 0;
    for row in 0..N {
        let mut before = label(at(0), at(row));
        for column in 1..N {
            let here = label(at(column), at(row));
            if here != before {
                edges += 1;
                let edge = [0.5 * (at(column) + at(column - 1)), at(row)];
                let is_near =
                    |p: &Vec<f64>| (0..2).all(|axis| (p[axis] - edge[axis]).abs() <= pixel);
                assert!(points.iter().any(is_near), "{edge:?}");
            }
            before = here;
        }
    }
    edges
}

/// Homoclinic points of Hénon's map: on both manifolds, and so are their images.
#[test]
fn homoclinic_points() {
    let (a, forth, back) = (1.4, henon(), inverse_henon());
    let saddle = [0.631_354_477_089_505, 0.3 * 0.631_354_477_089_505];
    let steps = ManifoldSteps { length: 8.0, ..ManifoldSteps::default() };
    let mut found = Vec::new();
    for side in [1.0, -1.0] {
        let unstable = UnstableManifold::new(&forth, 1, (&saddle, a), 1.0).unwrap();
        let stable = UnstableManifold::new(&back, 1, (&saddle, a), side).unwrap();
        let curves = [
            unstable.curve(&steps, |_| Continue(())).unwrap(),
            stable.curve(&steps, |_| Continue(())).unwrap(),
        ];
        let crossings = manifold_crossings((&unstable, &curves[0]), (&stable, &curves[1])).unwrap();
        for crossing in &crossings {
            let [t, r] = crossing.numbers;
            let on = [unstable.at(t).unwrap(), stable.at(r).unwrap()];
            assert!((on[0][0] - on[1][0]).hypot(on[0][1] - on[1][1]) < 1e-10);
            assert!(crossing.angle > 0.0 && crossing.error < 1e-10, "{crossing:?}");
            // The orbit leads to the saddle forward.
            let mut at = crossing.point.to_vec();
            let mut nearest = f64::INFINITY;
            for _ in 0..12 {
                at = forth.image(&at, a).unwrap().point;
                nearest = nearest.min((at[0] - saddle[0]).hypot(at[1] - saddle[1]));
            }
            assert!(nearest < 1e-2, "{crossing:?} {nearest}");
        }
        found.extend(crossings);
    }
    assert!(found.len() >= 4, "{}", found.len());
}

/// Homoclinic tangencies of Hénon's map: one is found again from both crossings beside it, and that whose existence Z. Arai and
/// K. Mischaikow (2006) prove between 1.392419807915 and 1.392419807931.
#[test]
fn homoclinic_tangencies() {
    let (forth, back) = (henon(), inverse_henon());
    let saddle = |a: f64| {
        let x = (-0.7 + (0.49 + 4.0 * a).sqrt()) / (2.0 * a);
        [x, 0.3 * x]
    };
    let one = |a: f64| UnstableManifold::new(&forth, 1, (&saddle(a), a), 1.0);
    let two = |a: f64| UnstableManifold::new(&back, 1, (&saddle(a), a), -1.0);
    let start = 1.385;
    let (unstable, stable) = (one(start).unwrap(), two(start).unwrap());
    let region = vec![(-2.0, 2.0); 2];
    let steps = ManifoldSteps { length: 20.0, region, ..ManifoldSteps::default() };
    let curves = [
        unstable.curve(&steps, |_| Continue(())).unwrap(),
        stable.curve(&steps, |_| Continue(())).unwrap(),
    ];
    let crossings = manifold_crossings((&unstable, &curves[0]), (&stable, &curves[1])).unwrap();
    let near: Vec<_> = crossings.iter().filter(|crossing| crossing.angle < 0.2).collect();
    assert_eq!(near.len(), 2, "{crossings:?}");
    let found = near
        .iter()
        .map(|crossing| manifold_tangency(one, two, (crossing, start), (1.3, 1.4)).unwrap())
        .collect::<Vec<_>>();
    let off = found[0].parameter - found[1].parameter;
    assert!(off.abs() < 1e-13 && found[0].error < 1e-13, "{found:?}");
    // No tangency is on that side.
    let missed = manifold_tangency(one, two, (near[0], start), (1.3845, 1.4));
    assert!(matches!(missed, Err(Error::NoTangency { .. })), "{missed:?}");
    // Far along both curves.
    let numbers = [5.3148, 6.8009];
    let far = ManifoldCrossing { point: [1.2708, -0.0252], numbers, angle: 0.1, error: 1e-3 };
    let found = manifold_tangency(one, two, (&far, 1.393), (1.39, 1.4)).unwrap();
    assert!((1.392_419_807_915..1.392_419_807_931).contains(&found.parameter), "{found:?}");
}

/// A map with a jump: its manifold is cut there, and the piece is named.
#[test]
fn manifolds_are_cut_at_discontinuities() {
    let map = pieces(2, |x: &[f64], _| {
        let (shift, name) = if x[0] > 1.0 { (3.0, "right") } else { (0.0, "left") };
        Ok((vec![2.0 * x[0] + shift, 0.5 * x[1]], name))
    });
    let manifold = UnstableManifold::new(&map, 1, (&[0.0, 0.0], 0.0), 1.0).unwrap();
    let steps = ManifoldSteps { length: 3.5, ..ManifoldSteps::default() };
    let curve = manifold.curve(&steps, |_| Continue(())).unwrap();
    assert_eq!(curve.cuts.len(), 1, "{:?}", curve.cuts);
    let cut = &curve.cuts[0];
    assert_eq!(cut.pieces, [Some("left".to_owned()), Some("right".to_owned())]);
    assert!((curve.points[cut.after][0] - 2.0).abs() < 1e-9);
    assert!((curve.points[cut.after + 1][0] - 5.0).abs() < 1e-9);
    // A map without images behind 1.
    let ends = family(2, |x: &[f64], p| match x[0] < 1.0 {
        true => Ok(vec![2.0 * x[0], 0.5 * x[1]]),
        false => Err(Error::NoImage { point: x.to_vec(), parameter: p }),
    });
    let manifold = UnstableManifold::new(&ends, 1, (&[0.0, 0.0], 0.0), 1.0).unwrap();
    let curve = manifold.curve(&steps, |_| Continue(())).unwrap();
    assert!(matches!(curve.end, ManifoldEnd::NoImage(_)));
    assert!((curve.points.last().unwrap()[0] - 2.0).abs() < 1e-9);
}

/// Curves that touch to third order at one parameter have one crossing before and behind it: no tangency. Nor have curves that are one.
#[test]
fn what_is_no_tangency_is_refused() {
    let bent = |x: f64| (x - 2.0).powi(3);
    let curve = family(2, move |x: &[f64], _| {
        Ok(vec![2.0 * x[0], 0.5 * (x[1] - bent(x[0])) + bent(2.0 * x[0])])
    });
    let line = family(2, |x: &[f64], p| Ok(vec![2.0 * x[0], p + 0.5 * (x[1] - p)]));
    let one = |p: f64| UnstableManifold::new(&curve, 1, (&[0.0, -8.0], p), 1.0);
    let two = |p: f64| UnstableManifold::new(&line, 1, (&[0.0, p], p), 1.0);
    let (bend, flat) = (one(0.01).unwrap(), two(0.01).unwrap());
    let steps = ManifoldSteps { length: 12.0, ..ManifoldSteps::default() };
    let curves = [
        bend.curve(&steps, |_| Continue(())).unwrap(),
        flat.curve(&steps, |_| Continue(())).unwrap(),
    ];
    let crossings = manifold_crossings((&bend, &curves[0]), (&flat, &curves[1])).unwrap();
    assert_eq!(crossings.len(), 1, "{crossings:?}");
    let found = manifold_tangency(one, two, (&crossings[0], 0.01), (-0.5, 0.5));
    assert!(matches!(found, Err(Error::NoTangency { .. })), "{found:?}");
    let far = ManifoldCrossing { numbers: [1.0, 1.0], ..crossings[0].clone() };
    let found = manifold_tangency(two, two, (&far, 0.01), (-0.5, 0.5));
    assert!(matches!(found, Err(Error::NoTangency { .. })), "{found:?}");
}

/// The first points are as near to each other as all are, and manifolds of other dimensions do not cross.
#[test]
fn a_curve_begins_at_its_saddle() {
    for c in [0.0, 10.0, 100.0] {
        let curve = family(2, move |x: &[f64], _| {
            let u = x[0] - c;
            let w = x[1] - c - 0.1 * (u - 2.0);
            Ok(vec![c + 2.0 * u, c + 0.5 * w + 0.1 * (2.0 * u - 2.0)])
        });
        let line = family(2, move |x: &[f64], p| {
            Ok(vec![c + 2.0 * (x[0] - c), c + p + 0.5 * (x[1] - c - p)])
        });
        let one = UnstableManifold::new(&curve, 1, (&[c, c - 0.2], 0.0), 1.0).unwrap();
        let two = UnstableManifold::new(&line, 1, (&[c, c], 0.0), 1.0).unwrap();
        let steps = ManifoldSteps { length: 5.0, ..ManifoldSteps::default() };
        let curves = [
            one.curve(&steps, |_| Continue(())).unwrap(),
            two.curve(&steps, |_| Continue(())).unwrap(),
        ];
        for curve in &curves {
            let near = |pair: &[Vec<f64>]| {
                (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]) <= steps.longest
            };
            assert!(curve.points.windows(2).all(near), "{c}");
        }
        let found = manifold_crossings((&one, &curves[0]), (&two, &curves[1])).unwrap();
        assert_eq!(found.len(), 1, "{c}: {found:?}");
        assert!((found[0].point[0] - c - 2.0).abs() < 1e-9 * (1.0 + c));
        assert!(one.at(f64::NAN).is_err());
        let none = ManifoldSteps { length: f64::NAN, ..ManifoldSteps::default() };
        let none = one.curve(&none, |_| Continue(()));
        assert!(matches!(none, Err(Error::BadArgument { .. })));
    }
    let space = family(3, |x: &[f64], _| Ok(vec![2.0 * x[0], 0.5 * x[1], 0.5 * x[2]]));
    let one = UnstableManifold::new(&space, 1, (&[0.0; 3], 0.0), 1.0).unwrap();
    let curve = one.curve(&ManifoldSteps::default(), |_| Continue(())).unwrap();
    assert!(manifold_crossings((&one, &curve), (&one, &curve)).is_err());
}
