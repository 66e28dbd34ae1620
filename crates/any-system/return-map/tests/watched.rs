//! Work is counted and can be stopped, and what a stopped map seems to be is no result.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hybrid_system::Equations;
use return_map::{
    ApproximateMap, BifurcationKind, BranchEnd, BranchSteps, CurveEnd, EquationReturns, Error,
    Image, ManifoldEnd, ManifoldSteps, MapFamily, OrbitLength, PeriodicAttractor, Seeds,
    UnstableManifold, bifurcation_diagram, border_curve, cascade, continue_branch, doubled_branch,
    family, follow_branch, lyapunov_exponents, manifold_crossings, map_pieces, periodic_attractors,
    rotation_number, scalar_family, watched,
};
use std::ops::ControlFlow::{self, Break, Continue};
use std::sync::atomic::{AtomicUsize, Ordering};

fn up_to(most: usize) -> impl Fn(usize) -> ControlFlow<()> + Sync {
    move |images| if images < most { Continue(()) } else { Break(()) }
}

/// Wherever it is stopped, a branch is the beginning of the whole one, says that it was stopped, and goes on.
#[test]
fn branches() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let steps = BranchSteps::default();
    let window = (2.4, 3.6);
    let follow = |map: &dyn MapFamily| {
        follow_branch(&map, 1, (&[0.6], 2.5), window, steps, |_| Continue(()))
    };
    let whole = follow(&logistic).unwrap();
    let mut parts = 0;
    for most in (1..3000).step_by(37) {
        let map = watched(&logistic, up_to(most));
        match follow(&map) {
            Err(error) => assert!(matches!(error, Error::Stopped { .. }), "{error:?}"),
            Ok(branch) if map.stopped().is_none() => assert_eq!(branch, whole),
            Ok(branch) => {
                parts += 1;
                assert!(branch.ends.contains(&BranchEnd::Stopped), "{most}: {:?}", branch.ends);
                let is_end =
                    |end: &BranchEnd| matches!(end, BranchEnd::Stopped | BranchEnd::Window);
                assert!(branch.ends.iter().all(is_end));
                let on =
                    continue_branch(&logistic, &branch, window, steps, |_| Continue(())).unwrap();
                let kinds: Vec<_> = on.bifurcations.iter().map(|found| found.kind).collect();
                assert_eq!(kinds, [BifurcationKind::Doubling], "{most}");
                assert_eq!(on.ends, [BranchEnd::Window, BranchEnd::Window]);
            }
        }
    }
    assert!(parts > 5);
    let doubling = &whole.bifurcations[0];
    let map = watched(&logistic, up_to(60));
    let stopped = doubled_branch(&map, (1, doubling), window, steps, |_| Continue(()));
    assert!(match stopped {
        Ok(branch) => branch.ends[1] == BranchEnd::Stopped,
        Err(error) => matches!(error, Error::Stopped { .. }),
    });
    let mut seen = 0;
    let see = |_: &_| {
        seen += 1;
        if seen == 2 { Break(()) } else { Continue(()) }
    };
    let found = cascade(&logistic, 1, (&[0.6], 2.8), (2.5, 4.0), steps, 9, see).unwrap();
    assert_eq!(found.len(), 2);
}

/// The curve of a grazing follows the map beyond it, which is watched as well.
#[test]
fn curves_of_borders() {
    let throw = |ceiling: f64| {
        let ball =
            Equations::new(&["height", "speed"], &[("p", "1"), ("top", &format!("{ceiling:?}"))])
                .mode_text("flight", &["speed", "-1"])
                .rising_text("ceiling", "height - top")
                .falling_text("floor", "height")
                .resets_text(&["0", "p - speed/10"]);
        EquationReturns::new(&ball, "p", ("flight", "floor"), &["speed"]).unwrap()
    };
    let steps = BranchSteps { first: 0.1, longest: 0.4, ..BranchSteps::default() };
    let start = (&[1.0 / 0.9][..], 1.0);
    let branch = follow_branch(&throw(1.0), 1, start, (0.5, 2.0), steps, |_| Continue(())).unwrap();
    let end = (&branch.ends[1], 1.0);
    let windows = ((0.5, 2.0), (0.6, 1.4));
    let curve = border_curve(&throw, 1, end, windows, steps, |_| Continue(())).unwrap();
    for found in &curve.points {
        let [p, ceiling] = found.parameters;
        assert!((p - 0.9 * (2.0 * ceiling).sqrt()).abs() < 1e-9, "{found:?}");
    }
    let images = AtomicUsize::new(0);
    let curve = |most: usize| {
        images.store(0, Ordering::Relaxed);
        let count = |_| match images.fetch_add(1, Ordering::Relaxed) < most {
            true => Continue(()),
            false => Break(()),
        };
        let map = |ceiling: f64| watched(throw(ceiling), count);
        border_curve(&map, 1, end, windows, steps, |_| Continue(()))
    };
    let whole = curve(usize::MAX).unwrap();
    assert_eq!(whole.ends, [CurveEnd::Window, CurveEnd::Window]);
    let all = images.load(Ordering::Relaxed);
    assert!(all > 20, "{all}");
    for most in (0..all).step_by(1 + all / 40) {
        match curve(most) {
            Err(error) => assert!(matches!(error, Error::Stopped { .. }), "{most}: {error:?}"),
            Ok(curve) => assert!(curve.ends.contains(&CurveEnd::Stopped), "{most}: {curve:?}"),
        }
    }
}

