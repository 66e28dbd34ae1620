//! Return maps of hybrid systems by closures, with a parameter.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hybrid_system::*;
use nalgebra::{Matrix2, RowVector2, SMatrix, SVector, Vector1, Vector2};
use return_map::{
    Border, BranchEnd, BranchSteps, EquationReturns, MapFamily, Section, SmoothSection,
    follow_branch, returns, smooth_returns,
};
use std::ops::ControlFlow::Continue;

/// A ball that keeps the part r of its speed at the floor, which adds 1 to it: the map is v ↦ 1 + r v.
#[derive(Debug, Clone, Copy)]
struct Ball(f64);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Floor;

impl HybridSystem for Ball {
    type State = State<2>;
    type Mode = ();
    type Surface = Floor;
    fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
        Vector2::new(x[0] + t * (x[1] - t / 2.0), x[1] - t)
    }
    fn vector_field(&self, (): (), x: &State<2>) -> Option<State<2>> {
        Some(Vector2::new(x[1], -1.0))
    }
    fn guards(&self, (): ()) -> &[Guard<Floor>] {
        const { &[Guard::falling(Floor)] }
    }
    fn guard_value(&self, _: Floor, x: &State<2>) -> f64 {
        x[0]
    }
    fn guard_quasi_polynomial(&self, _: (), _: Floor, x: &State<2>) -> Option<QuasiPolynomial> {
        Some(QuasiPolynomial::polynomial(&[x[0], x[1], -0.5]))
    }
    fn reset(&self, (): (), _: Floor, x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: Vector2::new(0.0, 1.0 - self.0 * x[1]) }
    }
}

impl Differentiable<2> for Ball {
    fn flow_jacobian(&self, (): (), _: &State<2>, t: f64) -> SMatrix<f64, 2, 2> {
        Matrix2::new(1.0, t, 0.0, 1.0)
    }
    fn guard_gradient(&self, _: Floor, _: &State<2>) -> State<2> {
        Vector2::new(1.0, 0.0)
    }
    fn reset_jacobian(&self, (): (), _: Floor, _: &State<2>) -> SMatrix<f64, 2, 2> {
        Matrix2::new(0.0, 0.0, 0.0, -self.0)
    }
}

struct Bounce;

impl Section<Ball, 2, 1> for Bounce {
    fn point(&self, speed: &SVector<f64, 1>) -> ((), State<2>) {
        ((), Vector2::new(0.0, speed[0]))
    }
    fn coordinates(&self, event: &Event<(), Floor, State<2>>) -> Option<SVector<f64, 1>> {
        event.after.map(|(_, state)| Vector1::new(state[1]))
    }
}

impl SmoothSection<Ball, 2, 1> for Bounce {
    fn point_jacobian(&self, _: &SVector<f64, 1>) -> SMatrix<f64, 2, 1> {
        Vector2::new(0.0, 1.0)
    }
    fn coordinates_jacobian(&self, _: &Event<(), Floor, State<2>>) -> SMatrix<f64, 1, 2> {
        RowVector2::new(0.0, 1.0)
    }
}

