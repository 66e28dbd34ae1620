//! Branches that close, bubbles, ends of windows, curves through resonances.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use return_map::{
    BifurcationKind, Branch, BranchEnd, BranchSteps, CurveEnd, bifurcation_curve, doubled_branch,
    family, follow_branch, pieces, scalar_family,
};
use std::f64::consts::PI;
use std::ops::ControlFlow::Continue;

fn kinds(branch: &Branch) -> Vec<(BifurcationKind, f64)> {
    branch.bifurcations.iter().map(|found| (found.kind, found.at.parameter)).collect()
}

/// A closed branch: fixed points on x² + p² = 1, with a fold at each side. A start on a fold.
#[test]
fn a_closed_branch() {
    let map = scalar_family(|x, p| x + 0.1 * (x * x + p * p - 1.0));
    let steps = BranchSteps { longest: 0.05, ..BranchSteps::default() };
    let branch =
        follow_branch(&map, 1, (&[1.0], 0.0), (-2.0, 2.0), steps, |_| Continue(())).unwrap();
    assert_eq!(branch.ends, [BranchEnd::Closed, BranchEnd::Closed]);
    let mut folds: Vec<f64> = branch.bifurcations.iter().map(|fold| fold.at.parameter).collect();
    folds.sort_by(f64::total_cmp);
    assert_eq!(branch.bifurcations.len(), 2, "{folds:?}");
    assert!((folds[0] + 1.0).abs() < 1e-12 && (folds[1] - 1.0).abs() < 1e-12, "{folds:?}");
    assert!(branch.points.iter().all(|at| (at.point[0].hypot(at.parameter) - 1.0).abs() < 1e-12));
}

/// A bubble: a doubling at p = −1 that is taken back at p = 1. A branch that starts at a bifurcation, or ends at one, has it.
#[test]
fn bubbles_and_bifurcations_at_the_ends() {
    // x ↦ −x (1 + (1 − p²)/4) + x³.
    let map = scalar_family(|x, p| -x * (1.0 + 0.25 * (1.0 - p * p)) + x * x * x);
    let steps = BranchSteps::default();
    let branch =
        follow_branch(&map, 1, (&[0.0], -1.5), (-1.5, 1.5), steps, |_| Continue(())).unwrap();
    let found = kinds(&branch);
    assert_eq!(found.len(), 2, "{found:?}");
    let doubled =
        doubled_branch(&map, (1, &branch.bifurcations[0]), (-1.5, 1.5), steps, |_| Continue(()))
            .unwrap();
    // 1 − x² + ¼ (1 − p²) = 1: x² = ¼ (1 − p²), back at the other doubling.
    for at in &doubled.points {
        let off = at.point[0].powi(2) - 0.25 * (1.0 - at.parameter.powi(2));
        assert!(off.abs() < 1e-10, "{at:?}");
    }
    for start in [-1.0, 1.0] {
        let branch =
            follow_branch(&map, 1, (&[0.0], start), (-1.5, 1.5), steps, |_| Continue(())).unwrap();
        assert_eq!(kinds(&branch).len(), 2, "{start}: {:?}", kinds(&branch));
    }
}

/// The map has other pieces beyond the window: the branch ends at the window.
#[test]
fn windows_come_before_borders_behind_them() {
    let map = pieces(1, |x: &[f64], p| Ok((vec![0.5 * x[0] + p], x[0] > 1.001)));
    let steps = BranchSteps { first: 0.4, longest: 0.4, ..BranchSteps::default() };
    let branch =
        follow_branch(&map, 1, (&[0.4], 0.2), (0.1, 0.5), steps, |_| Continue(())).unwrap();
    assert_eq!(branch.ends, [BranchEnd::Window, BranchEnd::Window]);
    assert_eq!(branch.points.last().unwrap().parameter, 0.5);
    // From an end of the window.
    let branch =
        follow_branch(&map, 1, (&[1.0], 0.5), (0.1, 0.5), steps, |_| Continue(())).unwrap();
    assert_eq!(branch.ends, [BranchEnd::Window, BranchEnd::Window]);
    assert!(branch.points.windows(2).all(|pair| pair[0].parameter != pair[1].parameter));
}

/// z ↦ e^(iθ) (1 + p − |z|²) z: at p = 0 circles begin, for any angle θ; the coefficient is not known at the strong resonances.
#[test]
fn a_curve_of_circles_through_resonances() {
    let turning = |angle: f64| {
        family(2, move |z: &[f64], p| {
            let size = 1.0 + p - z[0] * z[0] - z[1] * z[1];
            let (sin, cos) = angle.sin_cos();
            Ok(vec![size * (cos * z[0] - sin * z[1]), size * (sin * z[0] + cos * z[1])])
        })
    };
    let steps = BranchSteps::default();
    let of = |angle: f64| {
        let start = (&[0.0, 0.0][..], -0.1);
        follow_branch(&turning(angle), 1, start, (-0.1, 0.2), steps, |_| Continue(())).unwrap()
    };
    let first = of(1.0);
    let circle = &first.bifurcations[0];
    assert_eq!(circle.kind, BifurcationKind::NeimarkSacker);
    // The circles are stable.
    assert!(circle.coefficient.unwrap() < 0.0);
    let windows = ((-0.1, 0.2), (0.5, 2.5));
    let curve =
        bifurcation_curve(&turning, 1, (circle, 1.0), windows, steps, |_| Continue(())).unwrap();
    assert_eq!(curve.ends, [CurveEnd::Window, CurveEnd::Window]);
    assert!(curve.points.iter().all(|at| at.parameters[0].abs() < 1e-10));
    for resonance in [PI / 2.0, 2.0 * PI / 3.0] {
        let circle = &of(resonance).bifurcations[0];
        assert_eq!((circle.kind, circle.coefficient), (BifurcationKind::NeimarkSacker, None));
    }
}
