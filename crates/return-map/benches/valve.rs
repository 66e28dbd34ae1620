//! Benchmark: section returns of the pressure relief valve at tolerances of 10⁻¹⁰.
//!
//! Run with `cargo bench -p return-map`.

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use example_systems::valve::turns;
use rayon::prelude::*;

/// Returns for each flow rate: enough that the start of an execution costs nothing in comparison.
const RETURNS: usize = 500;

fn valve(criterion: &mut Criterion) {
    let rates: Vec<f64> = (0..20).map(|k| 0.2 + 9.8 * f64::from(k) / 19.0).collect();
    let mut group = criterion.benchmark_group("section returns of the valve");
    group.sample_size(10);
    group.throughput(Throughput::Elements((RETURNS * rates.len()) as u64));
    group.bench_function("one thread", |b| {
        b.iter(|| rates.iter().map(|&q| turns(q, RETURNS - 1, 1).unwrap()[0]).sum::<f64>());
    });
    group.bench_function("all threads", |b| {
        b.iter(|| {
            rates.par_iter().map(|&q| turns(q, RETURNS - 1, 1).unwrap()[0]).collect::<Vec<_>>()
        });
    });
    group.finish();
}

criterion_group!(benches, valve);
criterion_main!(benches);
