//! Rasters next to edges that fall onto a fixed point, at every depth that `f64` has.

use basin_of_attraction::{Grid, Interval};
use hopper_basin::{Fates, basin_columns};
use passive_hopper::{MassRatio, alpha_star};
use proptest::prelude::*;

/// (M, α) of points that fall onto α*_1, α*_2, α*_1 and α*_3.
const EDGES: [(f64, f64); 4] = [
    (0.2, 8.473039723398273),
    (0.12, 11.920553918335777),
    (0.8, 8.457399673997674),
    (0.2, 15.025371092446333),
];

/// Compares labels of a window about an edge with the fates alone: of a window of two columns, which are labelled
/// one by one, and of two columns of a wider one, whose columns share circles. None is undecided.
fn check(m: f64, edge: f64, half: f64, rows: usize) -> usize {
    let x = Interval::new(m - 0.1 * half, m + 0.1 * half).unwrap();
    let y = Interval::new(edge - half, edge + half).unwrap();
    let of =
        |columns| check_columns(&Grid { x, y, columns, rows }, columns / 2 - 1..columns / 2 + 1);
    of(2).max(of(64))
}

fn check_columns(grid: &Grid, columns: std::ops::Range<usize>) -> usize {
    let labels = basin_columns(grid, columns.clone()).unwrap();
    let mut different = std::collections::BTreeSet::new();
    for (column, labels) in columns.zip(&labels) {
        let m = grid.x_at(column);
        let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        for (row, &label) in labels.iter().enumerate() {
            let alpha = grid.y_at(row);
            let fate = fates.fate(alpha).unwrap().label();
            assert!(!label.is_undecided(), "M = {m}, α = {alpha}: {label}");
            assert_eq!(label, fate, "M = {m}, α = {alpha}");
            different.insert(label);
        }
    }
    different.len()
}

#[test]
fn zooms_into_edges_agree_with_single_fates() {
    let mut most = 0;
    for (m, edge) in EDGES {
        for depth in 3..=13 {
            most = most.max(check(m, edge, 10f64.powi(-depth), 64));
        }
    }
    assert!(most >= 3, "some zoom shows three fates");
}

/// The fixed points themselves are edges, of which no orbit has to hop to be near.
#[test]
fn zooms_into_fixed_points_agree_with_single_fates() {
    for (n, m) in [(1, 0.8), (2, 0.12), (3, 0.2), (9, 0.3), (2, 0.95), (2, 3.0)] {
        for depth in [4, 7, 10, 13] {
            check(m, alpha_star(n), 10f64.powi(-depth), 48);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Edges at random mass ratios: the speed to which bisection between two fates leads.
    #[test]
    fn zooms_into_random_edges_agree_with_single_fates(
        m in 0.02..0.9f64,
        (start, width) in (4.6..20.0f64, 0.01..0.3f64),
        depth in 5.0..12.0f64,
    ) {
        let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        let label = |alpha: f64| fates.fate(alpha).unwrap().label();
        let (mut left, mut right) = (start, start + width);
        prop_assume!(label(left) != label(right));
        while right - left > 4.0 * f64::EPSILON * right {
            let middle = left.midpoint(right);
            if label(middle) == label(left) { left = middle } else { right = middle }
        }
        check(m, left, 10f64.powf(-depth), 48);
    }
}
