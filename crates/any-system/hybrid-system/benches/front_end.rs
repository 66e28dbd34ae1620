//! Cost of a model by closures against the same model by the trait: the thermostat, a bouncing ball with samples,
//! and the section of a pendulum. Many runs of equations, one by one and side by side.

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use hybrid_system::*;
use std::hint::black_box;
use std::ops::ControlFlow::Continue;

const TOLERANCE: f64 = 1e-9;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Heater {
    On,
    Off,
}
use Heater::{Off, On};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Surface {
    Warm,
    Cold,
}
use Surface::{Cold, Warm};

struct Room;

impl HybridSystem for Room {
    type State = State<1>;
    type Mode = Heater;
    type Surface = Surface;
    fn vector_field(&self, heater: Heater, x: &State<1>) -> Option<State<1>> {
        match heater {
            On => Some(State::from([30.0 - x[0]])),
            Off => Some(State::from([10.0 - x[0]])),
        }
    }
    fn flow(&self, heater: Heater, x: &State<1>, t: f64) -> State<1> {
        integrated_flow(self, heater, x, t, Tolerances::both(TOLERANCE))
    }
    fn guards(&self, heater: Heater) -> &[Guard<Surface>] {
        match heater {
            On => const { &[Guard::rising(Warm)] },
            Off => const { &[Guard::falling(Cold)] },
        }
    }
    fn guard_value(&self, surface: Surface, x: &State<1>) -> f64 {
        match surface {
            Warm => x[0] - 21.0,
            Cold => x[0] - 19.0,
        }
    }
    fn reset(&self, _: Heater, surface: Surface, x: &State<1>) -> Reset<Heater, State<1>> {
        match surface {
            Warm => Reset::Jump { mode: Off, state: *x },
            Cold => Reset::Jump { mode: On, state: *x },
        }
    }
    fn first_crossing(
        &self,
        heater: Heater,
        x: &State<1>,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State<1>>, Error> {
        integrated_crossing(self, heater, x, search, Tolerances::both(TOLERANCE))
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Floor;

struct Ball;

impl HybridSystem for Ball {
    type State = State<2>;
    type Mode = ();
    type Surface = Floor;
    fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
        State::from([x[0] + t * (x[1] - t / 2.0), x[1] - t])
    }
    fn guards(&self, (): ()) -> &[Guard<Floor>] {
        const { &[Guard::falling(Floor)] }
    }
    fn guard_value(&self, _: Floor, x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, (): (), _: Floor, x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: State::from([0.0, -x[1]]) }
    }
}

struct Pendulum;

impl HybridSystem for Pendulum {
    type State = State<2>;
    type Mode = ();
    type Surface = Floor;
    fn vector_field(&self, (): (), x: &State<2>) -> Option<State<2>> {
        Some(State::from([x[1], -pxfm::f_sin(x[0])]))
    }
    fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
        integrated_flow(self, (), x, t, Tolerances::both(TOLERANCE))
    }
    fn guards(&self, (): ()) -> &[Guard<Floor>] {
        const { &[Guard::falling(Floor).crossing()] }
    }
    fn guard_value(&self, _: Floor, x: &State<2>) -> f64 {
        x[0]
    }
    fn reset(&self, (): (), _: Floor, x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: *x }
    }
    fn first_crossing(
        &self,
        (): (),
        x: &State<2>,
        search: &Search<Floor>,
    ) -> Result<NextEvent<Floor, State<2>>, Error> {
        integrated_crossing(self, (), x, search, Tolerances::both(TOLERANCE))
    }
}

