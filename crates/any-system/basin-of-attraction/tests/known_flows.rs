//! Flows whose basin fractions are known from the literature: their attractors are found by recurrences, their
//! basins by random points.

use super::runge_kutta::after;
use basin_of_attraction::{
    Attractors, EdgeLimits, Hyperrectangle, Interval, Label, LabelCounts, RecurrenceLimits,
    SplitMix64, StateGrid, UnmatchedReason, region_fractions, track_edge,
};

fn region(sides: &[(f64, f64)]) -> Hyperrectangle {
    let side = |&(left, right): &(f64, f64)| Interval::new(left, right).unwrap();
    Hyperrectangle::new(sides.iter().map(side).collect()).unwrap()
}

fn grid(region: &Hyperrectangle, cells: usize) -> StateGrid {
    StateGrid::uniform(region.clone(), cells).unwrap()
}

/// The attractors that the first `starts` points of `window` find, and the labels of `count` others. `lift` makes a
/// state of a point.
fn basins(
    step: &(impl Fn(&[f64]) -> Option<Vec<f64>> + Sync),
    space: StateGrid,
    window: &Hyperrectangle,
    lift: impl Fn(&[f64]) -> Vec<f64> + Sync,
    limits: RecurrenceLimits,
    (starts, count): (u64, usize),
) -> (Attractors, LabelCounts) {
    let random = SplitMix64::from_seed(11);
    let starts: Vec<Vec<f64>> =
        (0..starts).map(|k| lift(&window.random_point(&random, k))).collect();
    let found = Attractors::search(step, space, &starts, limits).unwrap();
    let counts = region_fractions(window, count, 3, |x| found.label(step, &lift(x))).unwrap();
    (found, counts)
}

/// The fractions in decreasing order.
fn fractions(counts: &LabelCounts) -> Vec<f64> {
    let mut found: Vec<f64> =
        counts.basins().map(|label| counts.fraction(label).unwrap().value).collect();
    found.sort_by(|a, b| b.total_cmp(a));
    found
}

/// A fixed point has 0.645 of the cube. A cycle and a chaotic attractor share the rest. Their basins reach into the
/// cells beside them: on this grid neither is a trap, and their orbits are reported instead of being given to one
/// of the two.
#[test]
fn lorenz_84_has_its_fixed_point_and_reports_all_other_orbits() {
    let (f, g, a, b) = (6.886, 1.347, 0.255, 4.0);
    let field = move |[x, y, z]: [f64; 3]| {
        [-y * y - z * z - a * x + a * f, x * y - y - b * x * z + g, b * x * y + x * z - z]
    };
    let step = move |z: &[f64]| after(field, z, 0.02, 25);
    let window = region(&[(-3.0, 3.0); 3]);
    let limits = RecurrenceLimits::default();
    let (found, counts) =
        basins(&step, grid(&window, 60), &window, <[f64]>::to_vec, limits, (20, 600));
    assert_eq!(found.attractors().len(), 1);
    let share = fractions(&counts)[0];
    assert!((share - 0.645).abs() < 0.06, "{share}");
    assert!(counts.undecided() > 0 && !found.unmatched().is_empty());
    assert!(found.unmatched().iter().all(|orbit| orbit.reason == UnmatchedReason::NoTrap));
}

/// Thomas' cyclically symmetric system at b = 0.1665, from the plane z = 0.
#[test]
fn thomas_has_its_three_cycles() {
    let field = move |[x, y, z]: [f64; 3]| {
        [y.sin() - 0.1665 * x, z.sin() - 0.1665 * y, x.sin() - 0.1665 * z]
    };
    let step = move |z: &[f64]| after(field, z, 0.05, 20);
    let window = region(&[(-6.0, 6.0); 2]);
    let limits = RecurrenceLimits::default();
    let lift = |x: &[f64]| vec![x[0], x[1], 0.0];
    let space = grid(&region(&[(-6.0, 6.0); 3]), 400);
    let (found, counts) = basins(&step, space, &window, lift, limits, (20, 600));
    assert_eq!((found.attractors().len(), found.unmatched().len(), counts.undecided()), (3, 0, 0));
    // Three standard deviations of 600 points are 0.06.
    for (share, published) in fractions(&counts).into_iter().zip([0.454, 0.28, 0.266]) {
        assert!((share - published).abs() < 0.06, "{share} {published}");
    }
}

