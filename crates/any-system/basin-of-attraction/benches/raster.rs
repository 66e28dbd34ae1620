//! Rasters and preimages of small maps.

#![allow(missing_docs)]

use basin_of_attraction::{
    Branch, Grid, Interval, Label, TrapSet, Traps, classify, preimage_levels_from_known, raster,
};
use criterion::{Criterion, criterion_group, criterion_main};
use std::ops::ControlFlow;

const fn interval(left: f64, right: f64) -> Interval {
    Interval { left, right }
}

fn tools(criterion: &mut Criterion) {
    let grid = Grid { x: interval(0.1, 1.0), y: interval(-0.9, 0.0), columns: 64, rows: 64 };
    let traps = TrapSet::new(vec![(interval(-1e-3, 0.0), Label::from(1))]);
    criterion.bench_function("raster 64 × 64 of x + c x²", |bencher| {
        bencher.iter(|| {
            // The label contains the number of steps, so that the compiler cannot leave out a part of the orbit.
            let label = |&c: &f64, x: f64| {
                let map = |x: f64| Some(x + c * x * x);
                traps.as_ref().map_or(Label::UNDECIDED, |traps| {
                    let even = Label::from(classify(&map, traps, x, 10_000).1 % 2 == 0);
                    traps.label(x).unwrap_or(even)
                })
            };
            raster(grid, |c| c, label, |_| ControlFlow::Continue(()))
        });
    });
    let tent = |x: f64| Some(if x < 0.5 { 3.0 * x } else { 3.0 * (1.0 - x) });
    let branches = [
        Branch { domain: interval(0.0, 0.5), at_left: 0.0, at_right: 1.5 },
        Branch { domain: interval(0.5, 1.0), at_left: 1.5, at_right: 0.0 },
    ];
    criterion.bench_function("eight levels of the tent map's holes", |bencher| {
        bencher.iter(|| {
            preimage_levels_from_known(&tent, &branches, interval(1.0, 1.5), 8).map(|all| all.len())
        });
    });
}

criterion_group!(benches, tools);
criterion_main!(benches);
