//! Stops and clocks some ulps beside events lose none of them and double none, in random scenes: oscillators and balls,
//! by steps, samples and signals, with equal and different guards.

#![cfg(feature = "ode")]

use hybrid_system::*;

/// How events are found.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Search {
    Integrated(f64),
    Sampled,
    Signal,
}

/// What an event does.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Does {
    /// Nothing: an observer.
    Watches,
    /// The velocity turns round, times this factor: a contact, of the position.
    Bounces(f64),
    /// The position or the velocity shrinks by a tenth.
    Shrinks(usize),
    /// The position doubles.
    Doubles,
}

/// The guard a·x + b·v − c, or the square x² + v − c.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Value {
    Plane(f64, f64, f64),
    Square(f64),
}

#[derive(Debug, Clone)]
struct Scene {
    /// Of the oscillator ẍ = −x, of the ball ẍ = −1, or of a nonlinear one.
    field: usize,
    search: Search,
    guards: Vec<(Guard<usize>, Value, Does)>,
    list: Vec<Guard<usize>>,
    clocks: Vec<f64>,
}

impl Scene {
    fn new(field: usize, search: Search, guards: Vec<(Guard<usize>, Value, Does)>) -> Self {
        let list = guards.iter().map(|guard| guard.0).collect();
        Scene { field, search, guards, list, clocks: Vec::new() }
    }

    fn with_clocks(&self, clocks: &[f64]) -> Self {
        let mut scene = self.clone();
        scene.list.push(Guard::clock(self.guards.len()));
        scene.clocks = clocks.to_vec();
        scene
    }
}

impl HybridSystem for Scene {
    type State = State<2>;
    type Mode = u32;
    type Surface = usize;
    fn flow(&self, mode: u32, x: &State<2>, t: f64) -> State<2> {
        match (self.search, self.field) {
            (Search::Integrated(tolerance), _) => {
                integrated_flow(self, mode, x, t, Tolerances::both(tolerance))
            }
            (_, 0) => {
                State::<2>::new(x[0] * t.cos() + x[1] * t.sin(), x[1] * t.cos() - x[0] * t.sin())
            }
            _ => State::<2>::new(x[0] + t * (x[1] - 0.5 * t), x[1] - t),
        }
    }
    fn vector_field(&self, _: u32, x: &State<2>) -> Option<State<2>> {
        Some(State::<2>::new(x[1], [-x[0], -1.0, x[0] - x[0].powi(3)][self.field]))
    }
    fn guards(&self, _: u32) -> &[Guard<usize>] {
        &self.list
    }
    fn guard_value(&self, surface: usize, x: &State<2>) -> f64 {
        match self.guards[surface].1 {
            Value::Plane(a, b, c) => a * x[0] + b * x[1] - c,
            Value::Square(c) => x[0] * x[0] + x[1] - c,
        }
    }
    fn guard_quasi_polynomial(
        &self,
        _: u32,
        surface: usize,
        x: &State<2>,
    ) -> Option<QuasiPolynomial> {
        let Value::Plane(a, b, c) = self.guards[surface].1 else { return None };
        let value = a * x[0] + b * x[1];
        (self.search == Search::Signal).then(|| match self.field {
            0 => {
                QuasiPolynomial::cosine(value, 1.0)
                    + QuasiPolynomial::sine(a * x[1] - b * x[0], 1.0)
                    + QuasiPolynomial::polynomial(&[-c])
            }
            _ => QuasiPolynomial::polynomial(&[value - c, a * x[1] - b, -0.5 * a]),
        })
    }
    fn next_time(&self, _: u32, _: usize, after: f64) -> Option<f64> {
        self.clocks.iter().copied().find(|&time| time > after)
    }
    fn reset(&self, mode: u32, surface: usize, x: &State<2>) -> Reset<u32, State<2>> {
        let mut state = *x;
        let does = self.guards.get(surface).map_or(Does::Watches, |guard| guard.2);
        match does {
            Does::Watches => {}
            Does::Bounces(factor) => state[1] *= -factor,
            Does::Shrinks(axis) => state[axis] *= 0.9,
            Does::Doubles => state[0] *= 2.0,
        }
        let changes_mode = matches!(does, Does::Shrinks(_) | Does::Doubles);
        Reset::Jump { mode: mode + u32::from(changes_mode), state }
    }
    fn first_crossing(
        &self,
        mode: u32,
        x: &State<2>,
        search: &hybrid_system::Search<usize>,
    ) -> Result<NextEvent<usize, State<2>>, Error> {
        match self.search {
            Search::Integrated(tolerance) => {
                integrated_crossing(self, mode, x, search, Tolerances::both(tolerance))
            }
            _ => default_search(self, mode, x, search),
        }
    }
}