/// By its own derivatives, by differences, and by equations: one branch.
#[test]
fn three_ways_to_one_branch() {
    let limits = Limits::new(100.0, 10);
    let smooth = smooth_returns(Ball, |_| Bounce, limits);
    let closures = returns(
        1,
        Ball,
        |v: &[f64], _| ((), Vector2::new(0.0, v[0])),
        |event, _| Some(vec![event.after?.1[1]]),
        limits,
    );
    let equations = Equations::new(&["height", "speed"], &[("r", "0.5")])
        .mode_text("flight", &["speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["0", "1 - r*speed"]);
    // Written to JSON and read again.
    let equations = Equations::from_json(&equations.to_json().unwrap()).unwrap();
    let equations = EquationReturns::new(&equations, "r", ("flight", "floor"), &["speed"]).unwrap();
    let maps: [&dyn MapFamily; 3] = [&smooth, &closures, &equations];
    for map in maps {
        let image = map.image(&[1.5], 0.4).unwrap();
        assert!((image.point[0] - 1.6).abs() < 1e-14 && (image.time - 3.0).abs() < 1e-14);
        assert_eq!(image.certainty, Certainty::Certain);
        assert_eq!(image.itinerary.len(), 1);
        let steps = BranchSteps::default();
        let start = (&[2.0][..], 0.5);
        let branch = follow_branch(&map, 1, start, (0.1, 0.8), steps, |_| Continue(())).unwrap();
        assert_eq!(branch.ends, [BranchEnd::Window, BranchEnd::Window]);
        for found in &branch.points {
            let exact = 1.0 / (1.0 - found.parameter);
            assert!((found.point[0] - exact).abs() < 1e-12 * exact, "{found:?}");
            let off = (found.multipliers[0].re - found.parameter).abs();
            assert!(off <= found.multiplier_errors[0], "{off:e} {found:?}");
        }
    }
    let exact = smooth.linearized(&[1.5], 0.4).unwrap();
    assert!((exact.slopes[(0, 0)] - 0.4).abs() < 1e-15);
    assert!((exact.slopes[(0, 1)] - 1.5).abs() < 1e-12);
    assert!(smooth.image(&[1.0, 2.0], 0.4).is_err());
    // It never comes back: the branch has no start.
    let gone = returns(
        1,
        Ball,
        |_: &[f64], _| ((), Vector2::new(0.0, 1.0)),
        |_, _| None,
        Limits::new(10.0, 3),
    );
    let none =
        follow_branch(
            &gone,
            1,
            (&[1.0], 0.5),
            (0.1, 0.8),
            BranchSteps::default(),
            |_| Continue(()),
        );
    assert!(matches!(none, Err(return_map::Error::NoReturn { .. })), "{none:?}");
}

/// A mass on a belt of speed 1 with Coulomb friction 1, which a spring pulls. Between its turning points it moves about x = 1 on a circle, if
/// that is slower than the belt: with a radius below 1. Above it sticks, and comes back with the radius 1. After each turn the radius R is
/// set to p + R/2: the fixed point R = 2p sticks from p = ½ on.
#[test]
fn the_onset_of_sliding_of_a_filippov_system() {
    let belt = |_: f64| {
        let model = Model::integrated(move |faster: bool, x: &State<2>| {
            [x[1], -x[0] + if faster { -1.0 } else { 1.0 }]
        })
        .tolerance(1e-8)
        .rising(false, |x| x[1] - 1.0, |x| (true, *x))
        .falling(true, |x| x[1] - 1.0, |x| (false, *x))
        .falling(false, |x| x[1], |x| (false, *x));
        Filippov::new(model, Tolerances::both(1e-8))
    };
    let map = returns(
        1,
        belt,
        |radius: &[f64], p| {
            (FilippovMode::Free(false), Vector2::new(1.0 - (p + 0.5 * radius[0]), 0.0))
        },
        |event, _| match event.surface {
            FilippovSurface::Model(2) => Some(vec![event.before[0] - 1.0]),
            _ => None,
        },
        Limits::new(100.0, 10),
    );
    let steps = BranchSteps { first: 0.1, longest: 0.2, shortest: 2e-2, ..BranchSteps::default() };
    let branch =
        follow_branch(&map, 1, (&[0.98], 0.49), (0.48, 0.6), steps, |_| Continue(())).unwrap();
    for found in &branch.points {
        assert!((found.point[0] - 2.0 * found.parameter).abs() < 1e-7, "{found:?}");
    }
    let BranchEnd::Border { border, at, .. } = &branch.ends[1] else { panic!("{:?}", branch.ends) };
    assert_eq!(*border, Border::Sliding { surface: String::from("Model(0)") });
    assert!((at.parameter - 0.5).abs() < 1e-6, "{at:?}");
}
