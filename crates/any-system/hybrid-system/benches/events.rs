//! Cost of an event for each kind of guard: quasi-polynomial, enclosures, samples, integrated flow.

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use hybrid_system::*;
use nalgebra::Vector2;
use std::hint::black_box;

/// A harmonic oscillator whose zeros are events.
struct Swing(GuardBounds);

#[derive(Clone, Copy, PartialEq)]
enum GuardBounds {
    QuasiPolynomial,
    Enclosure,
    Samples,
}

const TOLERANCES: Tolerances = Tolerances::both(1e-10);

impl HybridSystem for Swing {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
        let (sin, cos) = pxfm::f_sincos(t);
        Vector2::new(x[0] * cos + x[1] * sin, x[1] * cos - x[0] * sin)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::either(())] }
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        x[0]
    }
    fn guard_quasi_polynomial(&self, _: (), _: (), x: &State<2>) -> Option<QuasiPolynomial> {
        (self.0 == GuardBounds::QuasiPolynomial)
            .then(|| QuasiPolynomial::cosine(x[0], 1.0) + QuasiPolynomial::sine(x[1], 1.0))
    }
    fn guard_enclosure(
        &self,
        mode: (),
        _: (),
        x: &State<2>,
        order: u32,
        (from, to): (f64, f64),
    ) -> Option<Enclosure> {
        if self.0 != GuardBounds::Enclosure {
            return None;
        }
        // |x⁽ᵏ⁺¹⁾| is at most the amplitude: x⁽ᵏ⁾ changes by no more than amplitude · time. 1e-15 is for rounding.
        let middle = self.flow(mode, x, 0.5 * (from + to));
        let value = [middle[0], middle[1], -middle[0]].get(order as usize).copied()?;
        Some(Enclosure::around(value, x.norm() * (0.5 * (to - from) + 1e-15)))
    }
    fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: *x }
    }
}

/// The same oscillator, integrated.
struct Integrated;

impl HybridSystem for Integrated {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, mode: (), x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, mode, x, t, TOLERANCES)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::either(())] }
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: *x }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<2>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
        integrated_crossing(self, mode, x, search, TOLERANCES)
    }
    fn vector_field(&self, _: (), x: &State<2>) -> Option<State<2>> {
        Some(Vector2::new(x[1], -x[0]))
    }
}

fn zeros(criterion: &mut Criterion) {
    for (name, search) in [
        ("quasi-polynomial", GuardBounds::QuasiPolynomial),
        ("enclosure", GuardBounds::Enclosure),
        ("samples", GuardBounds::Samples),
    ] {
        criterion.bench_function(&format!("ten zeros of a swing: {name}"), |bencher| {
            let swing = Swing(search);
            let start = Vector2::new(1.0, 0.0);
            let limits = Limits::sampled(100.0, 10, 0.1);
            bencher.iter(|| Execution::new(&swing, (), black_box(start), limits).count());
        });
    }
    criterion.bench_function("ten zeros of a swing: integrated", |bencher| {
        let start = Vector2::new(1.0, 0.0);
        let limits = Limits::new(100.0, 10);
        bencher.iter(|| Execution::new(&Integrated, (), black_box(start), limits).count());
    });
}

criterion_group!(benches, zeros);
criterion_main!(benches);