#[test]
fn the_magnetic_pendulum_comes_to_each_magnet_equally_often() {
    let field = move |[x, y, u, v]: [f64; 4]| {
        let (mut ax, mut ay) = (-0.64 * x - 0.2 * u, -0.64 * y - 0.2 * v);
        for k in 0..3 {
            let angle = std::f64::consts::TAU * f64::from(k) / 3.0;
            let (dx, dy) = (x - angle.cos(), y - angle.sin());
            let square = dx * dx + dy * dy + 0.04;
            let cube = square * square.sqrt();
            ax -= dx / cube;
            ay -= dy / cube;
        }
        [u, v, ax, ay]
    };
    let step = move |z: &[f64]| after(field, z, 0.02, 50);
    let window = region(&[(-2.0, 2.0); 2]);
    let limits = RecurrenceLimits { locate: 100, ..RecurrenceLimits::default() };
    let lift = |x: &[f64]| vec![x[0], x[1], 0.0, 0.0];
    let space = grid(&region(&[(-3.0, 3.0); 4]), 100);
    let (found, counts) = basins(&step, space, &window, lift, limits, (20, 600));
    assert_eq!((found.attractors().len(), found.unmatched().len(), counts.undecided()), (3, 0, 0));
    for share in fractions(&counts) {
        assert!((share - 1.0 / 3.0).abs() < 0.06, "{share}");
    }
}

/// Thomas' system at b = 0.16: between each two of its three attractors the boundary has saddles of the same
/// distance from the origin (the value is that of Attractors.jl). On attractor k coordinate k has the amplitude
/// 4.48, and the others have 3.72 and 3.05.
#[test]
fn the_edge_states_of_thomas_have_the_norm_4_06585() {
    let field = |[x, y, z]: [f64; 3]| [y.sin() - 0.16 * x, z.sin() - 0.16 * y, x.sin() - 0.16 * z];
    let step = move |z: &[f64]| after(field, z, 0.05, 10);
    // The coordinate with the amplitude of an attractor in three stretches of time, one after the other.
    let label = |start: &[f64]| {
        let (mut at, mut seen) = (start.to_vec(), (usize::MAX, 0));
        for _ in 0..40 {
            let mut amplitude = [0.0f64; 3];
            for _ in 0..200 {
                let Some(next) = step(&at) else { return Label::UNDECIDED_MAP };
                at = next;
                (0..3).for_each(|k| amplitude[k] = amplitude[k].max(at[k].abs()));
            }
            let own = (0..3)
                .find(|&k| (4.4..4.6).contains(&amplitude[k]) && amplitude[(k + 1) % 3] < 3.1);
            seen = own.map_or((usize::MAX, 0), |k| (k, if k == seen.0 { seen.1 + 1 } else { 1 }));
            if seen.1 == 3 {
                return Label::from(seen.0 as u8);
            }
        }
        Label::UNDECIDED
    };
    let (mut known, random): (Vec<Option<Vec<f64>>>, _) =
        (vec![None; 3], SplitMix64::from_seed(11));
    let space = region(&[(-6.0, 6.0); 3]);
    for number in 0..20 {
        let start = space.random_point(&random, number);
        if let Some(own) = label(&start).basin_number() {
            known[usize::from(own)].get_or_insert(start);
        }
    }
    let known: Vec<Vec<f64>> = known.into_iter().map(Option::unwrap).collect();
    for (i, k) in [(0, 1), (1, 2), (0, 2)] {
        let track = track_edge(&known[i], &known[k], &step, label, EdgeLimits::default()).unwrap();
        let norm = track.bracket.middle().iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((norm - 4.06585).abs() < 1e-3, "{norm} {:?}", track.end);
    }
}

/// φ̈ = −0.1 φ̇ + 0.5 − sin φ: the fixed point sin φ = 1/2, or rotation, from φ within π of the fixed point and
/// |φ̇| < 10 (M. Stender, N. Hoffmann, Nonlinear Dyn. 107, 2022: 0.152 and 0.848 of 10⁴ points).
#[test]
fn the_driven_pendulum_stands_or_rotates() {
    let rest = 0.5f64.asin();
    let field = |[x, v]: [f64; 2]| [v, -0.1 * v + 0.5 - x.sin()];
    let step = move |z: &[f64]| after(field, z, 0.05, 20);
    let angles = (rest - std::f64::consts::PI, rest + std::f64::consts::PI);
    let window = region(&[angles, (-10.0, 10.0)]);
    let (found, counts) = basins(
        &step,
        // The angle is periodic, so that a rotation comes back.
        grid(&window, 100).periodic(0).unwrap(),
        &window,
        <[f64]>::to_vec,
        RecurrenceLimits::default(),
        (20, 5000),
    );
    assert_eq!((found.attractors().len(), found.unmatched().len(), counts.undecided()), (2, 0, 0));
    for (share, known) in fractions(&counts).into_iter().zip([0.844, 0.156]) {
        // Three standard deviations.
        assert!((share - known).abs() < 0.016, "{share} {known}");
    }
}