/// Surface, time and error of an event.
type Found = (usize, f64, f64);

/// The events that are no ticks of a clock, up to each stop in turn.
fn events(scene: &Scene, start: [f64; 2], stops: &[f64]) -> Result<Vec<Found>, Error> {
    let limits = Limits::sampled(stops[0], 400, 0.02);
    let mut execution = Execution::new(scene, 0, start.into(), limits);
    let mut found = Vec::new();
    for stop in stops {
        for arc in execution.run_until(*stop) {
            if let Some(event) = arc?.event().filter(|event| event.kind != EventKind::Clock) {
                found.push((event.surface, event.time, event.time_error));
            }
        }
    }
    Ok(found)
}

fn moved(time: f64, ulps: i64) -> f64 {
    f64::from_bits(time.to_bits().wrapping_add_signed(ulps))
}

/// The end of the runs.
const END: f64 = 5.0;

/// Two zeros that are closer may be exchanged by runs with other steps, and a flight that is shorter may be lost in the
/// error of its ends.
const CLOSE: f64 = 1e-4;

/// The surfaces of the events before a time.
fn surfaces(events: &[Found], until: f64) -> Vec<usize> {
    events.iter().take_while(|event| event.1 < until).map(|event| event.0).collect()
}

/// The time up to which all runs have the same events: the end, or the first time with a large error.
fn known_until(events: &[Found]) -> f64 {
    events.iter().find(|event| event.2 > 0.1 * CLOSE).map_or(END, |event| event.1) - CLOSE
}

/// A scene, its start, and its events without a stop; `None` where two different zeros are too close to be told apart
/// by runs with different steps.
fn random_scene(random: &mut Random) -> Option<(Scene, [f64; 2], Vec<Found>)> {
    let search =
        [Search::Integrated(1e-12), Search::Integrated(1e-8), Search::Sampled, Search::Signal];
    let search = search[random.below(4)];
    let field = random.below(if matches!(search, Search::Integrated(_)) { 3 } else { 2 });
    let mut guards: Vec<(Guard<usize>, Value, Does)> = Vec::new();
    for surface in 0..1 + random.below(3) {
        let c = random.unit() - 0.5;
        let value = match guards.first() {
            Some(first) if random.below(2) == 0 => first.1,
            _ => [
                Value::Plane(1.0, 0.0, c),
                Value::Plane(0.0, 1.0, c),
                Value::Plane(1.0, 0.3, c),
                Value::Plane(1e5, 0.0, 1e5 * c),
                Value::Square(c),
            ][random.below(5)],
        };
        let direction = [Guard::rising, Guard::falling, Guard::either][random.below(3)];
        let does = [Does::Watches, Does::Watches, Does::Shrinks(0), Does::Shrinks(1)];
        guards.push((
            direction(surface).crossing().touch(Touch::Ignore),
            value,
            does[random.below(4)],
        ));
    }
    if field == 1 {
        let (surface, factor) = (guards.len(), if random.below(2) == 0 { 1.0 } else { 0.8 });
        let floor = Value::Plane(1.0, 0.0, 0.0);
        if random.below(2) == 0 {
            guards[0] = (Guard::falling(0).crossing(), floor, Does::Watches);
        }
        guards.push((Guard::falling(surface).contact(), floor, Does::Bounces(factor)));
    }
    let scene = Scene::new(field, search, guards);
    let start = [0.5 + random.unit(), 2.0 * random.unit() - 1.0];
    let whole = events(&scene, start, &[END]).ok()?;
    let close = whole.windows(2).any(|pair| {
        let [first, second] = [0, 1].map(|k| scene.guards[pair[k].0].1);
        pair[1].1 - pair[0].1 < CLOSE && first != second
    });
    (!close && whole.len() < 60).then_some((scene, start, whole))
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }
}

