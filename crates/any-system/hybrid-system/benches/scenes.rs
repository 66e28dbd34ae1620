//! Events a second of ordinary scenes: the ball in four ways, a pendulum section, van der Pol.
//!
//! Run with `cargo bench -p hybrid-system --features ode --bench scenes`. With `-- --smallest [NAME]` the program
//! prints instead the smallest time of an event in each scene. Two builds that run in turn are compared by it.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use criterion::{Criterion, Throughput};
use hybrid_system::*;
use nalgebra::Vector2;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Events of an execution. Its start takes no noticeable part of the time, and a run is shorter than the time slices
/// of a busy machine.
const EVENTS: usize = 60;

/// Later than all events.
const TIME: f64 = 1e5;

/// The flow of an elastic ball under unit gravity.
fn fall(x: &State<2>, t: f64) -> State<2> {
    Vector2::new(x[0] + t * (x[1] - t / 2.0), x[1] - t)
}

fn rebound(x: &State<2>) -> State<2> {
    Vector2::new(0.0, -x[1])
}

/// The ball solves for its impacts.
struct Solved;

impl HybridSystem for Solved {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
        fall(x, t)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::falling(())] }
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: rebound(x) }
    }
    fn first_crossing(
        &self,
        _: (),
        x: &State<2>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
        let time = x[1] + (x[1] * x[1] + 2.0 * x[0]).sqrt();
        if time > search.horizon {
            return Ok(NextEvent::never());
        }
        let state = Vector2::new(0.0, x[1] - time);
        Ok(NextEvent::Crossing(Crossing::exact((), time, state)))
    }
}

/// The ball whose impacts are searched, with or without bounds.
struct Searched {
    bounds: bool,
}

impl HybridSystem for Searched {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
        fall(x, t)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        const { &[Guard::falling(())] }
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        x[0]
    }
    fn guard_quasi_polynomial(&self, _: (), _: (), x: &State<2>) -> Option<QuasiPolynomial> {
        self.bounds.then(|| QuasiPolynomial::polynomial(&[x[0], x[1], -0.5]))
    }
    fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: rebound(x) }
    }
}

/// An integrated mode with one guard, the first component.
struct Integrated<F> {
    field: F,
    guards: [Guard<()>; 1],
    jump: fn(&State<2>) -> State<2>,
    tolerances: Tolerances,
}

impl<F: Fn(&State<2>) -> State<2>> HybridSystem for Integrated<F> {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, mode: (), x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, mode, x, t, self.tolerances)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        &self.guards
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: (self.jump)(x) }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<2>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
        integrated_crossing(self, mode, x, search, self.tolerances)
    }
    fn vector_field(&self, _: (), x: &State<2>) -> Option<State<2>> {
        Some((self.field)(x))
    }
}

/// An elastic ball.
fn ball(tolerance: f64) -> impl System<State<2>, (), ()> {
    Integrated {
        field: |x: &State<2>| Vector2::new(x[1], -1.0),
        guards: [Guard::falling(())],
        jump: rebound,
        tolerances: Tolerances::both(tolerance),
    }
}

/// The passages of a pendulum through its lowest point. Both directions count.
fn pendulum(tolerance: f64) -> impl System<State<2>, (), ()> {
    Integrated {
        field: |x: &State<2>| Vector2::new(x[1], -pxfm::f_sin(x[0])),
        guards: [Guard::either(()).crossing()],
        jump: |x| *x,
        tolerances: Tolerances::both(tolerance),
    }
}

/// The zeros of van der Pol's oscillator with μ = 5.
fn van_der_pol(tolerance: f64) -> impl System<State<2>, (), ()> {
    Integrated {
        field: |x: &State<2>| Vector2::new(x[1], 5.0 * (1.0 - x[0] * x[0]) * x[1] - x[0]),
        guards: [Guard::either(()).crossing()],
        jump: |x| *x,
        tolerances: Tolerances::both(tolerance),
    }
}

/// A scene: its name, and a run that returns the number of its events.
type Scene = (&'static str, Box<dyn Fn() -> usize>);

fn scene(
    name: &'static str,
    start: (f64, f64),
    interval: Option<f64>,
    system: impl System<State<2>, (), ()> + 'static,
) -> Scene {
    let run = move || {
        let limits = Limits { sampling_interval: interval, ..Limits::new(TIME, EVENTS) };
        let start = black_box(Vector2::new(start.0, start.1));
        let arcs = Execution::new(&system, (), start, limits);
        arcs.filter(|arc| arc.as_ref().unwrap().event().is_some()).count()
    };
    (name, Box::new(run))
}

fn scenes() -> Vec<Scene> {
    vec![
        scene("ball, exact", (0.5, 0.0), None, Solved),
        scene("ball, quasi-polynomial", (0.5, 0.0), None, Searched { bounds: true }),
        scene("ball, sampled", (0.5, 0.0), Some(0.7), Searched { bounds: false }),
        scene("ball, integrated, 1e-10", (0.5, 0.0), None, ball(1e-10)),
        scene("pendulum section, 1e-6", (1.0, 0.0), None, pendulum(1e-6)),
        scene("pendulum section, 1e-12", (1.0, 0.0), None, pendulum(1e-12)),
        scene("van der Pol, 1e-6", (2.0, 0.0), None, van_der_pol(1e-6)),
        scene("van der Pol, 1e-12", (2.0, 0.0), None, van_der_pol(1e-12)),
    ]
}

/// Time for one scene before the next one.
const SHARE: Duration = Duration::from_millis(250);

/// Prints the smallest time of an event in nanoseconds, for each scene whose name contains a text.
fn smallest(text: &str) {
    for (name, run) in scenes().into_iter().filter(|(name, _)| name.contains(text)) {
        let (begin, mut smallest) = (Instant::now(), f64::INFINITY);
        while begin.elapsed() < SHARE {
            let start = Instant::now();
            assert_eq!(run(), EVENTS, "{name}");
            smallest = smallest.min(start.elapsed().as_secs_f64());
        }
        println!("{name}\t{:.2}", 1e9 * smallest / EVENTS as f64);
    }
}

fn main() {
    let mut arguments = std::env::args().skip_while(|argument| argument != "--smallest").skip(1);
    if std::env::args().any(|argument| argument == "--smallest") {
        return smallest(&arguments.next().unwrap_or_default());
    }
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("events");
    group.throughput(Throughput::Elements(EVENTS as u64));
    for (name, run) in scenes() {
        group.bench_function(name, |bencher| bencher.iter(&run));
    }
    group.finish();
    criterion.final_summary();
}
