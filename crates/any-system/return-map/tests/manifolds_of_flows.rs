//! Manifolds of return maps, through events, forward and backward by the reversed equations: over the basins that they part.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use basin_of_attraction::{Grid, Interval, Label, raster};
use hybrid_system::{Equations, Tolerances};
use return_map::{
    BranchSteps, EquationReturns, ManifoldEnd, ManifoldSteps, OrbitEnd, PeriodicAttractor,
    UnstableManifold, follow_branch, orbit_fate, periodic_attractors,
};
use std::ops::ControlFlow::{Break, Continue};

/// A cart with a saddle ẋ = x, ẏ = −y, once in a time unit: at x = 4 it is thrown to x = 6. Its manifold has a gap there.
#[test]
fn a_manifold_is_cut_at_a_surface() {
    let cart = Equations::new(&["x", "v"], &[("p", "0")])
        .mode_text("near", &["x", "p - v"])
        .rising_text("ramp", "x - 4")
        .resets_text(&["x + 2", "v"])
        .to("far")
        .clock_text("strobe", "1", "1")
        .mode_text("far", &["x - 2", "p - v"])
        .clock_text("strobe", "1", "1");
    let map = EquationReturns::new(&cart, "p", ("near", "strobe"), &["x", "v"]).unwrap();
    let manifold = UnstableManifold::new(&map, 1, (&[0.0, 0.0], 0.0), 1.0).unwrap();
    let steps = ManifoldSteps { length: 6.0, ..ManifoldSteps::default() };
    let curve = manifold.curve(&steps, |_| Continue(())).unwrap();
    let [cut] = &curve.cuts[..] else { panic!("{:?} {:?}", curve.cuts, curve.end) };
    let [before, behind] = &curve.points[cut.after..=cut.after + 1] else { panic!() };
    assert!(
        (before[0] - 4.0).abs() < 1e-9 && (behind[0] - 6.0).abs() < 1e-9,
        "{before:?} {behind:?}"
    );
    assert_eq!(cut.pieces[1], Some(String::from("near: ramp")));
}

/// The basins of two attractors on a raster, whose edges must be within a pixel of the stable manifold of a saddle; from the saddle orbits
/// lead to both.
fn check_boundary(
    equations: &Equations,
    (mode, parameter, value): (&str, &str, f64),
    saddle: &[f64],
    attractors: &[PeriodicAttractor],
    region: [(f64, f64); 2],
) {
    let names = ["x", "v"];
    let returns = |equations: &Equations| {
        let map = EquationReturns::new(equations, parameter, (mode, "strobe"), &names).unwrap();
        map.tolerances(Tolerances::both(1e-11))
    };
    let (forth, back) = (returns(equations), returns(&equations.reversed().unwrap()));
    let mut points = Vec::new();
    let mut ends = Vec::new();
    for side in [1.0, -1.0] {
        let unstable = UnstableManifold::new(&forth, 1, (saddle, value), side).unwrap();
        let last = unstable.at(60.0).unwrap();
        ends.push(attractors.iter().position(|known| known.contains(&last)).unwrap());
        let stable = UnstableManifold::new(&back, 1, (saddle, value), side).unwrap();
        // Multipliers of a map and of its inverse.
        let own = &unstable.saddle().multipliers;
        assert!(own.iter().any(|m| (m.re * stable.multiplier() - 1.0).abs() < 1e-7), "{own:?}");
        let steps = ManifoldSteps {
            length: 25.0,
            region: region.to_vec(),
            points: 20_000,
            ..ManifoldSteps::default()
        };
        // Further out it does not come back.
        let see = |p: &[f64]| if p[0].hypot(p[1]) < 4.0 { Continue(()) } else { Break(()) };
        let curve = stable.curve(&steps, see).unwrap();
        assert!(!matches!(curve.end, ManifoldEnd::PointLimit), "{}", curve.length);
        points.extend(curve.points);
    }
    ends.sort_unstable();
    assert_eq!(ends, [0, 1]);
    const N: usize = 40;
    let [x, y] = region.map(|(low, high)| Interval::new(low, high).unwrap());
    let grid = Grid { x, y, columns: N, rows: N };
    let label = |&x: &f64, v: f64| match orbit_fate(&forth, (&[x, v], value), attractors, 300).end {
        OrbitEnd::Attractor(number) => Label::from(number as u8),
        _ => Label::UNDECIDED,
    };
    let image = raster(grid, |x| x, label, |_| Continue(())).unwrap();
    assert_eq!(image.counts().len(), 2, "{:?}", image.counts());
    let pixels = region.map(|(low, high)| (high - low) / N as f64);
    let mut edges = 0;
    for (row, column, side) in (0..N * N * 2).map(|k| (k / 2 / N, k / 2 % N, k % 2)) {
        // The pixel to the left, or below.
        let other =
            if side == 0 { (column.wrapping_sub(1), row) } else { (column, row.wrapping_sub(1)) };
        if other.0 < N && other.1 < N && image.at(column, row) != image.at(other.0, other.1) {
            edges += 1;
            let edge = [
                0.5 * (grid.x_at(column) + grid.x_at(other.0)),
                0.5 * (grid.y_at(row) + grid.y_at(other.1)),
            ];
            let is_near = |p: &Vec<f64>| (0..2).all(|k| (p[k] - edge[k]).abs() <= pixels[k]);
            assert!(points.iter().any(is_near), "{edge:?}");
        }
    }
    assert!(edges > N, "{edges}");
}

