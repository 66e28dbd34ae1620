//! Return maps of known flows: Rössler's system, the valve.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use example_systems::valve::{Mode, Surface, Valve, valve_equations};
use hybrid_system::{Equations, Execution, Limits, Tolerances};
use nalgebra::Vector3;
use return_map::{
    BifurcationKind, BranchSteps, EquationReturns, MapFamily, doubled_branch, follow_branch,
    map_pieces,
};
use std::ops::ControlFlow::{Break, Continue};

fn roessler() -> Equations {
    Equations::new(&["x", "y", "z"], &[("a", "0.2"), ("b", "0.2"), ("c", "5.7")])
        .mode_text("flow", &["-y - z", "x + a*y", "b + z*(x - c)"])
        .rising_text("up", "x")
        .crossing()
        .falling_text("down", "x")
        .crossing()
}

/// Periodic orbits of Rössler's system. Points and periods are the middles of intervals that are proved by the examples
/// `RosslerPeriodicOrbit` and `IPoincareMapDerivativeExample` of CAPD (T. Kapela, M. Mrozek, D. Wilczak, P. Zgliczyński, 2021), with the
/// multiplier of the first orbit from the derivative there; the others are printed in exercises of P. Cvitanović et al., *ChaosBook* (2020).
#[test]
fn roessler_s_orbits() {
    let returns = EquationReturns::new(&roessler(), "c", ("flow", "up"), &["y", "z"]).unwrap();
    let table = [
        (
            1,
            [-8.380_941_742_829_88, 0.029_590_060_630_667],
            5.881_088_455_553_9,
            -2.403_953_531_85,
            1e-10,
        ),
        (
            2,
            [-5.424_073_822_665_2, 0.031_081_210_807_876_4],
            11.758_626_071_660_1,
            -3.512_006_980,
            1e-8,
        ),
        (3, [-6.233_158_628_538, 0.030_640_111_658_160_6], 17.515_791_070_335_8, -2.341_923, 1e-6),
    ];
    for (period, point, time, multiplier, printed) in table {
        let start = (&point[..], 5.7);
        let window = (5.699, 5.7);
        let steps = BranchSteps::default();
        let branch = follow_branch(&returns, period, start, window, steps, |_| Break(())).unwrap();
        let found = &branch.points[0];
        let off = found.point.iter().zip(point).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(off < 1e-11, "{off:e} {found:?}");
        let largest = found.multipliers.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()));
        assert!((largest.unwrap().re - multiplier).abs() < printed, "{found:?}");
        let mut total = 0.0;
        let see = &mut |image: return_map::Image| {
            total += image.time;
            Continue(())
        };
        returns.orbit(&found.point, 5.7, period, see).unwrap();
        assert!((total - time).abs() < 1e-11, "{period}: {total}");
    }
}

/// The second of its doublings, on the branch that begins at the first one. No printed table of them is known to us; that there are two such
/// doublings is proved by D. Wilczak and P. Zgliczyński (2009).
#[test]
fn roessler_s_second_doubling() {
    let returns = EquationReturns::new(&roessler(), "c", ("flow", "up"), &["y", "z"])
        .unwrap()
        .tolerances(Tolerances::both(1e-10));
    let steps = BranchSteps { first: 0.3, longest: 0.5, ..BranchSteps::default() };
    let start = (&[-4.55, 0.0525][..], 2.87);
    let window = (2.8, 3.9);
    let once = follow_branch(&returns, 1, start, (2.8, 2.87), steps, |_| Continue(())).unwrap();
    let twice =
        doubled_branch(&returns, (1, &once.bifurcations[0]), window, steps, |_| Continue(()))
            .unwrap();
    let found: Vec<_> = twice.bifurcations.iter().map(|one| (one.kind, one.at.parameter)).collect();
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, BifurcationKind::Doubling);
    assert!((found[0].1 - 3.837).abs() < 1e-3, "{found:?}");
}

/// The valve's map from one turning point to the next, on the line of starts at one pressure: its pieces are the numbers of impacts on
/// the way. An independent model, written by hand, counts the same ones.
#[test]
fn the_valve_s_pieces() {
    let flow_rate = 1.0;
    let valve = valve_equations();
    let map = EquationReturns::new(&valve, "flow", ("open", "turning point"), &["displacement"])
        .unwrap()
        .starting_text(&["displacement", "0", "load"])
        .unwrap()
        .coordinates_text(&["displacement"])
        .unwrap();
    let found = map_pieces(&map, flow_rate, (0.05, 6.0), 400).unwrap();
    // Where the seat is touched to rounding, the model does not say if it is hit.
    assert!(found.gaps.iter().all(|gap| gap.ends.1 - gap.ends.0 < 1e-12), "{:?}", found.gaps);
    let impacts = |itinerary: &[String]| {
        itinerary.iter().filter(|event| event.as_str() == "open: seat").count()
    };
    let by_hand = |displacement: f64| {
        let start = Vector3::new(displacement, 0.0, 10.0);
        let mut count = 0;
        for arc in Execution::new(&Valve { flow_rate }, Mode::Open, start, Limits::new(100.0, 1000))
        {
            match arc.unwrap().event().map(|event| event.surface) {
                Some(Surface::Seat) => count += 1,
                Some(Surface::TurningPoint) => break,
                _ => {}
            }
        }
        count
    };
    assert!(found.pieces.len() > 1);
    for piece in &found.pieces {
        let (left, right) = piece.ends;
        for part in [1e-6, 0.5, 1.0 - 1e-6] {
            let at = left + part * (right - left);
            assert_eq!(by_hand(at), impacts(&piece.itinerary), "{at}: {piece:?}");
        }
    }
}
