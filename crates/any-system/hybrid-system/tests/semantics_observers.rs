//! The scenes of the page `hybrid_system::semantics` in which a guard watches: observers on a circle, triple roots,
//! jumps of a guard, and guards that fall and rise in turn. A transversal crossing is never a grazing.

use hybrid_system::*;
use nalgebra::{Vector1, Vector2};

/// Tolerances of the integrated circle.
const TOLERANCES: Tolerances = Tolerances::both(1e-12);

/// Observers of one function along ẋ = y, ẏ = −x.
struct Circle<G> {
    guard: G,
    guards: [Guard<()>; 1],
    integrated: bool,
}

impl<G: Fn(&State<2>) -> f64> HybridSystem for Circle<G> {
    type State = State<2>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<2>, t: f64) -> State<2> {
        if self.integrated {
            return integrated_flow(self, (), x, t, TOLERANCES);
        }
        let (sin, cos) = t.sin_cos();
        Vector2::new(x[0] * cos + x[1] * sin, x[1] * cos - x[0] * sin)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        &self.guards
    }
    fn guard_value(&self, _: (), x: &State<2>) -> f64 {
        (self.guard)(x)
    }
    fn reset(&self, _: (), _: (), x: &State<2>) -> Reset<(), State<2>> {
        Reset::Jump { mode: (), state: *x }
    }
    fn vector_field(&self, _: (), x: &State<2>) -> Option<State<2>> {
        Some(Vector2::new(x[1], -x[0]))
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<2>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<2>>, Error> {
        if self.integrated {
            integrated_crossing(self, mode, x, search, TOLERANCES)
        } else {
            default_search(self, mode, x, search)
        }
    }
}

/// Length of a run: a little more than three turns.
const LENGTH: f64 = 20.0;

/// The shortest angle between two crossings, and between a crossing and the ends of the run, for which a run is
/// counted. Closer crossings may lie between two samples.
const CLEAR: f64 = 0.05;

/// Number of changes of sign of the guard on the circle, and whether they are clear of each other. The values are
/// taken at points of the exact circle: this count shares nothing with the search.
fn count(guard: impl Fn(&State<2>) -> f64, start: f64) -> Option<usize> {
    /// So fine that two changes of sign that are `CLEAR` are some 300 points apart.
    const POINTS: usize = 120_000;
    let value = |k: usize| {
        let angle = start - LENGTH * k as f64 / POINTS as f64;
        guard(&Vector2::new(angle.cos(), angle.sin()))
    };
    let mut last = 0.0;
    let mut crossings = 0;
    let mut before = value(0);
    for k in 1..=POINTS {
        let now = value(k);
        if (before < 0.0) != (now < 0.0) {
            let at = LENGTH * k as f64 / POINTS as f64;
            if at - last < CLEAR {
                return None;
            }
            (last, crossings) = (at, crossings + 1);
        }
        before = now;
    }
    (LENGTH - last > CLEAR).then_some(crossings)
}

/// Parameters that fill (0, 1)³ evenly: additive recurrence with the powers of the plastic-like root for three
/// dimensions.
fn parameters(k: usize) -> [f64; 3] {
    [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_2]
        .map(|step| (0.5 + step * (k + 1) as f64).fract())
}

/// Runs with many parameters: each ends without an error and finds each crossing once.
#[track_caller]
fn all_crossings_are_found<G: Fn(&State<2>) -> f64>(guard_of: impl Fn([f64; 3]) -> G) {
    let mut runs = 0;
    for k in 0..60 {
        let [a, b, c] = parameters(k);
        let start = std::f64::consts::TAU * c;
        let Some(crossings) = count(guard_of([a, b, c]), start) else { continue };
        for integrated in [false, true] {
            let guard = guard_of([a, b, c]);
            let system = Circle { guard, guards: [Guard::either(()).crossing()], integrated };
            let limits = Limits::sampled(LENGTH, 1000, 0.02);
            let first = Vector2::new(start.cos(), start.sin());
            let arcs: Result<Vec<_>, Error> = Execution::new(&system, (), first, limits).collect();
            let arcs =
                arcs.unwrap_or_else(|error| panic!("{:?}, {integrated}: {error}", [a, b, c]));
            let found = arcs.iter().filter_map(Arc::event).count();
            assert_eq!(found, crossings, "{:?}, integrated: {integrated}", [a, b, c]);
        }
        runs += 1;
    }
    // The others have crossings that are too close to each other or to the ends.
    assert!(runs >= 20, "{runs}");
}

#[test]
fn an_observer_of_another_circle_never_grazes_at_a_crossing() {
    all_crossings_are_found(|[a, b, r]| {
        move |x: &State<2>| (x[0] - a).powi(2) + (x[1] - b).powi(2) - (0.5 + r).powi(2)
    });
}