/// A forced ball in a double well: ẍ = x − x³ − v/4 + F cos t (G. Duffing). With F = 0.1 there is an attractor in each well.
#[test]
fn the_basins_of_duffing_s_oscillator() {
    let duffing = Equations::new(&["x", "v", "phase"], &[("force", "0.1")])
        .mode_text("well", &["v", "x - x^3 - v/4 + force*cos(phase)", "1"])
        .rising_text("strobe", "phase - 2*pi")
        .resets_text(&["x", "v", "phase - 2*pi"])
        .inverse_text(&["x", "v", "phase + 2*pi"]);
    let map = EquationReturns::new(&duffing, "force", ("well", "strobe"), &["x", "v"]).unwrap();
    let seeds = [vec![1.0, 0.0], vec![-1.0, 0.0]];
    let attractors = periodic_attractors(&map, 0.1, &seeds, (100, 1), |_| Continue(()));
    assert_eq!(attractors.len(), 2);
    let at = ("well", "force", 0.1);
    // On the ridge it moves by the linear equation: x = −16 F/65 (2 cos t − sin t/4).
    check_boundary(&duffing, at, &[-3.2 / 65.0, 0.4 / 65.0], &attractors, [(-1.6, 1.6); 2]);
}

/// The oscillator with a stop: between the fold of its impacts and the grazing a motion with impacts and one without attract. The saddle
/// between them is on the branch with impacts, behind its fold.
#[test]
fn the_basins_of_an_oscillator_with_a_stop() {
    let stop = Equations::new(&["x", "v", "phase"], &[("force", "0.2")])
        .mode_text("free", &["v", "force*cos(phase) - x - v/10", "1.3"])
        .rising_text("stop", "x - 1/2")
        .resets_text(&["x", "-0.8*v", "phase"])
        .inverse_text(&["x", "-v/0.8", "phase"])
        .rising_text("strobe", "phase - 2*pi")
        .resets_text(&["x", "v", "phase - 2*pi"])
        .inverse_text(&["x", "v", "phase + 2*pi"]);
    let map = EquationReturns::new(&stop, "force", ("free", "strobe"), &["x", "v"]).unwrap();
    let seeds = [vec![0.1, 0.8], vec![-0.28, 0.07]];
    let attractors = periodic_attractors(&map, 0.2, &seeds, (200, 1), |_| Continue(()));
    assert_eq!(attractors.len(), 2);
    let start = (&attractors[0].orbit[0][..], 0.2);
    let steps = BranchSteps { first: 0.1, longest: 0.2, ..BranchSteps::default() };
    let branch = follow_branch(&map, 1, start, (0.1, 0.2), steps, |_| Continue(())).unwrap();
    let is_saddle = |point: &&return_map::BranchPoint| point.parameter == 0.2 && !point.is_stable;
    let saddle = branch.points.iter().find(is_saddle).unwrap();
    let at = ("free", "force", 0.2);
    check_boundary(&stop, at, &saddle.point, &attractors, [(-1.5, 0.49), (-1.5, 1.5)]);
}
