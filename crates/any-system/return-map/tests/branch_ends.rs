//! Branches that close, bubbles, ends of windows, curves through resonances.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use equations::{Formulas, Names};
use return_map::{
    BifurcationKind, Branch, BranchEnd, BranchSteps, CurveEnd, FormulaMap, MapFamily,
    bifurcation_curve, continue_branch, doubled_branch, family, follow_branch, follow_equilibria,
    pieces, scalar_family,
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

/// Beside a pitchfork the bent branch has no fold.
#[test]
fn no_folds_beside_pitchforks() {
    let names = Names::new(&["x"], &[("p", "0")]).unwrap();
    let map = FormulaMap::new(&Formulas::from_text(names, &["p*x - x^3"]).unwrap(), "p").unwrap();
    let steps = BranchSteps::default();
    for k in 0..50 {
        let p = 1.2 + 0.016 * f64::from(k);
        let start = (&[(p - 1.0).sqrt()][..], p);
        let branch = follow_branch(&map, 1, start, (0.5, 2.5), steps, |_| Continue(())).unwrap();
        let folds = kinds(&branch).iter().filter(|found| found.0 == BifurcationKind::Fold).count();
        let forks =
            kinds(&branch).iter().filter(|found| found.0 == BifurcationKind::Pitchfork).count();
        assert_eq!((folds, forks), (0, 1), "{p}: {:?}", kinds(&branch));
    }
}

/// Two branches that pass each other at a small distance: each is followed to its fold, and no crossing is invented.
#[test]
fn branches_beside_others_are_not_left() {
    for eps in [1e-4f64, 5e-5, 2e-5, 1e-5, 1e-6, 1e-7] {
        let map = scalar_family(|x, p| x + 0.5 * (x * x - p * p + eps));
        let start = (&[-(1.0 - eps).sqrt()][..], -1.0);
        let steps = BranchSteps::default();
        let branch = follow_branch(&map, 1, start, (-1.0, 1.3), steps, |_| Continue(())).unwrap();
        let found = kinds(&branch);
        assert_eq!(found.len(), 1, "{eps}: {found:?} {:?}", branch.ends);
        assert_eq!(found[0].0, BifurcationKind::Fold);
        assert!((found[0].1 + eps.sqrt()).abs() < 1e-9, "{eps}: {found:?}");
        assert_eq!(branch.ends, [BranchEnd::Window, BranchEnd::Window]);
    }
    // An imperfect pitchfork.
    for eps in [1e-4, 1e-5, 1e-6] {
        let map = scalar_family(|x, p| x + p * x - x * x * x + eps);
        let steps = BranchSteps::default();
        let start = (&[1.3f64.sqrt()][..], 1.3);
        let branch = follow_branch(&map, 1, start, (-1.0, 1.3), steps, |_| Continue(())).unwrap();
        // The upper branch stays positive.
        assert!(branch.points.iter().all(|at| at.point[0] > 0.0), "{eps}");
        assert!(kinds(&branch).iter().all(|found| found.0 == BifurcationKind::Doubling));
    }
    // Two waves side by side.
    for d in [0.01, 0.005, 0.003] {
        let wave = |p: f64| 1.0 + 0.05 * (30.0 * p).sin();
        let map = scalar_family(|x, p| x + 0.5 * ((x - wave(p)).powi(2) - d * d));
        let steps = BranchSteps::default();
        let start = (&[1.0 + d][..], 0.0);
        let branch = follow_branch(&map, 1, start, (-2.0, 2.0), steps, |_| Continue(())).unwrap();
        assert!(branch.bifurcations.is_empty(), "{d}: {:?}", kinds(&branch));
        assert!(branch.points.iter().all(|at| at.point[0] > wave(at.parameter)), "{d}");
        assert_eq!(branch.ends, [BranchEnd::Window, BranchEnd::Window]);
    }
}

/// A slow cycle, and slow circles: the size of a frequency does not matter.
#[test]
fn slow_cycles_begin_too() {
    for rate in [1.0, 1e-5, 1e-7] {
        let field = family(2, move |x, mu| {
            Ok(vec![rate * x[1], rate * (mu * x[1] - x[0] - x[0] * x[0] * x[1])])
        });
        let start = (&[0.0, 0.0][..], -0.5);
        let steps = BranchSteps::default();
        let branch =
            follow_equilibria(&field, start, (-1.0, 1.0), steps, |_| Continue(())).unwrap();
        let found = kinds(&branch);
        assert_eq!(found.len(), 1, "{rate}: {found:?}");
        assert_eq!(found[0].0, BifurcationKind::Hopf);
        assert!(found[0].1.abs() < 1e-9);
    }
}

/// A family whose maps change their dimension, seeds of another one, and a window that is none.
#[test]
fn wrong_dimensions_are_errors() {
    let steps = BranchSteps::default();
    let henon = |b: f64| {
        family(if b > 0.4 { 3 } else { 2 }, move |x: &[f64], a| {
            let mut next = vec![1.0 - a * x[0] * x[0] + x[1], b * x[0]];
            next.extend(x.iter().skip(2));
            Ok(next)
        })
    };
    let start = (&[0.9, 0.3][..], 0.2);
    let branch = follow_branch(&henon(0.3), 1, start, (0.0, 1.0), steps, |_| Continue(())).unwrap();
    let windows = ((0.0, 2.0), (0.0, 0.6));
    let doubling = (&branch.bifurcations[0], 0.3);
    let curve = bifurcation_curve(&henon, 1, doubling, windows, steps, |_| Continue(())).unwrap();
    assert!(curve.ends.iter().any(|end| matches!(end, CurveEnd::Lost { .. })), "{:?}", curve.ends);
    let swap = family(2, |x, _| Ok(vec![x[1], x[0]]));
    assert!(swap.image(&[0.1], 0.0).is_err());
    assert!(scalar_family(|x, _| x).image(&[0.1, f64::NAN], 0.0).is_err());
    for window in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
        let again = continue_branch(&henon(0.3), &branch, window, steps, |_| Continue(()));
        assert!(again.is_err(), "{window:?}");
    }
}
