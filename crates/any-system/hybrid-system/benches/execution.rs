//! Cost of ten bounces of a ball in closed form, with a sampled guard.

#![allow(missing_docs)]

use criterion::{Criterion, criterion_group, criterion_main};
use hybrid_system::{Execution, Guard, HybridSystem, Limits, Reset, State};
use nalgebra::Vector2;
use std::hint::black_box;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Floor;

struct Ball;

impl HybridSystem for Ball {
    type State = State<2>;
    type Mode = ();
    type Surface = Floor;
    fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
        Vector2::new(x[0] + t * (x[1] - t / 2.0), x[1] - t)
    }
    fn guards(&self, _: ()) -> &[Guard<Floor>] {
        const { &[Guard::falling(Floor)] }
    }
    fn guard_value(&self, _: Floor, x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, _: (), _: Floor, x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: Vector2::new(0.0, -x[1]) }
    }
}

fn ten_bounces(criterion: &mut Criterion) {
    let limits = Limits::sampled(1e3, 10, 0.05);
    criterion.bench_function("ten bounces, sampled at 0.05", |bencher| {
        bencher
            .iter(|| Execution::new(&Ball, (), black_box(Vector2::new(0.5, 0.0)), limits).count());
    });
}

criterion_group!(benches, ten_bounces);
criterion_main!(benches);
