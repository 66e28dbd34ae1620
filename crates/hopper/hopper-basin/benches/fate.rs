//! Fates, traps and rasters of the hopper.

#![allow(missing_docs)]

use basin_of_attraction::{Grid, Interval};
use criterion::{Criterion, criterion_group, criterion_main};
use hopper_basin::{Error, Fates, basin_columns, basin_raster, first_humps};
use passive_hopper::MassRatio;
use std::hint::black_box;
use std::ops::ControlFlow;

/// The window of Fig. 6 from M = 0.1 on.
fn window(columns: usize, rows: usize) -> Grid {
    let x = Interval { left: 0.1, right: 1.0 };
    Grid { x, y: first_humps(5), columns, rows }
}

fn fates(criterion: &mut Criterion) {
    criterion.bench_function("traps of α*_0 … α*_7", |bencher| {
        bencher.iter(|| {
            let fates = Fates::new(MassRatio::new(black_box(0.3))?)?;
            (0..8).map(|n| Ok(fates.trap(n)?.right())).sum::<Result<f64, Error>>()
        });
    });
    let Ok(fates) = MassRatio::new(0.3).map_err(Error::from).and_then(Fates::new) else { return };
    let speeds: Vec<f64> = (0..1024).map(|row| window(1, 1024).y_at(row)).collect();
    criterion.bench_function("fate of 1024 speeds at M = 0.3, one by one", |bencher| {
        bencher
            .iter(|| black_box(&speeds).iter().filter(|&&alpha| fates.fate(alpha).is_ok()).count());
    });
    criterion.bench_function("labels of 1024 speeds at M = 0.3", |bencher| {
        bencher.iter(|| fates.labels(black_box(&speeds)));
    });
    criterion.bench_function("16 columns of 1024² of Fig. 6's window", |bencher| {
        bencher.iter(|| basin_columns(&window(1024, 1024), 240..256));
    });
    criterion.bench_function("raster 256 × 256 of Fig. 6's window", |bencher| {
        bencher.iter(|| basin_raster(window(256, 256), |_| ControlFlow::Continue(())));
    });
}

criterion_group!(benches, fates);
criterion_main!(benches);
