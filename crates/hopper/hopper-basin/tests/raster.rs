//! Rasters and labels of many speeds agree with the fates of single speeds.

use basin_of_attraction::{Grid, Interval, Label};
use hopper_basin::{Error, Fates, HopperFate, basin_columns, basin_raster, first_humps};
use passive_hopper::{MassRatio, alpha_star};
use proptest::prelude::*;
use std::ops::ControlFlow::Continue;

/// A label is that of the fate; where the fate is undecided alone, the orbits around it may prove a label.
fn assert_same(label: Label, fate: Label, m: f64, alpha: f64) {
    let same = label == fate || fate.is_undecided();
    assert!(same, "M = {m}, α = {alpha}: label {label}, fate {fate}");
}

/// Compares every pixel with the fate of its middle.
fn check(x: (f64, f64), y: (f64, f64), columns: usize, rows: usize) {
    let (x, y) = (Interval::new(x.0, x.1).unwrap(), Interval::new(y.0, y.1).unwrap());
    let grid = Grid { x, y, columns, rows };
    let image = basin_raster(grid, |_| Continue(())).unwrap();
    for column in 0..columns {
        let fates = Fates::new(MassRatio::new(grid.x_at(column)).unwrap()).unwrap();
        for row in 0..rows {
            let alpha = grid.y_at(row);
            let label = fates.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label);
            assert_same(image.at(column, row).unwrap(), label, grid.x_at(column), alpha);
        }
    }
}

#[test]
fn rasters_of_the_papers_windows_agree_with_single_fates() {
    let humps = first_humps(5);
    let (low, high) = (humps.left, humps.right);
    check((0.1, 1.0), (low, high), 1024, 1024);
    check((0.17, 0.18), (17.0, 17.8), 1024, 1024);
    check((1.0, 10.0), (low, high), 64, 256);
}

#[test]
fn rasters_of_unusual_windows_agree_with_single_fates() {
    check((0.001, 0.02), (0.0, 9.0), 5, 300);
    check((5.0, 200.0), (0.5, 40.0), 9, 100);
    check((0.1, 0.9), (190.0, 230.0), 7, 200);
    check((0.5, 0.6), (alpha_star(2) - 1e-6, alpha_star(2) + 1e-6), 4, 200);
}

/// Compares every label with the fate of its speed.
fn check_speeds(m: f64, speeds: &[f64]) {
    let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
    let labels = fates.labels(speeds).unwrap();
    for (&alpha, label) in speeds.iter().zip(labels) {
        assert_same(label, fates.fate(alpha).unwrap().label(), m, alpha);
    }
}

/// The speeds are in any order; some are repeated, some lie beyond all tables, some next to a fixed point.
#[test]
fn labels_of_unsorted_speeds_agree_with_single_fates() {
    let star = alpha_star(2);
    let near = (0..60).map(|k| star + (f64::from(k) - 30.0) * star * f64::EPSILON);
    let far = (1..400).map(|k| 40.0 * (f64::from(k) * 0.618_033_988_75).fract());
    let odd = [1e12, 300.0, 7.0, 7.0, 1e-300, 5e-324];
    let speeds: Vec<f64> = far.chain(near).chain(odd).collect();
    for m in [0.05, 0.2, 0.7, 1.0, 30.0] {
        check_speeds(m, &speeds);
    }
}

/// The orbits of these speeds enter the last ulps of a trap, where the computed map leaves the trap again.
#[test]
fn orbits_that_enter_the_last_ulps_of_a_trap_end_there() {
    for (m, alpha) in [
        (0.330_499_999_999_999_96, 3.398_198_266_583_449),
        (0.3326, 3.384_241_188_234_909_7),
        (0.3389, 3.358_787_720_946_075_3),
        (0.3452, 3.343_558_012_500_218),
    ] {
        let above = (0..100).map(|k| 30.0 + 0.01 * f64::from(k));
        check_speeds(m, &[0.5, alpha].into_iter().chain(above).collect::<Vec<_>>());
    }
}

#[test]
fn invalid_speeds_and_rasters_are_errors() {
    let fates = Fates::new(MassRatio::new(0.2).unwrap()).unwrap();
    assert!(fates.labels(&[]).unwrap().is_empty());
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e14] {
        for count in [1, 100] {
            let mut speeds = vec![5.0; count];
            speeds[count / 2] = wrong;
            assert!(fates.labels(&speeds).is_err(), "{wrong}");
        }
    }
    let (x, y) = (Interval::new(0.1, 1.0).unwrap(), Interval::new(4.0, 9.0).unwrap());
    let grid = Grid { x, y, columns: 10, rows: 40 };
    assert!(basin_columns(&grid, 3..3).unwrap().is_empty());
    let error = basin_columns(&grid, 3..11).unwrap_err();
    assert_eq!(error, Error::ColumnRange { columns: 10, first: 3, end: 11 });
    for (columns, rows) in [(10, usize::MAX), (10, 0), (0, 10), (1 << 20, 1 << 20)] {
        let grid = Grid { columns, rows, ..grid };
        assert!(basin_columns(&grid, 0..0).is_err(), "{columns} {rows}");
        assert!(basin_raster(grid, |_| Continue(())).is_err(), "{columns} {rows}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, ..ProptestConfig::default() })]

    /// Windows of any size, next to fixed points, to multiples of π, and elsewhere.
    #[test]
    fn rasters_of_any_window_agree_with_single_fates(
        exponent in -2.0..1.2f64,
        narrow in -4.0..-1.0f64,
        (n, place, away) in (1..10u64, 0..3usize, -9.0..0.0f64),
        (width, rows) in (-8.0..0.5f64, 33..150usize),
    ) {
        let near = [alpha_star(n), n as f64 * std::f64::consts::PI, 3.3 * n as f64][place];
        let (m, bottom) = (10f64.powf(exponent), near - 10f64.powf(away).min(0.5 * near));
        let right = m * (1.0 + 10f64.powf(narrow));
        check((m, right), (bottom, bottom + 10f64.powf(width)), 3, rows);
    }
}
