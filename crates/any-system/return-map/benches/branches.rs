//! Benchmark: a branch of a thousand points with their multipliers, images by polynomials, and the valve's diagram by its equations and by hand.
//!
//! Run with `cargo bench -p return-map --features parallel --bench branches`. With `-- --points` the program prints instead the branch as
//! CSV: `benches/spring_leg_branch.py` computes the same points with SciPy and prints its time and how far they are apart.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use criterion::{Criterion, Throughput};
use example_systems::{
    spring_leg::apexes,
    valve::{turning_points, valve_equations},
};
use hybrid_system::Tolerances;
use rayon::prelude::*;
use return_map::{
    ApproximateMap, Branch, BranchSteps, EquationReturns, MapFamily, OrbitLength, Seeds,
    bifurcation_diagram, follow_branch, map_pieces,
};
use std::ops::ControlFlow::Continue;

/// The runs from 67.5° to 69°.
fn branch() -> Branch {
    let steps = BranchSteps { first: 1e-3, longest: 1e-3, ..BranchSteps::default() };
    follow_branch(&apexes().unwrap(), 1, (&[0.94], 68.0), (67.5, 69.0), steps, |_| Continue(()))
        .unwrap()
}

fn branches(criterion: &mut Criterion) {
    let points = branch().points.len() as u64;
    let mut group = criterion.benchmark_group("a branch of the spring leg with multipliers");
    group.sample_size(10).throughput(Throughput::Elements(points));
    group.bench_function(format!("{points} points"), |b| b.iter(branch));
    group.finish();
}

fn polynomials(criterion: &mut Criterion) {
    let flow = apexes().unwrap();
    let pieces = map_pieces(&flow, 68.0, (0.93, 1.0), 50).unwrap();
    let fast = ApproximateMap::new(&flow, &pieces, 1e-9).unwrap();
    let mut group = criterion.benchmark_group("an image of the spring leg's map");
    let starts: Vec<f64> = (0..64).map(|k| 0.93 + 0.07 * (f64::from(k) + 0.5) / 64.0).collect();
    group.throughput(Throughput::Elements(starts.len() as u64));
    group.bench_function("by its flow", |b| {
        b.iter(|| starts.iter().map(|x| flow.image(&[*x], 68.0).unwrap().point[0]).sum::<f64>());
    });
    group.bench_function("by polynomials", |b| {
        b.iter(|| starts.iter().map(|x| fast.value(*x).unwrap()).sum::<f64>());
    });
    group.finish();
}

/// Turning points of each flow rate of the valve's diagram here.
const RETURNS: usize = 1000;

fn diagrams(criterion: &mut Criterion) {
    let rates: Vec<f64> = (0..20).map(|k| 0.2 + 9.8 * f64::from(k) / 19.0).collect();
    let section = ("open", "turning point");
    let equations =
        EquationReturns::new(&valve_equations(), "flow", section, &["displacement", "pressure"])
            .unwrap()
            .tolerances(Tolerances::both(1e-10));
    let mut group = criterion.benchmark_group("the valve's diagram");
    group.sample_size(10).throughput(Throughput::Elements((RETURNS * rates.len()) as u64));
    let seeds = [vec![1.0, 10.0]];
    let length = OrbitLength { transient: RETURNS - 64, keep: 64 };
    group.bench_function("by its equations", |b| {
        b.iter(|| {
            bifurcation_diagram(
                &equations,
                &rates,
                (&seeds, Seeds::Fresh),
                length,
                |_| Continue(()),
            )
        });
    });
    group.bench_function("by hand", |b| {
        b.iter(|| {
            rates
                .par_iter()
                .map(|&q| turning_points(q, RETURNS - 64, 64).unwrap())
                .collect::<Vec<_>>()
        });
    });
    group.finish();
}

fn main() {
    if std::env::args().any(|argument| argument == "--points") {
        println!("attack,height,multiplier");
        for point in branch().points {
            let multiplier = point.multipliers[0].re;
            println!("{},{},{multiplier}", point.parameter, point.point[0]);
        }
        return;
    }
    let mut criterion = Criterion::default().configure_from_args();
    branches(&mut criterion);
    polynomials(&mut criterion);
    diagrams(&mut criterion);
    criterion.final_summary();
}
