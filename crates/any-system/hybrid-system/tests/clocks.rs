//! Guards that are clocks: periodic and preset times.

use hybrid_system::*;
use nalgebra::{Vector1, Vector2};

/// A system whose only guards are clocks.
struct Clocked<F, R> {
    flow: F,
    reset: R,
    guards: Vec<Guard<usize>>,
    next: Vec<Box<dyn Fn(f64) -> Option<f64>>>,
}

impl<F, R, const N: usize> HybridSystem for Clocked<F, (R, [(); N])>
where
    F: Fn(&State<N>, f64) -> State<N>,
    R: Fn(usize, &State<N>) -> State<N>,
{
    type State = State<N>;
    type Mode = ();
    type Surface = usize;
    fn flow(&self, _: (), x: &State<N>, t: f64) -> State<N> {
        (self.flow)(x, t)
    }
    fn guards(&self, _: ()) -> &[Guard<usize>] {
        &self.guards
    }
    fn guard_value(&self, _: usize, _: &State<N>) -> f64 {
        1.0
    }
    fn reset(&self, _: (), clock: usize, x: &State<N>) -> Reset<(), State<N>> {
        Reset::Jump { mode: (), state: (self.reset.0)(clock, x) }
    }
    fn next_time(&self, _: (), clock: usize, after: f64) -> Option<f64> {
        (self.next[clock])(after)
    }
}

fn clocked<F, R, const N: usize>(
    flow: F,
    reset: R,
    next: Vec<Box<dyn Fn(f64) -> Option<f64>>>,
) -> Clocked<F, (R, [(); N])>
where
    F: Fn(&State<N>, f64) -> State<N>,
    R: Fn(usize, &State<N>) -> State<N>,
{
    let guards = (0..next.len()).map(Guard::clock).collect();
    Clocked { flow, reset: (reset, [(); N]), guards, next }
}

fn periodic(first: f64, period: f64) -> Box<dyn Fn(f64) -> Option<f64>> {
    let times = PeriodicTimes::new(first, period).unwrap();
    Box::new(move |after| times.next_after(after))
}

fn events<T: HybridSystem<Mode = ()>>(
    system: &T,
    start: T::State,
    (from, to): (f64, f64),
) -> Vec<Event<(), T::Surface, T::State>> {
    Execution::new(system, (), start, Limits::new(to, 1_000_000))
        .starting_at(from)
        .filter_map(|arc| arc.unwrap().event().cloned())
        .collect()
}

/// ẋ = u, and u = −2x is held from each sample to the next: x is multiplied by 1 − 2·0.1 from sample to sample.
#[test]
fn a_sampled_controller_holds_its_input() {
    let controller = clocked(
        |x: &State<2>, t| Vector2::new(x[0] + x[1] * t, x[1]),
        |_, x: &State<2>| Vector2::new(x[0], -2.0 * x[0]),
        vec![periodic(0.1, 0.1)],
    );
    let found = events(&controller, Vector2::new(1.0, -2.0), (0.0, 5.0));
    assert_eq!(found.len(), 50);
    for (k, event) in (1..).zip(&found) {
        assert_eq!(event.kind, EventKind::Clock);
        // The k-th tick is the double nearest to k times the double 0.1.
        assert!((event.time - 0.1 * f64::from(k)).abs() <= 4.0 * f64::EPSILON);
        assert!((event.before[0] - 0.8f64.powi(k)).abs() < 1e-14, "{event:?}");
        assert_eq!(event.at_time_limit, k == 50);
    }
}

/// The kicked rotor is the standard map.
#[test]
fn a_kicked_rotor_follows_the_standard_map() {
    let kick = |_: usize, x: &State<2>| Vector2::new(x[0], x[1] + 0.5 * x[0].sin());
    let rotor = clocked(
        |x: &State<2>, t| Vector2::new(x[0] + x[1] * t, x[1]),
        kick,
        vec![periodic(1.0, 1.0)],
    );
    let start = Vector2::new(1.0, 0.3);
    let found = events(&rotor, start, (0.0, 1000.5));
    assert_eq!(found.len(), 1000);
    let mut x = start;
    for event in found {
        x = Vector2::new(x[0] + x[1], x[1]);
        assert_eq!(event.before, x);
        x = kick(0, &x);
    }
}

/// From t = 10⁸ the sum of durations of 0.1 in one double is 6 % of a period behind after a million ticks.
#[test]
fn a_clock_does_not_drift() {
    let ticks = clocked(|x: &State<1>, _| *x, |_, x| *x, vec![periodic(1e8, 0.1)]);
    let found = events(&ticks, Vector1::new(0.0), (1e8, 1e8 + 2e4));
    assert_eq!(found.len(), 200_000);
    for (k, event) in (1..).zip(&found) {
        assert!((event.time - (1e8 + 0.1 * f64::from(k))).abs() <= 2e-8, "{k} {}", event.time);
    }
    assert_eq!(found[199_999].time, 1e8 + 2e4);
    assert!(found[199_999].at_time_limit);
}