#[test]
fn an_observer_of_an_exponential_never_grazes_at_a_crossing() {
    all_crossings_are_found(|[c, ..]| move |x: &State<2>| x[0].exp() - 0.4 - 2.2 * c);
}

#[test]
fn an_observer_of_a_distance_never_grazes_at_a_crossing() {
    all_crossings_are_found(|[d, ..]| move |x: &State<2>| (x[0] - 2.0).hypot(x[1]) - 1.0 - 2.0 * d);
}

#[test]
fn an_observer_of_an_angle_never_grazes_at_a_crossing() {
    all_crossings_are_found(|[p, ..]| move |x: &State<2>| (x[1].atan2(x[0]) + 6.0 * p).sin());
}

#[test]
fn an_observer_of_a_sum_of_sines_never_grazes_at_a_crossing() {
    all_crossings_are_found(|[a, b, _]| {
        move |x: &State<2>| (3.0 * x[0] + a).sin() + (2.0 * x[1] + 5.0 * b).sin() + 0.3
    });
}

/// A function of x along ẋ = 1, watched both ways.
struct Line<G> {
    guard: G,
    guards: [Guard<()>; 1],
    integrated: bool,
}

impl<G: Fn(f64) -> f64> HybridSystem for Line<G> {
    type State = State<1>;
    type Mode = ();
    type Surface = ();
    fn flow(&self, _: (), x: &State<1>, t: f64) -> State<1> {
        Vector1::new(x[0] + t)
    }
    fn guards(&self, _: ()) -> &[Guard<()>] {
        &self.guards
    }
    fn guard_value(&self, _: (), x: &State<1>) -> f64 {
        (self.guard)(x[0])
    }
    fn reset(&self, _: (), _: (), x: &State<1>) -> Reset<(), State<1>> {
        Reset::Jump { mode: (), state: *x }
    }
    fn vector_field(&self, _: (), _: &State<1>) -> Option<State<1>> {
        Some(Vector1::new(1.0))
    }
    fn first_crossing(
        &self,
        mode: (),
        x: &State<1>,
        search: &Search<()>,
    ) -> Result<NextEvent<(), State<1>>, Error> {
        if self.integrated {
            integrated_crossing(self, mode, x, search, TOLERANCES)
        } else {
            default_search(self, mode, x, search)
        }
    }
}

/// The states at the events of an observer.
fn watched(guard: impl Fn(f64) -> f64 + Copy, start: f64, time: f64, integrated: bool) -> Vec<f64> {
    let system = Line { guard, guards: [Guard::either(()).crossing()], integrated };
    let limits = Limits::sampled(time, 10_000, 1e-3);
    Execution::new(&system, (), Vector1::new(start), limits)
        .filter_map(|arc| {
            arc.unwrap_or_else(|error| panic!("{integrated}: {error}"))
                .event()
                .map(|event| event.before[0])
        })
        .collect()
}

#[test]
fn a_triple_root_is_a_crossing() {
    for integrated in [false, true] {
        let found = watched(|x| (x - 1.0).powi(3), 0.0, 2.5, integrated);
        assert_eq!(found.len(), 1, "{found:?}");
        // Within 1e-5 of the root, (x − 1)³ is below the rounding of its terms, 1e-16.
        assert!((found[0] - 1.0).abs() < 1e-5, "{found:?}");
    }
}

#[test]
fn an_oscillation_of_a_large_component_has_crossings() {
    // At 1e8 the component has a rounding error of 1.5e-8, and sin(1000 x) one of 1.5e-5.
    for integrated in [false, true] {
        let found = watched(|x| (1000.0 * x).sin(), 1e8, 0.1, integrated);
        // 0.1 · 1000/π = 31.8 half waves.
        assert!((31..=32).contains(&found.len()), "{integrated}: {}", found.len());
    }
}

#[test]
fn a_jump_of_a_guard_is_located() {
    for integrated in [false, true] {
        let found = watched(|x| if x < 0.7 { -1.0 } else { 2.0 }, 0.0, 2.0, integrated);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0] - 0.7).abs() < 1e-12, "{found:?}");
    }
}

/// A ball with e = 1 and two observers: at a quarter of its height, and at its tops. It stops at each of its
/// events, or a few ulps behind it.
#[test]
fn a_stop_just_behind_an_event_counts_no_event_twice() {
    for height in [0.123, 0.37, 0.5, 1.7] {
        let flow = |(), x: &State<2>, t: f64| [x[0] + t * (x[1] - t / 2.0), x[1] - t];
        let ball = || {
            Model::closed_form(flow)
                .falling((), |x| x[0], |x| ((), [0.0, -x[1]]))
                .observer(Guard::either(1), move |x| x[0] - 0.25 * height)
                .observer(Guard::falling(2), |x| x[1])
        };
        let signal = QuasiPolynomial::polynomial;
        let signals = ball()
            .signal(0, move |(), x| Some(signal(&[x[0], x[1], -0.5])))
            .signal(1, move |(), x| Some(signal(&[x[0] - 0.25 * height, x[1], -0.5])))
            .signal(2, move |(), x| Some(signal(&[x[1], -1.0])));
        let integrated = Model::integrated(|(), x: &State<2>| [x[1], -1.0])
            .falling((), |x| x[0], |x| ((), [0.0, -x[1]]))
            .observer(Guard::either(1), move |x| x[0] - 0.25 * height)
            .observer(Guard::falling(2), |x| x[1]);
        stops_count_nothing_twice(&signals, height);
        stops_count_nothing_twice(&ball().sampled(0.07), height);
        stops_count_nothing_twice(&integrated, height);
    }
}

