//! Fates and traps of the hopper.

#![allow(missing_docs)]

use basin_of_attraction::{Grid, Interval};
use criterion::{Criterion, criterion_group, criterion_main};
use hopper_basin::{Fates, basin_raster};
use passive_hopper::{MassRatio, alpha_star};
use std::hint::black_box;
use std::ops::ControlFlow;

fn fates(criterion: &mut Criterion) {
    criterion.bench_function("eight traps", |bencher| {
        bencher.iter(|| MassRatio::new(black_box(0.3)).map(Fates::new));
    });
    let x = Interval { left: 0.1, right: 1.0 };
    let y = Interval { left: alpha_star(1).high, right: alpha_star(6).high };
    let grid = Grid { x, y, columns: 64, rows: 64 };
    criterion.bench_function("raster 64 × 64 of Fig. 6's window", |bencher| {
        bencher.iter(|| basin_raster(grid, |_| ControlFlow::Continue(())));
    });
}

criterion_group!(benches, fates);
criterion_main!(benches);
