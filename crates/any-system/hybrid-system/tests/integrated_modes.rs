//! A system with one integrated mode and one in closed form.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::{SMatrix, Vector2};

const TIGHT: Tolerances = Tolerances::both(1e-13);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    /// In the air, with drag: integrated.
    Air,
    /// On the spring: closed form.
    Spring,
}

/// A ball that falls through air onto a spring of stiffness 1.
struct Trampoline {
    drag: f64,
}

impl HybridSystem for Trampoline {
    type State = State<2>;
    type Mode = Mode;
    type Surface = ();
    fn flow(&self, mode: Mode, x: &State<2>, t: f64) -> State<2> {
        match mode {
            Mode::Air => integrated_flow(self, mode, x, t, TIGHT),
            Mode::Spring => {
                let (sin, cos) = t.sin_cos();
                let depth = x[0] + 1.0;
                Vector2::new(depth * cos + x[1] * sin - 1.0, x[1] * cos - depth * sin)
            }
        }
    }
    fn guards(&self, mode: Mode) -> &[Guard<()>] {
        match mode {
            Mode::Air => const { &[Guard::falling(())] },
            Mode::Spring => const { &[Guard::rising(())] },
        }
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        x[0]
    }
    fn guard_quasi_polynomial(&self, _: Mode, _: (), x: &State<2>) -> Option<QuasiPolynomial> {
        let swing = QuasiPolynomial::cosine(x[0] + 1.0, 1.0) + QuasiPolynomial::sine(x[1], 1.0);
        Some(swing + QuasiPolynomial::polynomial(&[-1.0]))
    }
    fn reset(&self, mode: Mode, _: (), x: &State<2>) -> Reset<Mode, State<2>> {
        let next = if mode == Mode::Air { Mode::Spring } else { Mode::Air };
        Reset::Jump { mode: next, state: Vector2::new(0.0, x[1]) }
    }
    fn first_crossing(
        &self,
        mode: Mode,
        x: &State<2>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
        match mode {
            Mode::Air => integrated_crossing(self, mode, x, search, TIGHT),
            Mode::Spring => default_search(self, mode, x, search),
        }
    }
    fn vector_field(&self, mode: Mode, x: &State<2>) -> Option<State<2>> {
        Some(match mode {
            Mode::Air => Vector2::new(x[1], -1.0 - self.drag * x[1] * x[1].abs()),
            Mode::Spring => Vector2::new(x[1], -1.0 - x[0]),
        })
    }
}

/// Alternately through air and onto the spring, against the closed form v² = (1 − e^(−2kh))/k of each fall from height
/// h.
#[test]
fn one_mode_integrated_and_one_in_closed_form() {
    let ball = Trampoline { drag: 0.3 };
    let arcs: Vec<_> =
        Execution::new(&ball, Mode::Air, Vector2::new(2.0, 0.0), Limits::new(60.0, 100))
            .collect::<Result<_, _>>()
            .unwrap();
    let k = ball.drag;
    let mut speed = ((1.0 - (-2.0 * k * 2.0f64).exp()) / k).sqrt();
    let mut bounces = 0;
    for arc in &arcs {
        let Some(event) = arc.event() else { continue };
        match arc.mode {
            Mode::Air => {
                assert!((event.before[1] + speed).abs() < 1e-11, "{} {speed}", event.before[1]);
                assert_eq!(event.certainty, Certainty::Interpolated);
            }
            Mode::Spring => {
                // The spring returns the speed. With it the ball rises to h = ln(1 + k v²)/2k.
                assert!((event.before[1] - speed).abs() < 1e-11);
                assert_eq!(event.certainty, Certainty::Certain);
                let height = (k * speed * speed).ln_1p() / (2.0 * k);
                speed = (-(-2.0 * k * height).exp_m1() / k).sqrt();
                bounces += 1;
            }
        }
    }
    assert!(bounces > 3);
}

impl Linearized<2> for Trampoline {
    fn field_jacobian(&self, _: Mode, x: &State<2>) -> SMatrix<f64, 2, 2> {
        SMatrix::<f64, 2, 2>::new(0.0, 1.0, 0.0, -2.0 * self.drag * x[1].abs())
    }
}

#[test]
fn the_variational_equation_gives_the_derivative_of_the_flow() {
    let ball = Trampoline { drag: 0.3 };
    let (start, time) = (Vector2::new(2.0, 0.7), 1.9);
    let jacobian = integrated_jacobian(&ball, Mode::Air, &start, time, TIGHT).unwrap();
    for axis in 0..2 {
        let mut shift = Vector2::zeros();
        shift[axis] = 1e-4;
        let end = |x: State<2>| integrated_flow(&ball, Mode::Air, &x, time, TIGHT);
        let difference = (end(start + shift) - end(start - shift)) / 2e-4;
        assert!((difference - jacobian.column(axis)).amax() < 1e-7);
    }
    let bad = Tolerances::both(-1.0);
    assert!(integrated_jacobian(&ball, Mode::Air, &start, time, bad).is_err());
}