#[test]
fn pieces_orbits_and_attractors() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let is_stopped = |error: Option<Error>| matches!(error, Some(Error::Stopped { .. }));
    for most in [1, 10, 100] {
        let map = watched(&logistic, up_to(most));
        assert!(is_stopped(map_pieces(&map, 3.9, (0.0, 1.0), 1000).err()));
        let map = watched(&logistic, up_to(most));
        assert!(is_stopped(lyapunov_exponents(&map, (&[0.3], 4.0), 10, 1000).err()));
        let map = watched(&logistic, up_to(most));
        let turn = |x: &[f64], y: &[f64]| y[0] - x[0];
        assert!(is_stopped(rotation_number(&map, (&[0.3], 4.0), 10, 1000, turn).err()));
        let map = watched(&logistic, up_to(most));
        // It needs some 20 images.
        if most < 20 {
            assert!(is_stopped(PeriodicAttractor::new(&map, 2, (&[0.5], 3.2)).err()), "{most}");
        }
    }
    let pieces = map_pieces(&logistic, 3.9, (0.0, 1.0), 100).unwrap();
    let map = watched(&logistic, up_to(5));
    assert!(is_stopped(ApproximateMap::new(&map, &pieces, 1e-9).err()));
    // Two attractors: the second seed is not looked at.
    let cubic = scalar_family(|x, _| 1.5 * x - 0.5 * x * x * x);
    let seeds = [vec![0.5], vec![-0.5]];
    assert_eq!(periodic_attractors(&cubic, 0.0, &seeds, (100, 2), |_| Continue(())).len(), 2);
    assert_eq!(periodic_attractors(&cubic, 0.0, &seeds, (100, 2), |_| Break(())).len(), 1);
    // A diagram keeps the finished columns, of carried seeds too.
    let parameters: Vec<f64> = (0..50).map(|k| 3.0 + 0.01 * f64::from(k)).collect();
    let length = OrbitLength { transient: 100, keep: 4 };
    let seeds = [vec![0.3], vec![0.6]];
    let diagram = |progress: &(dyn Fn(usize) -> ControlFlow<()> + Sync)| {
        bifurcation_diagram(&logistic, &parameters, (&seeds, Seeds::Carried), length, progress)
    };
    let whole = diagram(&|_| Continue(()));
    let part = diagram(&up_to(7));
    assert_eq!((whole.len(), part.len()), (50, 7));
    assert_eq!(part[..], whole[..7]);
}

#[test]
fn manifolds() {
    let henon = family(2, |x: &[f64], a| Ok(vec![1.0 - a * x[0] * x[0] + x[1], 0.3 * x[0]]));
    let start = (&[0.63, 0.19][..], 1.4);
    let map = watched(&henon, up_to(3));
    assert!(matches!(UnstableManifold::new(&map, 1, start, 1.0), Err(Error::Stopped { .. })));
    for most in [40, 90, 400] {
        let map = watched(&henon, up_to(most));
        let Ok(manifold) = UnstableManifold::new(&map, 1, start, 1.0) else { continue };
        let curve = manifold.curve(&ManifoldSteps::default(), |_| Continue(())).unwrap();
        assert_eq!(curve.end, ManifoldEnd::Stopped);
        let both = manifold_crossings((&manifold, &curve), (&manifold, &curve));
        assert!(matches!(both, Err(Error::Stopped { .. })));
    }
}

/// What an orbit sees of a watched map is what it sees of the map, up to the end.
#[test]
fn orbits() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let map = watched(&logistic, up_to(5));
    let mut seen = 0;
    let see = &mut |_: Image| {
        seen += 1;
        Continue(())
    };
    let ended = map.orbit(&[0.3], 3.9, 100, see);
    assert_eq!((ended, seen), (Err(Error::Stopped { images: 5 }), 4));
}
