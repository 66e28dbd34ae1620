//! Section returns of the pressure relief valve at tolerances of 1e-10.

#![allow(missing_docs, clippy::unwrap_used)]

#[path = "../examples/pressure_relief_valve/model.rs"]
mod model;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use model::{LIMITS, START, Turns, Valve};
use rayon::prelude::*;
use return_map::ReturnMap;

const RETURNS: usize = 500;

fn returns(flow_rate: f64) -> f64 {
    let valve = Valve { flow_rate };
    let map = ReturnMap::new(&valve, &Turns, LIMITS);
    (0..RETURNS).fold(START, |at, _| map.next(&at).unwrap().coordinates)[0]
}

fn valve(criterion: &mut Criterion) {
    let rates: Vec<f64> = (0..8).map(|k| 0.5 + f64::from(k)).collect();
    let mut group = criterion.benchmark_group("section returns of the valve");
    group.sample_size(10);
    group.throughput(Throughput::Elements((RETURNS * rates.len()) as u64));
    group.bench_function("one thread", |b| {
        b.iter(|| rates.iter().map(|&q| returns(q)).sum::<f64>());
    });
    group.bench_function("all threads", |b| {
        b.iter(|| rates.par_iter().map(|&q| returns(q)).collect::<Vec<_>>());
    });
    group.finish();
}

criterion_group!(benches, valve);
criterion_main!(benches);
