//! A flow that goes on after an event or a stop: every guard keeps the side that the signs of the trajectory give it.

#![cfg(feature = "ode")]

use hybrid_system::*;

type Value = Box<dyn Fn(&State<2>) -> f64>;

/// How the oscillator ẍ = −ω²x is searched.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Searched {
    Integrated(f64),
    Sampled,
    Signal,
}

struct Oscillator {
    omega: f64,
    searched: Searched,
    guards: Vec<Guard<usize>>,
    values: Vec<Value>,
    /// The level of a guard x − c, for its signal.
    levels: Vec<f64>,
    bounces: bool,
}

impl HybridSystem for Oscillator {
    type State = State<2>;
    type Mode = ();
    type Surface = usize;
    fn flow(&self, (): (), x: &State<2>, t: f64) -> State<2> {
        let (w, (s, c)) = (self.omega, (self.omega * t).sin_cos());
        State::<2>::new(x[0] * c + x[1] / w * s, x[1] * c - w * x[0] * s)
    }
    fn vector_field(&self, (): (), x: &State<2>) -> Option<State<2>> {
        Some(State::<2>::new(x[1], -self.omega * self.omega * x[0]))
    }
    fn guards(&self, (): ()) -> &[Guard<usize>] {
        &self.guards
    }
    fn guard_value(&self, surface: usize, x: &State<2>) -> f64 {
        self.values[surface](x)
    }
    fn guard_quasi_polynomial(
        &self,
        (): (),
        surface: usize,
        x: &State<2>,
    ) -> Option<QuasiPolynomial> {
        let wave = || {
            QuasiPolynomial::cosine(x[0], self.omega)
                + QuasiPolynomial::sine(x[1] / self.omega, self.omega)
                + QuasiPolynomial::polynomial(&[-self.levels[surface]])
        };
        (self.searched == Searched::Signal).then(wave)
    }
    fn reset(&self, (): (), _: usize, x: &State<2>) -> Reset<(), State<2>> {
        let state = if self.bounces { State::<2>::new(x[0], -x[1]) } else { *x };
        Reset::Jump { mode: (), state }
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<2>,
        search: &Search<usize>,
    ) -> Result<NextEvent<usize, State<2>>, Error> {
        match self.searched {
            Searched::Integrated(tolerance) => {
                integrated_crossing(self, mode, x, search, Tolerances::both(tolerance))
            }
            _ => default_search(self, mode, x, search),
        }
    }
}

/// The events up to each of some stops, one after the other: surface and time.
fn events(
    model: &Oscillator,
    start: [f64; 2],
    stops: &[f64],
) -> Result<(Vec<(usize, f64)>, State<2>), Error> {
    let mut execution =
        Execution::new(model, (), start.into(), Limits::sampled(stops[0], 1000, 0.02));
    let mut found = Vec::new();
    for stop in stops {
        for arc in execution.run_until(*stop) {
            if let Some(event) = arc?.event() {
                found.push((event.surface, event.time));
            }
        }
    }
    Ok((found, *execution.state()))
}

fn watched(omega: f64, searched: Searched, guards: Vec<(Guard<usize>, Value, f64)>) -> Oscillator {
    let mut model = Oscillator {
        omega,
        searched,
        guards: Vec::new(),
        values: Vec::new(),
        levels: Vec::new(),
        bounces: false,
    };
    for (guard, value, level) in guards {
        model.guards.push(guard.touch(Touch::Ignore));
        model.values.push(value);
        model.levels.push(level);
    }
    model
}

fn line(level: f64) -> Value {
    Box::new(move |x| x[0] - level)
}

const DIRECTIONS: [fn(usize) -> Guard<usize>; 3] = [Guard::rising, Guard::falling, Guard::either];
const SEARCHES: [Searched; 4] =
    [Searched::Integrated(1e-6), Searched::Integrated(1e-10), Searched::Sampled, Searched::Signal];