/// Random scenes: without optimization some hundred, which take some seconds.
const SCENES: usize = if cfg!(debug_assertions) { 200 } else { 40_000 };

#[test]
fn stops_and_clocks_some_ulps_beside_events_change_nothing() {
    let (mut random, mut tried) = (Random(0x2545_F491_4F6C_DD1D), 0);
    for _ in 0..SCENES {
        let Some((scene, start, whole)) = random_scene(&mut random) else { continue };
        for spread in [2, 8, 40] {
            let inner: Vec<_> =
                whole.iter().filter(|event| event.1 < known_until(&whole)).collect();
            if inner.is_empty() {
                break;
            }
            let at = inner[random.below(inner.len())].1;
            let mut times: Vec<f64> = (0..1 + random.below(3))
                .map(|_| moved(at, random.below(2 * spread + 1) as i64 - spread as i64))
                .collect();
            times.sort_by(f64::total_cmp);
            times.dedup();
            let found = match random.below(2) {
                0 => events(&scene.with_clocks(&times), start, &[END]),
                _ => events(&scene, start, &[times.as_slice(), &[END]].concat()),
            };
            let found =
                found.unwrap_or_else(|error| panic!("{scene:?} {start:?} {times:?}: {error}"));
            let [found, expected] =
                [&found, &whole].map(|events| surfaces(events, known_until(&whole)));
            assert_eq!(found, expected, "{scene:?} {start:?} {times:?}");
            tried += 1;
        }
    }
    assert!(tried > 2 * SCENES, "{tried}");
}

/// The top of an oscillation moves the state to twice the amplitude. A clock some ulps before or behind has its own
/// event, and the top has one.
#[test]
fn a_crossing_between_two_ticks_happens_once() {
    let top = vec![(Guard::falling(0).crossing(), Value::Plane(0.0, 1.0, 0.0), Does::Doubles)];
    let scene = Scene::new(0, Search::Integrated(1e-12), top);
    let top = std::f64::consts::FRAC_PI_2;
    for first in -12..12 {
        for second in first + 1..14 {
            let clocks = [moved(top, first), moved(top, second)];
            let found = events(&scene.with_clocks(&clocks), [0.0, 1.0], &[3.0]).unwrap();
            assert_eq!(found.len(), 1, "{first} {second}: {found:?}");
            let found = events(&scene, [0.0, 1.0], &[clocks[0], clocks[1], 3.0]).unwrap();
            assert_eq!(found.len(), 1, "{first} {second}: {found:?}");
        }
    }
}

/// An observer of the height of a ball is met together with its floor, also where the limit on time is ulps beside the
/// impact.
#[test]
fn an_observer_of_the_floor_is_met_with_it() {
    for height in 0..200 {
        for by in [Search::Integrated(1e-12), Search::Sampled, Search::Signal] {
            let start = [1.0 + 0.0137 * f64::from(height), 0.0];
            let floor = Value::Plane(1.0, 0.0, 0.0);
            let guards = vec![
                (Guard::falling(0).crossing(), floor, Does::Watches),
                (Guard::falling(1).contact(), floor, Does::Bounces(1.0)),
            ];
            let scene = Scene::new(1, by, guards);
            let impact = (2.0 * start[0]).sqrt();
            for ulps in -6..=6 {
                let stop = moved(impact, ulps);
                let found = events(&scene, start, &[stop, stop + 1e-3]).unwrap();
                let found: Vec<_> = found.iter().map(|event| event.0).collect();
                assert_eq!(found, [0, 1], "{by:?} {start:?} {ulps}");
            }
        }
    }
}
