//! Borders that a branch passes without meeting them, and borders at which slopes are steep.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use return_map::{
    BifurcationKind, BranchEnd, BranchSteps, family, follow_branch, follow_equilibria, pieces,
    scalar_family,
};
use std::ops::ControlFlow::Continue;

/// x = p² passes other pieces, with a branch of their own, at the distance d.
#[test]
fn other_pieces_beside_a_branch_are_no_end() {
    for d in [1e-2, 1e-3, 3e-4, 1e-4, 3e-5, 1e-7] {
        let map = pieces(1, move |x: &[f64], p| match x[0] >= -d {
            true => Ok((vec![0.5 * x[0] + 0.5 * p * p], "in")),
            false => Ok((vec![0.5 * x[0] + 0.5 * p * p + 5.0 * (x[0] + d)], "out")),
        });
        for start in [-0.5, -0.71, 0.3] {
            let at = (&[start * start][..], start);
            let steps = BranchSteps::default();
            let branch = follow_branch(&map, 1, at, (-1.0, 1.0), steps, |_| Continue(())).unwrap();
            assert_eq!(branch.ends, [BranchEnd::Window, BranchEnd::Window], "{d} {start}");
            let off = |at: &return_map::BranchPoint| (at.point[0] - at.parameter.powi(2)).abs();
            assert!(branch.points.iter().all(|at| off(at) < 1e-12));
        }
    }
}

/// x ↦ p − k √x for x > 0, p + 0.4 x else: the fixed point passes the border at p = 0, with an infinite slope on one side.
#[test]
fn steep_slopes_at_a_border() {
    for k in [0.01, 0.03, 0.1, 0.3, 1.0, 3.0] {
        let map = pieces(1, move |x: &[f64], p| match x[0] > 0.0 {
            true => Ok((vec![p - k * x[0].sqrt()], "hit")),
            false => Ok((vec![p + 0.4 * x[0]], "miss")),
        });
        let steps = BranchSteps::default();
        // √x = (−k + √(k² + 4p))/2.
        let root = 0.5 * (-k + (k * k + 2.0f64).sqrt());
        let hit = (&[root * root][..], 0.5);
        let hit = follow_branch(&map, 1, hit, (-1.0, 1.0), steps, |_| Continue(())).unwrap();
        let miss = (&[-0.5 / 0.6][..], -0.5);
        let miss = follow_branch(&map, 1, miss, (-1.0, 1.0), steps, |_| Continue(())).unwrap();
        let BranchEnd::Border { at, .. } = &miss.ends[1] else { panic!("{k}: {:?}", miss.ends) };
        assert!(at.parameter.abs() < 1e-9, "{k}: {at:?}");
        // On the steep side differences give no derivative so near to the border: the end is the last point that was found.
        let BranchEnd::Border { at, .. } = &hit.ends[0] else { panic!("{k}: {:?}", hit.ends) };
        assert!(at.parameter.abs() < 1e-4, "{k}: {at:?}");
    }
}

/// A start on a fold is on the branch, and so is one of a field with a small rate.
#[test]
fn folds_and_slow_fields_have_a_direction() {
    let steps = BranchSteps::default();
    for (unit, at) in [(1.0, 0.0), (1.0, 1.0), (1e-10, 2.0), (1e6, 2.0)] {
        let map = scalar_family(move |x, p| x + unit * (p - (x / unit - at).powi(2)));
        let start = (&[unit * at][..], 0.0);
        let branch = follow_branch(&map, 1, start, (-1.0, 1.0), steps, |_| Continue(())).unwrap();
        let mut folds =
            branch.bifurcations.iter().filter(|found| found.kind == BifurcationKind::Fold);
        assert!(folds.next().is_some_and(|fold| fold.at.parameter.abs() < 1e-9), "{unit} {at}");
        assert!(folds.next().is_none());
    }
    for rate in [1.0, 1e-10, 1e-18, 1e-25] {
        let field = family(1, move |x: &[f64], p| Ok(vec![rate * (p - x[0])]));
        let start = (&[0.5][..], 0.5);
        let branch = follow_equilibria(&field, start, (0.0, 1.0), steps, |_| Continue(())).unwrap();
        assert_eq!(branch.ends, [BranchEnd::Window, BranchEnd::Window], "{rate}");
    }
}
