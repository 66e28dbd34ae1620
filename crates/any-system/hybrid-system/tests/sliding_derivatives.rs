//! Derivatives through sliding motions against finite differences.

#![cfg(feature = "ode")]

use super::two_sided::{Side, TIGHT, is_sliding, lasting, run};
use hybrid_system::*;
use nalgebra::{SMatrix, Vector3};

/// A sphere, with fields that turn along it at different rates: sliding on a curved surface in space, entered from
/// below and left where the field above turns tangent.
struct Sphere;

impl Sphere {
    fn turn(side: Side) -> SMatrix<f64, 3, 3> {
        let (a, b) = if side == Side::Below { (1.0, 0.3) } else { (0.4, -0.2) };
        SMatrix::<f64, 3, 3>::new(0.0, -a, b, a, 0.0, -0.5, -b, 0.5, 0.0)
    }
    /// The radial speed: outwards below; above it changes its sign with x₃.
    fn radial(side: Side, x: &State<3>) -> (f64, State<3>) {
        if side == Side::Below {
            (0.5, Vector3::zeros())
        } else {
            (-0.4 - x[2], Vector3::new(0.0, 0.0, -1.0))
        }
    }
}

impl HybridSystem for Sphere {
    type State = State<3>;
    type Mode = Side;
    type Surface = ();
    fn flow(&self, side: Side, x: &State<3>, t: f64) -> State<3> {
        integrated_flow(self, side, x, t, TIGHT)
    }
    fn guards(&self, side: Side) -> &[Guard<()>] {
        match side {
            Side::Below => const { &[Guard::rising(())] },
            Side::Above => const { &[Guard::falling(())] },
        }
    }
    fn guard_value(&self, _: (), x: &State<3>) -> f64 {
        x.norm_squared() - 1.0
    }
    fn reset(&self, side: Side, _: (), x: &State<3>) -> Reset<Side, State<3>> {
        let mode = if side == Side::Below { Side::Above } else { Side::Below };
        Reset::Jump { mode, state: *x }
    }
    fn vector_field(&self, side: Side, x: &State<3>) -> Option<State<3>> {
        Some(Self::turn(side) * x + x * Self::radial(side, x).0)
    }
    fn first_crossing(
        &self,
        side: Side,
        x: &State<3>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<3>>, Error> {
        integrated_crossing(self, side, x, search, TIGHT)
    }
}

impl Linearized<3> for Sphere {
    fn field_jacobian(&self, side: Side, x: &State<3>) -> SMatrix<f64, 3, 3> {
        let (radial, gradient) = Self::radial(side, x);
        Self::turn(side) + SMatrix::<f64, 3, 3>::identity() * radial + x * gradient.transpose()
    }
}

impl Differentiable<3> for Sphere {
    fn flow_jacobian(&self, side: Side, x: &State<3>, t: f64) -> SMatrix<f64, 3, 3> {
        integrated_jacobian(self, side, x, t, TIGHT).unwrap()
    }
    fn guard_gradient(&self, _: (), x: &State<3>) -> State<3> {
        2.0 * x
    }
    fn reset_jacobian(&self, _: Side, _: (), _: &State<3>) -> SMatrix<f64, 3, 3> {
        SMatrix::identity()
    }
}

/// Along whole orbits: to the surface, along it, and away from it, against central differences.
#[test]
fn derivatives_through_sliding_equal_finite_differences() {
    let system = Filippov::new(Sphere, TIGHT);
    let below = FilippovMode::Free(Side::Below);
    let end = |start: State<3>, time| {
        let (arcs, _) = run(&system, below, start, Limits::new(time, 40)).unwrap();
        let last = arcs.last().unwrap();
        (last.state(&system, last.duration).unwrap(), arcs)
    };
    let (mut slid, mut left) = (0, 0);
    for start in
        [Vector3::new(0.5, 0.2, 0.3), Vector3::new(0.5, -0.4, -0.05), Vector3::new(-0.2, 0.6, -0.1)]
    {
        for time in [1.0, 2.0, 3.0, 4.5, 6.0] {
            let (_, arcs) = end(start, time);
            let lasting = lasting(&arcs);
            if lasting.last().unwrap().duration < 1e-2 {
                continue;
            }
            slid += usize::from(is_sliding(&lasting.last().unwrap().mode));
            left += usize::from(lasting.len() > 2);
            let matrix = sensitivity(&system, &arcs).unwrap();
            const STEP: f64 = 1e-5;
            for axis in 0..3 {
                let mut shift = Vector3::zeros();
                shift[axis] = STEP;
                let (plus, minus) = (end(start + shift, time).0, end(start - shift, time).0);
                let difference = (plus - minus) / (2.0 * STEP);
                let column = matrix.column(axis);
                // The difference itself is wrong by about STEP² and 1e-12/STEP.
                assert!(
                    (difference - column).norm() < 1e-6 * (1.0 + column.norm()),
                    "{start} {time} {difference} {column}"
                );
            }
            if lasting.len() == 2 {
                // While it slides, one direction of changes is forgotten.
                let x = lasting[1].state(&system, lasting[1].duration).unwrap();
                assert!((x.transpose() * matrix).norm() < 1e-9, "changes stay on the sphere");
            }
        }
    }
    assert!(slid >= 3 && left >= 2, "{slid} {left}");
}
