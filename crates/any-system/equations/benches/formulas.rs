//! What formulas cost: a value, many values, a series, a step, an enclosure, the second derivatives of a large formula.

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use equations::{Enclosure, Evaluator, Formulas, Names, Series, TaylorFlow};
use std::hint::black_box;

/// The order of a series at the tolerance 1e-15.
const ORDER: usize = 20;

/// Parts of the large formula.
const PARTS: usize = 10_000;

fn pendulum() -> Formulas {
    let names = Names::new(&["angle", "speed"], &[("damping", "0.1")]).unwrap();
    Formulas::new(names, |_, x, p| [x[1], -x[0].sin() - p["damping"] * x[1]]).unwrap()
}

/// One formula of two numbers, in which each part needs the one before.
fn large() -> Formulas {
    let names = Names::new(&["x", "y"], &[]).unwrap();
    Formulas::new(names, |_, x, _| {
        [(0..PARTS / 4).fold(x[0], |grown, _| (grown * x[1]).sin() / 2.0 + x[0])]
    })
    .unwrap()
}

fn formulas(criterion: &mut Criterion) {
    let pendulum = pendulum();
    let state = [1.0, 0.5];
    let mut evaluator = Evaluator::new(&pendulum);
    criterion.bench_function("field_of_a_pendulum", |b| {
        b.iter(|| evaluator.values(0.0, black_box(&state)).unwrap()[1]);
    });
    let columns = [vec![1.0; 1000], vec![0.5; 1000]];
    criterion.bench_function("field_of_a_pendulum_at_1000_states", |b| {
        b.iter(|| pendulum.columns(&[0.0], &[&columns[0], &columns[1]]).unwrap());
    });
    let series = Series::new(&pendulum, None).unwrap();
    criterion.bench_function("series_to_order_20", |b| {
        b.iter(|| series.coefficients(0.0, black_box(&state), ORDER).unwrap());
    });
    criterion.bench_function("series_to_order_20_in_enclosures", |b| {
        let state = state.map(Enclosure::from);
        b.iter(|| series.coefficients(Enclosure::ZERO, black_box(&state), ORDER).unwrap());
    });
    let flow = TaylorFlow::new(&series, 1e-15, 1e-15).unwrap();
    let mut step = flow.memory().unwrap();
    criterion.bench_function("step_at_1e-15", |b| {
        b.iter(|| flow.step(0.0, black_box(&state), 100.0, &mut step).unwrap());
    });
    let large = large();
    assert!(large.parts() >= PARTS, "{}", large.parts());
    criterion.bench_function("second_derivatives_of_10000_parts", |b| {
        b.iter(|| black_box(&large).jacobian().unwrap().jacobian().unwrap());
    });
}

criterion_group!(benches, formulas);
criterion_main!(benches);
