//! A start on its own section does not return after no time, and a run that ends names the surface.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic)]

use hybrid_system::*;
use nalgebra::{Matrix2, RowVector2, SMatrix, SVector, Vector2};
use return_map::{Error, ReturnMap, Section, SmoothSection};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surface {
    Floor,
    Roof,
}

/// A ball that keeps half of its speed at the floor, under a roof that ends the run.
struct Ball;

impl HybridSystem for Ball {
    type State = State<2>;
    type Mode = ();
    type Surface = Surface;
    fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
        Vector2::new(x[0] + t * (x[1] - t / 2.0), x[1] - t)
    }
    fn vector_field(&self, (): (), x: &State<2>) -> Option<State<2>> {
        Some(Vector2::new(x[1], -1.0))
    }
    fn guards(&self, (): ()) -> &[Guard<Surface>] {
        const { &[Guard::falling(Surface::Floor).contact(), Guard::rising(Surface::Roof).contact()] }
    }
    fn guard_value(&self, surface: Surface, x: &State<2>) -> f64 {
        match surface {
            Surface::Floor => x[0],
            Surface::Roof => x[0] - 2.0,
        }
    }
    fn reset(&self, (): (), surface: Surface, x: &State<2>) -> Reset<(), State<2>> {
        match surface {
            Surface::Floor => Reset::Jump { mode: (), state: Vector2::new(0.0, -0.5 * x[1]) },
            Surface::Roof => Reset::Stop,
        }
    }
}

/// The speed after a bounce. A point of the section is the ball on the floor, before the bounce: its own event is
/// at once.
struct Bounce;

impl Section<Ball, 2, 1> for Bounce {
    fn point(&self, speed: &SVector<f64, 1>) -> ((), State<2>) {
        ((), Vector2::new(0.0, -speed[0]))
    }
    fn coordinates(&self, event: &Event<(), Surface, State<2>>) -> Option<SVector<f64, 1>> {
        event.after.map(|(_, state)| SVector::<f64, 1>::new(state[1]))
    }
}

#[test]
fn a_return_takes_time_unless_asked_for() {
    let mut map = ReturnMap::new(&Ball, &Bounce, Limits::sampled(10.0, 10, 0.01));
    let start = SVector::<f64, 1>::new(1.0);
    let found = map.next(&start).unwrap();
    // It bounces up at ½, and is back after the time 1, where it keeps ¼.
    assert!((found.time - 1.0).abs() < 1e-14 && (found.coordinates[0] - 0.25).abs() < 1e-14);
    assert_eq!(found.events, 2);
    map.counts_at_once = true;
    let found = map.next(&start).unwrap();
    assert_eq!((found.time, found.coordinates[0], found.events), (0.0, 0.5, 1));
}

impl Differentiable<2> for Ball {
    fn flow_jacobian(&self, (): (), _: &State<2>, time: f64) -> SMatrix<f64, 2, 2> {
        Matrix2::new(1.0, time, 0.0, 1.0)
    }
    fn guard_gradient(&self, _: Surface, _: &State<2>) -> State<2> {
        Vector2::new(1.0, 0.0)
    }
    fn reset_jacobian(&self, (): (), _: Surface, _: &State<2>) -> SMatrix<f64, 2, 2> {
        Matrix2::new(0.0, 0.0, 0.0, -0.5)
    }
}

impl SmoothSection<Ball, 2, 1> for Bounce {
    fn point_jacobian(&self, _: &SVector<f64, 1>) -> SMatrix<f64, 2, 1> {
        Vector2::new(0.0, -1.0)
    }
    fn coordinates_jacobian(&self, _: &Event<(), Surface, State<2>>) -> SMatrix<f64, 1, 2> {
        RowVector2::new(0.0, 1.0)
    }
}

/// The return after the event at the start keeps a quarter of the speed, and takes it as its time.
#[test]
fn the_derivative_is_that_of_the_return_that_takes_time() {
    let mut map = ReturnMap::new(&Ball, &Bounce, Limits::sampled(10.0, 10, 0.01));
    let start = SVector::<f64, 1>::new(1.0);
    let found = map.next_with_derivative(&start).unwrap();
    assert!((found.to.time - 1.0).abs() < 1e-14 && found.to.events == 2);
    assert!((found.derivative[0] - 0.25).abs() < 1e-12, "{}", found.derivative);
    assert!((found.time_derivative[0] - 1.0).abs() < 1e-12, "{}", found.time_derivative);
    map.counts_at_once = true;
    let found = map.next_with_derivative(&start).unwrap();
    assert_eq!((found.to.time, found.to.events), (0.0, 1));
    assert!((found.derivative[0] - 0.5).abs() < 1e-12, "{}", found.derivative);
}

#[test]
fn a_run_that_ends_names_the_terminal_surface() {
    let map = ReturnMap::new(&Ball, &Bounce, Limits::sampled(10.0, 10, 0.01));
    let error = map.next(&SVector::<f64, 1>::new(8.0)).unwrap_err();
    let Error::NoReturn { stop, surface, events, .. } = &error else { panic!("{error}") };
    assert_eq!((*stop, surface.as_deref(), *events), (Stop::Terminal, Some("Roof"), 2));
    assert!(error.to_string().contains("at Roof"), "{error}");
    // The section of a start at rest on the floor: no event follows, and no surface is named.
    let error = map.next(&SVector::<f64, 1>::new(0.0)).unwrap_err();
    assert!(!matches!(error, Error::NoReturn { surface: Some(_), .. }), "{error}");
}
