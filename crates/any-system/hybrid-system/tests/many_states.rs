//! Many states of one integrated arc, by one integration.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::Vector2;
use std::cell::Cell;

/// A pendulum that counts the evaluations of its field.
struct Pendulum(Cell<usize>);

const TOLERANCES: Tolerances = Tolerances::both(1e-9);

impl HybridSystem for Pendulum {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, mode: (), x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, mode, x, t, TOLERANCES)
    }
    fn flow_at(&self, mode: (), x: &State<2>, times: &[f64]) -> Result<Vec<State<2>>, Error> {
        integrated_states(self, mode, x, times, TOLERANCES)
    }
    fn vector_field(&self, (): (), x: &State<2>) -> Option<State<2>> {
        self.0.set(self.0.get() + 1);
        Some(Vector2::new(x[1], -pxfm::f_sin(x[0])))
    }
    fn guards(&self, (): ()) -> &[Guard<()>] {
        &[]
    }
    fn guard_value(&self, (): (), x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, (): (), (): (), _: &State<2>) -> Reset<(), State<2>> {
        Reset::Stop
    }
}

#[test]
fn a_thousand_states_cost_less_than_two_arcs() {
    let pendulum = Pendulum(Cell::new(0));
    let start = Vector2::new(2.0, 0.0);
    let end = pendulum.flow((), &start, 500.0);
    let one_arc = pendulum.0.take();
    let arc = Arc {
        mode: (),
        time: 0.0,
        jump: 0,
        start,
        duration: 500.0,
        end: ArcEnd::<(), (), State<2>>::TimeLimit { certainty: Certainty::Interpolated },
    };
    let times: Vec<f64> = (0..=1000).map(|k| 0.5 * f64::from(k)).collect();
    let states = arc.states(&pendulum, &times).unwrap();
    assert!(pendulum.0.take() < 2 * one_arc);
    assert_eq!((states[0], states[1000]), (start, end));
    for k in [1, 17, 400, 999] {
        let alone = pendulum.flow((), &start, times[k]);
        assert!((alone - states[k]).norm() < 1e-6, "{k}");
    }
}

#[test]
fn times_are_in_order() {
    let pendulum = Pendulum(Cell::new(0));
    let start = Vector2::new(2.0, 0.0);
    let at = |times: &[f64]| integrated_states(&pendulum, (), &start, times, TOLERANCES);
    for bad in [&[1.0, 0.5][..], &[0.5, -1.0], &[f64::NAN], &[f64::INFINITY], &[0.0, 2.0, 1.0]] {
        assert!(matches!(at(bad), Err(Error::BadLimit { .. })), "{bad:?}");
    }
    assert!(at(&[]).unwrap().is_empty());
    assert_eq!(at(&[0.0, 0.0]).unwrap(), vec![start, start]);
    // Backward and forward again.
    let back = at(&[-1.0, -3.0]).unwrap()[1];
    let again = integrated_states(&pendulum, (), &back, &[3.0], TOLERANCES).unwrap()[0];
    assert!((again - start).norm() < 1e-7);
}

/// The flow to a negative time is the way back.
#[test]
fn a_flow_to_a_negative_time_leads_back() {
    let pendulum = Pendulum(Cell::new(0));
    let start = Vector2::new(2.0, 0.3);
    let there = pendulum.flow((), &start, 7.0);
    assert!((pendulum.flow((), &there, -7.0) - start).amax() < 1e-7);
    let back = pendulum.flow_at((), &there, &[0.0, -3.0, -7.0]).unwrap();
    assert!((back[1] - pendulum.flow((), &start, 4.0)).amax() < 1e-7);
    assert!((back[2] - start).amax() < 1e-7);
}