#[test]
fn preset_times_happen_once_each() {
    let preset = PresetTimes::new([0.5, 2.0, 3.5]).unwrap();
    let system = clocked(
        |x: &State<1>, t| Vector1::new(x[0] + t),
        |_, _: &State<1>| Vector1::new(0.0),
        vec![Box::new(move |after| preset.next_after(after))],
    );
    let found = events(&system, Vector1::new(0.0), (0.0, 10.0));
    let times: Vec<_> = found.iter().map(|event| (event.time, event.before[0])).collect();
    assert_eq!(times, [(0.5, 0.5), (2.0, 1.5), (3.5, 1.5)]);
    // From a later start, only the later ones.
    assert_eq!(events(&system, Vector1::new(0.0), (2.0, 10.0)).len(), 1);
}

#[test]
fn two_clocks_at_one_instant_have_an_event_each() {
    let both = clocked(
        |x: &State<1>, _| *x,
        |clock, x: &State<1>| Vector1::new(10.0 * x[0] + clock as f64 + 1.0),
        vec![periodic(2.0, 2.0), periodic(3.0, 3.0)],
    );
    let found = events(&both, Vector1::new(0.0), (0.0, 12.0));
    let times: Vec<_> = found.iter().map(|event| (event.time, event.surface)).collect();
    let expected = [
        (2., 0),
        (3., 1),
        (4., 0),
        (6., 0),
        (6., 1),
        (8., 0),
        (9., 1),
        (10., 0),
        (12., 0),
        (12., 1),
    ];
    assert_eq!(times, expected);
    // Both events at the limit lie on it.
    let flags: Vec<_> = found.iter().map(|event| event.at_time_limit).collect();
    assert_eq!(flags[8..], [true, true]);
    assert!(flags[..8].iter().all(|flag| !flag));
}

#[test]
fn a_clock_that_does_not_move_on_is_an_error() {
    // Neighbouring doubles at 1e17 are 16 apart.
    let stuck: Vec<Box<dyn Fn(f64) -> Option<f64>>> =
        vec![Box::new(Some), Box::new(|_| Some(f64::NAN)), periodic(0.0, 0.1)];
    for clock in stuck {
        let system = clocked(|x: &State<1>, _| *x, |_, x| *x, vec![clock]);
        let mut execution = Execution::new(&system, (), Vector1::new(0.0), Limits::new(2e17, 100))
            .starting_at(1e17);
        assert!(matches!(execution.next(), Some(Err(Error::BadLimit { .. }))));
        assert_eq!(execution.stop(), Some(Stop::Failed));
    }
}

/// x = vt passes 1 at the time of a clock, 1/v, within rounding: on either side of it, or exactly.
#[test]
fn an_observer_that_is_crossed_at_the_time_of_a_clock_has_one_event() {
    for k in 1..100 {
        let speed = 0.37 * f64::from(k);
        let tick = 1.0 / speed;
        let clock = PeriodicTimes::new(tick, tick).unwrap();
        for observer in [Guard::either(1), Guard::rising(1)] {
            let line = || {
                Model::closed_form(move |(), x: &State<1>, t| [x[0] + speed * t])
                    .clock((), 0, move |after| clock.next_after(after), |(), x| ((), *x))
                    .observer(observer, |x| x[0] - 1.0)
            };
            let signal =
                move |(), x: &State<1>| Some(QuasiPolynomial::polynomial(&[x[0] - 1.0, speed]));
            let by_signal = line().signal(1, signal);
            let sampled = line().sampled(0.1 * tick);
            let count = |arcs: Vec<Arc<(), i32, State<1>>>| {
                arcs.iter().filter_map(Arc::event).filter(|event| event.surface == 1).count()
            };
            let end = 3.1 * tick;
            let arcs = by_signal.run((), [0.0], end).collect::<Result<_, _>>().unwrap();
            assert_eq!(count(arcs), 1, "signal, {k}");
            let arcs = sampled.run((), [0.0], end).collect::<Result<_, _>>().unwrap();
            assert_eq!(count(arcs), 1, "sampled, {k}");
        }
    }
}

#[test]
fn an_infinite_time_of_a_clock_never_comes() {
    let decay = Model::closed_form(|(), x: &State<1>, t| [x[0] / (1.0 + t)]).clock(
        (),
        0,
        |_| Some(f64::INFINITY),
        |(), x| ((), *x),
    );
    for end in [3.0, f64::INFINITY] {
        let arcs: Vec<_> = decay.run((), [1.0], end).collect::<Result<_, _>>().unwrap();
        assert!(arcs.len() == 1 && arcs[0].event().is_none() && arcs[0].duration == end);
    }
}
