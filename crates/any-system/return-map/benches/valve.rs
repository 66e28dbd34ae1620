//! Benchmark: section returns of the pressure relief valve at tolerances of 10⁻¹⁰.
//!
//! Run with `cargo bench -p return-map`. With `-- --smallest` the program prints instead the smallest time of a return
//! on one thread. Two builds that run in turn are compared by it.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use criterion::{Criterion, Throughput};
use example_systems::valve::turning_points;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// Returns for each flow rate. Their number is so large that the start of an execution does not matter.
const RETURNS: usize = 500;

/// Flow rates over the valve's whole range.
fn rates() -> Vec<f64> {
    (0..20).map(|k| 0.2 + 9.8 * f64::from(k) / 19.0).collect()
}

fn valve(criterion: &mut Criterion) {
    let rates = rates();
    let mut group = criterion.benchmark_group("section returns of the valve");
    group.sample_size(10);
    group.throughput(Throughput::Elements((RETURNS * rates.len()) as u64));
    group.bench_function("one thread", |b| {
        b.iter(|| {
            rates.iter().map(|&q| turning_points(q, RETURNS - 1, 1).unwrap()[0]).sum::<f64>()
        });
    });
    group.bench_function("all threads", |b| {
        b.iter(|| {
            rates
                .par_iter()
                .map(|&q| turning_points(q, RETURNS - 1, 1).unwrap()[0])
                .collect::<Vec<_>>()
        });
    });
    group.finish();
}

/// Returns of a run of [`smallest`]: the run is shorter than the time slices of a busy machine.
const FEW_RETURNS: usize = 40;

/// Time of [`smallest`].
const SHARE: Duration = Duration::from_secs(1);

/// Prints the smallest time of a return in nanoseconds, the mean over the flow rates.
fn smallest() {
    let rates = rates();
    let (begin, mut smallest) = (Instant::now(), vec![f64::INFINITY; rates.len()]);
    while begin.elapsed() < SHARE {
        for (&rate, smallest) in rates.iter().zip(&mut smallest) {
            let start = Instant::now();
            assert_eq!(turning_points(rate, 0, FEW_RETURNS).unwrap().len(), FEW_RETURNS);
            *smallest = smallest.min(start.elapsed().as_secs_f64());
        }
    }
    let returns = (FEW_RETURNS * rates.len()) as f64;
    println!("valve, 1e-10\t{:.2}", 1e9 * smallest.iter().sum::<f64>() / returns);
}

fn main() {
    if std::env::args().any(|argument| argument == "--smallest") {
        return smallest();
    }
    let mut criterion = Criterion::default().configure_from_args();
    valve(&mut criterion);
    criterion.final_summary();
}