fn front_end(criterion: &mut Criterion) {
    let room = Model::integrated(|heater, x: &State<1>| match heater {
        On => [30.0 - x[0]],
        Off => [10.0 - x[0]],
    })
    .tolerance(TOLERANCE)
    .rising(On, |x| x[0] - 21.0, |x| (Off, *x))
    .falling(Off, |x| x[0] - 19.0, |x| (On, *x));
    let named = Model::integrated(|heater, x: &State<1>| match heater {
        On => [30.0 - x[0]],
        Off => [10.0 - x[0]],
    })
    .tolerance(TOLERANCE)
    .guard(On, Guard::rising("warm"), |x| x[0] - 21.0, |x| (Off, *x))
    .guard(Off, Guard::falling("cold"), |x| x[0] - 19.0, |x| (On, *x));
    let ball = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
        .falling((), |x| x[0], |x| ((), [0.0, -x[1]]));
    let pendulum = Model::integrated(|(), x: &State<2>| [x[1], -pxfm::f_sin(x[0])])
        .tolerance(TOLERANCE)
        .observer(Guard::falling(0), |x| x[0]);
    fn run<T: HybridSystem>(
        criterion: &mut Criterion,
        name: &str,
        system: &T,
        (mode, start, limits): (T::Mode, T::State, Limits),
    ) {
        criterion.bench_function(name, |bencher| {
            bencher.iter(|| Execution::new(system, mode, black_box(start.clone()), limits).count());
        });
    }
    let (events, warm) = (Limits::new(1e3, 100), State::from([15.0]));
    run(criterion, "100 switches of a thermostat: trait", &Room, (On, warm, events));
    run(criterion, "100 switches of a thermostat: closures", &room, (On, warm, events));
    run(criterion, "100 switches of a thermostat: closures, names", &named, (On, warm, events));
    let (samples, high) = (Limits::sampled(1e3, 100, 0.05), State::from([0.5, 0.0]));
    run(criterion, "100 bounces of a ball, sampled: trait", &Ball, ((), high, samples));
    run(criterion, "100 bounces of a ball, sampled: closures", &ball, ((), high, samples));
    let swing = State::from([1.0, 0.0]);
    run(criterion, "100 returns of a pendulum: trait", &Pendulum, ((), swing, events));
    run(criterion, "100 returns of a pendulum: closures", &pendulum, ((), swing, events));
}

/// 64 runs of an oscillator with a stop every 5 time units, of one whose guard is far away, and of a leg.
fn many_runs(criterion: &mut Criterion) {
    let names = || Equations::new(&["x", "v"], &[]);
    let stop = names()
        .mode_text("m", &["v", "cos(1.3*t) - 0.1*v - x - x^3"])
        .rising_text("stop", "x - 0.5")
        .resets_text(&["x", "-0.8*v"]);
    let rare = names()
        .mode_text("m", &["v", "x - x^3 - 0.15*v + 0.3*cos(t)"])
        .rising_text("out", "x - 5")
        .stops();
    fn compare<const N: usize>(
        criterion: &mut Criterion,
        name: &str,
        model: &EquationsModel<State<N>>,
        (mode, start, end): (&str, impl Fn(f64) -> State<N> + Sync, f64),
    ) {
        let run = |k: usize| model.start(mode, start(0.001 * k as f64), end);
        criterion.bench_function(&format!("64 runs {name}: one by one"), |bencher| {
            bencher.iter(|| (0..64).map(|k| run(k).unwrap().fate().events).sum::<usize>());
        });
        criterion.bench_function(&format!("64 runs {name}: side by side"), |bencher| {
            bencher.iter(|| model.fates(64, run, |_| Continue(())).len());
        });
    }
    let start = |x: f64| State::from([0.1 + x, 0.0, 0.0]);
    let (stop, rare) = (stop.model().unwrap(), rare.model().unwrap());
    compare(criterion, "with a stop", &stop, ("m", start, 100.0));
    compare(criterion, "without an event", &rare, ("m", start, 100.0));
    let leg = example_systems::spring_leg::spring_leg().model().unwrap();
    let apex = |x: f64| State::from([0.0, 0.98 + 0.1 * x, 5.0, 0.0]);
    compare(criterion, "of a leg", &leg, ("flight", apex, 20.0));
}

criterion_group!(benches, front_end, many_runs);
criterion_main!(benches);
