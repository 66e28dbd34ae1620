//! Curves of bifurcations in two parameters, and why they end; branches that cannot begin.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use return_map::{
    BifurcationKind, BranchEnd, BranchSteps, CurveEnd, Error, MapFamily, bifurcation_curve,
    doubled_branch, family, follow_branch, pieces, scalar_family, watched,
};
use std::ops::ControlFlow::{Break, Continue};

/// The curve of the first bifurcation of a kind on the branch at the second parameter.
fn curve<M: MapFamily, F: Fn(f64) -> M>(
    kind: BifurcationKind,
    map: &F,
    (start, second): ((&[f64], f64), f64),
    windows: ((f64, f64), (f64, f64)),
) -> return_map::BifurcationCurve {
    let steps = BranchSteps::default();
    let branch = follow_branch(&map(second), 1, start, windows.0, steps, |_| Continue(())).unwrap();
    let first = branch.bifurcations.iter().find(|found| found.kind == kind).unwrap();
    bifurcation_curve(map, 1, (first, second), windows, steps, |_| Continue(())).unwrap()
}

/// x ↦ x + p + q x − x³: the folds are p = −2 x³, q = 3 x², through the cusp.
#[test]
fn folds_through_a_cusp() {
    let cusp = |q: f64| scalar_family(move |x, p| x + p + q * x - x * x * x);
    let found =
        curve(BifurcationKind::Fold, &cusp, ((&[1.2], 0.5), 1.0), ((-1.0, 1.0), (-0.5, 1.2)));
    assert_eq!(found.ends, [CurveEnd::Window, CurveEnd::Window]);
    for at in &found.points {
        let x = at.point[0];
        let off = [at.parameters[0] + 2.0 * x.powi(3), at.parameters[1] - 3.0 * x * x];
        assert!(off[0].abs() < 1e-9 && off[1].abs() < 1e-9, "{at:?}");
    }
    // From one side of the cusp to the other.
    let ends = [&found.points[0], found.points.last().unwrap()].map(|at| at.point[0]);
    assert!(ends[0] * ends[1] < 0.0 && ends.iter().all(|x| x.abs() > 0.5), "{ends:?}");
}

/// The fixed points on a sphere have their folds on a circle.
#[test]
fn a_closed_curve() {
    let sphere = |q: f64| scalar_family(move |x, p| x + 0.1 * (x * x + p * p + q * q - 1.0));
    let found =
        curve(BifurcationKind::Fold, &sphere, ((&[0.9], 0.3), 0.2), ((-2.0, 2.0), (-2.0, 2.0)));
    assert_eq!(found.ends, [CurveEnd::Closed, CurveEnd::Closed]);
    let off = |at: &return_map::BifurcationCurvePoint| {
        (at.parameters[0].hypot(at.parameters[1]) - 1.0).abs().max(at.point[0].abs())
    };
    assert!(found.points.iter().all(|at| off(at) < 1e-9));
}

/// The multipliers have the product d and the sum s: a circle begins at d = 1, as long as |s| < 2.
#[test]
fn circles_end_where_multipliers_become_real() {
    let map = |s: f64| family(2, move |x: &[f64], d| Ok(vec![x[1], s * x[1] - d * x[0]]));
    let found = curve(
        BifurcationKind::NeimarkSacker,
        &map,
        ((&[0.0, 0.0], 0.8), 0.5),
        ((0.5, 1.5), (-3.0, 3.0)),
    );
    assert_eq!(found.ends, [CurveEnd::NoBifurcation, CurveEnd::NoBifurcation]);
    let (mut low, mut high) = (0.0f64, 0.0f64);
    for at in &found.points {
        assert!((at.parameters[0] - 1.0).abs() < 1e-9, "{at:?}");
        (low, high) = (low.min(at.parameters[1]), high.max(at.parameters[1]));
    }
    assert!(low < -1.8 && low > -2.0 && high > 1.8 && high < 2.0, "{low} {high}");
}

