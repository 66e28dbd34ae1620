//! A raster is its pixels.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use basin_of_attraction::{Grid, Interval};
use hopper_basin::{Fates, HopperFate, basin_raster};
use passive_hopper::{MassRatio, alpha_star};
use std::ops::ControlFlow::Continue;

/// Every pixel against the fate of its middle.
fn check(x: (f64, f64), y: (f64, f64), columns: usize, rows: usize) {
    let (x, y) = (Interval::new(x.0, x.1).unwrap(), Interval::new(y.0, y.1).unwrap());
    let grid = Grid { x, y, columns, rows };
    let image = basin_raster(grid, |_| Continue(())).unwrap();
    for column in 0..columns {
        let fates = Fates::new(MassRatio::new(grid.x_at(column)).unwrap()).unwrap();
        for row in 0..rows {
            let alpha = grid.y_at(row);
            let label = fates.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label);
            let m = grid.x_at(column);
            assert_eq!(image.at(column, row), Some(label), "M = {m}, α = {alpha}");
        }
    }
}

#[test]
fn of_the_papers_windows() {
    let (low, high) = (alpha_star(1).high, alpha_star(6).high);
    check((0.1, 1.0), (low, high), 64, 1024);
    check((0.17, 0.18), (17.0, 17.8), 64, 1024);
    check((1.0, 10.0), (low, high), 64, 256);
}

#[test]
fn of_windows_nobody_would_choose() {
    check((0.001, 0.02), (0.0, 9.0), 5, 300);
    check((5.0, 200.0), (0.5, 40.0), 9, 100);
    check((0.1, 0.9), (190.0, 230.0), 7, 200);
    check((0.5, 0.6), (alpha_star(2).high - 1e-6, alpha_star(2).high + 1e-6), 4, 200);
}

/// Speeds in any order, twice, wrong, beyond all tables, and next to where fates part.
#[test]
fn of_speeds_in_no_order() {
    let star = alpha_star(2).high;
    let near = (0..60).map(|k| star + (f64::from(k) - 30.0) * star * f64::EPSILON);
    let far = (0..400).map(|k| 40.0 * (f64::from(k) * 0.618_033_988_75).fract());
    let wrong = [0.0, -1.0, f64::NAN, f64::INFINITY, 1e14, 300.0, 7.0, 7.0, f64::MIN_POSITIVE];
    let speeds: Vec<f64> = far.chain(near).chain(wrong).collect();
    for m in [0.05, 0.2, 0.7, 1.0, 30.0] {
        let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
        let labels = fates.labels(&speeds);
        for (&alpha, label) in speeds.iter().zip(labels) {
            let single = fates.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label);
            assert_eq!(label, single, "M = {m}, α = {alpha}");
        }
    }
}
