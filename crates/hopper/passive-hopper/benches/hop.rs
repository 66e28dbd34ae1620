//! A hop by every method of the crate, over the paper's window.

#![allow(missing_docs)]

use criterion::{Criterion, criterion_group, criterion_main};
use hybrid_system::{Execution, Limits};
use passive_hopper::{
    Hopper, HopperState, LiftOffMap, MassRatio, Phase, alpha_star, printed_image,
};
use std::hint::black_box;

/// 256 pairs (M, α) from the paper's window, M in [0.05, 20], α in [α*_1, α*_6]: a sequence of golden and plastic
/// ratios, which fills it evenly.
fn inputs() -> Vec<(MassRatio, f64)> {
    let (low, high) = (alpha_star(1), alpha_star(6));
    (0..256)
        .filter_map(|k| {
            let part = |step: f64| (f64::from(k) * step).fract();
            let ratio = MassRatio::new(0.05 * pxfm::f_pow(400.0, part(0.618_033_988_749_895)));
            Some((ratio.ok()?, low + (high - low) * part(0.754_877_666_246_693)))
        })
        .collect()
}

fn hops(criterion: &mut Criterion) {
    let inputs = inputs();
    let mut group = criterion.benchmark_group("256 hops of the paper's window");
    group.bench_function("stable form", |bencher| {
        bencher.iter(|| {
            inputs
                .iter()
                .filter_map(|&(m, alpha)| LiftOffMap::new(m).image(black_box(alpha)).ok()?)
                .sum::<f64>()
        });
    });
    group.bench_function("stable form, at once, each its own M", |bencher| {
        let maps: Vec<_> = inputs.iter().map(|&(m, _)| LiftOffMap::new(m)).collect();
        bencher.iter(|| {
            let speeds = inputs.iter().map(|&(_, alpha)| Some(black_box(alpha)));
            let mut hops: Vec<_> = maps.iter().zip(speeds).collect();
            LiftOffMap::images_of_pairs(&mut hops).map(|()| hops.len())
        });
    });
    group.bench_function("stable form, at once, M = 0.3", |bencher| {
        let map = MassRatio::new(0.3).map(LiftOffMap::new);
        let mut speeds = vec![None; inputs.len()];
        bencher.iter(|| {
            for (speed, &(_, alpha)) in speeds.iter_mut().zip(&inputs) {
                *speed = Some(black_box(alpha));
            }
            map.as_ref().map(|map| map.images(&mut speeds))
        });
    });
    group.bench_function("printed form", |bencher| {
        bencher.iter(|| {
            inputs
                .iter()
                .filter_map(|&(m, alpha)| printed_image(m, black_box(alpha)).ok()?)
                .sum::<f64>()
        });
    });
    group.bench_function("hybrid system", |bencher| {
        bencher.iter(|| {
            let arcs = |&(m, alpha): &(MassRatio, f64)| {
                let hopper = Hopper::new(m);
                let start = HopperState::lift_off(black_box(alpha));
                Execution::new(&hopper, Phase::Flight, start.into(), Limits::new(1e3, 2)).count()
            };
            inputs.iter().map(arcs).sum::<usize>()
        });
    });
    group.bench_function("f64::sin_cos", |bencher| {
        // The unit of docs/performance.md: sine and cosine of the standard library, on the same arguments.
        #[allow(clippy::disallowed_methods)]
        bencher.iter(|| inputs.iter().map(|&(_, alpha)| black_box(alpha).sin_cos().0).sum::<f64>());
    });
    group.finish();
}

criterion_group!(benches, hops);
criterion_main!(benches);