/// The doubling of the logistic map is at x = ⅔. Where the piece ends before it the curve ends.
#[test]
fn a_curve_ends_at_a_border() {
    let map = |q: f64| {
        pieces(1, move |x: &[f64], r| {
            let piece = if x[0] < 0.6 + q { "left" } else { "right" };
            Ok((vec![r * x[0] * (1.0 - x[0])], piece))
        })
    };
    let found =
        curve(BifurcationKind::Doubling, &map, ((&[0.6], 2.6), 0.3), ((2.5, 3.5), (0.0, 0.5)));
    assert_eq!(found.ends.iter().filter(|end| **end == CurveEnd::Window).count(), 1);
    let border = CurveEnd::Border { beyond: vec![String::from("right")] };
    assert!(found.ends.contains(&border), "{:?}", found.ends);
    let nearest = found.points.iter().map(|at| at.parameters[1]).fold(1.0, f64::min);
    assert!(nearest > 2.0 / 3.0 - 0.6 && nearest < 0.1, "{nearest}");
    assert!(found.points.iter().all(|at| (at.parameters[0] - 3.0).abs() < 1e-8));
    // Stopped by the map, and by the caller.
    let steps = BranchSteps::default();
    let whole = map(0.3);
    let branch =
        follow_branch(&whole, 1, (&[0.6], 2.6), (2.5, 3.5), steps, |_| Continue(())).unwrap();
    let first = (&branch.bifurcations[0], 0.3);
    let windows = ((2.5, 3.5), (0.0, 0.5));
    let stopped = bifurcation_curve(&map, 1, first, windows, steps, |_| Break(())).unwrap();
    assert_eq!(stopped.points.len(), 1);
    let few = |q| watched(map(q), |images| if images < 400 { Continue(()) } else { Break(()) });
    let few = bifurcation_curve(&few, 1, first, windows, steps, |_| Continue(()));
    assert!(few.is_ok_and(|few| !few.points.is_empty()));
}

/// A parameter that does not matter gives a straight branch; a map that leaves all points where they are gives none.
#[test]
fn singular_starts() {
    let steps = BranchSteps::default();
    let still = scalar_family(|x, _| 0.5 * x + 1.0);
    let branch =
        follow_branch(&still, 1, (&[1.9], 0.0), (-1.0, 1.0), steps, |_| Continue(())).unwrap();
    assert_eq!(branch.ends, [BranchEnd::Window, BranchEnd::Window]);
    assert!(branch.points.iter().all(|at| (at.point[0] - 2.0).abs() < 1e-12));
    assert!(branch.bifurcations.is_empty());
    let identity = scalar_family(|x, _| x);
    let none = follow_branch(&identity, 1, (&[0.3], 0.0), (-1.0, 1.0), steps, |_| Continue(()));
    assert!(matches!(none, Err(Error::Singular { .. })), "{none:?}");
    // A crossing at the start: x ↦ x + p x − x² has the branches x = 0 and x = p.
    let crossing = scalar_family(|x, p| x + p * x - x * x);
    let none = follow_branch(&crossing, 1, (&[0.0], 0.0), (-1.0, 1.0), steps, |_| Continue(()));
    assert!(matches!(none, Err(Error::Singular { .. })), "{none:?}");
}

/// A bifurcation of another kind, another map or another period is refused.
#[test]
fn other_starts() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let steps = BranchSteps::default();
    let window = (2.5, 3.5);
    let branch =
        follow_branch(&logistic, 1, (&[0.6], 2.6), window, steps, |_| Continue(())).unwrap();
    let doubling = &branch.bifurcations[0];
    assert_eq!(doubling.kind, BifurcationKind::Doubling);
    let twice = doubled_branch(&logistic, (2, doubling), window, steps, |_| Continue(()));
    assert!(matches!(twice, Err(Error::OtherBranch { .. })), "{twice:?}");
    let other = scalar_family(|x, r| r * x * (1.1 - x));
    let other = doubled_branch(&other, (1, doubling), window, steps, |_| Continue(()));
    assert!(matches!(other, Err(Error::OtherBranch { .. })), "{other:?}");
    let fold = return_map::Bifurcation { kind: BifurcationKind::Fold, ..doubling.clone() };
    let none = doubled_branch(&logistic, (1, &fold), window, steps, |_| Continue(()));
    assert!(matches!(none, Err(Error::OtherStart { .. })), "{none:?}");
}

/// Where the second and the third derivative vanish no coefficient tells what begins: x = 0 crosses x³ = p, or a line of fixed points.
#[test]
fn degenerate_crossings_have_no_coefficient() {
    for degenerate in [|x: f64, p: f64| x + p * x - x.powi(4), |x, p| x + p * x] {
        let map = scalar_family(degenerate);
        let steps = BranchSteps::default();
        let branch =
            follow_branch(&map, 1, (&[0.0], -0.5), (-1.0, 1.0), steps, |_| Continue(())).unwrap();
        let [only] = &branch.bifurcations[..] else { panic!("{:?}", branch.bifurcations) };
        assert_eq!((only.kind, only.coefficient), (BifurcationKind::Transcritical, None));
    }
}