#[track_caller]
fn stops_count_nothing_twice<T>(ball: &T, height: f64)
where
    T: HybridSystem<State = State<2>, Mode = (), Surface = usize>,
{
    let limits = Limits::sampled(12.0, 1000, 0.07);
    let start = State::from([height, 0.0]);
    let events = |arcs: Vec<Arc<(), usize, State<2>>>| -> Vec<(usize, f64)> {
        arcs.iter().filter_map(Arc::event).map(|event| (event.surface, event.time)).collect()
    };
    let whole = Execution::new(ball, (), start, limits).collect::<Result<_, _>>().unwrap();
    let whole = events(whole);
    assert!(whole.len() > 10);
    for ulps in 0..4 {
        let (mut execution, mut last) = (Execution::new(ball, (), start, limits), 12.0f64);
        let mut arcs = Vec::new();
        for (_, time) in &whole {
            let stop = (0..ulps).fold(*time, |time, _| time.next_up());
            arcs.extend(execution.run_until(stop).map(Result::unwrap));
            last = last.max(stop.next_up().next_up());
        }
        arcs.extend(execution.run_until(last).map(Result::unwrap));
        let found = events(arcs);
        let surfaces = |list: &[(usize, f64)]| list.iter().map(|event| event.0).collect::<Vec<_>>();
        assert_eq!(surfaces(&found), surfaces(&whole), "{height}, {ulps} ulps: {found:?}");
        for (found, whole) in found.iter().zip(&whole) {
            assert!((found.1 - whole.1).abs() < 1e-9, "{height}, {ulps} ulps: {found:?} {whole:?}");
        }
    }
}

/// The direction of an event: of a guard that counts both ways it alternates along a sine, however the guard is searched.
/// Touches and preset times have none.
#[test]
fn an_event_says_how_its_guard_has_changed_its_sign() {
    let directions = |arcs: Vec<Option<Direction>>| arcs.into_iter().flatten().collect::<Vec<_>>();
    let falls_first = [Direction::Falling, Direction::Rising, Direction::Falling];
    let swing = |x: &State<2>, t: f64| {
        let (sin, cos) = pxfm::f_sincos(t);
        [x[0] * cos + x[1] * sin, x[1] * cos - x[0] * sin]
    };
    let closed = || Model::closed_form(move |(), x: &State<2>, t| swing(x, t));
    let sampled = closed().either((), |x| x[0], |x| ((), *x)).sampled(0.1);
    let signal = closed().either((), |x| x[0], |x| ((), *x)).signal(0, |(), x| {
        Some(QuasiPolynomial::cosine(x[0], 1.0) + QuasiPolynomial::sine(x[1], 1.0))
    });
    let integrated =
        Model::integrated(|(), x: &State<2>| [x[1], -x[0]]).either((), |x| x[0], |x| ((), *x));
    let of = |arc: Result<Arc<(), usize, State<2>>, Error>| {
        arc.unwrap().event().and_then(|event| event.direction)
    };
    for start in [[1.0, 0.0], [0.0, -1.0]] {
        // From x = 0, falling, the first event is a rise.
        let expected = if start[0] > 0.0 {
            falls_first.to_vec()
        } else {
            vec![Direction::Rising, Direction::Falling, Direction::Rising]
        };
        assert_eq!(directions(sampled.run((), start, 9.5).map(of).collect()), expected);
        assert_eq!(directions(signal.run((), start, 9.5).map(of).collect()), expected);
        assert_eq!(directions(integrated.run((), start, 9.5).map(of).collect()), expected);
    }
    let neither = Equations::new(&["x", "v"], &[])
        .mode_text("m", &["v", "-x"])
        .clock_text("tick", "1", "1")
        .either_text("top", "x - 1")
        .touch(Touch::Event)
        .model::<State<2>>()
        .unwrap();
    let found: Vec<_> = neither.start("m", [0.0, 1.0], 3.5).unwrap().map(Result::unwrap).collect();
    let events: Vec<_> = found.iter().filter_map(Arc::event).collect();
    assert_eq!(events.len(), 4);
    assert!(events.iter().all(|event| event.direction.is_none()));
}
