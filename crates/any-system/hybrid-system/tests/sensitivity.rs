//! State transition and saltation matrices against finite differences.

use hybrid_system::*;
use nalgebra::{Matrix2, SMatrix, Vector2};
use proptest::prelude::*;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Middle;

/// An oscillator with twice the frequency on the right side, that loses speed when it crosses from side to side.
struct Bilinear;

impl Bilinear {
    fn omega(side: Side) -> f64 {
        if side == Side::Left { 1.0 } else { 2.0 }
    }
}

impl HybridSystem for Bilinear {
    type State = State<2>;
    type Mode = Side;
    type Surface = Middle;
    fn flow(&self, side: Side, x: &State<2>, t: f64) -> State<2> {
        self.flow_jacobian(side, x, t) * x
    }
    fn guards(&self, side: Side) -> &[Guard<Middle>] {
        match side {
            Side::Left => const { &[Guard::rising(Middle)] },
            Side::Right => const { &[Guard::falling(Middle)] },
        }
    }
    fn guard_value(&self, _: Middle, x: &State<2>) -> f64 {
        x[0] - 0.3
    }
    fn guard_quasi_polynomial(
        &self,
        side: Side,
        _: Middle,
        x: &State<2>,
    ) -> Option<QuasiPolynomial> {
        let omega = Self::omega(side);
        Some(
            QuasiPolynomial::cosine(x[0], omega)
                + QuasiPolynomial::sine(x[1] / omega, omega)
                + QuasiPolynomial::polynomial(&[-0.3]),
        )
    }
    fn reset(&self, side: Side, _: Middle, x: &State<2>) -> Reset<Side, State<2>> {
        let mode = if side == Side::Left { Side::Right } else { Side::Left };
        Reset::Jump { mode, state: Vector2::new(x[0], 0.9 * x[1]) }
    }
    fn vector_field(&self, side: Side, x: &State<2>) -> Option<State<2>> {
        let omega = Self::omega(side);
        Some(Vector2::new(x[1], -omega * omega * x[0]))
    }
}

impl Differentiable<2> for Bilinear {
    fn flow_jacobian(&self, side: Side, _: &State<2>, t: f64) -> SMatrix<f64, 2, 2> {
        let omega = Self::omega(side);
        let (sin, cos) = (omega * t).sin_cos();
        Matrix2::new(cos, sin / omega, -omega * sin, cos)
    }
    fn guard_gradient(&self, _: Middle, _: &State<2>) -> State<2> {
        Vector2::new(1.0, 0.0)
    }
    fn reset_jacobian(&self, _: Side, _: Middle, _: &State<2>) -> SMatrix<f64, 2, 2> {
        Matrix2::new(1.0, 0.0, 0.0, 0.9)
    }
}

fn end(start: State<2>, time: f64) -> (State<2>, Vec<Arc<Side, Middle, State<2>>>) {
    let arcs: Vec<_> = Execution::new(&Bilinear, Side::Left, start, Limits::new(time, 1000))
        .collect::<Result<_, _>>()
        .unwrap();
    let last = arcs.last().unwrap();
    (last.state(&Bilinear, last.duration).unwrap(), arcs)
}

proptest! {
    /// Through several events, against central differences at the same end time.
    #[test]
    fn sensitivities_equal_finite_differences(x in -3.0..-0.5f64, v in -2.0..2.0f64, time in 3.0..9.0f64) {
        let start = Vector2::new(x, v);
        let (_, arcs) = end(start, time);
        prop_assume!(arcs.len() > 1);
        // No event within a difference step of the end.
        prop_assume!(arcs.last().unwrap().duration > 1e-3);
        let matrix = sensitivity(&Bilinear, &arcs).unwrap();
        let step = 1e-6;
        for axis in 0..2 {
            let mut shift = Vector2::zeros();
            shift[axis] = step;
            let (plus, more) = end(start + shift, time);
            let (minus, fewer) = end(start - shift, time);
            prop_assume!(more.len() == arcs.len() && fewer.len() == arcs.len());
            let difference = (plus - minus) / (2.0 * step);
            let column = matrix.column(axis);
            prop_assert!((difference - column).norm() < 1e-6 * (1.0 + column.norm()), "{} {}", difference, column);
        }
    }
}

#[test]
fn a_grazing_has_no_derivative() {
    let event = Event {
        surface: Middle,
        time: 1.0,
        time_rounding: 0.0,
        time_error: 0.0,
        at_time_limit: false,
        kind: EventKind::Crossing,
        direction: Some(Direction::Rising),
        jump: 0,
        before: Vector2::new(0.3, 0.0),
        after: Some((Side::Right, Vector2::new(0.3, 0.0))),
        certainty: Certainty::Exact,
    };
    let arc = Arc {
        mode: Side::Left,
        time: 0.0,
        jump: 0,
        start: Vector2::new(-0.3, 0.0),
        duration: 1.0,
        end: ArcEnd::Event(event),
    };
    let error = arc_sensitivity(&Bilinear, &arc).unwrap_err();
    assert_eq!(error, Error::GrazingSensitivity { time: 1.0, rate: 0.0 });
    let never =
        Arc { end: ArcEnd::Never { certainty: Certainty::Exact }, duration: f64::INFINITY, ..arc };
    assert!(matches!(arc_sensitivity(&Bilinear, &never), Err(Error::NoSensitivity { .. })));
}