/// A guard of two levels, or of many, has as many events as the line through its jump, whatever the levels and the
/// frequency: no later crossing is taken for the departure from the last one.
#[test]
fn levels_have_the_crossings_of_their_line() {
    for omega in [1.0, 3.0, 5.0] {
        for (low, high) in [(-1.0, 1.0), (-1.0, 5.0), (-1.0, 9.0), (-9.0, 1.0), (-1e-3, 1.0)] {
            for direction in DIRECTIONS {
                let guard = direction(0).crossing();
                for searched in [Searched::Integrated(1e-8), Searched::Sampled] {
                    let count = |value| {
                        let model = watched(omega, searched, vec![(guard, value, 0.5)]);
                        events(&model, [1.0, 0.0], &[4.0]).unwrap().0.len()
                    };
                    let exact = count(line(0.5));
                    let found = count(Box::new(move |x| if x[0] > 0.5 { high } else { low }));
                    assert_eq!(found, exact, "{omega} {low} {high} {guard:?} {searched:?}");
                }
            }
        }
    }
}

/// Without optimization one motion of three is tried.
const STEP: usize = if cfg!(debug_assertions) { 6 } else { 1 };

/// Stops some ulps beside each event of a line lose nothing and double nothing.
#[test]
fn stops_beside_any_event_change_nothing() {
    let mut wrong = Vec::new();
    for k in (0..24).step_by(STEP) {
        let (x, v, level) =
            (0.9 - 0.07 * f64::from(k), -1.7 + 0.15 * f64::from(k), 0.57 - 0.05 * f64::from(k));
        for direction in DIRECTIONS {
            for searched in SEARCHES {
                let model =
                    watched(3.0, searched, vec![(direction(0).crossing(), line(level), level)]);
                let (whole, _) = events(&model, [x, v], &[7.0]).unwrap();
                for at in whole.iter().take(3) {
                    for ulps in -6..=4 {
                        let stop = at.1 + f64::from(ulps) * f64::EPSILON * at.1;
                        let found = events(&model, [x, v], &[stop, 7.0]);
                        let same = |found: &(Vec<(usize, f64)>, State<2>)| {
                            found.0.len() == whole.len()
                                && found.0.iter().zip(&whole).all(|(a, b)| (a.1 - b.1).abs() < 1e-4)
                        };
                        if !found.as_ref().is_ok_and(same) {
                            wrong.push((
                                k,
                                searched,
                                ulps,
                                at.1,
                                found.map(|found| found.0),
                                whole.len(),
                            ));
                        }
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}: {:?}", wrong.len(), &wrong[..wrong.len().min(6)]);
}

/// Two observers of one motion, equal or ulps apart, are met together every time.
#[test]
fn two_observers_ulps_apart_are_met_every_time() {
    let mut wrong = Vec::new();
    // Without the one that starts between the two.
    for k in (0..40).step_by(STEP).filter(|k| *k != 20) {
        let (x, v, level) =
            (0.9 - 0.04 * f64::from(k), 1.6 - 0.07 * f64::from(k), 0.7 - 0.03 * f64::from(k));
        for apart in [0.0, 1e-16, 1e-15, 4e-15, 1e-9] {
            for direction in DIRECTIONS {
                for searched in SEARCHES {
                    let other = level + apart;
                    let guards = vec![
                        (direction(0).crossing(), line(level), level),
                        (direction(1).crossing(), line(other), other),
                    ];
                    let model = watched(3.0, searched, guards);
                    let found = events(&model, [x, v], &[7.0]);
                    let count = |surface: usize| {
                        let own = |found: &(Vec<(usize, f64)>, State<2>)| {
                            found.0.iter().filter(|event| event.0 == surface).count()
                        };
                        found.as_ref().map(own).ok()
                    };
                    if count(0) != count(1) || count(0).is_none() {
                        wrong.push((k, apart, searched, count(0), count(1)));
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}: {:?}", wrong.len(), &wrong[..wrong.len().min(6)]);
}

/// A wall with a signal holds, from a start some ulps before it, and after a stop there.
#[test]
fn a_wall_with_a_signal_holds_beside_starts_and_stops() {
    for searched in SEARCHES {
        let mut model =
            watched(1.0, searched, vec![(Guard::falling(0).contact(), line(-0.5), -0.5)]);
        model.bounces = true;
        for k in [0, 1, 2, 4, 8, 12, 16, 24, 32, 64, 128] {
            let start = [-0.5 + f64::from(k) * 2f64.powi(-54), -1.0];
            match events(&model, start, &[1.0]) {
                Ok((_, state)) => assert!(state[0] > -0.5, "{searched:?} {k}: {state}"),
                Err(error) => assert!(
                    matches!(error, Error::UndecidedSign { .. } | Error::StartsBeyond { .. }),
                    "{error:?}"
                ),
            }
        }
        let hit = events(&model, [1.0, 0.0], &[3.0]).unwrap().0[0].1;
        for ulps in 0..40 {
            let stop = hit - f64::from(ulps) * 0.5 * f64::EPSILON * hit;
            let (found, state) = events(&model, [1.0, 0.0], &[stop, 4.0])
                .unwrap_or_else(|error| panic!("{searched:?} {ulps}: {error:?}"));
            assert!(
                state[0] > -0.5 - 1e-9 && found.len() == 1,
                "{searched:?} {ulps}: {found:?} {state}"
            );
        }
    }
}

/// A ball on a floor whose guard is a sign keeps above it, with a stop or a clock just before any impact.
#[test]
fn a_floor_with_a_sign_holds_beside_stops_and_clocks() {
    for (height, speed, floor) in
        [(0.5, 0.0, 0.0), (1.2, 0.0, 0.0), (0.834, 0.85, 0.0), (1.1, 0.3, 0.0), (0.7, 0.0, 0.1)]
    {
        let impact: f64 = speed + f64::sqrt(speed * speed + 2.0 * (height - floor));
        for before in [0.0, 1e-15, 5e-15, 1e-14, 1e-13, 1e-12, 1e-9, 1e-6, 1e-3] {
            let tick = impact - before;
            let ball = Model::integrated(|(), x: &State<2>| [x[1], -1.0])
                .falling(
                    (),
                    move |x| if x[0] > floor { 1.0 } else { -1.0 },
                    |x| ((), [x[0], -0.9 * x[1]]),
                )
                .contact()
                .clock((), 1, move |now| (now < tick).then_some(tick), |(), x| ((), *x));
            let mut execution =
                Execution::new(&ball, (), [height, speed].into(), Limits::new(6.0, 100));
            let failed = execution.by_ref().any(|arc| arc.is_err());
            assert!(
                failed || execution.state()[0] > floor - 1e-6,
                "clock {height} {before}: {}",
                execution.state()
            );
            let mut execution =
                Execution::new(&ball, (), [height, speed].into(), Limits::new(tick, 100));
            let failed = execution.by_ref().any(|arc| arc.is_err())
                || execution.run_until(6.0).any(|arc| arc.is_err());
            assert!(
                failed || execution.state()[0] > floor - 1e-6,
                "stop {height} {before}: {}",
                execution.state()
            );
        }
    }
}

/// A guard that jumps or bends just behind its zero has its event there, and no earlier at a stop before it.
#[test]
fn a_jump_behind_a_zero_is_no_reason_to_be_early() {
    let place = 0.7f64;
    let guards: [fn(f64) -> f64; 4] = [
        |x| if x <= 0.7 { x - 0.7 } else { 9.0 },
        |x| if x <= 0.7 { x - 0.7 } else { 1e5 },
        |x| (x - 0.7) * if x > 0.7 { 100.0 } else { 1.0 },
        |x| (x - 0.7) * if x > 0.7 { 1e4 } else { 1.0 },
    ];
    for (kind, guard) in guards.into_iter().enumerate() {
        for before in [1e-8, 1e-10, 1e-12, 1e-14, 1e-15] {
            let line = Model::integrated(|(), _: &State<1>| [1.0]).guard(
                (),
                Guard::rising(0).crossing().touch(Touch::Ignore),
                move |x: &State<1>| guard(x[0]),
                |x: &State<1>| ((), *x),
            );
            let mut execution =
                Execution::new(&line, (), [0.0].into(), Limits::new(place - before, 10));
            let mut found: Vec<f64> = Vec::new();
            for stop in [place - before, place - 0.5 * before, 2.0] {
                for arc in execution.run_until(stop) {
                    found.extend(arc.unwrap().event().map(|event| event.time));
                }
            }
            assert!(
                found.len() == 1 && (found[0] - place).abs() < 4e-15,
                "{kind} {before}: {found:?}"
            );
        }
    }
}
